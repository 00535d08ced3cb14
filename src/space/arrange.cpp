// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "arrange.h"

#include <algorithm>
#include <map>

#include "../polygon.h"

namespace scanworld::space {

namespace {

double area_of(const std::vector<Vec3>& polygon) { return doubled_area(polygon).norm() / 2; }

// The rectangle around polygons of a plane.
std::vector<Vec3> around(const SpacePlane& plane) {
  const PlaneFrame frame = frame_of(plane.plane);
  Eigen::AlignedBox2d box;
  for (const auto& region : plane.regions)
    for (const Vec3& p : region) box.extend(frame.to_plane(p));
  std::vector<Vec3> corners;
  for (const auto corner : {box.BottomLeft, box.BottomRight, box.TopRight, box.TopLeft})
    corners.push_back(frame.to_space(box.corner(corner)));
  return corners;
}

// [m2] of polygons in each cell.
std::map<int, double> areas_in_cells(const CellComplex& cells,
                                     const std::vector<std::vector<Vec3>>& polygons) {
  std::map<int, double> areas;
  for (const auto& polygon : polygons)
    cells.clip(polygon,
               [&](int cell, const std::vector<Vec3>& part) { areas[cell] += area_of(part); });
  return areas;
}

}  // namespace

Arrangement arrange(const std::vector<SpacePlane>& planes, const Box3& box,
                    const ArrangeOptions& options) {
  Arrangement result{CellComplex(grown(box, options.pad)), {}};
  CellComplex& cells = result.cells;
  result.parts.resize(CellComplex::kBoxPlanes);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    const SpacePlane& p = planes[k];
    if (p.regions.empty()) continue;
    const auto [plane, is_flipped] = cells.add_plane(p.plane);
    result.parts.resize(std::max(result.parts.size(), static_cast<std::size_t>(plane) + 1));
    result.parts[static_cast<std::size_t>(plane)].push_back({static_cast<int>(k), is_flipped});
    const bool is_surface = p.kind == SpacePlane::Kind::surface;
    double own = 0;
    for (const auto& region : p.regions) own += area_of(region);
    if (is_surface) own = p.size;
    const double enough = is_surface
                              ? std::min(options.min_touched, options.min_share * own)
                              : std::min(options.min_touched_bare, options.min_share_bare * own);
    const std::map<int, double> touched = areas_in_cells(cells, p.regions);
    const std::map<int, double> sections =
        is_surface ? areas_in_cells(cells, {around(p)}) : std::map<int, double>{};
    for (const auto& [cell, area] : touched) {
      const auto section = sections.find(cell);
      if (area >= enough ||
          (section != sections.end() && area >= options.min_own * section->second))
        cells.split(cell, plane);
    }
  }
  return result;
}

}  // namespace scanworld::space
