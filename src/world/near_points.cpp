// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "near_points.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

#include "../parallel.h"
#include "cell_table.h"

namespace scanworld {

namespace {

// Calls body(p) for every point of the cloud that is in the box, by several threads.
template <typename Body>
void for_points_in(const Box3& box, const CloudInWorld& cloud, const Body& body) {
  constexpr std::size_t kPart = 1 << 14;
  parallel_for(part_count(cloud.size(), kPart), [&](std::size_t i) {
    const auto [begin, end] = part_of(i, cloud.size(), kPart);
    for (std::size_t k = begin; k < end; ++k)
      if (const Vec3 p = cloud.point(k); box.contains(p)) body(p);
  });
}

// The smallest of some numbers does not depend on their order.
void lower(float& value, float other) {
  const std::atomic_ref<float> shared(value);
  float now = shared.load(std::memory_order_relaxed);
  while (other < now && !shared.compare_exchange_weak(now, other, std::memory_order_relaxed)) {
  }
}

// Numbers of places by the cells that their balls of radius `reach` touch: as cells are twice as
// large these are eight at most, and a point finds all places near it in its own cell.
struct PlacesByCell {
  std::vector<std::uint64_t> keys;   // of the cells, ascending
  std::vector<std::uint32_t> first;  // of each cell in `places`, and an end
  std::vector<std::uint32_t> places;
};

PlacesByCell sort_places(const std::vector<Vec3>& places, const std::vector<std::uint32_t>& which,
                         double reach) {
  struct Entry {
    std::uint64_t key;
    std::uint32_t place;
    auto operator<=>(const Entry&) const = default;
  };
  std::vector<Entry> entries;
  for (std::uint32_t place : which) {
    std::array<std::uint64_t, 8> keys{};
    for (std::size_t corner = 0; corner < 8; ++corner) {
      const Vec3 side(corner & 1 ? reach : -reach, corner & 2 ? reach : -reach,
                      corner & 4 ? reach : -reach);
      keys[corner] = CellTable::key_of(places[place] + side, 2 * reach);
    }
    std::sort(keys.begin(), keys.end());
    for (std::size_t k = 0; k < 8; ++k)
      if (k == 0 || keys[k] != keys[k - 1]) entries.push_back({keys[k], place});
  }
  std::sort(entries.begin(), entries.end());
  PlacesByCell sorted;
  for (const Entry& e : entries) {
    if (sorted.keys.empty() || sorted.keys.back() != e.key) {
      sorted.keys.push_back(e.key);
      sorted.first.push_back(static_cast<std::uint32_t>(sorted.places.size()));
    }
    sorted.places.push_back(e.place);
  }
  sorted.first.push_back(static_cast<std::uint32_t>(sorted.places.size()));
  return sorted;
}

// Lowers the squared distance of the places `which` to that of the nearest point within `reach`.
void look_within(double reach, const std::vector<Vec3>& places,
                 const std::vector<std::uint32_t>& which, const CloudInWorld& cloud,
                 std::vector<float>& squared) {
  const PlacesByCell sorted = sort_places(places, which, reach);
  const CellTable table(sorted.keys, 2 * reach);
  Box3 box;
  for (std::uint32_t place : which) box.extend(places[place]);
  for_points_in(grown(box, reach), cloud, [&](const Vec3& p) {
    const std::uint32_t cell = table.find(p);
    if (cell == CellTable::kNone) return;
    for (std::uint32_t i = sorted.first[cell]; i < sorted.first[cell + 1]; ++i) {
      const std::uint32_t place = sorted.places[i];
      lower(squared[place], static_cast<float>((places[place] - p).squaredNorm()));
    }
  });
}

// What the points of a cube add up to about its middle, in whole numbers: in any order the same.
struct CubeSums {
  std::array<std::int64_t, 10> sums{};  // n, x, y, z, xx, xy, xz, yy, yz, zz

