// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "floors.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "floor_pieces.h"
#include "join.h"

namespace scanworld::rival {

namespace {

constexpr double kFewestShared = 3;  // squares that two layers have in common at least

bool lies_in_layers(const Encounter& e, const FloorOptions& options) {
  return e.shared >= kFewestShared && e.shared > options.min_overlap * e.inside &&
         std::abs(e.offset) < options.max_offset;
}

// A step is one by the places beside it and by the planes of both: that of a few places may be
// chance, that of planes a bow.
bool has_step(const Encounter& e, const FloorOptions& options, const MergeOptions& merge) {
  const double limit = std::max(merge.min_step, merge.step_errors * e.error);
  // Where noise mixes them the one has the upper points, the other the lower ones.
  if (e.shared >= kFewestShared && e.shared > options.min_overlap * (e.shared + e.beside) &&
      std::abs(e.offset) < options.max_offset)
    return false;
  return std::min(std::abs(e.step), std::abs(e.between)) > limit;
}

// Two pieces that may be one floor: layers first, then those with the better plane in common.
struct Match {
  bool is_layer;
  double price;
  std::size_t larger, lesser;

  bool operator<(const Match& o) const {
    return std::tuple(!is_layer, price, larger, lesser) <
           std::tuple(!o.is_layer, o.price, o.larger, o.lesser);
  }
};

std::vector<Match> find_matches(const Grid& grid, const Scale& scale, const Clustering& c,
                                const Vec3& up, const FloorOptions& options,
                                const MergeOptions& merge, const BridgeOptions& bridge) {
  std::vector<Match> matches;
  const double reach = bridge.max_gap * grid.voxel;
  const FloorPieces pieces(grid, c, up, options.max_tilt, options.max_height);
  const GapFinder gaps(grid, c, gaps_of_clusters(grid, bridge));
  for (const std::size_t b : pieces.clusters())
    for (const std::size_t a : pieces.clusters()) {
      if (a == b) break;
      if (!pieces.are_near(a, b, reach)) continue;
      const Encounter e = pieces.compare(a, b, reach);
      if (!e.is_meeting()) continue;
      const double price =
          joint_price(c.clusters[a], c.clusters[b], scale, options.max_rms, Meeting::smooth);
      const bool is_layer = lies_in_layers(e, options);
      if (is_layer || (price < 1 && !has_step(e, options, merge) && gaps.is_open(a, b)))
        matches.push_back({is_layer, price, a, b});
    }
  std::sort(matches.begin(), matches.end());
  return matches;
}

// How far the parts of a floor are off its plane beside noise, where that is more than noise [m].
double bend_of(const Cluster& a, const Cluster& b, const Scale& scale) {
  const Plane plane = fit(a.moments + b.moments).plane;
  const double square = std::max(a.moments.mean_square(plane), b.moments.mean_square(plane)),
               variance = scale.variance_at(a.fit.centroid);
  return square > 4 * variance ? std::sqrt(square - variance) : 0;
}

// The plane of a piece that goes on from others where it meets them: places on those weigh as much
// as all its own points.
class Hinge {
 public:
  void add(const Plane& other, const std::vector<Vec3>& contacts) {
    for (const Vec3& p : contacts) places_ += Vec3(p - other.signed_distance(p) * other.normal);
  }
  Plane plane_of(const Moments& own) const {
    Moments all = own;
    const double weight = kWeight * own.n / places_.n;
    for (const auto m : {&Moments::n, &Moments::x, &Moments::y, &Moments::z, &Moments::xx,
                         &Moments::xy, &Moments::xz, &Moments::yy, &Moments::yz, &Moments::zz})
      all.*m += weight * places_.*m;
    return fit(all).plane;
  }

