// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "exporters/export.h"

#include <cstring>
#include <nlohmann/json.hpp>

#include "exporters/assimp.h"
#include "exporters/bodies.h"
#include "support/engines.h"
#include "support/scenes.h"
#include "world/solids.h"
#include "world/triangulate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

struct Measures {
  std::size_t triangles = 0;
  double area = 0;
  Box3 box;
};

Measures measure(const Mesh& mesh) {
  Measures m{.triangles = mesh.triangles.size()};
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    m.area += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
    for (std::size_t k = 0; k < 3; ++k) m.box.extend(at(k));
  }
  return m;
}

// All of a world that formats of triangles hold.
Mesh mesh_of_world(const World& world) {
  Mesh all = triangulate(world).mesh;
  for (const Obstacle& o : world.obstacles) append(all, mesh_of(o, world.frame));
  return all;
}

// The formats that hold triangles and that assimp reads.
const std::vector<std::string> kMeshFormats = {"stl", "obj", "glb", "ply", "dae", "3mf"};

// Writes the world in a format, has it read by assimp, and compares.
void check_reread(const World& world, const std::string& format) {
  const Mesh back = reread(world, format);
  const Measures expected = measure(mesh_of_world(world)), found = measure(back);
  CHECK(found.triangles == expected.triangles);
  CHECK(found.area == doctest::Approx(expected.area).scale(0).epsilon(1e-5));
  CHECK((found.box.min() - expected.box.min()).norm() < 1e-4);
  CHECK((found.box.max() - expected.box.max()).norm() < 1e-4);
}

}  // namespace

TEST_CASE("what an independent reader finds in each format is the world") {
  for (const char* name : {"room", "office", "stairs"})
    for (const std::string& format : kMeshFormats)
      check_reread(read_world(in_project(std::string("worlds/") + name + ".json")), format);
}

TEST_CASE("json exports the world itself") {
  const TempFolder folder;
  export_world(full_world(), folder / "w.json");
  CHECK(read_world(folder / "w.json") == full_world());
}

TEST_CASE("the same world gives the same bytes in every format") {
  const World world = read_world(in_project("worlds/room.json"));
  const TempFolder folder;
  for (const char* name : {"a", "b"}) export_all(world, folder / name);
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder / "a")) {
    if (!entry.is_regular_file()) continue;
    const auto other = folder / "b" / entry.path().lexically_relative(folder / "a");
    CHECK_MESSAGE(read_file(entry.path()) == read_file(other), other);
    ++files;
  }
  CHECK(files > export_formats().size());
}

TEST_CASE("an empty world, one surface and a world five kilometres wide are written or refused") {
  const TempFolder folder;
  const World wide = scaled(small_world(), 1250);
  for (const ExportFormat& format : export_formats()) {
    const auto path = folder / ("empty." + format.extension);
    export_world({}, path);
    CHECK(std::filesystem::exists(path));
    const auto write = [&] { export_world(wide, folder / ("wide." + format.extension)); };
    if (format.name == "bt" || format.name == "ot")  // more cells than there are
      CHECK(contains(error_of(Cause::usage, write), "a resolution of 0.58 m would do"));
    else if (format.name == "map_server")
      CHECK(contains(error_of(Cause::usage, write), "5000 m by 3750 m"));
    else
      write();
  }
  for (const std::string& format : kMeshFormats)
    check_reread(small_world(), format), check_reread(wide, format);
}

TEST_CASE("OBJ names an object for each surface and finds its materials beside it") {
  const TempFolder folder;
  World world = small_world();
  world.surfaces[1].color = Color{255, 0, 128};
  export_world(world, folder / "place.obj");
  const std::string obj = read_file(folder / "place.obj"), mtl = read_file(folder / "place.mtl");
  CHECK(contains(obj, "mtllib place.mtl\n"));
  CHECK(contains(obj, "o floor_0\nusemtl floor\n"));
  CHECK(contains(obj, "o wall_1\nusemtl rgb_ff0080\n"));
  CHECK(contains(mtl, "newmtl rgb_ff0080\nKd 1.0000 0.0000 0.5020\n"));
}

