// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include "moments.h"

namespace scanworld::rival {

// Sites are worked on in parts of so many.
constexpr std::size_t kSitesPerPart = 1 << 12;

// The points of one voxel, by their moments.
struct Site {
  Vec3f mean = Vec3f::Zero();           // relative to the cloud's origin
  std::array<float, 6> covariance{};    // [m2] xx, xy, xz, yy, yz, zz
  std::uint32_t points = 0, first = 0;  // how many, and where they begin in Grid::points
  std::uint32_t voxel = 0;              // block << 9 | z << 6 | y << 3 | x

  Moments moments() const;
  Vec3 position() const { return mean.cast<double>(); }
  // The variance of the points along a unit vector [m2].
  double variance(const Vec3& v) const;
};

// A cube of 8 x 8 x 8 voxels, some of which hold points.
struct Block {
  std::array<std::uint64_t, 8> occupied{};  // bit y << 3 | x of word z
  std::array<std::uint32_t, 8> first{};     // the site of the first occupied voxel of each word
  std::array<std::int32_t, 27> near{};      // blocks around this one, x fastest; -1 = no points

  // The site of an occupied voxel.
  std::uint32_t site_at(int z, int bit) const {
    const auto layer = static_cast<std::size_t>(z);
    const std::uint64_t below = (std::uint64_t{1} << bit) - 1;
    return first[layer] + static_cast<std::uint32_t>(std::popcount(occupied[layer] & below));
  }
};

// A scan divided into voxels, those with points only. Sites are in the order of their voxels, which
// does not depend on the order of the points.
struct Grid {
  double voxel = 0;  // [m]
  std::vector<Block> blocks;
  std::vector<Site> sites;
  std::vector<std::uint32_t> points;  // indices into the cloud, site by site
  // Where a voxel holds both sides of a thin wall: the plane between them, by site, and the site of
  // the other side. Sites of other sides come after all others. Empty where there are none.
  std::vector<std::int32_t> separator, twin;  // index or -1, for each site
  std::vector<Plane> separators;
  // Of each site the viewpoint that most of its points were seen from, by its index or -1; empty
  // where none is known.
  std::vector<std::int32_t> viewers;

  std::span<const std::uint32_t> points_of(std::size_t site) const {
    return {points.data() + sites[site].first, sites[site].points};
  }

  // Calls body(site) for each site no more than `reach` voxels (at most 8) from that of `site`
  // along each axis, itself included; without those no more than `inner` voxels away, where given.
  template <typename Body>
  void for_each_near(std::size_t site, int reach, Body body, int inner = -1) const;
};

inline std::size_t count_of(const Grid& grid) { return grid.sites.size(); }

// Sums are made in whole numbers of 1/4096 of a voxel, so that the order of points does not matter.
// In no site are points farther than half a million voxels from the origin, and a few points far
// from all others.
Grid build_grid(const PointCloud& cloud, double voxel);

// Notes the plane between the two sides of a wall that are around a site; where the site's own
// points are on both, the fewer become a new site.
void part_site(const PointCloud& cloud, std::uint32_t site, const Plane& between, Grid& grid);

// Fills in the sites' viewers.
Grid with_viewers(const PointCloud& cloud, Grid grid);

// The bits y << 3 | x of a word with x and y in these ranges, where any are.
inline std::uint64_t rectangle_mask(int x0, int x1, int y0, int y1) {
  x0 = std::max(x0, 0), x1 = std::min(x1, 7), y0 = std::max(y0, 0), y1 = std::min(y1, 7);
  if (x0 > x1 || y0 > y1) return 0;
  constexpr std::uint64_t kEachRow = 0x0101010101010101u;
  const std::uint64_t row = (std::uint64_t{0xff} >> (7 - x1 + x0)) << x0;
  const std::uint64_t rows = (~std::uint64_t{0} >> (8 * (7 - y1 + y0))) << (8 * y0);
  return kEachRow * row & rows;
}
// Those no more than `reach` from a place along x and y.
inline std::uint64_t square_mask(int at_x, int at_y, int reach) {
  return rectangle_mask(at_x - reach, at_x + reach, at_y - reach, at_y + reach);
}

template <typename Body>
void Grid::for_each_near(std::size_t site, int reach, Body body, int inner) const {
  const std::uint32_t v = sites[site].voxel;
  const Block& home = blocks[v >> 9];
  const int x = static_cast<int>(v & 7), y = static_cast<int>(v >> 3 & 7),
            z = static_cast<int>(v >> 6 & 7);
  const auto side = [](int c) { return (c + 8) >> 3; };  // 0 before, 1 in, 2 after the block
  for (int zz = z - reach; zz <= z + reach; ++zz)
    for (int by = side(y - reach); by <= side(y + reach); ++by)
      for (int bx = side(x - reach); bx <= side(x + reach); ++bx) {
        const std::int32_t b = home.near[static_cast<std::size_t>(bx + 3 * by + 9 * side(zz))];
        if (b < 0) continue;
        const Block& block = blocks[static_cast<std::size_t>(b)];
        const std::uint64_t word = block.occupied[static_cast<std::size_t>(zz & 7)];
        if (word == 0) continue;
        const int dx = x - (bx - 1) * 8, dy = y - (by - 1) * 8;
        std::uint64_t bits = word & square_mask(dx, dy, reach);
        if (inner >= 0 && std::abs(zz - z) <= inner) bits &= ~square_mask(dx, dy, inner);
        while (bits != 0) {
          const int bit = std::countr_zero(bits);
          bits &= bits - 1;
          const std::uint32_t at = block.site_at(zz & 7, bit);
          body(at);
          if (!twin.empty() && twin[at] >= 0) body(static_cast<std::uint32_t>(twin[at]));
        }
      }
}

inline Moments Site::moments() const {
  const double n = points;
  const Vec3 m = position();
  const auto& c = covariance;
  return {n,
          n * m.x(),
          n * m.y(),
          n * m.z(),
          n * (c[0] + m.x() * m.x()),
          n * (c[1] + m.x() * m.y()),
          n * (c[2] + m.x() * m.z()),
          n * (c[3] + m.y() * m.y()),
          n * (c[4] + m.y() * m.z()),
          n * (c[5] + m.z() * m.z())};
}

inline double Site::variance(const Vec3& v) const {
  const auto& c = covariance;
  return v.x() * (v.x() * c[0] + 2 * (v.y() * c[1] + v.z() * c[2])) +
         v.y() * (v.y() * c[3] + 2 * v.z() * c[4]) + v.z() * v.z() * c[5];
}

}  // namespace scanworld::rival
