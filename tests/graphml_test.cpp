// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "exporters/graphml.h"

#include <tinyxml2.h>

#include <set>

#include "exporters/export.h"
#include "support/scenes.h"
#include "world/topology.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

using Data = std::map<std::string, std::string>;

// A graph as a reader of the format sees it; checks what the schema demands on the way.
struct ReadGraph {
  std::map<std::string, Data> nodes;  // by id
  struct Edge {
    std::string source, target;
    Data data;
  };
  std::vector<Edge> edges;
};

ReadGraph read_graph(const std::filesystem::path& path) {
  tinyxml2::XMLDocument document;
  REQUIRE(document.Parse(read_file(path).c_str()) == tinyxml2::XML_SUCCESS);
  const tinyxml2::XMLElement* root = document.RootElement();
  CHECK(std::string(root->Name()) == "graphml");
  CHECK(std::string(root->Attribute("xmlns")) == "http://graphml.graphdrawing.org/xmlns");
  std::map<std::string, std::string> owner, type;
  const tinyxml2::XMLElement* child = root->FirstChildElement();
  for (; child && std::string(child->Name()) == "key"; child = child->NextSiblingElement()) {
    CHECK(owner.count(child->Attribute("id")) == 0);
    owner[child->Attribute("id")] = child->Attribute("for");
    type[child->Attribute("id")] = child->Attribute("attr.type");
    CHECK(child->Attribute("attr.name"));
  }
  REQUIRE(child);
  CHECK(std::string(child->Name()) == "graph");
  CHECK(std::string(child->Attribute("edgedefault")) == "undirected");
  CHECK_FALSE(child->NextSiblingElement());
  const auto data_of = [&](const tinyxml2::XMLElement* element) {
    Data data;
    for (auto* d = element->FirstChildElement(); d; d = d->NextSiblingElement()) {
      CHECK(std::string(d->Name()) == "data");
      const std::string key = d->Attribute("key"), text = d->GetText() ? d->GetText() : "";
      CHECK(owner[key] == element->Name());
      std::size_t used = text.size();
      if (type[key] == "double") (void)std::stod(text, &used);
      if (type[key] == "int") (void)std::stoi(text, &used);
      CHECK(used == text.size());
      data[key] = text;
    }
    return data;
  };
  ReadGraph graph;
  for (auto* e = child->FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (std::string(e->Name()) == "node") {
      CHECK(graph.nodes.count(e->Attribute("id")) == 0);
      graph.nodes[e->Attribute("id")] = data_of(e);
    } else {
      CHECK(std::string(e->Name()) == "edge");
      graph.edges.push_back({e->Attribute("source"), e->Attribute("target"), data_of(e)});
      CHECK(graph.nodes.count(graph.edges.back().source) == 1);
      CHECK(graph.nodes.count(graph.edges.back().target) == 1);
    }
  }
  return graph;
}

}  // namespace

TEST_CASE("what a reader of XML finds in GraphML is the topological map") {
  const TempFolder folder;
  for (const char* name : {"room", "office", "stairs"}) {
    const World world = read_world(in_project(std::string("worlds/") + name + ".json"));
    export_world(world, folder / "w.graphml");
    const ReadGraph graph = read_graph(folder / "w.graphml");
    const Topology map = topology_of(world);
    REQUIRE(graph.nodes.size() == map.nodes.size());
    REQUIRE(graph.edges.size() == map.edges.size() + map.climbs.size());
    for (const PlaceNode& room : map.nodes) {
      const Data& data = graph.nodes.at("room_" + std::to_string(room.room));
      CHECK(data.at("name") == room.name);
      CHECK(std::stod(data.at("area")) == *room.area);
      CHECK(std::stod(data.at("y")) == room.center->y());
    }
    for (std::size_t i = 0; i < map.edges.size(); ++i) {
      CHECK(graph.edges[i].source == "room_" + std::to_string(map.edges[i].rooms[0]));
      CHECK(std::stod(graph.edges[i].data.at("length")) == *map.edges[i].length);
      CHECK(std::stod(graph.edges[i].data.at("width")) == map.edges[i].width);
    }
  }
}

TEST_CASE("names with signs that XML gives a meaning come back as they were") {
  const TempFolder folder;
  World world = full_world();
  const std::string name = "R&D <\"lab\"> 'A' \xc3\xa4";
  world.rooms[0].name = name;
  world.rooms[1].name = "a\x01z";
  export_world(world, folder / "w.graphml");
  const ReadGraph graph = read_graph(folder / "w.graphml");
  CHECK(graph.nodes.at("room_0").at("name") == name);
  CHECK(graph.nodes.at("room_1").at("name") == "a\xef\xbf\xbdz");
  CHECK(graph.nodes.at("room_0").count("area") == 0);
}

TEST_CASE("stairs between rooms are an edge of the graph") {
  const TempFolder folder;
  World world = full_world();
  world.rooms[0].center = Vec3(0, 1, 0), world.rooms[1].center = Vec3(3, 1, 0);
  export_world(world, folder / "w.graphml");
  const ReadGraph graph = read_graph(folder / "w.graphml");
  REQUIRE(graph.edges.size() == 2);
  const auto& stairs = graph.edges[1];
  CHECK(stairs.source == "room_0");
  CHECK(stairs.target == "room_1");
  CHECK(stairs.data.at("kind") == "stairs");
  CHECK(stairs.data.at("ways") == "3");
  CHECK(stairs.data.count("opening") == 0);
  CHECK(std::stod(stairs.data.at("rise")) == doctest::Approx(1.0 / 3));
  CHECK(std::stod(stairs.data.at("length")) > 3);
}

TEST_CASE("a world without rooms has a graph without nodes") {
  const TempFolder folder;
  export_world({}, folder / "w.graphml");
  CHECK(read_graph(folder / "w.graphml").nodes.empty());
}
