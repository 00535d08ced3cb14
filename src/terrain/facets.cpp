// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "facets.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "../polygon.h"
#include "../surface/raster_outlines.h"

namespace scanworld::terrain {

namespace {

using Triangle = std::array<Vec2, 3>;

// By the lexical order of places.
struct Less {
  bool operator()(const Vec2& a, const Vec2& b) const {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  }
};

class FacetCutter {
 public:
  FacetCutter(const Heights& heights, const surface::Raster& wanted, const surface::Raster& seen,
              double error)
      : heights_(heights), wanted_(wanted), seen_(seen), error_(error) {}

  std::vector<Facet> cut() {
    std::vector<geos::Rings> outlines;
    for (surface::Ring& ring : surface::outline_rings(wanted_)) {
      for (const Vec2& p : ring.points) add(p);
      if (!ring.is_hole) outlines.emplace_back();
      outlines.back().push_back(std::move(ring.points));
    }
    std::vector<geos::Rings> valid;
    for (const geos::Rings& rings : outlines)
      for (geos::Rings& part : geos::make_valid(rings)) valid.push_back(std::move(part));
    std::vector<Facet> facets = triangulated();
    constexpr int kRounds = 40;
    for (int round = 0; round < kRounds && refine(facets); ++round) facets = triangulated();
    return cut_along(valid, facets);
  }

 private:
  // What of the facets is in some polygons.
  std::vector<Facet> cut_along(const std::vector<geos::Rings>& outlines,
                               const std::vector<Facet>& facets) const {
    std::vector<geos::Rings> whole;
    for (const Facet& facet : facets) whole.push_back(facet.rings);
    std::vector<std::vector<geos::Rings>> parts = geos::intersect(whole, outlines);
    std::vector<Facet> inside;
    for (std::size_t k = 0; k < facets.size(); ++k)
      for (geos::Rings& rings : parts[k]) {
        Facet part{.rings = std::move(rings),
                   .slope = facets[k].slope,
                   .base = facets[k].base,
                   .cells = {}};
        for (const std::size_t i : facets[k].cells)
          if (is_inside(part.rings, wanted_.middle(i)))
            part.cells.push_back(i), part.seen += seen_.bits[i] != 0;
        inside.push_back(std::move(part));
      }
    return inside;
  }

  // A place near a cell, with what the cells around it lead to expect.
  void add(const Vec2& p) {
    const surface::Raster& raster = wanted_;
    const Vec2 q = (p - raster.low) / raster.cell;
    const int x = std::clamp(static_cast<int>(q.x()), 0, raster.width - 1),
              y = std::clamp(static_cast<int>(q.y()), 0, raster.height - 1);
    double nearest = 1e300, height = 0;
    for (int v = y - 1; v <= y + 1; ++v)
      for (int u = x - 1; u <= x + 1; ++u) {
        if (!raster.is_set(u, v)) continue;
        const double distance = (raster.middle(u, v) - p).squaredNorm();
        if (distance < nearest) nearest = distance, height = heights_.height[raster.index(u, v)];
      }
    height_at_.emplace(p, height);
  }

  std::vector<Facet> triangulated() const {
    std::vector<Vec2> places;
    for (const auto& [p, height] : height_at_) places.push_back(p);
    std::vector<Facet> facets;
    for (const Triangle& t : geos::delaunay(places)) {
      Facet facet{.rings = {{t[0], t[1], t[2]}}};
      Eigen::Matrix2d edges;
      edges << (t[1] - t[0]).transpose(), (t[2] - t[0]).transpose();
      const double h = height_at_.at(t[0]);
      facet.slope = edges.inverse() * Vec2(height_at_.at(t[1]) - h, height_at_.at(t[2]) - h);
      facet.base = h - facet.slope.dot(t[0]);
      visit_cells(t, [&](std::size_t i) { facet.cells.push_back(i); });
      facets.push_back(std::move(facet));
    }
    return facets;
  }

  // Calls visit(i) for the wanted cells whose middles are in a triangle.
  template <typename Visit>
  void visit_cells(const Triangle& t, const Visit& visit) const {
    const surface::Raster& r = wanted_;
    Eigen::AlignedBox2d box;
    for (const Vec2& p : t) box.extend((p - r.low) / r.cell);
    const int y0 = std::max(0, static_cast<int>(box.min().y())),
              y1 = std::min(r.height - 1, static_cast<int>(box.max().y()));
    for (int y = y0; y <= y1; ++y) {
      const double at = r.middle(0, y).y();
      double low = 1e300, high = -1e300;
      for (std::size_t k = 0; k < 3; ++k) {
        Vec2 a = t[k], b = t[(k + 1) % 3];
        if (Less()(b, a)) std::swap(a, b);  // so that both triangles at an edge find one place
        if ((a.y() > at) == (b.y() > at)) continue;
        const double x = a.x() + (b.x() - a.x()) * ((at - a.y()) / (b.y() - a.y()));
        low = std::min(low, x), high = std::max(high, x);
      }
      const int x0 = std::max(0, static_cast<int>(std::ceil((low - r.low.x()) / r.cell - 0.5)));
      for (int x = x0; x < r.width && r.middle(x, y).x() < high; ++x)
        if (r.is_set(x, y)) visit(r.index(x, y));
    }
  }

  // Adds the worst place of each facet that is too far off; whether there was one.
  bool refine(const std::vector<Facet>& facets) {
    bool any = false;
    for (const Facet& facet : facets) {
      double worst = error_;
      Vec2 at;
      for (const std::size_t i : facet.cells) {
        if (!seen_.bits[i]) continue;
        const Vec2 p = wanted_.middle(i);
        const double off = std::abs(facet.height_at(p) - heights_.height[i]);
        if (off > worst) worst = off, at = p;
      }
      if (worst > error_) any |= height_at_.emplace(at, heights_.height[*wanted_.find(at)]).second;
    }
    return any;
  }

  const Heights& heights_;
  const surface::Raster &wanted_, &seen_;
  const double error_;
  std::map<Vec2, double, Less> height_at_;
};

}  // namespace

std::vector<Facet> cut_facets(const Heights& heights, const surface::Raster& wanted,
                              const surface::Raster& seen, double error) {
  return FacetCutter(heights, wanted, seen, error).cut();
}

}  // namespace scanworld::terrain
