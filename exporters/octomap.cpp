// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "octomap.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "error.h"
#include "facet.h"
#include "mesh_rays.h"
#include "occupancy_grid.h"
#include "octree_file.h"
#include "parallel.h"
#include "world/glass.h"
#include "world/solids.h"
#include "world/triangulate.h"

namespace scanworld {

namespace {

constexpr int kKnownStep = 16;     // [cells] that the bounds of what can be known are rounded to
constexpr int kApart = 64;         // [cells] edge of the cubes whose parts are made in parallel
constexpr double kMaxCells = 1e8;  // that surfaces lie in: some 10 s, and a file of 50 MB

// A cube of the tree, in cells.
struct Cube {
  Eigen::Vector3i low;
  int size;

  Cube child(int k) const {
    const int half = size / 2;
    return {low + half * Eigen::Vector3i(k & 1, k >> 1 & 1, k >> 2), half};
  }
  Box3 box(double cell) const {
    return {low.cast<double>() * cell, (low.array() + size).matrix().cast<double>() * cell};
  }
};

// A convex obstacle.
struct Solid {
  Mesh mesh;
  Box3 box;
};

Box3 rounded_out(const Box3& box, double step) {
  if (box.isEmpty()) return box;
  return {(box.min() / step).array().floor() * step, (box.max() / step).array().ceil() * step};
}

// All that cells are compared with.
struct Scenery {
  double cell;  // [m]
  OctreeKind kind;
  Box3 known;  // nothing outside of it is free
  std::vector<Facet> facets;
  std::vector<Solid> solids;
  std::unique_ptr<MeshRays> rays;  // triangle i is facet i

  Scenery(const World& world, double resolution, OctreeKind of)
      : cell(resolution), kind(of), known(rounded_out(bounds(world), kKnownStep * resolution)) {
    WorldMesh surfaces = triangulate(world);
    Mesh& all = surfaces.mesh;
    for (std::size_t t = 0; t < all.triangles.size(); ++t)
      facets.emplace_back(corners_of(all, t),
                          world.surfaces[static_cast<std::size_t>(surfaces.surface[t])].plane);
    for (const Obstacle& o : world.obstacles) {
      Solid solid{mesh_of(o, world.frame), {}};
      for (const Vec3& v : solid.mesh.vertices) solid.box.extend(v);
      for (std::size_t i = 0; i < solid.mesh.triangles.size(); ++i) {
        const auto corners = corners_of(solid.mesh, i);
        const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
        facets.emplace_back(corners, plane_through(corners[0], normal));
      }
      append(all, solid.mesh);
      solids.push_back(std::move(solid));
    }
    rays = std::make_unique<MeshRays>(std::move(all));
  }

  static std::array<Vec3, 3> corners_of(const Mesh& mesh, std::size_t triangle) {
    const auto& t = mesh.triangles[triangle];
    const auto at = [&](int index) { return mesh.vertices[static_cast<std::size_t>(index)]; };
    return {at(t[0]), at(t[1]), at(t[2])};
  }
};

// A cube that is divided, and what it is in. The lists belong to the caller.
struct Divided {
  const Divided* around;  // nullptr for the root
  Cube cube;
  Box3 box;
  const int *begin, *end;                   // the facets that touch the cube
  const std::vector<const Solid*>* solids;  // whose boxes meet it
};

class WorldTree {
 public:
  explicit WorldTree(const Scenery& scenery) : all_(scenery) {}

  // Adds what is in the root.
  void add(OctreeNodes& out) const {
    std::vector<int> facets(all_.facets.size());
    for (std::size_t i = 0; i < facets.size(); ++i) facets[i] = static_cast<int>(i);
    std::vector<const Solid*> solids;
    for (const Solid& s : all_.solids) solids.push_back(&s);
    const Cube root{Eigen::Vector3i::Constant(-kOctreeCells / 2), kOctreeCells};
    const Divided all{
        nullptr, root, root.box(all_.cell), facets.data(), facets.data() + facets.size(), &solids};
    divide(all, out, nullptr);
  }

 private:
  // Adds a cube that is divided: large ones with each of their parts on its own, as trees that are
  // then joined. `room` is where lists of facets can be written behind that of the cube.
  OctreeNode divide(const Divided& cube, OctreeNodes& out, int* room) const {
    const std::size_t opened = out.open();
    std::array<OctreeNode, 8> children;
    if (cube.cube.size <= kApart) {
      for (int k = 0; k < 8; ++k)
        children[static_cast<std::size_t>(k)] =
            add_part(cube, cube.cube.child(k), *cube.solids, out, room);
      return out.close(opened, children);
    }
    std::vector<OctreeNodes> parts(8, OctreeNodes(all_.kind));
    parallel_for(8, [&](std::size_t k) {
      const Cube part = cube.cube.child(static_cast<int>(k));
      const Box3 box = part.box(all_.cell);
      std::vector<const Solid*> solids;
      for (const Solid* s : *cube.solids)
        if (s->box.intersects(box)) solids.push_back(s);
      // A list for each level below, where lists are written one behind the other.
      const std::size_t most = static_cast<std::size_t>(cube.end - cube.begin);
      std::vector<int> lists(part.size > kApart ? most
                                                : most * std::bit_width(unsigned(part.size)));
      children[k] = add_part(cube, part, solids, parts[k], lists.data());
    });
    for (const OctreeNodes& part : parts) out.append(part);
    return out.close(opened, children);
  }

