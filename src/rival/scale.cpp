// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "scale.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "../mix.h"
#include "../parallel.h"
#include "../quantile.h"
#include "moments.h"

namespace scanworld::rival {

namespace {

constexpr std::size_t kMinPoints = 12;  // in a cell that is looked at
constexpr double kWanted = 20000;       // points in the smallest cells that are looked at
constexpr double kAgreement = 1.2, kOtherPlanes = 1.6;  // ratios of noise in cells twice as large
// Noise larger than cells can show looks like about a twelfth of their size.
constexpr double kMinSize = 12, kSureSize = 14;  // [noise] of cells that show all of it
constexpr std::size_t kMaxPoints = 400;          // of a cell are looked at
constexpr std::size_t kMinCells = 24;  // that hold a plane, for a size of cells to be believed
constexpr int kMaxAlone = 4;           // larger cells show no more where one holds all points
constexpr double kSmallest = 0.15, kLargest = 1e5;  // [m] cells

struct Sample {
  std::uint64_t cell;
  std::uint32_t point;
};

// Where cells of this size begin, in their edges: elsewhere for each size, so that no plane is at
// the border of cells of all sizes.
double shift_of(double size) {
  constexpr double kFirst = 0.37, kGolden = 0.618;
  const double shift = kFirst + kGolden * std::round(std::log2(size / kSmallest));
  return shift - std::floor(shift);
}

// The points of every `rate`-th cell of this size, by cell; `rate` is a power of two.
std::vector<Sample> sample_cells(const PointCloud& cloud, double size, std::uint64_t rate) {
  const std::size_t parts = part_count(cloud.points.size(), kPointsPerPart);
  std::vector<std::vector<Sample>> found(parts);
  const float inverse = static_cast<float>(1 / size);
  const double shift = shift_of(size);
  const std::uint64_t mask = rate - 1;
  constexpr std::int64_t kBias = 1 << 20;  // makes all positive, so that casts round down
  parallel_for(parts, [&](std::size_t i) {
    const auto [begin, end] = part_of(i, cloud.points.size(), kPointsPerPart);
    for (std::size_t k = begin; k < end; ++k) {
      const Vec3 at = (cloud.points[k] * inverse).cast<double>();
      if (!(at.array().abs() < 1e6).all()) continue;
      std::uint64_t key = 0;
      for (int a = 0; a < 3; ++a)
        key = key << 21 | static_cast<std::uint64_t>(at[a] + shift + static_cast<double>(kBias));
      if ((mix(key) & mask) == 0) found[i].push_back({key, static_cast<std::uint32_t>(k)});
    }
  });
  std::vector<Sample> all;
  for (const auto& f : found) all.insert(all.end(), f.begin(), f.end());
  return all;
}

struct CellFit {
  double rms = 0, spacing = 0;
  Vec3 centroid = Vec3::Zero();
};

// One plane through most of the points, by refitting to those within 2.5 standard deviations
// (taken from the median absolute distance); no rms where they do not lie in one.
CellFit fit_cell(const std::vector<Vec3>& points, double size) {
  Moments all;
  for (const Vec3& p : points) all += p;
  MomentFit plane = fit(all);
  std::vector<double> off(points.size());
  Moments inliers;
  double deviation = 0;
  for (int round = 0; round < 6; ++round) {
    for (std::size_t i = 0; i < points.size(); ++i)
      off[i] = std::abs(plane.plane.signed_distance(points[i]));
    deviation = 1.4826 * quantile(off, 0.5);
    inliers = {};
    for (const Vec3& p : points)
      if (std::abs(plane.plane.signed_distance(p)) <= 2.5 * deviation) inliers += p;
    if (inliers.n < 6) return {};
    plane = fit(inliers);
  }
  const bool one_plane = inliers.n >= 0.75 * static_cast<double>(points.size()) &&
                         std::sqrt(plane.variance[1]) > 3 * deviation;
  if (!one_plane) return {};
  // A plane near the border of its cell misses the points that noise has put into the next one.
  const double shift = shift_of(size);
  const Vec3 middle =
      ((plane.centroid / size).array() + shift).floor() * size + (0.5 - shift) * size;
  if (std::abs(plane.plane.signed_distance(middle)) > size / 4 || size < 10 * deviation) return {};
  return {std::sqrt(plane.variance[0] * inliers.n / (inliers.n - 3)) + 1e-12,
          std::sqrt(12 * std::sqrt(plane.variance[1] * plane.variance[2]) / inliers.n),
          plane.centroid};
}

struct CellFits {
  std::vector<CellFit> fits;  // of the cells that hold one plane
  std::size_t cells = 0;      // that hold points
};

CellFits fit_cells(const PointCloud& cloud, double size, std::uint64_t rate) {
  std::vector<Sample> samples = sample_cells(cloud, size, rate);
  // In each cell by position, so that the same points are taken whatever their order.
  const auto before = [&](const Sample& a, const Sample& b) {
    if (a.cell != b.cell) return a.cell < b.cell;
    const Vec3f &p = cloud.points[a.point], &q = cloud.points[b.point];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  };
  std::sort(samples.begin(), samples.end(), before);
  std::vector<std::size_t> first = {0};
  for (std::size_t i = 1; i <= samples.size(); ++i)
    if (i == samples.size() || samples[i].cell != samples[i - 1].cell) first.push_back(i);
  std::vector<CellFit> fits(first.size() - 1);
  parallel_for(fits.size(), [&](std::size_t c) {
    const std::size_t count = first[c + 1] - first[c];
    if (samples.empty() || count < kMinPoints) return;
    const std::size_t step = (count + kMaxPoints - 1) / kMaxPoints;
    std::vector<Vec3> points;
    for (std::size_t i = first[c]; i < first[c + 1]; i += step)
      points.push_back(cloud.points[samples[i].point].cast<double>());
    fits[c] = fit_cell(points, size);
    fits[c].spacing /= std::sqrt(static_cast<double>(step));
  });
  const std::size_t cells = samples.empty() ? 0 : fits.size();
  std::erase_if(fits, [](const CellFit& f) { return f.rms == 0; });
  return {std::move(fits), cells};
}

// What the cells of one size show, or several together.
struct Look {
  double noise = 0, spacing = 0;  // [m] as in Scale
  double modelled = 0;            // [m] the noise of a camera's model where the cells are, median
};

Look summarize(const std::vector<CellFit>& fits, const Scale& camera) {
  std::vector<double> noise, spacing, modelled;
  for (const CellFit& f : fits) {
    modelled.push_back(camera.noise_at(f.centroid));
    noise.push_back(f.rms > modelled.back() ? f.rms : 0);  // what the model does not explain
    spacing.push_back(f.spacing);
  }
  return {quantile(noise, 0.75), quantile(spacing, 0.5), quantile(modelled, 0.5)};
}

// By the smallest cells that are much larger than the noise (others leave out where there is most
// of it), of which enough hold a plane, and that agree with the next larger ones about noise. Much
// more noise in those is that of several planes.
Look look_at(const PointCloud& cloud, const Scale& camera) {
  Look last;
  bool is_good = false, is_sure = false;
  int alone = 0;  // sizes of which one cell held all points
  for (double size = kSmallest; size < kLargest && alone < kMaxAlone; size *= 2) {
    // Larger cells need more points for as many of them, dense scans even more.
    const auto wanted = static_cast<std::uint64_t>(kWanted * size / kSmallest);
    std::uint64_t rate = std::bit_floor(std::max<std::uint64_t>(1, cloud.points.size() / wanted));
    CellFits seen = fit_cells(cloud, size, rate);
    while (seen.fits.size() < kMinCells && rate > 1) {
      rate = std::max<std::uint64_t>(1, rate / 4);
      seen = fit_cells(cloud, size, rate);
    }
    if (rate == 1 && seen.cells <= 1) ++alone;
    if (seen.fits.size() < kMinCells && is_good) break;
    if (seen.fits.empty()) continue;
    const Look now = summarize(seen.fits, camera);
    if (is_sure && now.noise > kOtherPlanes * last.noise) break;
    if (is_good && now.noise <= kAgreement * last.noise) {
      last.noise = (last.noise + now.noise) / 2;
      break;
    }
    last = now;
    is_good = seen.fits.size() >= kMinCells && size >= kMinSize * last.noise;
    is_sure = is_good && size >= kSureSize * last.noise;
  }
  return last;
}

}  // namespace

Scale estimate_scale(const PointCloud& cloud, const ScaleOptions& options) {
  Scale scale{options.noise, options.spacing, options.voxel, options.depth_step};
  if (!cloud.viewpoints.empty()) scale.camera = cloud.viewpoints[0];
  Look seen;
  if (scale.noise == 0 || scale.spacing == 0) {
    seen = look_at(cloud, scale);
    if (scale.noise == 0) scale.noise = seen.noise;
    if (scale.spacing == 0) scale.spacing = seen.spacing;
  }
  scale.noise = std::max(scale.noise, options.min_noise);
  if (scale.voxel == 0)
    scale.voxel = std::max({options.min_voxel, options.voxel_per_spacing * scale.spacing,
                            options.voxel_per_noise * std::max(scale.noise, seen.modelled)});
  scale.flatness = {.max_bend = options.max_bend, .max_sag = options.max_sag};
  return scale;
}

}  // namespace scanworld::rival