TEST_CASE("STL does not begin with the word that would make it text") {
  const TempFolder folder;
  export_world(small_world(), folder / "w.stl");
  const std::string bytes = read_file(folder / "w.stl");
  CHECK(bytes.substr(0, 5) != "solid");
  CHECK(bytes.size() == 84 + 50 * triangulate(small_world()).surface.size());
}

TEST_CASE("GLB passes the validator of Khronos without error and warning") {
  const auto validator = in_project("tests/node/validate_glb.mjs");
  if (!std::filesystem::exists(in_project("tests/node/node_modules/gltf-validator"))) {
    MESSAGE("skipped: no gltf-validator; './dev test' installs it");
    return;
  }
  const TempFolder folder;
  World colored = small_world();
  colored.surfaces[0].color = Color{10, 200, 30};
  std::vector<std::string> command = {"node", validator.string()};
  const auto add = [&](const std::string& name, const World& world) {
    export_world(world, folder / (name + ".glb"));
    command.push_back((folder / (name + ".glb")).string());
  };
  add("empty", {});
  add("small", colored);
  add("full", full_world());
  for (const char* name : {"room", "office", "stairs"})
    add(name, read_world(in_project(std::string("worlds/") + name + ".json")));
  export_world(read_world(in_project("worlds/office.json")), folder / "solid.glb",
               {.physics = true});
  command.push_back((folder / "solid.glb").string());
  const Outcome outcome = run_program(command);
  CHECK_MESSAGE(outcome.code == 0, outcome.out << outcome.err);
}

TEST_CASE("GLB with physics has a static collider for every solid, and none without") {
  const TempFolder folder;
  const World world = read_world(in_project("worlds/office.json"));
  const auto json_of = [&](const ExportOptions& options) {
    export_world(world, folder / "w.glb", options);
    const std::string bytes = read_file(folder / "w.glb");
    std::uint32_t size = 0;
    std::memcpy(&size, bytes.data() + 12, 4);
    return nlohmann::json::parse(bytes.substr(20, size));
  };
  CHECK_FALSE(json_of({}).contains("extensionsUsed"));
  const nlohmann::json gltf = json_of({.friction = 0.4, .physics = true});
  std::size_t colliders = 0;
  for (const auto& node : gltf["nodes"]) {
    if (!node.contains("extensions")) continue;
    const auto& body = node["extensions"]["KHR_physics_rigid_bodies"];
    CHECK_FALSE(body.contains("motion"));
    const auto& geometry = body["collider"]["geometry"];
    CHECK(geometry.contains("shape") != geometry.contains("node"));
    if (geometry.contains("shape"))
      CHECK(geometry["shape"].get<std::size_t>() <
            gltf["extensions"]["KHR_implicit_shapes"]["shapes"].size());
    else
      CHECK(gltf["nodes"][geometry["node"].get<std::size_t>()].contains("mesh"));
    ++colliders;
  }
  CHECK(colliders == export_bodies(prepare_export(world, {}), {}).size());
  CHECK(gltf["extensions"]["KHR_physics_rigid_bodies"]["physicsMaterials"][0]["staticFriction"] ==
        0.4);
}

TEST_CASE(
    "formats that do not exist, and worlds that are not valid, are refused with nothing written") {
  const TempFolder folder;
  CHECK(contains(error_of(Cause::usage, [&] { export_world({}, folder / "w.blend"); }),
                 "'blend' is no export format"));
  CHECK(contains(error_of(Cause::usage, [&] { export_world({}, folder / "w.stl", {}, "fbx"); }),
                 "'fbx'"));
  World broken = small_world();
  std::swap(broken.surfaces[0].outer[0], broken.surfaces[0].outer[1]);
  for (const std::string& format : kMeshFormats)
    error_of(Cause::check_failed, [&] { export_world(broken, folder / "w", {}, format); });
  CHECK(std::filesystem::is_empty(folder.path()));
}

TEST_CASE("a mesh that cannot be read is told") {
  const TempFolder folder;
  CHECK(contains(error_of(Cause::bad_input,
                          [&] { read_mesh(write_file(folder / "x.obj", "v 1 2\nf what\n")); }),
                 "x.obj"));
  error_of(Cause::bad_input, [&] { read_mesh(folder / "absent.stl"); });
}
