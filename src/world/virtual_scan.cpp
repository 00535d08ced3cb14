// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "virtual_scan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../error.h"
#include "../mix.h"
#include "../parallel.h"
#include "ray_scene.h"

namespace scanworld {

namespace {

constexpr double kJump = 0.10;     // [m] range step between neighbouring rays that is an edge
constexpr double kGrazing = 0.17;  // cosine of incidence below which returns get rare
constexpr double kJitter = 0.2;    // of the resolution, by which rays are off their grid
constexpr double kZenith = M_PI / 2;

// Random numbers of one ray or point: SplitMix64 (Steele, Lea, Flood 2014) from a key. The same on
// every machine, which std::*_distribution do not promise.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream, std::uint64_t item)
      : state_(seed * 0x9e3779b97f4a7c15 ^ stream * 0xd1b54a32d192ed03 ^
               item * 0x8cb92ba72f3d8dd7) {
    next();
  }
  std::uint64_t next() { return mix(state_ += 0x9e3779b97f4a7c15); }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }  // [0, 1)
  double gauss() {                                                          // Box and Muller, 1958
    const double radius = std::sqrt(-2 * std::log(1 - uniform()));
    return radius * std::cos(2 * M_PI * uniform());
  }

 private:
  std::uint64_t state_;
};

struct Sample {
  Vec3 point;
  std::int32_t surface, kind, pose;
  std::uint64_t rank;  // random; the samples with the lowest are kept where there are too many
};

// One turn of a scanner: all rays of all poses.
class Scanner {
 public:
  Scanner(const World& world, const RayScene& scene, const std::vector<Vec3>& poses,
          const VirtualScanOptions& options, double resolution)
      : world_(world),
        scene_(scene),
        poses_(poses),
        options_(options),
        step_(resolution),
        rows_(static_cast<std::size_t>((kZenith - options.lowest) / resolution) + 1),
        columns_(static_cast<std::size_t>(2 * M_PI / resolution) + 1) {}

  std::vector<Sample> run() const {
    std::vector<std::vector<Sample>> lines(poses_.size() * rows_);
    parallel_for(lines.size(), [&](std::size_t i) { lines[i] = scan_line(i / rows_, i % rows_); });
    std::vector<Sample> all;
    for (const auto& line : lines) all.insert(all.end(), line.begin(), line.end());
    return all;
  }

 private:
  struct Echo {
    Vec3 direction;
    std::optional<Hit> hit;
  };

  Echo shoot(std::size_t pose, std::size_t row, std::size_t column) const {
    Random random(options_.seed, 2 * pose, row * columns_ + column);
    const double elevation =
        options_.lowest +
        (static_cast<double>(row) + 0.5 + kJitter * (random.uniform() - 0.5)) * step_;
    const double azimuth =
        (static_cast<double>(column) + kJitter * (random.uniform() - 0.5)) * step_;
    const double e = std::min(elevation, kZenith);
    const Vec3 direction(std::cos(e) * std::cos(azimuth), std::cos(e) * std::sin(azimuth),
                         std::sin(e));
    return {direction, scene_.cast(poses_[pose], direction, options_.max_range)};
  }

  std::vector<Sample> scan_line(std::size_t pose, std::size_t row) const {
    std::vector<Sample> samples;
    std::optional<Hit> left;
    for (std::size_t column = 0; column < columns_; ++column) {
      const Echo echo = shoot(pose, row, column);
      if (echo.hit) {
        Random random(options_.seed, 2 * pose + 1, row * columns_ + column);
        if (const auto sample = measure(echo, left, pose, random)) samples.push_back(*sample);
      }
      left = echo.hit;
    }
    return samples;
  }

  std::optional<Sample> measure(const Echo& echo, const std::optional<Hit>& left, std::size_t pose,
                                Random& random) const {
    const Hit& hit = *echo.hit;
    Sample sample{.kind = static_cast<std::int32_t>(hit.is_surface ? PointKind::surface
                                                                   : PointKind::obstacle),
                  .pose = static_cast<std::int32_t>(pose)};
    double incidence = 1;  // cosine
    sample.surface = -1;
    if (hit.is_surface) {
      const Surface& surface = world_.surfaces[hit.index];
      sample.surface = surface.id;
      incidence = std::abs(echo.direction.dot(surface.plane.normal));
      if (incidence < kGrazing && random.uniform() > incidence / kGrazing) return std::nullopt;
    }
    double range = hit.distance;
    // The beam of a ray at an edge meets two things and may return a range between them. A step
    // that the slant of a surface explains is no edge.
    const double slant =
        range * step_ * std::sqrt(1 - incidence * incidence) / std::max(incidence, 0.02);
    if (left && std::abs(left->distance - range) > std::max(kJump, 2 * slant) &&
        random.uniform() < options_.mixed) {
      const double between = range + (left->distance - range) * random.uniform();
      const double off = std::min(std::abs(between - range), std::abs(between - left->distance));
      if (off > 3 * std::max(options_.noise, 0.003)) {
        sample.kind = static_cast<std::int32_t>(PointKind::mixed);
        sample.surface = -1;
      }
      range = between;
    }
    sample.point = poses_[pose] + echo.direction * (range + options_.noise * random.gauss());
    sample.rank = random.next();
    return sample;
  }