 private:
  static constexpr double kWeight = 4;
  Moments places_;
};

// Two facets of a floor that meet.
struct Fold {
  std::size_t larger, lesser;
};

// The pieces that go on into each other, those of the largest first. The lesser one of each takes a
// plane that does, if its points are hardly worse in that.
std::vector<Fold> find_folds(const Grid& grid, const FloorPieces& pieces, const Scale& scale,
                             Clustering& c, const FloorOptions& options, const MergeOptions& merge,
                             const BridgeOptions& bridge) {
  constexpr double kLeastTurn = 0.005;  // [rad] between facets; planes at less meet nowhere
  const double reach = bridge.max_gap * grid.voxel;
  const GapFinder gaps(grid, c, gaps_of_clusters(grid, bridge));
  std::vector<Fold> folds, found;
  Hinge hinge;
  const auto finish = [&](std::size_t k) {
    if (found.empty()) return;
    Cluster& own = c.clusters[k];
    const Plane plane = hinge.plane_of(own.moments);
    const double bend = scale.flatness.limit_at(extent_of(own.fit));
    if (own.moments.mean_square(plane) < square_limit(own, own, bend, scale, merge.max_rms)) {
      own.fit.plane = plane.normal.dot(own.fit.plane.normal) < 0 ? plane.flipped() : plane;
      own.fit.variance[0] = own.moments.mean_square(plane);
      folds.insert(folds.end(), found.begin(), found.end());
    }
    hinge = {}, found.clear();
  };
  for (const std::size_t lesser : pieces.clusters()) {
    for (const std::size_t larger : pieces.clusters()) {
      if (larger == lesser) break;
      const Vec3 &p = c.clusters[larger].fit.plane.normal, &q = c.clusters[lesser].fit.plane.normal;
      if (!pieces.are_near(larger, lesser, reach) || p.cross(q).norm() < kLeastTurn) continue;
      const Encounter e = pieces.compare(larger, lesser, reach);
      if (!e.is_meeting() || has_step(e, options, merge) || !gaps.is_open(larger, lesser)) continue;
      hinge.add(c.clusters[larger].fit.plane, e.contacts);
      found.push_back({larger, lesser});
    }
    finish(lesser);
  }
  return folds;
}

// Gives the sites around the line of two facets to the one on whose side they are.
void part_at_fold(const Grid& grid, const Scale& scale, const FloorPieces& pieces, const Fold& fold,
                  const Vec3& up, Clustering& c) {
  constexpr int kNear = 2;           // [voxels] from the other facet
  constexpr double kMostOver = 0.3;  // of a facet's sites that are on the other's side
  const auto a = static_cast<std::int32_t>(fold.larger), b = static_cast<std::int32_t>(fold.lesser);
  const auto over = [&](const Vec3& p) { return height_over(c.plane(b), c.plane(a), p, up); };
  const double side = over(c.clusters[fold.lesser].fit.centroid) < 0 ? -1 : 1;
  const auto fits = [&](std::uint32_t i, const Plane& plane) {
    const Vec3 p = grid.sites[i].position();
    return std::pow(plane.signed_distance(p), 2) < 9 * scale.variance_at(p);
  };
  const auto touches = [&](std::uint32_t i, std::int32_t other) {
    bool found = false;
    grid.for_each_near(i, kNear, [&](std::uint32_t j) { found = found || c.label[j] == other; });
    return found;
  };
  std::vector<std::pair<std::uint32_t, std::int32_t>> moved;
  double gone = 0;
  for (const std::uint32_t i : pieces.members(fold.lesser))
    if (c.label[i] == b && side * over(grid.sites[i].position()) < 0) {
      ++gone;
      if (fits(i, c.plane(a))) moved.push_back({i, a});
    }
  if (gone > kMostOver * static_cast<double>(pieces.members(fold.lesser).size())) return;
  for (const std::uint32_t i : pieces.members(fold.larger))
    if (c.label[i] == a && pieces.box(fold.lesser).contains(grid.sites[i].position()) &&
        side * over(grid.sites[i].position()) > 0 && fits(i, c.plane(b)) && touches(i, b))
      moved.push_back({i, b});
  for (const auto& [site, label] : moved) c.relabel(site, label);
}

}  // namespace

Clustering join_floors(const Grid& grid, const Scale& scale, Clustering c, const Vec3& up,
                       const FloorOptions& options, const MergeOptions& merge,
                       const BridgeOptions& bridge) {
  const std::vector<Match> matches = find_matches(grid, scale, c, up, options, merge, bridge);
  Joiner joiner(std::move(c));
  for (const Match& m : matches) {
    const Cluster &p = joiner.whole(m.larger), &q = joiner.whole(m.lesser);
    if (&p == &q) continue;
    if (m.is_layer)
      joiner.join(m.larger, m.lesser);
    else if (joint_price(p, q, scale, options.max_rms, Meeting::smooth) < 1)
      joiner.join(m.larger, m.lesser, bend_of(p, q, scale));
  }
  return joiner.finish(grid);
}

Clustering fold_floors(const Grid& grid, const Scale& scale, Clustering c, const Vec3& up,
                       const FloorOptions& options, const MergeOptions& merge,
                       const BridgeOptions& bridge) {
  const FloorPieces pieces(grid, c, up, options.max_tilt, options.max_height);
  const std::vector<Fold> folds = find_folds(grid, pieces, scale, c, options, merge, bridge);
  for (const Fold& fold : folds) part_at_fold(grid, scale, pieces, fold, up, c);
  return c;
}

}  // namespace scanworld::rival
