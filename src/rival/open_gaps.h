// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <functional>
#include <optional>
#include <tuple>
#include <utility>
#include <vector>

#include "cluster.h"
#include "grid.h"

namespace scanworld::rival {

struct GapOptions {
  double max_gap = 0;             // [m] the widest
  double hidden_from = INFINITY;  // [m] wider ones are open only where something may hide a surface
  double open_share = 0.5;        // of the shortest ways across that nothing may cross, at least
};

// The shortest way from a place in one cluster to another cluster.
struct Link {
  float square;  // [m2] of its length
  Vec3f from, to;

  double length() const { return std::sqrt(square); }
  Vec3 middle() const { return (from + to).cast<double>() / 2; }
};

// The gap between two clusters that may be one.
struct Gap {
  double price;  // of their being one; 1 or more is too much
  std::size_t a, b;
  Vec3 middle;  // of the shortest way

  bool operator<(const Gap& o) const { return std::tie(price, a, b) < std::tie(o.price, o.a, o.b); }
};

// What speaks against two clusters' being one, given the middle of the shortest way between them.
using GapPrice = std::function<double(const Cluster&, const Cluster&, const Vec3& middle)>;

// The clusters in each cell of a scan.
class ClusterCells {
 public:
  ClusterCells(const Grid& grid, const Clustering& clustering);

  double edge() const { return edge_; }
  // Whether any cluster in the cell of a place, or kNone where sites are in none, is such.
  bool any_at(const Vec3& p, const std::function<bool(std::int32_t)>& is_such) const;

 private:
  double edge_;                                                   // [m]
  std::vector<std::pair<std::uint64_t, std::int32_t>> clusters_;  // by cell
};

// Looks for clusters that lie beside each other, nearly parallel, with nothing between them.
class GapFinder {
 public:
  GapFinder(const Grid& grid, const Clustering& clustering, const GapOptions& options);

  // The open gaps whose price is low enough, the lowest first.
  std::vector<Gap> find(const GapPrice& price_of) const;
  // Whether nothing goes through between two clusters, and they are near enough.
  bool is_open(std::size_t a, std::size_t b) const;

 private:
  struct Ways;

  const ClusterCells& cells() const;
  Ways find_ways(std::size_t a, std::size_t b) const;
  bool are_open(const Ways& ways) const;

  const Grid& grid_;
  const Clustering& c_;
  const GapOptions options_;
  const std::vector<std::vector<std::uint32_t>> members_;
  std::vector<Box3> boxes_;                    // of their sites
  mutable std::optional<ClusterCells> cells_;  // made when first asked for
};

}  // namespace scanworld::rival
