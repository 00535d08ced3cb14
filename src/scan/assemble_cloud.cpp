// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "assemble_cloud.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <numeric>
#include <optional>

#include "../error.h"
#include "../parallel.h"

namespace scanworld {

namespace {

// Calls visit(part, rows) for each part, in parallel.
void for_each_part(const RowSource& source,
                   const std::function<void(std::size_t, const RowsView&)>& visit) {
  parallel_for(source.parts(), [&](std::size_t part) {
    thread_local Rows scratch;
    visit(part, source.load(part, scratch));
  });
}

constexpr double kBin = 512;  // [m] to which the origin is told
constexpr std::size_t kBins = 2048;

// How the coordinates lie on each axis: in bins from `low` on, and below it. Rows that are not
// finite or too far out are not counted.
struct Histogram {
  Vec3 low;
  double width;  // [m] of a bin
  std::array<std::array<std::size_t, kBins>, 3> counts{};
  std::array<std::size_t, 3> below{};
  std::size_t all = 0;

  void add(std::span<const Vec3> points) {
    for (const Vec3& p : points) {
      if (!(p.array().abs() < kFarthest).all()) continue;
      ++all;
      for (std::size_t k = 0; k < 3; ++k) {
        const double bin = (p[static_cast<int>(k)] - low[static_cast<int>(k)]) / width;
        if (bin < 0)
          ++below[k];
        else if (bin < kBins)
          ++counts[k][static_cast<std::size_t>(bin)];
      }
    }
  }
  void add(const Histogram& other) {
    all += other.all;
    for (std::size_t k = 0; k < 3; ++k) {
      below[k] += other.below[k];
      for (std::size_t bin = 0; bin < kBins; ++bin) counts[k][bin] += other.counts[k][bin];
    }
  }
  // The lower edge of the bin that the median is in; nothing where it is outside of the bins.
  std::optional<double> median(std::size_t axis) const {
    std::size_t rank = below[axis];
    if (rank > all / 2) return std::nullopt;
    for (std::size_t bin = 0; bin < kBins; ++bin) {
      rank += counts[axis][bin];
      if (rank > all / 2) return low[static_cast<int>(axis)] + static_cast<double>(bin) * width;
    }
    return std::nullopt;
  }
};

Histogram count(const RowSource& source, const Vec3& low, double width) {
  Histogram sum{.low = low, .width = width};
  std::mutex mutex;
  for_each_part(source, [&](std::size_t, const RowsView& rows) {
    const auto part = std::make_unique<Histogram>(Histogram{.low = low, .width = width});
    part->add(rows.points);
    const std::lock_guard lock(mutex);  // whole numbers: the order of the parts does not matter
    sum.add(*part);
  });
  return sum;
}

// The median of the coordinates on each axis, as the lower edge of its bin of 512 m. An order
// statistic: the order of the rows does not matter, and a few outliers hardly do. It is looked for
// around `guess` first, then everywhere.
Vec3 coarse_median(const RowSource& source, const Vec3& guess) {
  const auto window = [](const Vec3& middle) {
    return Vec3(((middle / kBin).array().floor() - kBins / 2) * kBin);
  };
  Vec3 result = Vec3::Zero();
  const auto find = [&](const Vec3& low, double width) {
    const Histogram histogram = count(source, low, width);
    bool found = true;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto median = histogram.median(k);
      found &= median.has_value();
      result[static_cast<int>(k)] = median.value_or(0);
    }
    return found;
  };
  if (guess.allFinite() && find(window(guess), kBin)) return result;
  constexpr double kWide = 2 * kFarthest / kBins;  // such a bin fits into a window of fine ones
  if (!find(Vec3::Constant(-kFarthest), kWide)) return Vec3::Zero();  // nothing was counted
  find(window(result + Vec3::Constant(kWide / 2)), kBin);
  return result;
}

// The rows of several sources, one after the other; with their scan indices if those are wanted and
// any source has some.
RowSource chain(const std::vector<RowSource>& sources, bool with_index) {
  RowSource all{.first = {0}, .normals = true, .colors = true};
  std::vector<std::pair<const RowSource*, std::size_t>> parts;
  for (const RowSource& source : sources) {
    all.name += (all.name.empty() ? "" : ", ") + source.name;
    all.normals &= source.normals;
    all.colors &= source.colors;
    all.scan_index |= with_index && source.scan_index;
    const std::size_t before = all.rows();
    for (std::size_t part = 0; part < source.parts(); ++part) {
      parts.emplace_back(&source, part);
      all.first.push_back(before + source.first[part + 1]);
    }
  }
  // Attributes come with the rows only.
  const bool all_floats = !all.normals && !all.colors && !all.scan_index &&
                          std::all_of(sources.begin(), sources.end(),
                                      [](const RowSource& s) { return !!s.load_floats; });
  if (sources.size() == 1 && all_floats) all.take_floats = sources[0].take_floats;
  if (all_floats)
    all.load_floats = [parts](std::size_t i, Vec3f* to) {
      parts[i].first->load_floats(parts[i].second, to);
    };
  all.load = [parts](std::size_t i, Rows& scratch) -> RowsView {
    return parts[i].first->load(parts[i].second, scratch);
  };
  return all;
}

constexpr double kSetShare = 0.5;  // of the normals that must be set for any to say something

// Normals that were never set, which are zero or not finite, become zero; where most of them are,
// there are none.
void drop_unset(std::vector<Vec3f>& normals) {
  std::vector<std::size_t> set(part_count(normals.size(), kPointsPerPart));
  parallel_for(set.size(), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, normals.size(), kPointsPerPart);
    for (std::size_t i = begin; i < end; ++i)
      if (normals[i].allFinite() && !normals[i].isZero(0))
        ++set[part];
      else
        normals[i].setZero();
  });
  const std::size_t all = std::accumulate(set.begin(), set.end(), std::size_t{0});
  if (static_cast<double>(all) < kSetShare * static_cast<double>(normals.size())) normals = {};
}

