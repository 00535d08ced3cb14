// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sides.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "../parallel.h"

namespace scanworld::rival {

namespace {

constexpr std::size_t kPart = 1 << 12;
constexpr std::size_t kMaxPoints = 128;  // around a site are looked at

// Some points' offsets along a normal, from the lowest, and what they add up to.
struct Layer {
  double n = 0, sum = 0, squares = 0;

  void add(double x) { n += 1, sum += x, squares += x * x; }
  double mean() const { return sum / n; }
  double scatter() const { return squares - sum * sum / n; }
};

// The offset between two layers that leaves the least scatter in them (Otsu 1979), if they are two.
std::optional<double> separate(std::vector<double>& offsets, double noise,
                               const SidesOptions& options) {
  std::sort(offsets.begin(), offsets.end());
  Layer low, all;
  for (double x : offsets) all.add(x);
  double best = all.scatter();
  std::size_t at = 0;
  Layer best_low;
  for (std::size_t k = 0; k + 1 < offsets.size(); ++k) {
    low.add(offsets[k]);
    const Layer high{all.n - low.n, all.sum - low.sum, all.squares - low.squares};
    if (const double left = low.scatter() + high.scatter(); left < best)
      best = left, at = k, best_low = low;
  }
  if (best_low.n == 0) return std::nullopt;
  const Layer high{all.n - best_low.n, all.sum - best_low.sum, all.squares - best_low.squares};
  const double share = std::min(best_low.n, high.n) / all.n;
  const double rms = std::sqrt(std::max(0.0, best) / all.n);
  if (share < options.min_share || rms > options.max_noise * noise ||
      high.mean() - best_low.mean() < options.min_distance * noise)
    return std::nullopt;
  return (offsets[at] + offsets[at + 1]) / 2;
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

// The plane between the layers around a site, if there are two.
std::optional<Plane> find_separator(const PointCloud& cloud, const Grid& grid, std::size_t i,
                                    const Neighbors& neighbors, const LocalPlane& local,
                                    const Scale& scale, const SidesOptions& options,
                                    std::vector<double>& offsets) {
  const Vec3 normal = local.normal.cast<double>(), here = grid.sites[i].position();
  const auto around = neighbors.of(i);
  std::size_t points = 0;
  for (std::uint32_t j : around) points += grid.sites[j].points;
  const std::size_t step = points / kMaxPoints + 1;
  offsets.clear();
  Layer along, against;
  for (std::uint32_t j : around) {
    const auto of_site = grid.points_of(j);
    for (std::size_t k = 0; k < of_site.size(); k += step) {
      const double x = normal.dot(cloud.points[of_site[k]].cast<double>() - here);
      offsets.push_back(x);
      if (!cloud.normals.empty())
        (cloud.normals[of_site[k]].dot(local.normal) > 0 ? along : against).add(x);
    }
  }
  const double noise = scale.noise_at(here);
  const auto between = cloud.normals.empty() ? separate(offsets, noise, options)
                                             : separate_by_normals(along, against, noise, options);
  if (!between) return std::nullopt;
  return plane_through(here + *between * normal, normal);
}

}  // namespace

Grid part_sides(const PointCloud& cloud, Grid grid, const Neighbors& neighbors,
                const std::vector<LocalPlane>& local, const Scale& scale,
                const SidesOptions& options) {
  const std::size_t count = grid.sites.size();
  std::vector<std::vector<std::pair<std::uint32_t, Plane>>> found(part_count(count, kPart));
  parallel_for(found.size(), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, count, kPart);
    std::vector<double> offsets;
    for (std::size_t i = begin; i < end; ++i)
      if (local[i].ratio >= options.min_ratio && (!local[i].planar() || !cloud.normals.empty()))
        if (const auto plane =
                find_separator(cloud, grid, i, neighbors, local[i], scale, options, offsets))
          found[part].push_back({static_cast<std::uint32_t>(i), *plane});
  });
  for (const auto& list : found)
    for (const auto& [i, plane] : list) part_site(cloud, i, plane, grid);
  return grid;
}

}  // namespace scanworld::rival
