// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The files are read by liboctomap.
#include "exporters/octomap.h"

#include <octomap/octomap.h>

#include <algorithm>

#include "exporters/export.h"
#include "parallel.h"
#include "support/scenes.h"
#include "world/assemble.h"
#include "world/level.h"
#include "world/ray_scene.h"
#include "world/solids.h"
#include "world/triangulate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

octomap::point3d to_octomap(const Vec3& p) {
  return {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z())};
}
Vec3 from_octomap(const octomap::point3d& p) { return {p.x(), p.y(), p.z()}; }

// The tree that liboctomap reads, which checks the number of nodes.
std::unique_ptr<octomap::OcTree> octomap_of(const World& world, const ExportOptions& options = {}) {
  const TempFolder folder;
  write_octomap(folder / "world.bt", world, options, OctreeKind::binary);
  auto tree = std::make_unique<octomap::OcTree>(1.0);
  REQUIRE(tree->readBinary((folder / "world.bt").string()));
  CHECK(tree->getResolution() == options.resolution);
  return tree;
}

enum class Cell { unknown, free, occupied };

Cell cell_at(const octomap::OcTree& tree, const Vec3& p) {
  const auto* node = tree.search(p.x(), p.y(), p.z());
  return !node ? Cell::unknown : tree.isNodeOccupied(node) ? Cell::occupied : Cell::free;
}

// Turned, so that its surfaces are not along the cells.
World tilted(const World& world) {
  return moved(world, Eigen::Quaterniond(Eigen::AngleAxisd(0.3, Vec3(0.1, 0.2, 1).normalized())),
               Vec3(0.123, -4.567, 0.891));
}

World shipped(const std::string& name) {
  return read_world(in_project("worlds/" + name + ".json"));
}

// The nearest obstacle that a point is in, or nothing.
bool in_obstacle(const World& world, const Vec3& p) {
  return std::any_of(world.obstacles.begin(), world.obstacles.end(),
                     [&](const Obstacle& o) { return contains(mesh_of(o, world.frame), p); });
}

// Points of the surfaces of a world, on larger ones more often.
struct Samples {
  const World& world;
  WorldMesh triangles = triangulate(world);
  std::vector<double> areas;  // up to each triangle
  Random random{11};

  explicit Samples(const World& of) : world(of) {
    double total = 0;
    for (const auto& t : triangles.mesh.triangles)
      areas.push_back(total += (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm());
  }
  const Vec3& at(int v) const { return triangles.mesh.vertices[static_cast<std::size_t>(v)]; }
  // So much behind the surface [m].
  Vec3 next(double behind) {
    const auto i = static_cast<std::size_t>(
        std::lower_bound(areas.begin(), areas.end(), random.uniform(0, areas.back())) -
        areas.begin());
    const auto& t = triangles.mesh.triangles[i];
    double u = random.uniform(), v = random.uniform();
    if (u + v > 1) u = 1 - u, v = 1 - v;
    return at(t[0]) + u * (at(t[1]) - at(t[0])) + v * (at(t[2]) - at(t[0])) -
           behind * world.surfaces[static_cast<std::size_t>(triangles.surface[i])].plane.normal;
  }
};

// A square of 1 m with its middle at p.
World square_at(const Vec3& p) {
  return assemble_world({{.plane = plane_through(p, Vec3::UnitZ()),
                          .outer = {p + Vec3(-0.5, -0.5, 0), p + Vec3(0.5, -0.5, 0),
                                    p + Vec3(0.5, 0.5, 0), p + Vec3(-0.5, 0.5, 0)}}},
                        {});
}

}  // namespace

