// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "neighbors.h"

#include <algorithm>
#include <bit>

#include "../parallel.h"

namespace scanworld::rival {

namespace {

// A block's voxels and those around it, laid out as one cube, so that what is near a voxel is found
// without asking which block it is in.
class VoxelCube {
 public:
  // `reach`: [voxels] around the block, at most 8. `only`: where not empty, what it does not mark
  // is not there.
  VoxelCube(const Grid& grid, int reach, std::span<const std::uint8_t> only)
      : grid_(grid),
        only_(only),
        pad_(reach),
        width_(8 + 2 * reach),
        layers_(static_cast<std::size_t>(width_)),
        rows_(static_cast<std::size_t>(width_ * width_)),
        cells_(rows_.size() * static_cast<std::size_t>(width_)),
        found_(cells_.size() + 1) {}

  struct Cell {
    std::uint32_t site, points;
    std::int32_t twin;
  };

  // The sites no more than `reach` voxels from that of `site` along each axis, but more than
  // `inner` along one; twins are with their first. Valid until the next call.
  std::span<const Cell> find_near(std::size_t site, int reach, int inner) {
    const std::uint32_t v = grid_.sites[site].voxel;
    if (v >> 9 != block_) move_to(v >> 9);
    const int x = static_cast<int>(v & 7) + pad_, y = static_cast<int>(v >> 3 & 7) + pad_,
              z = static_cast<int>(v >> 6 & 7) + pad_;
    const std::uint32_t outside = span_of(x, reach), inside = inner < 0 ? 0 : span_of(x, inner);
    Cell* next = found_.data();
    for (int zz = z - reach; zz <= z + reach; ++zz)
      for (std::uint32_t rows = layers_[static_cast<std::size_t>(zz)] & span_of(y, reach);
           rows != 0; rows &= rows - 1) {
        const int yy = std::countr_zero(rows);
        const auto row = static_cast<std::size_t>(zz * width_ + yy);
        std::uint32_t bits = rows_[row] & outside;
        if (std::abs(zz - z) <= inner && std::abs(yy - y) <= inner) bits &= ~inside;
        // All are written, and those that are none are written over: no branch to be guessed.
        const Cell* cell = &cells_[row * static_cast<std::size_t>(width_)] + (x - reach);
        bits >>= x - reach;
        for (int k = 0; k <= 2 * reach; ++k, bits >>= 1) *next = cell[k], next += bits & 1;
      }
    return {found_.data(), next};
  }

 private:
  static std::uint32_t span_of(int x, int reach) {
    return ((std::uint32_t{1} << (2 * reach + 1)) - 1) << (x - reach);
  }

  void move_to(std::uint32_t b) {
    block_ = b;
    std::fill(layers_.begin(), layers_.end(), 0);
    std::fill(rows_.begin(), rows_.end(), 0);
    for (int n = 0; n < 27; ++n) {
      const std::int32_t near = grid_.blocks[b].near[static_cast<std::size_t>(n)];
      if (near < 0) continue;
      const Block& block = grid_.blocks[static_cast<std::size_t>(near)];
      // Where the block's first voxel is in the cube.
      const int x0 = pad_ + 8 * (n % 3 - 1), y0 = pad_ + 8 * (n / 3 % 3 - 1),
                z0 = pad_ + 8 * (n / 9 - 1);
      const std::uint64_t inside = rectangle_mask(-x0, width_ - 1 - x0, -y0, width_ - 1 - y0);
      for (int z = std::max(0, -z0); z < std::min(8, width_ - z0); ++z) {
        const std::uint64_t word = block.occupied[static_cast<std::size_t>(z)];
        for (std::uint64_t bits = word & inside; bits != 0; bits &= bits - 1) {
          const int bit = std::countr_zero(bits), x = x0 + (bit & 7), y = y0 + (bit >> 3);
          const std::uint32_t at = block.site_at(z, bit);
          const std::int32_t twin = grid_.twin.empty() ? -1 : grid_.twin[at];
          if (!is_there(at) && (twin < 0 || !is_there(static_cast<std::uint32_t>(twin)))) continue;
          const auto row = static_cast<std::size_t>((z0 + z) * width_ + y);
          layers_[static_cast<std::size_t>(z0 + z)] |= std::uint32_t{1} << y;
          rows_[row] |= std::uint32_t{1} << x;
          cells_[row * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x)] = {
              at, grid_.sites[at].points, twin};
        }
      }
    }
  }

  bool is_there(std::uint32_t site) const { return only_.empty() || only_[site]; }

