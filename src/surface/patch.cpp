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

Surroundings surroundings_of(std::vector<Vec3f> points, std::vector<std::int32_t> planes) {
  Surroundings s{std::move(points), std::move(planes), {}};
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    if (i % Surroundings::kRun == 0) s.boxes.emplace_back();
    s.boxes.back().extend(s.points[i]);
  }
  return s;
}

namespace {

constexpr std::size_t kFacingStep = 8;  // one of so many is enough to tell the free side
constexpr double kLeastSeen = 0.15;     // share of cells with points, of the sparsest surface

// Points a cell: those in all cells, or, where they are in a part of them only, as dense as there.
// Points that come by chance at a mean m hit 1 - exp(-m) of the cells.
float density_of(float points, int hits, int cells) {
  const float in_hit = points / static_cast<float>(hits);
  float mean = in_hit;
  for (int k = 0; k < 12; ++k) mean = in_hit * (1 - std::exp(-mean));
  return std::max(mean, points / static_cast<float>(cells));
}

Raster empty_like(Raster raster) {
  std::fill(raster.bits.begin(), raster.bits.end(), 0);
  return raster;
}

void set(Raster& raster, const Vec2& p) {
  const Vec2 q = ((p - raster.low) / raster.cell).array().floor();
  const int x = static_cast<int>(q.x()), y = static_cast<int>(q.y());
  if (raster.contains(x, y)) raster.bits[raster.index(x, y)] = 1;
}

// The cells that have set ones to both sides, along both axes.
Raster enclosed_by(const Raster& raster) {
  std::vector<int> ways(raster.bits.size());
  const auto walk = [&](int x, int y, int dx, int dy) {
    for (bool met = false; raster.contains(x, y); x += dx, y += dy) {
      const std::size_t i = raster.index(x, y);
      met |= raster.bits[i] != 0;
      ways[i] += met;
    }
  };
  for (int y = 0; y < raster.height; ++y) walk(0, y, 1, 0), walk(raster.width - 1, y, -1, 0);
  for (int x = 0; x < raster.width; ++x) walk(x, 0, 0, 1), walk(x, raster.height - 1, 0, -1);
  Raster enclosed = empty_like(raster);
  for (std::size_t i = 0; i < ways.size(); ++i) enclosed.bits[i] = ways[i] == 4;
  return enclosed;
}

class PatchMaker {
 public:
  PatchMaker(const PointCloud& cloud, std::span<const std::uint32_t> members,
             const std::vector<Plane>& planes, double cell, const Surroundings& surroundings,
             const Vec3& up, const PatchOptions& options)
      : cloud_(cloud),
        members_(members),
        planes_(planes),
        cell_(cell),
        around_(surroundings),
        up_(up),
        options_(options) {}

