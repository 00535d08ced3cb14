// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/place.h"

#include <cstring>

#include "exporters/export.h"
#include "exporters/ply.h"
#include "support/places.h"
#include "world/level.h"

using namespace scanworld;
using namespace scanworld::sim;
using namespace scanworld::test;

namespace {

Box3 box_around(const Mesh& mesh) {
  Box3 box;
  for (const Vec3& v : mesh.vertices) box.extend(v);
  return box;
}

std::string off_file(const std::string& vertices) {
  return "OFF\n3 1 0\n" + vertices + "3 0 1 2\n";
}

}  // namespace

TEST_CASE("a world is the same place as each of its exports") {
  const TempFolder folder;
  const World world = world_named("room");
  write_world(folder / "world.json", world);
  const Place expected = read_place(folder / "world.json");
  CHECK(expected.sort == Sort::world);
  CHECK(expected.solids.size() == export_bodies(*expected.world, {}).size());
  for (const char* name : {"w.stl", "w.obj", "w.glb", "w.dae", "w.3mf", "w.ply", "w.bullet"}) {
    INFO(name);
    export_world(world, folder / name);
    const Place place = read_place(folder / name);
    const Box3 box = box_around(place.seen), wanted = box_around(expected.seen);
    CHECK((box.min() - wanted.min()).norm() < 1e-4);
    CHECK((box.max() - wanted.max()).norm() < 1e-4);
    CHECK(area_of(place.seen) == doctest::Approx(area_of(expected.seen)).epsilon(1e-4));
    CHECK(place.sort == (std::string(name) == "w.bullet" ? Sort::world : Sort::mesh));
  }
}

TEST_CASE("places come together, in whichever coordinates each is") {
  const TempFolder folder;
  // A world that was moved and turned away from its scan, and tilted.
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3(0.05, 0.02, 1).normalized()));
  const World in_scan = world_named("room");
  const World world = moved(in_scan, turn, Vec3(300, -200, 5));
  write_world(folder / "world.json", world);
  export_world(world, folder / "own.stl");
  export_world(level_world(world, {.level = true}), folder / "upright.stl");
  export_world(in_scan, folder / "scan.stl");
  std::vector<Place> places;
  for (const char* name : {"scan.stl", "own.stl", "upright.stl", "world.json"})
    places.push_back(read_place(folder / name));
  align(places);
  const Box3 wanted = box_around(places.back().seen);
  for (const Place& place : places) {
    INFO(place.name);
    const Box3 box = box_around(place.seen);
    CHECK((box.min() - wanted.min()).norm() < 1e-3);
    CHECK((box.max() - wanted.max()).norm() < 1e-3);
  }
  // The floor is level.
  CHECK(places.back().world->frame.up.isApprox(Vec3::UnitZ()));
}

TEST_CASE("what is elsewhere is refused, by name") {
  std::vector<Place> places = {place_of("here", world_named("room")),
                               place_of("there", grid_mesh(4, 10))};
  move(places[1], Eigen::Quaterniond::Identity(), {0, 0, 50});
  CHECK(contains(error_of(Cause::bad_input, [&] { align(places); }), "there: not the same place"));
}

TEST_CASE("meshes that are not fit for an engine are refused, saying why") {
  const TempFolder folder;
  const auto error = [&](const std::string& name, const std::string& text,
                         const PlaceOptions& options = {}) {
    const auto path = write_file(folder / name, text);
    const std::string message = error_of(Cause::bad_input, [&] { read_place(path, options); });
    CHECK(contains(message, name));
    return message;
  };
  CHECK(contains(error("nan.off", off_file("0 0 0\n1 0 nan\n0 1 0\n")), "not finite"));
  CHECK(contains(error("millimetres.off", off_file("0 0 0\n9000 0 0\n0 8000 0\n")), "--unit"));
  CHECK(contains(error("flat.off", off_file("0 0 0\n1 0 0\n2 0 0\n")), "no area"));
  error("empty.obj", "");
  error("points.obj", "v 0 0 0\nv 1 0 0\n");
  error("text.stl", "this is no mesh");
  CHECK(contains(error_of(Cause::bad_input, [&] { read_place(folder / "none.ply"); }), "no such"));
}

TEST_CASE("a unit or an axis that is given is used") {
  const TempFolder folder;
  const auto path = write_file(folder / "m.off", off_file("0 0 0\n9000 0 0\n0 8000 0\n"));
  const Place place = read_place(path, {.unit = 0.001, .up = 'y'});
  CHECK(box_around(place.seen).max().isApprox(Vec3(9, 0, 8), 1e-9));
  CHECK(read_place(path, {.unit = 1}).seen.triangles.size() == 1);
}

TEST_CASE("a binary PLY whose data begins like a line is read right") {
  const TempFolder folder;
  Mesh mesh = grid_mesh(3, 4);
  std::memset(&mesh.vertices[0].x(), '\n', 1);  // the first byte of the data
  write_ply_mesh(folder / "m.ply", mesh);
  const Mesh read = read_place(folder / "m.ply").seen;
  CHECK(read.triangles.size() == mesh.triangles.size());
  CHECK(area_of(read) == doctest::Approx(area_of(mesh)));
}

TEST_CASE("a mesh that is cut is refused or read, and never a crash") {
  const TempFolder folder;
  write_ply_mesh(folder / "m.ply", grid_mesh(20, 4));
  export_world(world_named("room"), folder / "m.glb");
  for (const char* name : {"m.ply", "m.glb"}) {
    const std::string whole = read_file(folder / name);
    for (int tenth = 0; tenth < 10; ++tenth) {
      const auto path = write_file(folder / (std::string("cut_") + name),
                                   whole.substr(0, tenth * whole.size() / 10));
      try {
        read_place(path);
      } catch (const Error& e) {
        CHECK(e.cause == Cause::bad_input);
        CHECK(contains(e.what(), "cut_"));
      }
    }
  }
}