TEST_CASE(
    "every surface is in occupied cells, and every occupied cell is at a surface or in an "
    "obstacle") {
  for (const char* name : {"room", "office", "stairs"}) {
    const World world = shipped(name);
    const auto tree = octomap_of(world);
    Samples samples(world);
    for (int i = 0; i < 20000; ++i) CHECK(cell_at(*tree, samples.next(1e-6)) == Cell::occupied);

    const RayScene scene(world);
    std::size_t occupied = 0, far = 0;
    for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf) {
      if (!tree->isNodeOccupied(*leaf)) continue;
      ++occupied;
      const Vec3 middle = from_octomap(leaf.getCoordinate());
      const double reach = leaf.getSize() * std::sqrt(3) / 2 + 1e-6;
      far += !scene.nearest(middle, reach) && !in_obstacle(world, middle);
    }
    CHECK(occupied > 10000);
    CHECK(far == 0);
  }
}

TEST_CASE("a tree has no eight equal leaves under one node, and the nodes that its file promises") {
  for (const char* name : {"room", "stairs"}) {
    const auto tree = octomap_of(shipped(name));
    const std::size_t nodes = tree->size();
    tree->prune();
    CHECK(tree->size() == nodes);
    CHECK(tree->calcNumNodes() == nodes);
  }
}

TEST_CASE("rooms are free, and the inside of walls and outside are unknown") {
  const World world = shipped("room");
  const auto tree = octomap_of(world);
  const RayScene scene(world);
  Random random(3);
  const Box3 box = grown(bounds(world), 1);
  std::size_t free = 0, unknown = 0, wrong = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec3 p =
        box.min() +
        Vec3(random.uniform(), random.uniform(), random.uniform()).cwiseProduct(box.sizes());
    const Cell cell = cell_at(*tree, p);
    if (cell == Cell::occupied) continue;
    // Straight up and down from inside the room a floor and a ceiling show their fronts.
    const auto below = scene.cast(p, -Vec3::UnitZ()), above = scene.cast(p, Vec3::UnitZ());
    const auto faces = [&](const std::optional<Hit>& hit) {
      return hit && (!hit->is_surface || world.surfaces[hit->index].plane.signed_distance(p) > 0);
    };
    const bool is_room = faces(below) && faces(above);
    wrong += is_room != (cell == Cell::free);
    free += cell == Cell::free, unknown += cell == Cell::unknown;
  }
  CHECK(free > 3000);
  CHECK(unknown > 3000);
  CHECK(wrong < 0.01 * 20000);
}

TEST_CASE("a ray meets what it meets in the world, within a cell") {
  constexpr double kCell = 0.01;
  for (const World& world :
       {shipped("room"), shipped("office"), shipped("stairs"), tilted(shipped("room"))}) {
    const auto tree = octomap_of(world, {.resolution = kCell});
    const RayScene scene(world);
    Random random(5);
    const Box3 box = bounds(world);
    std::size_t rays = 0, same = 0, near = 0;
    while (rays < 1000) {
      const Vec3 from =
          box.min() +
          Vec3(random.uniform(), random.uniform(), random.uniform()).cwiseProduct(box.sizes());
      const Vec3 direction = random.direction();
      const auto hit = scene.cast(from, direction);
      if (cell_at(*tree, from) != Cell::free || !hit) continue;
      ++rays;
      octomap::point3d cell, entry;
      REQUIRE(tree->castRay(to_octomap(from), to_octomap(direction), cell, true));
      REQUIRE(tree->getRayIntersection(to_octomap(from), to_octomap(direction), cell, entry));
      const double early = hit->distance - (from_octomap(entry) - from).norm();
      // Never beyond the surface, as all of it is in occupied cells; never where nothing is.
      CHECK(early > -1e-4);
      const auto met = scene.nearest(from_octomap(cell), kCell * std::sqrt(3) / 2 + 1e-6);
      REQUIRE(met);
      // A cell that a plane goes through begins up to sum |n| of its edges before it, and a ray at
      // an angle to the normal is longer by its cosine. One that is earlier has met a cell of
      // something else, whose edge it passes that near.
      Vec3 normal = -direction;
      if (hit->is_surface) normal = world.surfaces[hit->index].plane.normal;
      const double most = kCell * normal.cwiseAbs().sum() / std::abs(normal.dot(direction)) + 1e-4;
      const bool is_other = met->is_surface != hit->is_surface || met->index != hit->index;
      CHECK((early <= most || is_other || !hit->is_surface));
      same += early <= most;
      // What castRay gives is the middle of the cell.
      near += std::abs((from_octomap(cell) - from).norm() - hit->distance) <= 0.01;
    }
    MESSAGE(same << " rays within the bound, " << near << " within 10 mm");
    CHECK(same > 950);
    CHECK(near > 750);  // over 900 where walls are along the cells
  }
}

