// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "patch.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../parallel.h"

namespace scanworld::surface {

Members group_points(const std::vector<std::int32_t>& labels, std::size_t planes) {
  constexpr std::size_t kPart = 1 << 18;
  const std::size_t parts = part_count(labels.size(), kPart);
  std::vector<std::vector<std::size_t>> count(parts, std::vector<std::size_t>(planes));
  parallel_for(parts, [&](std::size_t part) {
    const auto [begin, end] = part_of(part, labels.size(), kPart);
    for (std::size_t i = begin; i < end; ++i)
      if (labels[i] >= 0) ++count[part][static_cast<std::size_t>(labels[i])];
  });
  Members members;
  std::size_t sum = 0;
  for (std::size_t k = 0; k < planes; ++k) {
    members.first.push_back(sum);
    for (auto& c : count) sum += std::exchange(c[k], sum);
  }
  members.first.push_back(sum);
  members.points.resize(sum);
  parallel_for(parts, [&](std::size_t part) {
    const auto [begin, end] = part_of(part, labels.size(), kPart);
    for (std::size_t i = begin; i < end; ++i)
      if (labels[i] >= 0)
        members.points[count[part][static_cast<std::size_t>(labels[i])]++] =
            static_cast<std::uint32_t>(i);
  });
  return members;
}

namespace {

constexpr double kLeastSeen = 0.15;  // share of cells with points, of the sparsest surface

// Points a cell: those in all cells, or, where they are in a part of them only, as dense as there.
// Points that come by chance at a mean m hit 1 - exp(-m) of the cells.
float density_of(float points, int hits, int cells) {
  const float in_hit = points / static_cast<float>(hits);
  float mean = in_hit;
  for (int k = 0; k < 12; ++k) mean = in_hit * (1 - std::exp(-mean));
  return std::max(mean, points / static_cast<float>(cells));
}

class PatchMaker {
 public:
  PatchMaker(const PointCloud& cloud, std::span<const std::uint32_t> members, double cell,
             const PatchOptions& options)
      : cloud_(cloud), members_(members), cell_(cell), options_(options) {}

  Patch make(const Plane& plane) {
    Patch patch{.plane = plane, .frame = frame_of(plane)};
    if (members_.empty()) return patch;
    rasterize(patch);
    if (const int lines = lines_apart(patch.hit); lines > 1) {
      cell_ *= lines;
      rasterize(patch);
    }
    weigh(patch);
    return patch;
  }

 private:
  void rasterize(Patch& patch) {
    Eigen::AlignedBox2d extent;
    for (std::uint32_t i : members_) {
      const Vec3 p = cloud_.points[i].cast<double>();
      patch.box.extend(p);
      extent.extend(patch.frame.to_plane(p));
    }
    Raster& hit = patch.hit;
    hit = raster_around(extent, options_.margin, cell_);
    const std::size_t count = hit.bits.size();
    count_.assign(count, 0);
    // In whole parts of a cell, as the points come in any order.
    std::vector<std::array<std::uint32_t, 2>> sum(count);
    for (std::uint32_t member : members_) {
      const Vec2 q = (patch.frame.to_plane(cloud_.points[member].cast<double>()) - hit.low) / cell_;
      const int x = static_cast<int>(q.x()), y = static_cast<int>(q.y());
      const std::size_t i = hit.index(x, y);
      hit.bits[i] = 1, ++count_[i];
      sum[i][0] += static_cast<std::uint32_t>((q.x() - x) * 256);
      sum[i][1] += static_cast<std::uint32_t>((q.y() - y) * 256);
    }
    patch.middle.resize(count);
    for (int y = 0; y < hit.height; ++y)
      for (int x = 0; x < hit.width; ++x) {
        const std::size_t i = hit.index(x, y);
        patch.middle[i] = hit.middle(x, y);
        if (count_[i] == 0) continue;
        const Vec2 within = Vec2(sum[i][0], sum[i][1]) / (256.0 * count_[i]);
        patch.middle[i] = hit.low + cell_ * (Vec2(x, y) + within);
      }
    patch.covered = close(hit, gap_of(hit));
  }

