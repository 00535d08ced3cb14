// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "occupancy_grid.h"

#include <fmt/format.h>

#include <bit>
#include <limits>

#include "cell_sight.h"
#include "cell_walk.h"
#include "error.h"
#include "parallel.h"

namespace scanworld {

namespace {

using CellIndex = Eigen::Vector3i;
constexpr std::size_t kBlockCells = std::tuple_size_v<decltype(OccupancyGrid::Block::cells)>;
constexpr int kBlockBits = CellSet::kBlockBits;
static_assert(kBlockCells == 1 << kBlockBits);

constexpr std::size_t kRaysPerPart = 4096;

// A cell with points.
struct SeenCell {
  std::uint64_t code;  // Morton
  std::size_t points;
  std::size_t viewer = kNobody;  // index of the viewpoint that saw it
};

// What one viewpoint looked through, of one block.
struct Glance {
  std::size_t viewer;
  CellSet::Block block;
};

void check(const PointCloud& cloud, const OccupancyOptions& o) {
  const auto is_share = [](double p) { return p > 0 && p < 1; };
  if (!(o.resolution > 0) || !(is_share(o.hit) && o.hit >= 0.5) ||
      !(is_share(o.miss) && o.miss <= 0.5) || !is_share(o.lowest) || !is_share(o.highest) ||
      o.lowest > o.highest || o.min_points == 0)
    throw Error(Cause::usage,
                fmt::format("an occupancy grid of {} m cells, hit {}, miss {}, between {} and {}, "
                            "at least {} points: a value is out of range",
                            o.resolution, o.hit, o.miss, o.lowest, o.highest, o.min_points));
  double reach = 0;
  for (const Vec3f& p : cloud.points)
    reach = std::max(reach, static_cast<double>(p.cwiseAbs().maxCoeff()));
  for (const Vec3& v : cloud.viewpoints) reach = std::max(reach, v.cwiseAbs().maxCoeff());
  if (const double least = least_octree_resolution(reach); o.resolution < least)
    throw Error(Cause::usage,
                fmt::format("the scan reaches {:.1f} m from its origin, which is too far for 2^16 "
                            "cells of {} m; a resolution of {:.2g} m would do",
                            reach, o.resolution, rounded_up(least)));
}

// The cells with points, by ascending code.
std::vector<SeenCell> find_seen(const PointCloud& cloud, const OccupancyGrid& grid) {
  std::vector<std::uint64_t> codes(cloud.points.size());
  parallel_for(part_count(codes.size(), kPointsPerPart), [&](std::size_t i) {
    const auto [begin, end] = part_of(i, codes.size(), kPointsPerPart);
    for (std::size_t k = begin; k < end; ++k)
      codes[k] = morton_of(grid.cell_of(cloud.points[k].cast<double>()));
  });
  parallel_sort(codes);
  std::vector<SeenCell> seen;
  for (std::size_t i = 0, next = 0; i < codes.size(); i = next) {
    while (next < codes.size() && codes[next] == codes[i]) ++next;
    if (next - i >= grid.options.min_points) seen.push_back({codes[i], next - i});
  }
  return seen;
}

void find_viewers(std::vector<SeenCell>& cells, const PointCloud& cloud,
                  const OccupancyGrid& grid) {
  CellSet opaque;
  std::vector<std::uint64_t> codes;
  for (const SeenCell& cell : cells) {
    codes.push_back(cell.code);
    if (cell.points > 1) opaque.insert(cell.code);  // a single point may be a stray
  }
  const double edge = grid.options.resolution;
  const auto viewers =
      find_viewers(codes, cloud.viewpoints, edge, opaque, own_viewers(cloud, codes, edge));
  for (std::size_t i = 0; i < cells.size(); ++i) cells[i].viewer = viewers[i];
}

// What the viewpoints looked through, by blocks: those of one block are together, and of those the
// ones of one viewpoint. Rays to neighbouring cells are near each other, so that a part of them
// needs few blocks.
std::vector<Glance> look_through(const std::vector<SeenCell>& cells, const PointCloud& cloud,
                                 double resolution) {
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (cells[i].viewer != kNobody) order.push_back(i);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return cells[a].viewer < cells[b].viewer; });
  std::vector<Part> parts;
  for (std::size_t i = 0, next = 0; i < order.size(); i = next) {
    while (next < order.size() && next - i < kRaysPerPart &&
           cells[order[next]].viewer == cells[order[i]].viewer)
      ++next;
    parts.push_back({i, next});
  }
  std::vector<std::vector<CellSet::Block>> found(parts.size());
  parallel_for(parts.size(), [&](std::size_t part) {
    const Vec3 from = cloud.viewpoints[cells[order[parts[part].begin]].viewer] / resolution;
    CellSet passed;
    for (std::size_t i = parts[part].begin; i < parts[part].end; ++i)
      walk_cells(from, cell_at(cells[order[i]].code), [&](std::uint64_t code) {
        passed.insert(code);
        return true;
      });
    found[part] = passed.take_blocks();
  });
  std::vector<Glance> glances;
  for (std::size_t part = 0; part < parts.size(); ++part)
    for (const CellSet::Block& block : found[part])
      glances.push_back({cells[order[parts[part].begin]].viewer, block});
  std::sort(glances.begin(), glances.end(), [](const Glance& a, const Glance& b) {
    return std::pair(a.block.key, a.viewer) < std::pair(b.block.key, b.viewer);
  });
  return glances;
}