  const Grid& grid_;
  const std::span<const std::uint8_t> only_;
  const int pad_, width_;
  std::uint32_t block_ = ~0u;
  std::vector<std::uint32_t> layers_;  // bit y of layer z: whether there are sites in the row
  std::vector<std::uint32_t> rows_;    // bit x of row z * width + y: whether a site is there
  std::vector<Cell> cells_;
  std::vector<Cell> found_;
};

// Whether sites lie along one line, as those of a single ring of a lidar do: their points span no
// plane, however many they are.
bool is_line(const Grid& grid, std::span<const std::uint32_t> sites) {
  constexpr float kLeastSpread = 0.05f;
  const Vec3f origin = grid.sites[sites[0]].mean;  // near it floats suffice
  Vec3f sum = Vec3f::Zero(), squares = Vec3f::Zero(), products = Vec3f::Zero();
  for (const std::uint32_t j : sites) {
    const Vec3f p = grid.sites[j].mean - origin;
    sum += p;
    squares += p.cwiseProduct(p);
    products += p.cwiseProduct(Vec3f(p.y(), p.z(), p.x()));
  }
  const Vec3f mean = sum / static_cast<float>(sites.size());
  squares -= mean.cwiseProduct(sum);
  products -= mean.cwiseProduct(Vec3f(sum.y(), sum.z(), sum.x()));
  // Twice the sum of the products of two eigenvalues each.
  const float square = squares.sum() * squares.sum();
  return square - squares.squaredNorm() - 2 * products.squaredNorm() < kLeastSpread * square;
}

// Appends the neighbours of site i to a list.
void add_neighbors(const Grid& grid, std::size_t i, const NeighborOptions& options,
                   const std::vector<std::uint8_t>& only, VoxelCube& cube,
                   std::vector<std::uint32_t>& list) {
  const std::int32_t separator = grid.separator.empty() ? -1 : grid.separator[i];
  const Plane* const between =
      separator < 0 ? nullptr : &grid.separators[static_cast<std::size_t>(separator)];
  const auto is_before = [&](std::size_t j) {
    return between->signed_distance(grid.sites[j].position()) > 0;
  };
  const bool own_side = between && is_before(i);
  const std::size_t start = list.size();
  std::size_t points = 0;
  const auto is_enough = [&] {
    return points >= static_cast<std::size_t>(options.min_points) &&
           list.size() >= start + static_cast<std::size_t>(options.min_sites);
  };
  // A cube of 27 voxels is too small for a line of so many.
  const auto is_whole = [&](int reach) {
    return is_enough() && (reach == 1 || !is_line(grid, std::span(list).subspan(start)));
  };
  const auto add = [&](std::uint32_t j, std::uint32_t n) {
    if (!only.empty() && !only[j]) return;
    if (between && is_before(j) != own_side) return;
    points += n;
    list.push_back(j);
  };
  for (int reach = 1; reach <= options.max_reach && !is_whole(reach - 1); ++reach)
    for (const auto& cell : cube.find_near(i, reach, reach > 1 ? reach - 1 : -1)) {
      add(cell.site, cell.points);
      if (cell.twin < 0) continue;
      const auto twin = static_cast<std::uint32_t>(cell.twin);
      add(twin, grid.sites[twin].points);
    }
}

std::size_t site_count(const Neighbors& neighbors) {
  std::size_t count = 0;
  for (const Neighbors::Part& part : neighbors.parts) count += part.first.size() - 1;
  return count;
}

// Makes the lists of a part of the sites, by add(site, list).
template <typename Add>
Neighbors::Part make_part(const Part& range, const Add& add) {
  Neighbors::Part part;
  std::vector<std::uint32_t> list;
  part.first = {0};
  list.reserve(16 * (range.end - range.begin));
  part.first.reserve(range.end - range.begin + 1);
  for (std::size_t i = range.begin; i < range.end; ++i) {
    add(i, list);
    part.first.push_back(static_cast<std::uint32_t>(list.size()));
  }
  part.sites.assign(list.begin(), list.end());  // without the room that `list` has grown
  return part;
}

}  // namespace

Neighbors find_neighbors(const Grid& grid, const NeighborOptions& options,
                         const std::vector<std::uint8_t>& only) {
  const std::size_t count = grid.sites.size();
  Neighbors result;
  result.parts.resize(part_count(count, Neighbors::kPart));
  parallel_for(result.parts.size(), [&](std::size_t p) {
    VoxelCube cube(grid, options.max_reach, only);
    result.parts[p] =
        make_part(part_of(p, count, Neighbors::kPart), [&](std::size_t i, auto& list) {
          if (only.empty() || only[i]) add_neighbors(grid, i, options, only, cube, list);
        });
  });
  return result;
}

Neighbors update_neighbors(const Grid& grid, const NeighborOptions& options, Neighbors before,
                           std::vector<std::uint8_t>& changed) {
  changed.assign(grid.sites.size(), 0);
  if (grid.separators.empty()) return before;
  for (std::size_t i = 0; i < grid.sites.size(); ++i) {
    if (grid.separator[i] >= 0) changed[i] = 1;
    if (grid.twin[i] >= 0)
      grid.for_each_near(i, options.max_reach, [&](std::uint32_t j) { changed[j] = 1; });
  }
  const std::size_t count = grid.sites.size(), old = site_count(before);
  Neighbors result;
  result.parts.resize(part_count(count, Neighbors::kPart));
  parallel_for(result.parts.size(), [&](std::size_t p) {
    const auto [begin, end] = part_of(p, count, Neighbors::kPart);
    const auto is_changed = [](std::uint8_t c) { return c != 0; };
    const bool is_same =
        end <= old && std::none_of(changed.begin() + static_cast<long>(begin),
                                   changed.begin() + static_cast<long>(end), is_changed);
    VoxelCube cube(grid, options.max_reach, {});
    result.parts[p] = is_same ? std::move(before.parts[p])
                              : make_part({begin, end}, [&](std::size_t i, auto& list) {
                                  if (changed[i])
                                    return add_neighbors(grid, i, options, {}, cube, list);
                                  const auto same = before.of(i);
                                  list.insert(list.end(), same.begin(), same.end());
                                });
    if (p < before.parts.size()) before.parts[p] = {};
  });
  return result;
}

}  // namespace scanworld::rival
