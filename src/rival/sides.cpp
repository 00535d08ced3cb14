// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sides.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "../parallel.h"

namespace scanworld::rival {

namespace {

constexpr int kRounds = 4;  // of 2-means

// What offsets along a normal add up to.
struct Layer {
  double n = 0, sum = 0, squares = 0;

  // `points` with this mean and variance.
  void add(double mean, double points = 1, double variance = 0) {
    n += points, sum += points * mean, squares += points * (mean * mean + variance);
  }
  double mean() const { return sum / n; }
  double scatter() const { return squares - sum * sum / n; }
};

// A point's offset along a normal, or that of several together.
struct Offset {
  double mean, points, variance;
};

// The offset half-way between two layers, by 2-means (Lloyd 1982), if they are two.
std::optional<double> separate(const std::vector<Offset>& offsets, double noise,
                               const SidesOptions& options) {
  Layer all, low, high;
  for (const Offset& o : offsets) all.add(o.mean, o.points, o.variance);
  double between = all.mean();
  for (int round = 0; round < kRounds; ++round) {
    low = high = {};
    for (const Offset& o : offsets)
      (o.mean < between ? low : high).add(o.mean, o.points, o.variance);
    if (std::min(low.n, high.n) < options.min_share * all.n) return std::nullopt;
    between = (low.mean() + high.mean()) / 2;
  }
  const double rms = std::sqrt(std::max(0.0, low.scatter() + high.scatter()) / all.n);
  if (rms > options.max_noise * noise || high.mean() - low.mean() < options.min_distance * noise)
    return std::nullopt;
  return between;
}

// The same by the points' normals: half-way between those that point along the axis and the others.
std::optional<double> separate_by_normals(const Layer& along, const Layer& against, double noise,
                                          const SidesOptions& options) {
  const double n = along.n + against.n;
  if (std::min(along.n, against.n) < options.min_share * n) return std::nullopt;
  const double rms = std::sqrt(std::max(0.0, along.scatter() + against.scatter()) / n);
  if (rms > options.max_noise * noise || along.mean() < against.mean() + noise) return std::nullopt;
  return (along.mean() + against.mean()) / 2;
}

// Whether a site may hold points of two layers.
bool is_mixed(const Site& site, const Vec3& normal, double noise, const SidesOptions& options) {
  return site.points > 1 && site.variance(normal) > std::pow(options.max_noise * noise, 2);
}

// The plane between the layers around a site, if there are two.
std::optional<Plane> find_separator(const PointCloud& cloud, const Grid& grid, std::size_t i,
                                    const Neighbors& neighbors, const LocalPlane& local,
                                    const Scale& scale, const SidesOptions& options,
                                    std::vector<Offset>& offsets) {
  const Vec3 normal = local.normal.cast<double>(), here = grid.sites[i].position();
  const double noise = scale.noise_at(here);
  const auto offset = [&](const Vec3f& p) { return normal.dot(p.cast<double>() - here); };
  std::optional<double> between;
  if (cloud.normals.empty()) {
    offsets.clear();
    for (std::uint32_t j : neighbors.of(i)) {
      const Site& s = grid.sites[j];
      if (!is_mixed(s, normal, noise, options)) {
        offsets.push_back({offset(s.mean), static_cast<double>(s.points), s.variance(normal)});
        continue;
      }
      const auto first = static_cast<std::ptrdiff_t>(offsets.size());
      for (std::uint32_t p : grid.points_of(j)) offsets.push_back({offset(cloud.points[p]), 1, 0});
      // Sums must not depend on the order of the points.
      std::sort(offsets.begin() + first, offsets.end(),
                [](const Offset& a, const Offset& b) { return a.mean < b.mean; });
    }
    between = separate(offsets, noise, options);
  } else {
    std::array<std::vector<double>, 2> sides;  // against the normal, and along it
    for (std::uint32_t j : neighbors.of(i))
      for (std::uint32_t p : grid.points_of(j))
        sides[cloud.normals[p].dot(local.normal) > 0].push_back(offset(cloud.points[p]));
    std::array<Layer, 2> layers;
    for (std::size_t k = 0; k < 2; ++k) {
      std::sort(sides[k].begin(), sides[k].end());
      for (double x : sides[k]) layers[k].add(x);
    }
    between = separate_by_normals(layers[1], layers[0], noise, options);
  }
  if (!between) return std::nullopt;
  return plane_through(here + *between * normal, normal);
}

}  // namespace

Grid part_sides(const PointCloud& cloud, Grid grid, const Neighbors& neighbors,
                const std::vector<LocalPlane>& local, const Scale& scale,
                const SidesOptions& options) {
  const std::size_t count = grid.sites.size();
  std::vector<std::vector<std::pair<std::uint32_t, Plane>>> found(part_count(count, kSitesPerPart));
  parallel_for(found.size(), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, count, kSitesPerPart);
    std::vector<Offset> offsets;
    for (std::size_t i = begin; i < end; ++i) {
      // Normals may tell two sides where all is within the noise of one plane.
      if (local[i].ratio < options.min_ratio || (local[i].planar() && cloud.normals.empty()))
        continue;
      if (const auto plane =
              find_separator(cloud, grid, i, neighbors, local[i], scale, options, offsets))
        found[part].push_back({static_cast<std::uint32_t>(i), *plane});
    }
  });
  for (const auto& list : found)
    for (const auto& [i, plane] : list) part_site(cloud, i, plane, grid);
  return grid;
}

}  // namespace scanworld::rival
