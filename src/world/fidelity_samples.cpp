// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "fidelity_samples.h"

#include <algorithm>
#include <cmath>

#include "../mix.h"
#include "../parallel.h"
#include "../polygon.h"
#include "inferred_parts.h"
#include "triangulate.h"

namespace scanworld {

std::vector<std::uint32_t> sample_points(const CloudInWorld& cloud, std::size_t wanted) {
  struct Ranked {
    std::uint64_t rank;
    std::uint32_t point;
  };
  const double share =
      static_cast<double>(wanted) / static_cast<double>(std::max(wanted, cloud.size()));
  const auto limit = static_cast<std::uint64_t>(share * 0x1p53);
  constexpr std::size_t kPart = 1 << 14;
  std::vector<std::vector<Ranked>> parts(part_count(cloud.size(), kPart));
  parallel_for(parts.size(), [&](std::size_t i) {
    const auto [begin, end] = part_of(i, cloud.size(), kPart);
    for (std::size_t k = begin; k < end; ++k) {
      const Vec3f& p = cloud.cloud().points[k];
      const std::uint64_t rank = hash_of_place(p.x(), p.y(), p.z()) >> 11;
      if (rank <= limit) parts[i].push_back({rank, static_cast<std::uint32_t>(k)});
    }
  });
  std::vector<Ranked> all;
  for (const auto& part : parts) all.insert(all.end(), part.begin(), part.end());
  const auto xyz = [&](const Ranked& r) { return cloud.cloud().points[r.point].data(); };
  std::sort(all.begin(), all.end(), [&](const Ranked& a, const Ranked& b) {
    if (a.rank != b.rank) return a.rank < b.rank;
    if (cloud.cloud().points[a.point] == cloud.cloud().points[b.point])
      return cloud.cloud().viewer_of(a.point) < cloud.cloud().viewer_of(b.point);
    return std::lexicographical_compare(xyz(a), xyz(a) + 3, xyz(b), xyz(b) + 3);
  });
  std::vector<std::uint32_t> points;
  for (const Ranked& r : all) points.push_back(r.point);
  return points;
}

std::vector<PlaceOnSurface> sample_surfaces(const World& world, std::size_t wanted,
                                            std::size_t each) {
  const WorldMesh mesh = triangulate(world);
  const auto corner = [&](std::size_t t, std::size_t k) -> const Vec3& {
    return mesh.mesh.vertices[static_cast<std::size_t>(mesh.mesh.triangles[t][k])];
  };
  std::vector<double> area(mesh.surface.size()), whole(world.surfaces.size());
  double total = 0;
  for (std::size_t t = 0; t < area.size(); ++t) {
    area[t] = (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)).norm() / 2;
    const auto s = static_cast<std::size_t>(mesh.surface[t]);
    whole[s] += area[t];
    if (world.surfaces[s].source == Source::measured) total += area[t];
  }
  std::vector<PlaceOnSurface> places;
  std::size_t owner = SIZE_MAX, taken = 0;
  double step = 0, passed = 0;  // [m2] between places, and of the surface before this triangle
  PlaneFrame frame = {};
  std::vector<geos::Rings> inferred;
  for (std::size_t t = 0; t < area.size(); ++t) {
    const auto s = static_cast<std::size_t>(mesh.surface[t]);
    if (world.surfaces[s].source != Source::measured) continue;
    if (s != owner) {
      const double share = std::ceil(static_cast<double>(wanted) * whole[s] / total);
      step = whole[s] / std::max(share, static_cast<double>(each));
      owner = s, taken = 0, passed = 0;
      frame = frame_of(world.surfaces[s].plane);
      inferred = inferred_rings(world.surfaces[s], frame);
    }
    passed += area[t];
    for (; (static_cast<double>(taken) + 0.5) * step < passed; ++taken) {
      double ignored = 0;
      double u = std::modf(0.5 + 0.7548776662466927 * static_cast<double>(taken), &ignored),
             v = std::modf(0.5 + 0.5698402909980532 * static_cast<double>(taken), &ignored);
      if (u + v > 1) u = 1 - u, v = 1 - v;
      const Vec3 at =
          corner(t, 0) + u * (corner(t, 1) - corner(t, 0)) + v * (corner(t, 2) - corner(t, 0));
      const bool is_inferred =
          std::any_of(inferred.begin(), inferred.end(),
                      [&](const geos::Rings& part) { return is_inside(part, frame.to_plane(at)); });
      if (!is_inferred) places.push_back({at, s, step});
    }
  }
  return places;
}

}  // namespace scanworld
