// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "round_seeds.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "../parallel.h"
#include "round_fit.h"

namespace scanworld::rival {

namespace {

constexpr double kLeastTurn = 0.02;  // [rad] between neighbouring strips of a curve
constexpr int kLeastContacts = 4;    // of a strip with such neighbours, looking at ...
constexpr std::uint32_t kStep = 4;   // ... one in so many sites
constexpr std::array<std::size_t, 3> kLevels = {50, 150, 400};  // sites of a neighbourhood
constexpr std::size_t kFewest = 12;                             // sites that tell anything
constexpr std::size_t kEnough = 50;                             // to fit a shape to
constexpr double kBent = 2.5;          // [noise2] off a plane: it no longer explains them
constexpr float kLeastCosine = 0.8f;   // of neighbours' normals on one surface
constexpr double kMostCylinder = 0.6;  // roundness of normals, both ways
constexpr double kLeastSphere = 0.2;
constexpr double kLeastAngle = 0.2;  // [rad] half of a cone's; less grows as a cylinder first

// A set of sites, for some hundred.
class SiteSet {
 public:
  // Tells whether it was new.
  bool add(std::uint32_t i) {
    for (std::size_t h = i * 2654435761u % kSize;; h = (h + 1) % kSize) {
      if (table_[h] == i) return false;
      if (table_[h] == kFree) return table_[h] = i, true;
    }
  }
  SiteSet() { table_.fill(kFree); }

 private:
  static constexpr std::size_t kSize = 1024;
  static constexpr std::uint32_t kFree = ~0u;
  std::array<std::uint32_t, kSize> table_;
};

// How alike normals spread in the two directions in which they do most, 0 to 1: little on a
// cylinder, much on a sphere.
double roundness_of(const std::vector<Vec3f>& normals) {
  Moments sum;
  for (const Vec3f& n : normals) sum += (n.dot(normals[0]) < 0 ? -n : n).cast<double>().eval();
  const MomentFit spread = fit(sum);
  return spread.variance[1] / std::max(spread.variance[2], 1e-12);
}

class SeedFinder {
 public:
  SeedFinder(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
             const std::vector<LocalPlane>& local, const CurveOptions& options)
      : grid_(grid), neighbors_(neighbors), scale_(scale), local_(local), options_(options) {}

  // The round surfaces in the least neighbourhood that bends.
  std::vector<RoundSeed> look_around(std::uint32_t start) const {
    std::vector<std::uint32_t> sites{start};
    SiteSet known;
    known.add(start);
    Moments sum = grid_.sites[start].moments();
    const double bent = kBent * scale_.variance_at(grid_.sites[start].position());
    std::size_t next = 0;
    for (const std::size_t level : kLevels) {
      for (; next < sites.size() && sites.size() < level; ++next)
        for (std::uint32_t j : neighbors_.of(sites[next])) {
          if (local_[j].ratio < kReliableRatio || sites.size() >= level) continue;
          const float cosine = local_[j].normal.dot(local_[sites[next]].normal);
          if (std::abs(cosine) < kLeastCosine || !known.add(j)) continue;
          sites.push_back(j);
          sum += grid_.sites[j].moments();
        }
      if (sites.size() < kFewest) return {};
      if (const double flat = fit(sum).variance[0]; flat > bent)
        if (std::vector<RoundSeed> seeds = fit_shapes(sites, flat); !seeds.empty()) return seeds;
      if (sites.size() < level) return {};
    }
    return {};
  }

 private:
  // Those shapes that most of the sites are on, and that explain them far better than a plane.
  std::vector<RoundSeed> fit_shapes(const std::vector<std::uint32_t>& sites, double flat) const {
    std::vector<RoundSeed> seeds;
    const std::vector<std::uint32_t> some = some_of(sites, kEnough);
    std::vector<Vec3f> normals;
    for (std::uint32_t i : some) normals.push_back(local_[i].normal);
    const double roundness = roundness_of(normals);
    for (CurveType type : {CurveType::cylinder, CurveType::sphere, CurveType::cone}) {
      if (type == CurveType::sphere ? roundness < kLeastSphere : roundness > kMostCylinder)
        continue;
      const auto shape = fit_round(type, grid_, some, normals, options_.weight);
      if (!shape || !has_good_radius(*shape, options_)) continue;
      if (type == CurveType::cone && shape->half_angle < kLeastAngle) continue;
      double square = 0, points = 0, on = 0;
      for (std::uint32_t i : sites) {
        const Site& s = grid_.sites[i];
        const double off = off_surface(s, *shape).square;
        if (off > limit_of(s, *shape, scale_, options_)) continue;
        square += s.points * off, points += s.points, on += 1;
      }
      if (on < 0.8 * static_cast<double>(sites.size()) || square > 0.5 * flat * points) continue;
      const double variance = variance_of(grid_.sites[sites[0]], *shape, scale_, options_);
      seeds.push_back({*shape, sites, square / points / variance / std::sqrt(on)});
    }
    return seeds;
  }