// Fills a cloud from the rows of all sources.
class Assembler {
 public:
  Assembler(const std::vector<RowSource>& sources, const std::vector<Vec3>& poses)
      : sources_(sources),
        poses_(poses),
        source_(chain(sources, !poses.empty())),
        first_(first_point()),
        skipped_(source_.parts()),
        reach_(source_.parts()) {}

  PointCloud run() {
    // Where the scan begins far away, as in a map projection, the origin will move for sure.
    if (!begins_far()) fill_in_place();
    if (begins_far() || reaches_far()) move_origin();
    for (const auto& s : skipped_) cloud_.skipped.insert(cloud_.skipped.end(), s.begin(), s.end());
    if (cloud_.skipped.size() == source_.rows()) fail_without_points();
    note_viewpoints();
    if (!cloud_.skipped.empty()) {
      close_gaps(cloud_.points), close_gaps(cloud_.normals), close_gaps(cloud_.colors);
      close_gaps(cloud_.viewers);
    }
    drop_unset(cloud_.normals);
    if (std::ranges::all_of(cloud_.viewers, [](std::int32_t v) { return v < 0; }))
      cloud_.viewers = {};
    return std::move(cloud_);
  }

 private:
  bool begins_far() const { return (first_.array().abs() > kNearOrigin).any(); }

  Vec3 first_point() const {
    if (source_.rows() == 0 || source_.load_floats) return Vec3::Zero();
    Rows scratch;
    return source_.load(0, scratch).points[0];
  }

  bool reaches_far() const {
    return std::any_of(reach_.begin(), reach_.end(),
                       [](float far) { return far > static_cast<float>(kNearOrigin); });
  }

  void move_origin() {
    const Vec3 median = coarse_median(source_, first_);
    for (int k = 0; k < 3; ++k)
      cloud_.origin[k] = std::abs(median[k]) > kNearOrigin ? median[k] : 0;
    fill();
  }

  // Puts the points where they belong, as they are, in the fastest way that the source offers.
  void fill_in_place() {
    if (source_.take_floats) {
      cloud_.points = source_.take_floats();
      parallel_for(source_.parts(), [&](std::size_t part) { look_at(part); });
    } else if (source_.load_floats) {
      cloud_.points.resize(source_.rows());
      parallel_for(source_.parts(), [&](std::size_t part) {
        source_.load_floats(part, cloud_.points.data() + source_.first[part]);
        look_at(part);
      });
    } else {
      fill();
    }
  }