  OctreeNode add_part(const Divided& whole, const Cube& cube,
                      const std::vector<const Solid*>& solids, OctreeNodes& out, int* room) const {
    const Box3 box = cube.box(all_.cell);
    const Vec3 center = box.center();
    const double half = cube.size * all_.cell / 2;
    int* end = room;
    for (const int* f = whole.begin; f != whole.end; ++f)
      if (all_.facets[static_cast<std::size_t>(*f)].touches(center, half)) {
        if (cube.size == 1) return out.add_leaf(occupied_);
        *end++ = *f;
      }
    if (end == room) {
      if (is_inside(center, solids)) return out.add_leaf(occupied_);
      if (!all_.known.contains(center) && !all_.known.intersects(box)) return {};
      if (!faces_front(whole, center)) return {};
      if (cube.size <= kKnownStep || all_.known.contains(box))
        return all_.known.contains(center) ? out.add_leaf(free_) : OctreeNode{};
    }
    return divide({&whole, cube, box, room, end, &solids}, out, end);
  }

  static bool is_inside(const Vec3& point, const std::vector<const Solid*>& solids) {
    for (const Solid* s : solids)
      if (s->box.contains(point) && contains(s->mesh, point)) return true;
    return false;
  }

  // Whether the nearest facet that a point in a cube is straight before or behind of shows its
  // front: in the smallest cube around the point that has one, as long as those are small. Nothing
  // is between the two, as it would be in the cube as well and nearer.
  bool faces_front(const Divided& cube, const Vec3& point) const {
    double nearest = std::numeric_limits<double>::max();
    bool is_front = false;
    for (const int* f = cube.begin; f != cube.end; ++f) {
      const Facet& facet = all_.facets[static_cast<std::size_t>(*f)];
      const double distance = facet.plane.signed_distance(point);
      if (std::abs(distance) >= nearest || !facet.is_over(point) ||
          !cube.box.contains(point - distance * facet.plane.normal))
        continue;
      nearest = std::abs(distance), is_front = distance > 0;
    }
    if (nearest < std::numeric_limits<double>::max()) return is_front;
    return cube.around && cube.around->cube.size <= kApart ? faces_front(*cube.around, point)
                                                           : looks_at_front(point);
  }

  // The same by what is nearest along the axes.
  bool looks_at_front(const Vec3& point) const {
    double nearest = std::numeric_limits<float>::max();
    bool is_front = false;
    for (int k = 0; k < 6; ++k) {
      const Vec3 direction = (k < 3 ? 1 : -1) * Vec3::Unit(k % 3);
      const auto hit = all_.rays->cast(point, direction, nearest);
      if (!hit || hit->distance >= nearest) continue;
      nearest = hit->distance;
      is_front = all_.facets[hit->triangle].plane.signed_distance(point) > 0;
    }
    return is_front;
  }

  const Scenery& all_;
  const float free_ = log_odds_of(OccupancyOptions{}.lowest);
  const float occupied_ = log_odds_of(OccupancyOptions{}.highest);
};

void check_size(const std::filesystem::path& path, const World& world, double resolution) {
  const Box3 box = bounds(world);
  if (box.isEmpty()) return;
  const double reach = box.min().cwiseAbs().cwiseMax(box.max().cwiseAbs()).maxCoeff();
  double total = 0;
  for (const Surface& s : world.surfaces) total += area(world, s);
  const double least = std::max(least_octree_resolution(reach), std::sqrt(total / kMaxCells));
  if (resolution >= least) return;
  throw Error(
      Cause::usage,
      fmt::format("{}: a world that reaches {:.1f} m from its origin with {:.0f} m2 of "
                  "surfaces is too large for an OctoMap of {} m cells (2^16 along an axis, "
                  "{:.0f} million on surfaces); a resolution of {:.2g} m would do",
                  path.string(), reach, total, resolution, kMaxCells / 1e6, rounded_up(least)));
}

}  // namespace

void write_octomap(const std::filesystem::path& path, const World& world,
                   const ExportOptions& options, OctreeKind kind) {
  check_size(path, world, options.resolution);
  const Scenery scenery(options.open_glass ? world : with_panes(world), options.resolution, kind);
  OctreeNodes nodes(kind);
  WorldTree(scenery).add(nodes);
  nodes.write(path, options.resolution, world.frame);
}

}  // namespace scanworld