void count_up(std::uint16_t& count, std::size_t more) {
  count = static_cast<std::uint16_t>(
      std::min<std::size_t>(count + more, std::numeric_limits<std::uint16_t>::max()));
}

// Counts the cells of a block that a viewpoint looked through, and saw no point in.
void add_misses(const Glance* begin, const Glance* end, const SeenCell* seen_begin,
                const SeenCell* seen_end, OccupancyGrid::Block& block) {
  auto bits = begin->block.bits;
  for (const Glance* g = begin + 1; g != end; ++g)
    for (std::size_t w = 0; w < bits.size(); ++w) bits[w] |= g->block.bits[w];
  for (const SeenCell* s = seen_begin; s != seen_end; ++s) {
    const std::uint64_t cell = s->code & (kBlockCells - 1);
    if (s->viewer == begin->viewer) bits[cell / 64] &= ~(std::uint64_t{1} << cell % 64);
  }
  for (std::size_t w = 0; w < bits.size(); ++w)
    for (std::uint64_t left = bits[w]; left != 0; left &= left - 1)
      count_up(block.cells[64 * w + static_cast<std::size_t>(std::countr_zero(left))].misses, 1);
}

void fill_block(const std::vector<SeenCell>& seen, const std::vector<Glance>& glances,
                OccupancyGrid::Block& block) {
  const auto first = std::partition_point(seen.begin(), seen.end(), [&](const SeenCell& c) {
    return c.code >> kBlockBits < block.key;
  });
  const auto last = std::partition_point(
      first, seen.end(), [&](const SeenCell& c) { return c.code >> kBlockBits == block.key; });
  for (auto cell = first; cell != last; ++cell)
    count_up(block.cells[cell->code & (kBlockCells - 1)].hits, cell->points);

  auto glance = std::partition_point(glances.begin(), glances.end(),
                                     [&](const Glance& g) { return g.block.key < block.key; });
  while (glance != glances.end() && glance->block.key == block.key) {
    auto next = glance;
    while (next != glances.end() && next->block.key == block.key && next->viewer == glance->viewer)
      ++next;
    add_misses(&*glance, &*glance + (next - glance), seen.data() + (first - seen.begin()),
               seen.data() + (last - seen.begin()), block);
    glance = next;
  }
}

}  // namespace

double rounded_up(double value) {
  const double digit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::ceil(value / digit) * digit;
}

OccupancyGrid::Cell OccupancyGrid::at(const Eigen::Vector3i& cell) const {
  if (cell.minCoeff() < -kOctreeCells / 2 || cell.maxCoeff() >= kOctreeCells / 2) return {};
  const std::uint64_t code = morton_of(cell);
  const auto block = std::partition_point(
      blocks.begin(), blocks.end(), [&](const Block& b) { return b.key < code >> kBlockBits; });
  if (block == blocks.end() || block->key != code >> kBlockBits) return {};
  return block->cells[code & (kBlockCells - 1)];
}

float OccupancyGrid::log_odds(const Cell& cell) const {
  return std::clamp(static_cast<float>(cell.hits) * log_odds_of(options.hit) +
                        static_cast<float>(cell.misses) * log_odds_of(options.miss),
                    log_odds_of(options.lowest), log_odds_of(options.highest));
}

double OccupancyGrid::probability(const Eigen::Vector3i& cell) const {
  const Cell counts = at(cell);
  if (!counts.is_known()) return 0.5;
  return 1 - 1 / (1 + std::exp(static_cast<double>(log_odds(counts))));
}

OccupancyGrid make_occupancy_grid(const PointCloud& cloud, const OccupancyOptions& options) {
  check(cloud, options);
  OccupancyGrid grid{.options = options, .origin = cloud.origin, .blocks = {}};
  std::vector<SeenCell> seen = find_seen(cloud, grid);
  find_viewers(seen, cloud, grid);
  const std::vector<Glance> glances = cloud.viewpoints.empty()
                                          ? std::vector<Glance>{}
                                          : look_through(seen, cloud, options.resolution);

  std::vector<std::uint64_t> keys;
  for (const SeenCell& cell : seen) keys.push_back(cell.code >> kBlockBits);
  for (const Glance& glance : glances) keys.push_back(glance.block.key);
  parallel_sort(keys);
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  grid.blocks.resize(keys.size());
  parallel_for(keys.size(), [&](std::size_t i) {
    grid.blocks[i].key = keys[i];
    fill_block(seen, glances, grid.blocks[i]);
  });
  return grid;
}

}  // namespace scanworld
