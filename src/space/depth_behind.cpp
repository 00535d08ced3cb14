// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "depth_behind.h"

#include <algorithm>

namespace scanworld::space {

namespace {

constexpr double kBeside = 0.1;  // of the way from a corner to the middle

struct Depth {
  double depth, area;  // [m], and [m2] that it stands for
};

double depth_at(const CellComplex& cells, const std::vector<Label>& labels, const Vec3& place,
                const Vec3& inwards, int plane, double max_depth) {
  double depth = max_depth;
  // The plane itself is where one begins, so that rounding does not tell on which side.
  const Vec3 from = place + 1e-6 * inwards;
  cells.walk(from, place + max_depth * inwards, plane, [&](int cell, double t0, double, int) {
    if (labels[static_cast<std::size_t>(cell)] != Label::free) return true;
    depth = t0 * max_depth;
    return false;
  });
  return depth;
}

}  // namespace

double depth_behind(const CellComplex& cells, const std::vector<Label>& labels,
                    const Interface& surface, const DepthOptions& options) {
  const Vec3 inwards = cells.plane(surface.plane).normal * (surface.is_flipped ? 1 : -1);
  std::vector<Depth> depths;
  double whole = 0;
  for (const int f : surface.facets) {
    const CellFacet& facet = cells.facets()[static_cast<std::size_t>(f)];
    const Vec3 middle = cells.middle_of(facet);
    const double area = cells.area_of(facet) / static_cast<double>(facet.vertices.size() + 1);
    const bool is_border = facet.cells[0] < 0 || facet.cells[1] < 0;
    const auto look = [&](const Vec3& place) {
      depths.push_back(
          {is_border ? options.max_depth
                     : depth_at(cells, labels, place, inwards, surface.plane, options.max_depth),
           area});
      whole += area;
    };
    look(middle);
    for (const int v : facet.vertices) look(cells.vertex(v) + kBeside * (middle - cells.vertex(v)));
  }
  std::sort(depths.begin(), depths.end(),
            [](const Depth& a, const Depth& b) { return a.depth < b.depth; });
  double sum = 0;
  for (const Depth& d : depths)
    if ((sum += d.area) > options.share * whole) return d.depth;
  return options.max_depth;
}

}  // namespace scanworld::space
