// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "triangulate.h"

#include <fmt/format.h>

#include <map>

#include "../error.h"
#include "../parallel.h"
#include "geos.h"
#include "surface_rings.h"

namespace scanworld {

namespace {

std::vector<std::array<int, 3>> triangulate(const World& world, const Surface& surface) {
  const auto fail = [&](const std::string& why) {
    throw Error(Cause::check_failed, fmt::format("surface {}: {}", surface.id, why));
  };
  const geos::Rings rings = rings_of(world, surface);
  if (const auto why = geos::why_invalid(rings)) fail(*why);
  const auto triangles = geos::triangulate(rings);
  if (!triangles) fail("cannot be triangulated");

  // The library gives corners back as it got them, so that their coordinates tell the vertex.
  std::map<std::pair<double, double>, int> vertex_at;
  const auto name_ring = [&](const std::vector<Vec2>& ring, const Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) vertex_at[{ring[i].x(), ring[i].y()}] = loop[i];
  };
  name_ring(rings[0], surface.outer);
  for (std::size_t h = 0; h < surface.holes.size(); ++h) name_ring(rings[h + 1], surface.holes[h]);
  std::vector<std::array<int, 3>> result;
  for (const auto& corners : *triangles) {
    std::array<int, 3> triangle{};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = vertex_at.find({corners[k].x(), corners[k].y()});
      if (found == vertex_at.end()) fail("its triangulation has a vertex of its own");
      triangle[k] = found->second;
    }
    result.push_back(triangle);
  }
  return result;
}

}  // namespace

WorldMesh triangulate(const World& world) {
  std::vector<std::vector<std::array<int, 3>>> parts(world.surfaces.size());
  parallel_for(parts.size(),
               [&](std::size_t i) { parts[i] = triangulate(world, world.surfaces[i]); });
  WorldMesh result;
  result.mesh.vertices = world.vertices;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    result.mesh.triangles.insert(result.mesh.triangles.end(), parts[i].begin(), parts[i].end());
    result.surface.insert(result.surface.end(), parts[i].size(), static_cast<int>(i));
  }
  return result;
}

}  // namespace scanworld