TEST_CASE("a surface on the faces of cells is in the cells behind it, and met exactly") {
  // A closed room, its walls where cells begin.
  World world;
  world.obstacles = {{.shape = OrientedBox{{1.5, 1, 1.25}, {3, 2, 2.5}}}};
  std::vector<FoundSurface> walls;
  const Mesh box = mesh_of(world.obstacles[0], world.frame);
  for (const auto& t : box.triangles) {
    const auto at = [&](std::size_t k) { return box.vertices[static_cast<std::size_t>(t[k])]; };
    const Vec3 inwards = (at(2) - at(0)).cross(at(1) - at(0)).normalized();
    walls.push_back({.plane = plane_through(at(0), inwards), .outer = {at(0), at(2), at(1)}});
  }
  world = assemble_world(walls, {});
  const auto tree = octomap_of(world);
  const RayScene scene(world);
  Random random(6);
  for (int i = 0; i < 500; ++i) {
    const Vec3 from(random.uniform(0.01, 2.99), random.uniform(0.01, 1.99),
                    random.uniform(0.01, 2.49));
    CHECK(cell_at(*tree, from) == Cell::free);
    const Vec3 direction = random.direction();
    const auto hit = scene.cast(from, direction);
    REQUIRE(hit);
    octomap::point3d cell, entry;
    REQUIRE(tree->castRay(to_octomap(from), to_octomap(direction), cell, true));
    REQUIRE(tree->getRayIntersection(to_octomap(from), to_octomap(direction), cell, entry));
    CHECK((from_octomap(entry) - from).norm() ==
          doctest::Approx(hit->distance).epsilon(1e-4).scale(0));
  }
}

TEST_CASE("rays pass through every open door") {
  for (const char* name : {"room", "office", "stairs"}) {
    const World world = shipped(name);
    const auto tree = octomap_of(world);
    int doors = 0;
    for (const Opening& o : world.openings) {
      if (o.glass || o.kind == OpeningKind::window) continue;
      const auto surface = std::find_if(world.surfaces.begin(), world.surfaces.end(),
                                        [&](const Surface& s) { return s.id == o.surface; });
      Vec3 middle = Vec3::Zero();
      for (int v : o.loop) middle += world.vertices[static_cast<std::size_t>(v)];
      middle /= static_cast<double>(o.loop.size());
      const Vec3 normal = surface->plane.normal;
      octomap::point3d end;
      INFO(name << " opening " << o.id);
      CHECK_FALSE(
          tree->castRay(to_octomap(middle + 0.3 * normal), to_octomap(-normal), end, true, 0.8));
      CHECK(cell_at(*tree, middle) == Cell::free);
      ++doors;
    }
    CHECK(doors > 0);
  }
}

TEST_CASE("a pane of glass is occupied unless it is not wanted") {
  World world = full_world();
  const Vec3 pane(1.5, -1e-6, 1.5);  // seen from +y
  CHECK(cell_at(*octomap_of(world), pane) != Cell::occupied);
  world.openings[0].glass = true;
  CHECK(cell_at(*octomap_of(world), pane) == Cell::occupied);
  CHECK(cell_at(*octomap_of(world, {.open_glass = true}), pane) != Cell::occupied);
}

