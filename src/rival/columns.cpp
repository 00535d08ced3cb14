// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "columns.h"

#include <algorithm>
#include <cmath>

#include "../circle.h"
#include "../disjoint_sets.h"
#include "round_fit.h"

namespace scanworld::rival {

namespace {

Vec2 plan_of(const Vec3& p) { return p.head<2>(); }

// How far a site's points are off an upright cylinder, as the mean of the squares [m2].
double mean_square(const Site& site, const Circle& circle) {
  const RoundShape cylinder{.point = {circle.center.x(), circle.center.y(), 0},
                            .radius = circle.radius};
  return off_surface(site, cylinder).square;
}

double mean_square(const Site& site, const Plane& plane) {
  const double off = plane.signed_distance(site.position());
  return site.variance(plane.normal) + off * off;
}

// Whether a cluster may be a facet: upright, and narrow enough to be one of a column's.
bool is_facet(const Cluster& cluster, const ColumnOptions& options) {
  const Vec3& n = cluster.fit.plane.normal;
  if (std::abs(n.z()) > std::sin(options.max_slope)) return false;
  const Vec3 across = Vec3::UnitZ().cross(n).normalized();
  return std::sqrt(12 * std::max(0.0, across.dot(cluster.moments.covariance() * across))) <
         options.max_radius;
}

// The facets next to each other, those with a site in no cluster between them too; each group by
// its lowest cluster.
DisjointSets join_facets(const Neighbors& neighbors, const Clustering& c,
                         const std::vector<char>& is_facet) {
  DisjointSets groups(c.clusters.size());
  std::vector<std::int32_t> seen;
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    if (!c.may_border(i)) continue;
    seen.clear();
    if (c.label[i] != kNone) {
      if (!is_facet[static_cast<std::size_t>(c.label[i])]) continue;
      seen.push_back(c.label[i]);
    }
    for (std::uint32_t j : neighbors.of(i))
      if (const std::int32_t l = c.label[j]; l != kNone && is_facet[static_cast<std::size_t>(l)])
        add_new(seen, l);
    for (std::size_t k = 1; k < seen.size(); ++k)
      groups.unite(static_cast<std::size_t>(seen[0]), static_cast<std::size_t>(seen[k]));
  }
  return groups;
}

// What the points of some facets are off their planes and off a circle in plan: sums of squares
// [m2].
struct Squares {
  double off_facets = 0, off_circle = 0, noise = 0;

  bool is_round(const ColumnOptions& options) const {
    return off_circle <= off_facets && off_circle <= options.max_noise * options.max_noise * noise;
  }
};

Squares squares_of(const Grid& grid, const Scale& scale, const Plane& facet, const Circle& circle,
                   const std::vector<std::uint32_t>& members) {
  Squares sum;
  for (std::uint32_t i : members) {
    const Site& s = grid.sites[i];
    sum.off_facets += s.points * mean_square(s, facet);
    sum.off_circle += s.points * mean_square(s, circle);
    sum.noise += s.points * scale.variance_at(s.position());
  }
  return sum;
}

// The circle in plan on which the points of some facets lie, where they do so better than on the
// facets.
std::optional<Circle> find_circle(const Grid& grid, const Scale& scale, const Clustering& c,
                                  const std::vector<std::vector<std::uint32_t>>& members,
                                  const std::vector<std::size_t>& facets,
                                  const ColumnOptions& options) {
  std::vector<WeightedPoint> points;
  for (std::size_t f : facets)
    for (std::uint32_t i : members[f])
      points.push_back(
          {plan_of(grid.sites[i].position()), static_cast<double>(grid.sites[i].points)});
  const std::optional<Circle> circle = fit_circle(points);
  if (!circle || circle->radius > options.max_radius) return std::nullopt;
  Squares all;
  for (std::size_t f : facets) {
    const Squares one = squares_of(grid, scale, c.clusters[f].fit.plane, *circle, members[f]);
    all.off_facets += one.off_facets, all.off_circle += one.off_circle, all.noise += one.noise;
  }
  return all.is_round(options) ? circle : std::nullopt;
}

}  // namespace

Clustering drop_columns(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                        Clustering c, const ColumnOptions& options) {
  std::vector<char> facet(c.clusters.size());
  for (std::size_t k = 0; k < facet.size(); ++k) facet[k] = is_facet(c.clusters[k], options);
  DisjointSets groups = join_facets(neighbors, c, facet);
  std::vector<std::vector<std::size_t>> facets_of(c.clusters.size());
  for (std::size_t k = 0; k < facet.size(); ++k)
    if (facet[k]) facets_of[groups.find(k)].push_back(k);
  const std::vector<std::vector<std::uint32_t>> members = members_of(c);
  std::vector<char> drop(c.clusters.size());
  for (auto& facets : facets_of) {
    if (facets.size() < 2) continue;  // a single one can always be bent a little
    std::optional<Circle> circle = find_circle(grid, scale, c, members, facets, options);
    // With them go those of the same column that do not touch them.
    for (std::size_t k = 0; circle && k < facet.size(); ++k) {
      const Cluster& cluster = c.clusters[k];
      const double off = circle->signed_distance(plan_of(cluster.fit.centroid));
      if (!facet[k] || std::abs(off) > circle->radius / 2 ||
          std::find(facets.begin(), facets.end(), k) != facets.end())
        continue;
      facets.push_back(k);
      const auto wider = find_circle(grid, scale, c, members, facets, options);
      if (wider && squares_of(grid, scale, cluster.fit.plane, *wider, members[k]).is_round(options))
        circle = wider;
      else
        facets.pop_back();
    }
    if (circle)
      for (std::size_t k : facets) drop[k] = 1;
  }
  for (std::size_t k = 0; k < drop.size(); ++k)
    if (drop[k])
      for (std::uint32_t i : members[k]) c.relabel(i, kNone);
  return c;
}

}  // namespace scanworld::rival
