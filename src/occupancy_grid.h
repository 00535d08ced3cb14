// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "cell_walk.h"
#include "types.h"

namespace scanworld {

// The cells of an OctoMap are those of a tree of 16 levels: from -2^15 to 2^15 - 1 along each axis.
// Cell 0 begins at 0.
constexpr int kOctreeDepth = 16;
constexpr int kOctreeCells = 1 << kOctreeDepth;

// The smallest edge of cells [m] with which coordinates up to `reach` [m] are in the tree.
inline double least_octree_resolution(double reach) { return reach / (kOctreeCells / 2 - 1); }

// To two digits, for people.
double rounded_up(double value);

// Of a probability.
inline float log_odds_of(double probability) {
  return static_cast<float>(std::log(probability / (1 - probability)));
}

// The sensor model of OctoMap, with the values of its library (Hornung et al. 2013).
struct OccupancyOptions {
  double resolution = 0.05;    // [m] edge of a cell
  double hit = 0.7;            // probability that a cell is occupied that a point is in ...
  double miss = 0.4;           // ... and one that was looked through
  double lowest = 0.1192;      // what no probability falls below ...
  double highest = 0.971;      // ... or rises above
  std::size_t min_points = 1;  // a cell with fewer points counts as one without
};

// How likely the cells of space are occupied. Only blocks of cells of which something is known are
// kept.
struct OccupancyGrid {
  static constexpr int kBlock = 8;  // cells along each edge of a block

  struct Cell {
    std::uint16_t hits = 0;    // points in it
    std::uint16_t misses = 0;  // viewpoints that looked through it and saw no point in it
    bool is_known() const { return hits > 0 || misses > 0; }
    bool operator==(const Cell&) const = default;
  };
  // Names and cells are in Morton order: bits of x, y and z in turn, x lowest.
  struct Block {
    std::uint64_t key;
    std::array<Cell, kBlock * kBlock * kBlock> cells;
    bool operator==(const Block&) const = default;
  };

  OccupancyOptions options;
  Vec3 origin = Vec3::Zero();  // [m] what was subtracted from the scan's coordinates
  std::vector<Block> blocks;   // by ascending key

  // The cell that a point is in.
  Eigen::Vector3i cell_of(const Vec3& p) const { return scanworld::cell_of(p, options.resolution); }
  Cell at(const Eigen::Vector3i& cell) const;

  // Of a cell of which something is known: the sum over its hits and misses, kept between the
  // bounds.
  float log_odds(const Cell& cell) const;
  // That a cell is occupied; 0.5 where nothing is known.
  double probability(const Eigen::Vector3i& cell) const;
};

// The grid of a scan, in its coordinates as stored. Every point is a hit in its cell. All cells on
// the way from a viewpoint to the middle of a cell with points that it saw were looked through.
// That is the one that most of its points know to have been seen from; else of many the nearest
// one, of the four nearest, that no other cell with points hides it from, beyond those that it
// adjoins; where there is none, as with strays behind walls, none. Without viewpoints there are
// only hits.
//
// OctoMap adds up scan by scan and bounds each sum, which depends on their order; here sums of
// whole counts are bounded once. A viewpoint counts once a cell, however many of its rays pass
// there, and not where it saw a point: else walls that are looked along would fade. Depends neither
// on the order of the points nor on threads. Throws usage where an option is out of range or the
// scan is too large for 2^16 cells.
OccupancyGrid make_occupancy_grid(const PointCloud& cloud, const OccupancyOptions& options = {});

}  // namespace scanworld