  Patch make(const Plane& plane) {
    Patch patch{.plane = plane, .frame = frame_of(plane)};
    if (members_.empty()) return patch;
    rasterize(patch);
    if (is_from_behind(patch)) {
      patch = {.plane = plane.flipped(), .frame = frame_of(plane.flipped())};
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
    hit.cell = cell_;
    // At whole cells, so that the raster does not hang on a single point.
    const Vec2 low = ((extent.min().array() - options_.margin) / cell_).floor(),
               high = ((extent.max().array() + options_.margin) / cell_).ceil();
    hit.low = cell_ * low;
    hit.width = static_cast<int>(high.x() - low.x());
    hit.height = static_cast<int>(high.y() - low.y());
    const std::size_t count =
        static_cast<std::size_t>(hit.width) * static_cast<std::size_t>(hit.height);
    hit.bits.assign(count, 0);
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

  // [cells] half of the widest gap that is to be expected between points.
  int gap_of(const Raster& hit) const {
    const auto hits = static_cast<double>(std::count(hit.bits.begin(), hit.bits.end(), 1));
    const double density = static_cast<double>(members_.size()) / hits;  // where there are some
    return density < 1.4 ? 3 : density < 2.2 ? 2 : 1;
  }

  // Calls body(distance, where, plane) for what is around the patch, up to a depth.
  template <typename Body>
  void look(const Patch& patch, double depth, const Body& body, std::size_t step = 1) const {
    const Eigen::AlignedBox3f reach = grown(patch.box, depth).cast<float>();
    for (std::size_t run = 0; run < around_.boxes.size(); ++run) {
      if (!reach.intersects(around_.boxes[run])) continue;
      const std::size_t begin = run * Surroundings::kRun;
      for (std::size_t i = begin; i < std::min(begin + Surroundings::kRun, around_.points.size());
           i += step) {
        const Vec3 p = around_.points[i].cast<double>();
        const double distance = patch.plane.signed_distance(p);
        if (std::abs(distance) < depth) body(distance, patch.frame.to_plane(p), around_.planes[i]);
      }
    }
  }

  bool is_from_behind(const Patch& patch) const {
    if (!cloud_.viewpoints.empty())
      return patch.plane.signed_distance(nearest_of(cloud_.viewpoints, patch.box.center())) < 0;
    if (!cloud_.normals.empty()) {
      std::int64_t along = 0;
      for (std::uint32_t i : members_)
        along += cloud_.normals[i].cast<double>().dot(patch.plane.normal) > 0 ? 1 : -1;
      return along < 0;
    }
    double sum = 0;
    look(
        patch, options_.facing_depth,
        [&](double distance, const Vec2& p, std::int32_t) {
          if (patch.covered.is_set(p)) sum += distance;
        },
        kFacingStep);
    return sum < 0;
  }

  // The cells of a floor that have nothing below; none of what is no floor.
  Raster find_ground(const Patch& patch) const {
    Raster ground = empty_like(patch.hit);
    if (patch.plane.normal.dot(up_) < options_.level) return ground;
    Raster below = ground;
    look(patch, options_.depth_below, [&](double distance, const Vec2& p, std::int32_t) {
      if (distance < -2 * cell_) set(below, p);
    });
    below = close(below, 2);
    const Raster enclosed = enclosed_by(patch.hit);
    for (std::size_t i = 0; i < ground.bits.size(); ++i)
      ground.bits[i] = enclosed.bits[i] && !below.bits[i];
    return ground;
  }

  // Whether what belongs to a plane, or to none, hides what is behind it.
  bool may_hide(std::int32_t plane, const Plane& patch) const {
    return plane < 0 ||
           std::abs(planes_[static_cast<std::size_t>(plane)].normal.dot(patch.normal)) >
               options_.shadow_cosine;
  }
  // The cells that something stands before.
  Raster find_shadow(const Patch& patch) const {
    Raster shadow = empty_like(patch.hit);
    look(patch, options_.shadow_depth, [&](double distance, const Vec2& p, std::int32_t plane) {
      if (distance > 2 * cell_ && may_hide(plane, patch.plane)) set(shadow, p);
    });
    return shadow;
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
    const Raster shadow = find_shadow(patch), ground = find_ground(patch);
    patch.evidence.resize(expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
      // Of points that come by chance, the share of cells that would have one.
      const double seen = 1 - std::exp(-static_cast<double>(expected[i]));
      const double says = patch.hit.bits[i] ? 1 / std::max(seen, kLeastSeen)
                          : shadow.bits[i]  ? options_.hidden_evidence
                          : ground.bits[i]  ? -seen * options_.ground_price
                                            : -seen;
      patch.evidence[i] = static_cast<float>(says);
    }
  }

  const PointCloud& cloud_;
  std::span<const std::uint32_t> members_;
  const std::vector<Plane>& planes_;
  const double cell_;
  const Surroundings& around_;
  const Vec3& up_;
  const PatchOptions& options_;
  std::vector<std::uint32_t> count_;  // points in each cell
};

}  // namespace

std::vector<Patch> find_patches(const PointCloud& cloud, const Members& members,
                                const std::vector<Plane>& planes, double cell,
                                const Surroundings& surroundings, const Vec3& up,
                                const PatchOptions& options) {
  std::vector<Patch> patches(planes.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    patches[k] =
        PatchMaker(cloud, members.of(k), planes, cell, surroundings, up, options).make(planes[k]);
  });
  return patches;
}

}  // namespace scanworld::surface
