// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "find_inferred.h"

#include "polygon.h"
#include "surface/raster_outlines.h"
#include "world/surface_rings.h"

namespace scanworld {

namespace {

// The cells that are measured, as polygons.
std::vector<geos::Rings> polygons_of(const surface::Raster& raster) {
  std::vector<geos::Rings> outlines;
  for (const surface::Ring& ring : surface::outline_rings(raster)) {
    if (!ring.is_hole) outlines.emplace_back();
    outlines.back().push_back(ring.points);
  }
  std::vector<geos::Rings> valid;
  for (const geos::Rings& rings : outlines)
    for (geos::Rings& part : geos::make_valid(rings)) valid.push_back(std::move(part));
  return valid;
}

}  // namespace

std::vector<InferredPart> find_inferred(const FoundSurface& surface,
                                        const std::function<bool(const Vec3&)>& is_measured,
                                        const InferredOptions& options) {
  const PlaneFrame frame = frame_of(surface.plane, surface.outer[0]);
  const geos::Rings rings = flat_rings(frame, surface);
  Eigen::AlignedBox2d box;
  for (const Vec2& p : rings[0]) box.extend(p);
  surface::Raster raster = surface::raster_around(box, options.cell, options.cell);
  bool is_whole = true;
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      const bool measured = is_measured(frame.to_space(raster.middle(x, y)));
      raster.bits[raster.index(x, y)] = measured;
      is_whole &= measured || !is_inside(rings, raster.middle(x, y));
    }
  std::vector<InferredPart> parts;
  if (is_whole) return parts;
  for (const geos::Rings& left : geos::subtract(rings, polygons_of(raster), 2 * options.cell)) {
    InferredPart part{placed_ring(frame, left[0]), {}};
    for (std::size_t k = 1; k < left.size(); ++k) part.holes.push_back(placed_ring(frame, left[k]));
    parts.push_back(std::move(part));
  }
  return parts;
}

}  // namespace scanworld