  // [cells] between the scan lines that points are dense along, 1 where there are none: closing the
  // gaps between lines makes so much more of them, but little more of anything else.
  int lines_apart(const Raster& hit) const {
    constexpr int kReach = 6;       // half of the widest gap
    constexpr double kDense = 2.2;  // points in cells that have some
    constexpr double kLeast = 1.8;  // ragged things have less
    const auto count = [](const Raster& raster) {
      return static_cast<double>(std::count(raster.bits.begin(), raster.bits.end(), 1));
    };
    const double lines = count(hit);
    if (static_cast<double>(members_.size()) < kDense * lines) return 1;
    Raster room{.width = hit.width + 2 * kReach, .height = hit.height + 2 * kReach};
    room.bits.assign(room.index(0, room.height), 0);
    for (int y = 0; y < hit.height; ++y)
      for (int x = 0; x < hit.width; ++x)
        room.bits[room.index(x + kReach, y + kReach)] = hit.is_set(x, y);
    const double times = count(close(room, kReach)) / lines;
    return times < kLeast ? 1 : static_cast<int>(std::ceil(std::min(times, 8.0)));
  }

  // [cells] half of the widest gap that is to be expected between points.
  int gap_of(const Raster& hit) const {
    const auto hits = static_cast<double>(std::count(hit.bits.begin(), hit.bits.end(), 1));
    const double density = static_cast<double>(members_.size()) / hits;  // where there are some
    return density < 1.4 ? 3 : density < 2.2 ? 2 : 1;
  }

  // How many points a cell would have, by squares of 8 x 8 cells that have some, or larger ones.
  std::vector<float> expect(const Patch& patch) const {
    constexpr int kSquare = 8;
    const Raster& hit = patch.hit;
    const int width = (hit.width + kSquare - 1) / kSquare,
              height = (hit.height + kSquare - 1) / kSquare;
    const auto square = [&](int x, int y) {
      return static_cast<std::size_t>(y / kSquare) * static_cast<std::size_t>(width) +
             static_cast<std::size_t>(x / kSquare);
    };
    std::vector<float> density(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    std::vector<int> hits(density.size());
    for (int y = 0; y < hit.height; ++y)
      for (int x = 0; x < hit.width; ++x) {
        density[square(x, y)] += static_cast<float>(count_[hit.index(x, y)]);
        hits[square(x, y)] += hit.is_set(x, y);
      }
    for (std::size_t i = 0; i < density.size(); ++i)
      if (hits[i] > 0) density[i] = density_of(density[i], hits[i], kSquare * kSquare);
    fill_gaps(density, width, height);
    std::vector<float> expected(hit.bits.size());
    for (int y = 0; y < hit.height; ++y)
      for (int x = 0; x < hit.width; ++x) expected[hit.index(x, y)] = density[square(x, y)];
    return expected;
  }

  // Gives squares without points the mean of those around that have some, farther and farther.
  static void fill_gaps(std::vector<float>& values, int width, int height) {
    for (bool any = true; any;) {
      any = false;
      const std::vector<float> before = values;
      for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
          const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                         static_cast<std::size_t>(x);
          if (before[i] > 0) continue;
          float sum = 0;
          int count = 0;
          for (int b = std::max(0, y - 1); b <= std::min(height - 1, y + 1); ++b)
            for (int a = std::max(0, x - 1); a <= std::min(width - 1, x + 1); ++a) {
              const float v = before[static_cast<std::size_t>(b) * static_cast<std::size_t>(width) +
                                     static_cast<std::size_t>(a)];
              if (v > 0) sum += v, ++count;
            }
          if (count > 0) values[i] = sum / static_cast<float>(count), any = true;
        }
    }
  }

  void weigh(Patch& patch) const {
    const std::vector<float> expected = expect(patch);
    patch.evidence.assign(expected.size(), 0);
    for (std::size_t i = 0; i < expected.size(); ++i) {
      // Of points that come by chance, the share of cells that would have one.
      const double seen = 1 - std::exp(-static_cast<double>(expected[i]));
      patch.evidence[i] =
          static_cast<float>(patch.hit.bits[i] ? 1 / std::max(seen, kLeastSeen) : -seen);
    }
  }

  const PointCloud& cloud_;
  std::span<const std::uint32_t> members_;
  double cell_;
  const PatchOptions& options_;
  std::vector<std::uint32_t> count_;  // points in each cell
};

}  // namespace

std::vector<Patch> find_patches(const PointCloud& cloud, const Members& members,
                                const std::vector<Plane>& planes, double cell,
                                const PatchOptions& options) {
  std::vector<Patch> patches(planes.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    patches[k] = PatchMaker(cloud, members.of(k), cell, options).make(planes[k]);
  });
  return patches;
}

}  // namespace scanworld::surface
