// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "describe.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "../point_sums.h"
#include "../polygon.h"

namespace scanworld::surface {

namespace {

// A polygon in the frame of its patch.
struct FlatPolygon {
  std::vector<std::vector<Vec2>> loops;
  Eigen::AlignedBox2d box;

  bool contains(const Vec2& p) const { return box.contains(p) && is_inside(loops, p); }
};

FlatPolygon flatten(const PlaneFrame& frame, const Piece& piece) {
  FlatPolygon polygon;
  for (const auto& loop : piece.loops) {
    polygon.loops.emplace_back();
    for (const Vec3& v : loop) {
      polygon.loops.back().push_back(frame.to_plane(v));
      polygon.box.extend(polygon.loops.back().back());
    }
  }
  return polygon;
}

FoundSurface surface_of(const Plane& plane, const Piece& piece, Source source) {
  return {.plane = plane,
          .outer = piece.loops[0],
          .holes = {piece.loops.begin() + 1, piece.loops.end()},
          .source = source};
}

FoundSurface describe(const PointCloud& cloud, std::span<const std::uint32_t> members,
                      const Patch& patch, const Piece& piece) {
  const CellsInside cells = count_cells(patch.hit, patch.frame, piece);
  FoundSurface surface = surface_of(patch.plane, piece, Source::measured);
  PointSums sums;
  for (std::uint32_t i : members) sums.add(cloud, i, patch.plane);
  sums.describe(cloud, surface);
  // The share of the patch's cells in the polygon that have points.
  surface.support.coverage =
      cells.all > 0 ? static_cast<double>(cells.set) / static_cast<double>(cells.all) : 1;
  return surface;
}

}  // namespace

CellsInside count_cells(const Raster& raster, const PlaneFrame& frame, const Piece& piece) {
  const FlatPolygon polygon = flatten(frame, piece);
  CellsInside cells;
  const Vec2 low = ((polygon.box.min() - raster.low) / raster.cell).array().floor(),
             high = ((polygon.box.max() - raster.low) / raster.cell).array().ceil();
  for (int y = std::max(0, static_cast<int>(low.y()));
       y < std::min(raster.height, static_cast<int>(high.y())); ++y)
    for (int x = std::max(0, static_cast<int>(low.x()));
         x < std::min(raster.width, static_cast<int>(high.x())); ++x) {
      if (!polygon.contains(raster.middle(x, y))) continue;
      ++cells.all;
      cells.set += raster.is_set(x, y);
    }
  return cells;
}

std::vector<FoundSurface> describe(const PointCloud& cloud, const Members& members,
                                   const std::vector<Patch>& patches,
                                   const std::vector<Plane>& planes,
                                   const std::vector<Piece>& pieces) {
  std::vector<FoundSurface> surfaces(pieces.size());
  parallel_for(pieces.size(), [&](std::size_t k) {
    const auto patch = static_cast<std::size_t>(pieces[k].patch);
    if (patch < patches.size())
      surfaces[k] = describe(cloud, members.of(patch), patches[patch], pieces[k]);
    else
      surfaces[k] = surface_of(planes[patch], pieces[k], Source::inferred);
  });
  return surfaces;
}

}  // namespace scanworld::surface