TEST_CASE("the inside of obstacles is occupied") {
  World world = square_at({0, 0, 0});
  world.obstacles = {{.id = 0, .shape = OrientedBox{{3, 0, 1}, {1, 1, 1}}},
                     {.id = 1, .shape = Cylinder{{-3, 0, 1}, 0.5, 1}}};
  const auto tree = octomap_of(world);
  Random random(9);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 off(random.uniform(-0.35, 0.35), random.uniform(-0.35, 0.35),
                   random.uniform(-0.5, 0.5));
    CHECK(cell_at(*tree, Vec3(3, 0, 1) + off) == Cell::occupied);
    CHECK(cell_at(*tree, Vec3(-3, 0, 1) + off) == Cell::occupied);
  }
  CHECK(cell_at(*tree, {3, 0, 1.6}) != Cell::occupied);
}

TEST_CASE("the same world gives the same bytes for any number of threads") {
  const World world = shipped("office");
  const TempFolder folder;
  for (const char* name : {"a.bt", "a.ot"}) {
    std::vector<std::string> files;
    for (int threads : {1, 3}) {
      const ThreadLimit limit(threads);
      write_octomap(folder / name, world, {}, OctreeKind::binary);
      files.push_back(read_file(folder / name));
    }
    CHECK(files[0] == files[1]);
  }
}

TEST_CASE("the two kinds of file hold the same tree") {
  const World world = shipped("room");
  const TempFolder folder;
  write_octomap(folder / "a.ot", world, {}, OctreeKind::log_odds);
  const std::unique_ptr<octomap::AbstractOcTree> any(
      octomap::AbstractOcTree::read((folder / "a.ot").string()));
  auto* odds = dynamic_cast<octomap::OcTree*>(any.get());
  REQUIRE(odds);
  CHECK(*odds == *octomap_of(world));
}

TEST_CASE("an empty world is an empty tree, and one surface is its cells") {
  CHECK(octomap_of({})->size() == 0);
  const auto tree = octomap_of(square_at({10.02, 0.02, 0.02}));
  CHECK(cell_at(*tree, {10.02, 0.02, 0.02}) == Cell::occupied);
  CHECK(cell_at(*tree, {10.02, 0.02, 0.07}) == Cell::free);
  CHECK(cell_at(*tree, {10.02, 0.02, -0.03}) == Cell::unknown);
  std::size_t occupied = 0;
  for (auto leaf = tree->begin_leafs(); leaf != tree->end_leafs(); ++leaf)
    occupied += tree->isNodeOccupied(*leaf);
  CHECK(occupied == 21 * 21);
}

TEST_CASE("a world that is too large for the tree is refused with the resolution that would do") {
  const TempFolder folder;
  const World wide = square_at({2500, 0, 0});
  const std::string why =
      error_of(Cause::usage, [&] { write_octomap(folder / "w.bt", wide, {}, OctreeKind::binary); });
  CHECK(contains(why, "w.bt"));
  CHECK(contains(why, "2500.5 m"));
  CHECK(contains(why, "0.05 m cells"));
  CHECK(contains(why, "0.077 m would do"));
  CHECK_FALSE(std::filesystem::exists(folder / "w.bt"));
  CHECK(cell_at(*octomap_of(wide, {.resolution = 0.077}), {2500, 0, -1e-6}) == Cell::occupied);

  World large = square_at({0, 0, 0});
  for (Vec3& v : large.vertices) v *= 3000;
  CHECK(contains(error_of(Cause::usage,
                          [&] { write_octomap(folder / "w.bt", large, {}, OctreeKind::binary); }),
                 "with 9000000 m2 of surfaces"));
}

TEST_CASE("the format by name decides which kind of OctoMap is written, not the file's name") {
  const TempFolder folder;
  const World world = read_world(in_project("worlds/room.json"));
  export_world(world, folder / "grid", {}, "ot");
  CHECK(read_file(folder / "grid").starts_with("# Octomap OcTree file\n"));
  export_world(world, folder / "grid.ot", {}, "bt");
  CHECK(read_file(folder / "grid.ot").starts_with("# Octomap OcTree binary file\n"));
}