  const World& world_;
  const RayScene& scene_;
  const std::vector<Vec3>& poses_;
  const VirtualScanOptions& options_;
  const double step_;
  const std::size_t rows_, columns_;
};

void check(const VirtualScanOptions& o) {
  const auto require = [](bool good, const char* what, double value) {
    if (!good) throw Error(Cause::usage, fmt::format("{} cannot be {}", what, value));
  };
  require(o.resolution >= 1e-5 && o.resolution <= 0.5, "the resolution [rad]", o.resolution);
  require(o.lowest >= -kZenith && o.lowest < kZenith, "the lowest elevation [rad]", o.lowest);
  require(o.max_range > 0 && std::isfinite(o.max_range), "the range [m]", o.max_range);
  require(o.noise >= 0 && std::isfinite(o.noise), "the noise [m]", o.noise);
  require(o.outliers >= 0 && o.outliers <= 0.9, "the share of outliers", o.outliers);
  require(o.mixed >= 0 && o.mixed <= 1, "the chance of mixed points", o.mixed);
}

// Finds the resolution that gives a few more returns than wanted, and drops those by chance.
std::vector<Sample> scan_points(const World& world, const RayScene& scene,
                                const std::vector<Vec3>& poses, const VirtualScanOptions& options,
                                std::size_t wanted) {
  const double sphere = (kZenith - options.lowest) * 2 * M_PI * static_cast<double>(poses.size());
  double rays = 20000;
  std::vector<Sample> samples;
  for (int round = 0; round < 8; ++round) {
    samples = Scanner(world, scene, poses, options, std::sqrt(sphere / rays)).run();
    if (samples.empty()) return samples;
    if (samples.size() >= wanted && round > 0) break;
    rays *= std::max(round > 0 ? 1.02 : 0.0,
                     1.02 * static_cast<double>(wanted) / static_cast<double>(samples.size()));
  }
  if (samples.size() <= wanted) return samples;
  std::vector<std::uint64_t> ranks;
  for (const Sample& s : samples) ranks.push_back(s.rank);
  const auto limit = ranks.begin() + static_cast<std::ptrdiff_t>(wanted);
  std::nth_element(ranks.begin(), limit, ranks.end());
  std::erase_if(samples, [&](const Sample& s) { return s.rank >= *limit; });
  return samples;
}

void add_outliers(const World& world, const VirtualScanOptions& options, std::size_t poses,
                  std::vector<Sample>& samples) {
  Box3 box = bounds(world);
  const Vec3 margin = box.sizes() * 0.1;
  box = {box.min() - margin, box.max() + margin};
  const auto count = static_cast<std::size_t>(std::llround(
      options.outliers / (1 - options.outliers) * static_cast<double>(samples.size())));
  for (std::size_t i = 0; i < count; ++i) {
    Random random(options.seed, UINT64_MAX, i);
    const double x = random.uniform(), y = random.uniform(), z = random.uniform();
    samples.push_back({.point = box.min() + Vec3(x, y, z).cwiseProduct(box.sizes()),
                       .surface = -1,
                       .kind = static_cast<std::int32_t>(PointKind::outlier),
                       .pose = static_cast<std::int32_t>(random.next() % poses),
                       .rank = 0});
  }
}

}  // namespace

VirtualScan virtual_scan(const World& world, const VirtualScanOptions& options) {
  check(options);
  const RayScene scene(world);
  const std::vector<Vec3> poses = options.poses.empty() ? place_scanners(world) : options.poses;
  if (poses.empty())
    throw Error(Cause::nothing_found, "there is no place for a scanner: give its poses");
  const auto real_points = static_cast<std::size_t>(
      std::llround(static_cast<double>(options.points) * (1 - options.outliers)));
  std::vector<Sample> samples =
      options.points > 0 ? scan_points(world, scene, poses, options, real_points)
                         : Scanner(world, scene, poses, options, options.resolution).run();
  if (samples.empty()) throw Error(Cause::nothing_found, "the scanners see nothing of the world");
  add_outliers(world, options, poses.size(), samples);
  std::stable_sort(samples.begin(), samples.end(),
                   [](const Sample& a, const Sample& b) { return a.pose < b.pose; });

  VirtualScan scan;
  const Eigen::Quaterniond& to_scan = world.frame.rotation;
  scan.cloud.origin = world.frame.origin;
  for (const Vec3& pose : poses) scan.cloud.viewpoints.push_back(to_scan * pose);
  for (const Sample& s : samples) {
    scan.cloud.points.push_back((to_scan * s.point).cast<float>());
    scan.surface.push_back(s.surface);
    scan.kind.push_back(s.kind);
    scan.pose.push_back(s.pose);
  }
  return scan;
}

}  // namespace scanworld
