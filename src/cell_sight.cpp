// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cell_sight.h"

#include "cell_walk.h"
#include "parallel.h"
#include "viewers.h"

namespace scanworld {

namespace {

constexpr std::size_t kNearestViewpoints = 4;  // that may have seen a cell
constexpr std::size_t kCellsPerPart = 4096;

// Whether something stands between a cell and a viewpoint. The surface that the cell is of is left
// first, over two cells at least: where it is looked along, cells of it are on the way.
bool is_hidden(std::uint64_t cell, const Eigen::Vector3i& viewpoint, const CellSet& opaque) {
  int gap = 0;
  bool has_left = false, meets = false;
  CellSet::Reader cells(opaque);
  walk_cells(cell_at(cell).cast<double>() + Vec3::Constant(0.5), viewpoint,
             [&](std::uint64_t code) {
               const bool is_opaque = cells.contains(code);
               gap = is_opaque ? 0 : gap + 1;
               has_left = has_left || gap == 2;
               meets = is_opaque && has_left;
               return !meets;
             });
  return meets;
}

}  // namespace

std::vector<OwnViewer> own_viewers(const PointCloud& cloud, std::span<const std::uint64_t> codes,
                                   double cell) {
  if (cloud.viewers.empty()) return {};
  std::vector<std::pair<std::uint64_t, std::int32_t>> seen;  // cells and viewers of points
  for (std::size_t i = 0; i < cloud.points.size(); ++i)
    if (const Vec3 p = cloud.points[i].cast<double>(); cloud.viewers[i] >= 0 && has_code(p, cell))
      seen.emplace_back(morton_of(cell_of(p, cell)), cloud.viewers[i]);
  parallel_sort(seen);
  std::vector<OwnViewer> own;
  std::vector<std::int32_t> viewers;
  auto at = seen.begin();
  for (const std::uint64_t code : codes) {
    viewers.clear();
    while (at != seen.end() && at->first < code) ++at;
    for (; at != seen.end() && at->first == code; ++at) viewers.push_back(at->second);
    const bool is_alone = viewers.size() == 1;
    own.push_back({main_viewer(viewers, cloud.viewpoints, middle_of_cell(code, cell)), is_alone});
  }
  return own;
}

std::vector<std::size_t> find_viewers(std::span<const std::uint64_t> codes,
                                      const std::vector<Vec3>& viewpoints, double cell,
                                      const CellSet& opaque, std::span<const OwnViewer> own) {
  const bool is_only = viewpoints.size() == 1 && own.empty();
  std::vector<std::size_t> viewers(codes.size(), is_only ? 0 : kNobody);
  if (is_only || viewpoints.empty()) return viewers;
  const auto hides = [&](std::uint64_t code, std::size_t v) {
    const Vec3 from = viewpoints[v] / cell;
    return is_hidden(code, from.array().floor().cast<int>(), opaque);
  };
  parallel_for(part_count(codes.size(), kCellsPerPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, codes.size(), kCellsPerPart);
    std::vector<std::pair<double, std::size_t>> by_distance(viewpoints.size());
    const std::size_t candidates = std::min(by_distance.size(), kNearestViewpoints);
    for (std::size_t i = begin; i < end; ++i) {
      if (!own.empty() && own[i].viewer >= 0) {
        const auto v = static_cast<std::size_t>(own[i].viewer);
        if (!own[i].is_alone || !hides(codes[i], v)) viewers[i] = v;
        continue;
      }
      const Vec3 middle = middle_of_cell(codes[i], cell);
      for (std::size_t v = 0; v < by_distance.size(); ++v)
        by_distance[v] = {(viewpoints[v] - middle).squaredNorm(), v};
      const auto last = by_distance.begin() + static_cast<std::ptrdiff_t>(candidates);
      std::partial_sort(by_distance.begin(), last, by_distance.end());
      const auto viewer = std::find_if(by_distance.begin(), last, [&](const auto& candidate) {
        return !hides(codes[i], candidate.second);
      });
      if (viewer != last) viewers[i] = viewer->second;
    }
  });
  return viewers;
}

}  // namespace scanworld
