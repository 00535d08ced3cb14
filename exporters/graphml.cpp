// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "graphml.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files.h"
#include "world/topology.h"
#include "xml.h"

namespace scanworld {

namespace {

XmlElement key(const char* owner, const char* name, const char* type) {
  return {"key", {{"id", name}, {"for", owner}, {"attr.name", name}, {"attr.type", type}}, {}, ""};
}

void add_data(XmlElement& to, const char* name, const std::string& value) {
  to.add({"data", {{"key", name}}, {}, value});
}

void add_number(XmlElement& to, const char* name, std::optional<double> value) {
  if (value) add_data(to, name, fmt::format("{}", *value));
}

XmlElement node_of(const PlaceNode& room) {
  XmlElement node{"node", {{"id", fmt::format("room_{}", room.room)}}, {}, ""};
  add_data(node, "name", room.name);
  add_number(node, "area", room.area);
  if (room.center) {
    add_number(node, "x", room.center->x());
    add_number(node, "y", room.center->y());
    add_number(node, "z", room.center->z());
  }
  return node;
}

XmlElement edge_between(const std::array<int, 2>& rooms) {
  return {
      "edge",
      {{"source", fmt::format("room_{}", rooms[0])}, {"target", fmt::format("room_{}", rooms[1])}},
      {},
      ""};
}

XmlElement edge_of(const PlaceEdge& door) {
  XmlElement edge = edge_between(door.rooms);
  add_data(edge, "opening", fmt::format("{}", door.opening));
  add_data(edge, "kind", name_of(door.kind));
  add_number(edge, "width", door.width);
  add_number(edge, "height", door.height);
  add_number(edge, "length", door.length);
  return edge;
}

XmlElement edge_of(const PlaceClimb& climb) {
  XmlElement edge = edge_between(climb.rooms);
  add_data(edge, "ways", fmt::format("{}", fmt::join(climb.ways, " ")));
  add_data(edge, "kind", name_of(climb.kind));
  add_number(edge, "width", climb.width);
  add_number(edge, "rise", climb.rise);
  add_number(edge, "length", climb.length);
  return edge;
}

}  // namespace

void write_graphml(const std::filesystem::path& path, const World& world, const ExportOptions&) {
  const Topology map = topology_of(world);
  const std::string schema = "http://graphml.graphdrawing.org/xmlns";
  XmlElement root{
      "graphml",
      {{"xmlns", schema},
       {"xmlns:xsi", "http://www.w3.org/2001/XMLSchema-instance"},
       {"xsi:schemaLocation", schema + " " + schema + "/1.0/graphml.xsd"}},
      {key("node", "name", "string"), key("node", "area", "double"), key("node", "x", "double"),
       key("node", "y", "double"), key("node", "z", "double"), key("edge", "opening", "int"),
       key("edge", "kind", "string"), key("edge", "width", "double"),
       key("edge", "height", "double"), key("edge", "length", "double"),
       key("edge", "ways", "string"), key("edge", "rise", "double")},
      ""};
  XmlElement& graph = root.add({"graph", {{"id", "rooms"}, {"edgedefault", "undirected"}}, {}, ""});
  for (const PlaceNode& room : map.nodes) graph.add(node_of(room));
  for (const PlaceEdge& door : map.edges) graph.add(edge_of(door));
  for (const PlaceClimb& climb : map.climbs) graph.add(edge_of(climb));
  write_text(path, xml_document(root));
}

}  // namespace scanworld