  const Grid& grid_;
  const Neighbors& neighbors_;
  const Scale& scale_;
  const std::vector<LocalPlane>& local_;
  const CurveOptions& options_;
};

// Whether each cluster may be a strip of a curve.
std::vector<std::uint8_t> find_strips(const Clustering& c, const Neighbors& neighbors,
                                      const Scale& scale, const CurveOptions& options) {
  const double most = std::cos(2 * options.max_angle), least = std::cos(kLeastTurn);
  std::vector<int> contacts(c.clusters.size());
  for (std::uint32_t i = 0; i < c.label.size(); i += kStep) {
    const std::int32_t a = c.label[i];
    if (a == kNone) continue;
    for (std::uint32_t j : neighbors.of(i)) {
      const std::int32_t b = c.label[j];
      if (b == kNone || b == a) continue;
      const double cosine = std::abs(c.plane(a).normal.dot(c.plane(b).normal));
      if (cosine < most || cosine > least) continue;
      ++contacts[static_cast<std::size_t>(a)], ++contacts[static_cast<std::size_t>(b)];
    }
  }
  std::vector<std::uint8_t> strips = find_wide(c, scale, options);
  for (std::size_t k = 0; k < strips.size(); ++k)
    strips[k] = !strips[k] && contacts[k] >= kLeastContacts;
  return strips;
}

}  // namespace

std::vector<std::uint8_t> find_wide(const Clustering& clusters, const Scale& scale,
                                    const CurveOptions& options) {
  const double widest = std::sqrt(8 * options.max_radius * 4 * scale.noise);
  std::vector<std::uint8_t> wide;
  for (const Cluster& c : clusters.clusters)
    wide.push_back(std::sqrt(12 * c.fit.variance[1]) > widest);
  return wide;
}

bool has_good_radius(const RoundShape& shape, const CurveOptions& options) {
  const double least = shape.type == CurveType::sphere ? kSmallRadius : options.min_radius;
  return shape.radius >= least && shape.radius <= options.max_radius;
}

std::vector<std::uint32_t> some_of(const std::vector<std::uint32_t>& sites, std::size_t enough) {
  if (sites.size() <= enough) return sites;
  std::vector<std::uint32_t> some;
  for (std::size_t k = 0; k < enough; ++k) some.push_back(sites[k * sites.size() / enough]);
  return some;
}

std::vector<RoundSeed> find_round_seeds(const Grid& grid, const Neighbors& neighbors,
                                        const Scale& scale, const std::vector<LocalPlane>& local,
                                        const Clustering& clusters, const CurveOptions& options) {
  const std::vector<std::uint8_t> strips = find_strips(clusters, neighbors, scale, options);
  std::vector<std::int64_t> best(grid.blocks.size(), -1);
  for (std::uint32_t i = 0; i < grid.sites.size(); ++i) {
    const std::int32_t l = clusters.label[i];
    if (l == kNone || !strips[static_cast<std::size_t>(l)] || local[i].ratio < kReliableRatio)
      continue;
    std::int64_t& b = best[grid.sites[i].voxel >> 9];
    if (b < 0 || local[i].ratio > local[static_cast<std::size_t>(b)].ratio) b = i;
  }
  std::erase(best, -1);
  const SeedFinder finder(grid, neighbors, scale, local, options);
  std::vector<std::vector<RoundSeed>> found(best.size());
  parallel_for(best.size(), [&](std::size_t k) {
    found[k] = finder.look_around(static_cast<std::uint32_t>(best[k]));
  });
  std::vector<RoundSeed> seeds;
  for (auto& list : found) std::move(list.begin(), list.end(), std::back_inserter(seeds));
  const auto order = [](const RoundSeed& s) {
    return std::pair(s.shape.type == CurveType::cone, s.rank);
  };
  std::stable_sort(seeds.begin(), seeds.end(),
                   [&](const RoundSeed& a, const RoundSeed& b) { return order(a) < order(b); });
  return seeds;
}

}  // namespace scanworld::rival