  void add(const std::array<std::int64_t, 3>& d) {
    std::size_t k = 0;
    const auto to_next = [&](std::int64_t value) {
      std::atomic_ref(sums[k++]).fetch_add(value, std::memory_order_relaxed);
    };
    to_next(1);
    for (std::int64_t v : d) to_next(v);
    for (std::size_t a = 0; a < 3; ++a)
      for (std::size_t b = a; b < 3; ++b) to_next(d[a] * d[b]);
  }
};

// The plane of a cube's points in units of `unit` about its middle, if they lie in one.
std::optional<Plane> plane_of(const CubeSums& cube, double unit, const PlanarOptions& options) {
  std::array<double, 10> s{};
  for (std::size_t k = 0; k < 10; ++k) s[k] = static_cast<double>(cube.sums[k]);
  if (s[0] < static_cast<double>(options.min_points)) return std::nullopt;
  const Vec3 mean = Vec3(s[1], s[2], s[3]) / s[0];
  Mat3 covariance;
  covariance << s[4], s[5], s[6], s[5], s[7], s[8], s[6], s[8], s[9];
  covariance = covariance / s[0] - mean * mean.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(covariance);
  const Vec3 deviation = unit * solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  if (deviation[0] > options.rms_per_noise * options.noise ||
      deviation[1] < options.min_spread * options.cell)
    return std::nullopt;
  return plane_through(mean * unit, solver.eigenvectors().col(0));
}

}  // namespace

std::vector<double> nearest_point_distances(const std::vector<Vec3>& places,
                                            const CloudInWorld& cloud, double reach,
                                            double max_distance) {
  std::vector<float> squared(places.size(), std::numeric_limits<float>::max());
  std::vector<std::uint32_t> open(places.size());
  std::iota(open.begin(), open.end(), 0);
  constexpr double kGrowth = 3;
  for (; !open.empty(); reach *= kGrowth) {
    reach = std::min(reach, max_distance);
    look_within(reach, places, open, cloud, squared);
    if (reach >= max_distance) break;
    std::erase_if(
        open, [&](std::uint32_t i) { return static_cast<double>(squared[i]) <= reach * reach; });
  }
  std::vector<double> distances;
  for (float s : squared)
    distances.push_back(std::min(std::sqrt(static_cast<double>(s)), max_distance));
  return distances;
}

std::vector<std::optional<Vec3>> planar_normals(const std::vector<Vec3>& places,
                                                const CloudInWorld& cloud,
                                                const PlanarOptions& options) {
  std::vector<std::uint64_t> keys;
  Box3 box;
  for (const Vec3& p : places) {
    keys.push_back(CellTable::key_of(p, options.cell));
    box.extend(p);
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  const CellTable table(keys, options.cell);
  std::vector<CubeSums> cubes(keys.size());
  const double unit = options.cell / (1 << 15);  // squares of 2^28, so that 2^35 points add up
  const auto from_middle = [&](const Vec3& p, std::uint32_t cell) -> Vec3 {
    return p - CellTable::middle_of(keys[cell], options.cell);
  };
  for_points_in(grown(box, options.cell), cloud, [&](const Vec3& p) {
    const std::uint32_t cell = table.find(p);
    if (cell == CellTable::kNone) return;
    const Vec3 d = from_middle(p, cell) / unit;
    cubes[cell].add({std::llround(d.x()), std::llround(d.y()), std::llround(d.z())});
  });
  std::vector<std::optional<Plane>> planes(cubes.size());
  parallel_for(cubes.size(), [&](std::size_t c) { planes[c] = plane_of(cubes[c], unit, options); });
  std::vector<std::optional<Vec3>> normals(places.size());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::uint32_t cell = table.find(places[i]);
    const std::optional<Plane>& plane = planes[cell];
    if (plane && std::abs(plane->signed_distance(from_middle(places[i], cell))) <=
                     options.distance_per_noise * options.noise)
      normals[i] = plane->normal;
  }
  return normals;
}

}  // namespace scanworld
