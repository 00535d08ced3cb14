// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The whole of `build` on real scans, where ../shared/data has them.
#include <nlohmann/json.hpp>

#include "exporters/assimp.h"
#include "support/support.h"
#include "world/triangulate.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

double mesh_area(const Mesh& mesh) {
  double sum = 0;
  for (const auto& t : mesh.triangles) {
    const auto at = [&](std::size_t k) { return mesh.vertices[static_cast<std::size_t>(t[k])]; };
    sum += (at(1) - at(0)).cross(at(2) - at(0)).norm() / 2;
  }
  return sum;
}

// Builds the scan and checks what must hold of the result whatever the place looks like.
std::optional<World> build(std::string_view name) {
  const auto scan = shared_scan(name);
  if (!scan) return std::nullopt;
  INFO(std::string(name));
  const TempFolder folder;
  const Outcome outcome = run({"build", *scan, "-o", folder / "w", "--method", "thesis", "-q",
                               "--export", "stl,obj,glb,ply"});
  CHECK_MESSAGE(outcome.code == 0, outcome.err);
  if (outcome.code != 0) return std::nullopt;
  const World world = read_world(folder / "w");
  CHECK(validate(world).empty());
  const WorldMesh mesh = triangulate(world);
  const double area = mesh_area(mesh.mesh);
  const Box3 box = bounds(world);
  for (const char* file : {"world.stl", "world.obj", "world.glb", "world.ply"}) {
    INFO(file);
    const Mesh back = read_mesh(folder / "w" / file);
    CHECK(back.triangles.size() == mesh.surface.size());
    CHECK(mesh_area(back) == doctest::Approx(area).scale(0).epsilon(1e-4));
    Box3 back_box;
    for (const Vec3& v : back.vertices)
      back_box.extend(std::string(file) == "world.glb" ? Vec3(v.x(), -v.z(), v.y()) : v);
    CHECK((back_box.sizes() - box.sizes()).norm() < 1e-3);
  }
  return world;
}

std::size_t count(const World& world, Kind kind, double min_area) {
  std::size_t n = 0;
  for (const Surface& s : world.surfaces) n += s.kind == kind && area(world, s) >= min_area;
  return n;
}

}  // namespace

TEST_CASE("real rooms, each one laser scan: floor and main walls are found") {
  for (const char* name : {"A605", "A607", "A617", "B604", "B612", "B630"})
    if (const auto world = build(std::string("dlut_rooms/") + name + ".pcd")) {
      INFO(name);
      CHECK(count(*world, Kind::floor, 1) >= 1);
      CHECK(count(*world, Kind::ceiling, 1) >= 1);
      CHECK(count(*world, Kind::wall, 1.5) >= 3);
    }
}

TEST_CASE("real rooms, scanned all around: floor, ceiling and main walls are found") {
  for (const char* name : {"pcl_room_scan1.pcd", "pcl_room_scan2.pcd"})
    if (const auto world = build(name)) {
      INFO(name);
      CHECK(count(*world, Kind::floor, 10) == 1);
      CHECK(count(*world, Kind::ceiling, 10) >= 1);
      CHECK(count(*world, Kind::wall, 2) >= 4);
    }
}

TEST_CASE("a real hall with stairs: floor and main walls are found") {
  if (const auto world = build("octomap_hall_stairs_scan.xyz")) {
    CHECK(count(*world, Kind::floor, 20) >= 1);
    CHECK(count(*world, Kind::wall, 10) >= 3);
  }
}

TEST_CASE(
    "real images of a depth camera: the floor is found and level, and the walls where there are "
    "some") {
  if (const auto world = build("pcl_kinect_office1.pcd")) {
    CHECK(count(*world, Kind::floor, 0.5) >= 1);
    CHECK(count(*world, Kind::wall, 2) >= 2);
  }
  if (const auto world = build("pcl_kinect_livingroom.pcd"))
    CHECK(count(*world, Kind::floor, 2) == 1);
}

TEST_CASE("other real scans make valid worlds: furniture, blocks, voxels, a town from the air") {
  for (const char* name :
       {"navvis_room1_gt_fine.pcd", "navvis_room2_gt_fine.pcd", "orids_drc_blocks.pcd",
        "orids_tilted_steps.pcd", "orids_entrance_stairs_rs.pcd",
        "octomap_freiburg_geb079_voxels.ply", "autzen_crop300m.ply"})
    if (const auto world = build(name)) CHECK(world->surfaces.size() >= 10);
}
