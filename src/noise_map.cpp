// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "noise_map.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cell_walk.h"
#include "quantile.h"

namespace scanworld {

NoiseMap::NoiseMap(std::span<const NoiseSample> samples, double edge, double least, double most)
    : edge_(edge) {
  std::map<std::uint64_t, std::vector<double>> own;
  for (const NoiseSample& s : samples)
    if (has_code(s.at, edge)) own[morton_of(cell_of(s.at, edge))].push_back(s.noise);
  for (const auto& [code, list] : own) {
    std::vector<double> around;
    const Eigen::Vector3i home = cell_at(code);
    for (int k = 0; k < 27; ++k)
      if (const auto near = own.find(
              morton_of(home + Eigen::Vector3i(k % 3, k / 3 % 3, k / 9) - Eigen::Vector3i::Ones()));
          near != own.end())
        around.insert(around.end(), near->second.begin(), near->second.end());
    const double noise = std::min(median(std::move(around)), most);
    if (noise <= least) continue;
    cells_.push_back({code, noise});
    largest_ = std::max(largest_, cells_.back().noise);
  }
}

double NoiseMap::find(const Vec3& p) const {
  if (!has_code(p, edge_)) return 0;
  const std::uint64_t code = morton_of(cell_of(p, edge_));
  const auto found =
      std::lower_bound(cells_.begin(), cells_.end(), code,
                       [](const Cell& cell, std::uint64_t wanted) { return cell.code < wanted; });
  return found != cells_.end() && found->code == code ? found->noise : 0;
}

std::vector<NoiseAtRange> noise_by_range(std::span<const NoiseSample> samples,
                                         std::span<const Vec3> viewpoints) {
  constexpr int kSlants = 3;
  std::map<std::pair<int, int>, std::vector<std::pair<double, double>>> bins;
  for (const NoiseSample& s : samples) {
    if (viewpoints.empty()) break;
    const Vec3& from = s.viewer >= 0 ? viewpoints[static_cast<std::size_t>(s.viewer)]
                                     : nearest_of(viewpoints, s.at);
    const Vec3 ray = from - s.at;
    const double range = ray.norm();
    if (!(range > 0)) continue;
    const double slant = std::acos(std::min(1.0, std::abs(ray.dot(s.normal)) / range));
    const int octave = range < 1 ? 0 : 1 + std::ilogb(range);
    bins[{octave, std::min(kSlants - 1, static_cast<int>(slant * 2 * kSlants / M_PI))}]
        .emplace_back(s.noise, s.area);
  }
  std::vector<NoiseAtRange> all;
  for (auto& [bin, list] : bins) {
    const auto& [octave, slant] = bin;
    double area = 0;
    for (const auto& [noise, part] : list) area += part;
    all.push_back({.min_range = octave == 0 ? 0 : std::exp2(octave - 1),
                   .max_range = std::exp2(octave),
                   .min_incidence = slant * M_PI / (2 * kSlants),
                   .max_incidence = (slant + 1) * M_PI / (2 * kSlants),
                   .noise = weighted_median(std::move(list)),
                   .area = area});
  }
  return all;
}

NoiseModel describe_noise(std::span<const NoiseSample> samples, std::span<const Vec3> viewpoints) {
  if (samples.empty()) return {};
  std::vector<double> noise;
  for (const NoiseSample& s : samples) noise.push_back(s.noise);
  return {quantile(noise, 0.05), quantile(noise, 0.5), quantile(noise, 0.95),
          noise_by_range(samples, viewpoints)};
}

}  // namespace scanworld
