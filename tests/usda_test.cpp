// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What the schemas of USD and UsdPhysics ask of a file. That it parses is for three.js to tell
// (three_test.cpp).
#include <map>
#include <set>

#include "exporters/bodies.h"
#include "exporters/export.h"
#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

struct Prim {
  std::string type, path;
  std::map<std::string, std::string> fields;  // with the metadata
};

// What is between two texts in a line; nothing where they are not there.
std::string between(const std::string& line, const std::string& begin, const std::string& end) {
  const std::size_t from = line.find(begin);
  if (from == std::string::npos) return "";
  const std::size_t to = line.find(end, from + begin.size());
  return to == std::string::npos ? "" : line.substr(from + begin.size(), to - from - begin.size());
}

// The prims of a file that is written a field a line.
std::vector<Prim> prims_in(const std::string& text) {
  std::vector<Prim> prims;
  std::vector<std::size_t> open;
  std::istringstream lines(text);
  std::size_t newest = 0;
  for (std::string line; std::getline(lines, line);) {
    line.erase(0, line.find_first_not_of(' '));
    const std::size_t equals = line.find(" = ");
    if (line.starts_with("def ")) {
      const std::string parent = open.empty() ? "" : prims[open.back()].path;
      newest = prims.size();
      prims.push_back({between(line, "def ", " "), parent + "/" + between(line, "\"", "\""), {}});
    } else if (line == "{") {
      open.push_back(newest);
    } else if (line == "}") {
      open.pop_back();
      newest = open.empty() ? 0 : open.back();
    } else if (!prims.empty() && equals != std::string::npos) {
      const std::string left = line.substr(0, equals);
      prims[newest].fields[left.substr(left.rfind(' ') + 1)] = line.substr(equals + 3);
    }
  }
  CHECK(open.empty());
  return prims;
}

// Letters, digits and '_', not beginning with a digit, each after a slash.
bool is_prim_path(const std::string& path) {
  bool may_be_digit = false;
  for (const char c : path) {
    const bool is_digit = std::isdigit(static_cast<unsigned char>(c));
    if (c != '/' && c != '_' && !std::isalpha(static_cast<unsigned char>(c)) && !is_digit)
      return false;
    if (is_digit && !may_be_digit) return false;
    may_be_digit = c != '/';
  }
  return path.starts_with("/") && may_be_digit;
}

std::string usda_of(const World& world, const std::string& name,
                    const ExportOptions& options = {}) {
  const TempFolder folder;
  export_world(world, folder / name, options);
  return read_file(folder / name);
}

std::size_t commas(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
}

}  // namespace

TEST_CASE("every solid is a static collider, and nothing else is one") {
  const World world = prepare_export(read_world(in_project("worlds/stairs.json")), {});
  const std::vector<Prim> prims = prims_in(usda_of(world, "w.usda"));
  std::set<std::string> paths;
  std::size_t colliders = 0;
  for (const Prim& prim : prims) {
    CHECK(paths.insert(prim.path).second);
    CHECK(is_prim_path(prim.path));
    const auto schemas = prim.fields.find("apiSchemas");
    const std::string api = schemas == prim.fields.end() ? "" : schemas->second;
    const bool is_collider = contains(api, "\"PhysicsCollisionAPI\"");
    CHECK(is_collider == prim.path.starts_with("/w/collision/"));
    colliders += is_collider;
    CHECK_FALSE(contains(api, "RigidBodyAPI"));
    CHECK(contains(api, "PhysicsMeshCollisionAPI") == (is_collider && prim.type == "Mesh"));
    if (is_collider && prim.type == "Mesh")
      CHECK(prim.fields.at("physics:approximation") == "\"convexHull\"");
    if (prim.type == "Mesh") {
      CHECK(prim.fields.at("subdivisionScheme") == "\"none\"");
      CHECK(prim.fields.count("extent") == 1);
      const std::size_t faces = commas(prim.fields.at("faceVertexCounts")) + 1;
      CHECK(commas(prim.fields.at("faceVertexIndices")) + 1 == 3 * faces);
    }
  }
  CHECK(colliders == export_bodies(world, {}).size());
}

TEST_CASE("the stage says its root, unit and axis, has one physics scene, and binds a material") {
  const World world = small_world();
  const std::string text = usda_of(world, "3 rooms.usda", {.friction = 0.35});
  CHECK(text.starts_with("#usda 1.0\n"));
  for (const char* line : {"defaultPrim = \"_3_rooms\"", "metersPerUnit = 1\n", "upAxis = \"Z\""})
    CHECK(contains(text, line));
  CHECK(contains(usda_of(world, "w.usda", {.y_up = true}), "upAxis = \"Y\""));
  const std::vector<Prim> prims = prims_in(text);
  CHECK(std::count_if(prims.begin(), prims.end(),
                      [](const Prim& p) { return p.type == "PhysicsScene"; }) == 1);
  const auto prim = [&](const std::string& path) {
    return *std::find_if(prims.begin(), prims.end(), [&](const Prim& p) { return p.path == path; });
  };
  CHECK(prim("/_3_rooms/collision").fields.at("material:binding:physics") ==
        "</_3_rooms/physics_material>");
  CHECK(prim("/_3_rooms/physics_material").fields.at("physics:staticFriction") == "0.35");
}
