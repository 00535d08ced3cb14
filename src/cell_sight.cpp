// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cell_sight.h"

#include "cell_walk.h"
#include "parallel.h"

namespace scanworld {

namespace {

constexpr std::size_t kNearestViewpoints = 4;  // that may have seen a cell
constexpr std::size_t kCellsPerPart = 4096;

// Whether something stands between a cell and a viewpoint. The surface that the cell is of is left
// first, over two cells at least: where it is looked along, cells of it are on the way.
bool is_hidden(std::uint64_t cell, const Eigen::Vector3i& viewpoint, const CellSet& opaque) {
  int gap = 0;
  bool has_left = false, meets = false;
  std::uint64_t key = ~std::uint64_t{0};
  const CellSet::Block* block = nullptr;
  walk_cells(cell_at(cell).cast<double>() + Vec3::Constant(0.5), viewpoint,
             [&](std::uint64_t code) {
               if (code >> CellSet::kBlockBits != key)
                 key = code >> CellSet::kBlockBits, block = opaque.find(key);
               const bool is_opaque = block && CellSet::contains(*block, code);
               gap = is_opaque ? 0 : gap + 1;
               has_left = has_left || gap == 2;
               meets = is_opaque && has_left;
               return !meets;
             });
  return meets;
}

}  // namespace

std::vector<std::size_t> find_viewers(std::span<const std::uint64_t> codes,
                                      const std::vector<Vec3>& viewpoints, double cell,
                                      const CellSet& opaque) {
  std::vector<std::size_t> viewers(codes.size(), viewpoints.size() == 1 ? 0 : kNobody);
  if (viewpoints.size() < 2) return viewers;
  parallel_for(part_count(codes.size(), kCellsPerPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, codes.size(), kCellsPerPart);
    std::vector<std::pair<double, std::size_t>> by_distance(viewpoints.size());
    const std::size_t candidates = std::min(by_distance.size(), kNearestViewpoints);
    for (std::size_t i = begin; i < end; ++i) {
      const Vec3 middle = (cell_at(codes[i]).cast<double>() + Vec3::Constant(0.5)) * cell;
      for (std::size_t v = 0; v < by_distance.size(); ++v)
        by_distance[v] = {(viewpoints[v] - middle).squaredNorm(), v};
      const auto last = by_distance.begin() + static_cast<std::ptrdiff_t>(candidates);
      std::partial_sort(by_distance.begin(), last, by_distance.end());
      const auto viewer = std::find_if(by_distance.begin(), last, [&](const auto& candidate) {
        const Vec3 from = viewpoints[candidate.second] / cell;
        return !is_hidden(codes[i], from.array().floor().cast<int>(), opaque);
      });
      if (viewer != last) viewers[i] = viewer->second;
    }
  });
  return viewers;
}

}  // namespace scanworld