  // Puts points, relative to the origin, and attributes where they belong.
  void fill() {
    cloud_.points.resize(source_.rows());
    if (source_.normals) cloud_.normals.resize(source_.rows());
    if (source_.colors) cloud_.colors.resize(source_.rows());
    if (source_.scan_index) cloud_.viewers.assign(source_.rows(), -1);
    for_each_part(source_, [&](std::size_t part, const RowsView& rows) {
      const std::size_t first = source_.first[part];
      for (std::size_t i = 0; i < rows.points.size(); ++i)
        cloud_.points[first + i] = (rows.points[i] - cloud_.origin).cast<float>();
      if (source_.normals)
        std::copy(rows.normals.begin(), rows.normals.end(), cloud_.normals.data() + first);
      if (source_.colors)
        std::copy(rows.colors.begin(), rows.colors.end(), cloud_.colors.data() + first);
      if (source_.scan_index) take_indices(part, rows);
      look_at(part);
    });
  }

  // Notes which poses a part's points were seen from.
  void take_indices(std::size_t part, const RowsView& rows) {
    for (std::size_t i = 0; i < rows.scan_index.size(); ++i) {
      const double index = rows.scan_index[i];
      if (!(index >= 0) || !rows.points[i].allFinite()) continue;
      const std::size_t row = source_.first[part] + i;
      if (index != std::floor(index) || index >= static_cast<double>(poses_.size()))
        fail_at_index(row, index);
      cloud_.viewers[row] = static_cast<std::int32_t>(index);
    }
  }

  void note_viewpoints() {
    for (const Vec3& pose : poses_) cloud_.viewpoints.push_back(pose - cloud_.origin);
    if (!poses_.empty()) return;
    for (const RowSource& each : sources_) {
      // A file with several does not tell which of them saw a point.
      const std::int32_t viewer =
          each.viewpoints.size() == 1 ? static_cast<std::int32_t>(cloud_.viewpoints.size()) : -1;
      if (sources_.size() > 1) cloud_.viewers.insert(cloud_.viewers.end(), each.rows(), viewer);
      for (const Vec3& viewpoint : each.viewpoints)
        cloud_.viewpoints.push_back(viewpoint - cloud_.origin);
    }
  }

  // Notes which of a part's points are not finite, and how far from zero the others go.
  void look_at(std::size_t part) {
    skipped_[part].clear();
    Vec3f far = Vec3f::Zero();
    for (std::size_t i = source_.first[part]; i < source_.first[part + 1]; ++i) {
      const Vec3f& p = cloud_.points[i];
      if (p.x() * 0 + p.y() * 0 + p.z() * 0 == 0)
        far = far.cwiseMax(p.cwiseAbs());  // 0 times infinity is not 0
      else
        skipped_[part].push_back(i);
    }
    reach_[part] = far.maxCoeff();
  }

  [[noreturn]] void fail_at_index(std::size_t row, double index) const {
    auto source = sources_.begin();
    for (; row >= source->rows(); ++source) row -= source->rows();
    throw Error(Cause::bad_input,
                fmt::format("{}: the scan_index of point {} (from 0) is {}, but the poses are 0 to "
                            "{}",
                            source->name, row, index, poses_.size() - 1));
  }

  [[noreturn]] void fail_without_points() const {
    throw Error(Cause::bad_input, source_.rows() == 0
                                      ? fmt::format("{}: holds no points", source_.name)
                                      : fmt::format("{}: none of its {} points is finite",
                                                    source_.name, source_.rows()));
  }

  template <typename T>
  void close_gaps(std::vector<T>& values) const {
    if (values.empty()) return;
    auto to = values.begin();
    auto next = cloud_.skipped.begin();
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (next != cloud_.skipped.end() && *next == i)
        ++next;
      else
        *to++ = values[i];
    }
    values.erase(to, values.end());
  }

  const std::vector<RowSource>& sources_;
  const std::vector<Vec3>& poses_;
  const RowSource source_;
  const Vec3 first_;
  PointCloud cloud_;
  std::vector<std::vector<std::size_t>> skipped_;  // of each part
  std::vector<float> reach_;                       // of each part: how far from zero it goes
};

}  // namespace

PointCloud assemble_cloud(const std::vector<RowSource>& sources, const std::vector<Vec3>& poses) {
  return Assembler(sources, poses).run();
}

}  // namespace scanworld
