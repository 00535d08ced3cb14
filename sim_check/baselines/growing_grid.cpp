// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "growing_grid.h"

#include <algorithm>
#include <cmath>

#include "network.h"
#include "node_grid.h"
#include "require.h"
#include "signals.h"

namespace scanworld::sim {

namespace {

constexpr double kLeastShare = 1e-3;  // of the winner's way: nodes that would move by less stay
constexpr double kGrown = 0.8;        // share of the time that growth takes
constexpr std::int64_t kReportEvery = 100000;  // [signals]

const GrowingGridOptions& checked_lattice(const GrowingGridOptions& o) {
  require(o.nodes > 4, "nodes", o.nodes);
  require(o.lambda >= 1, "lambda", o.lambda);
  require(o.eps > 0 && o.eps <= 1, "eps", o.eps);
  require(o.sigma > 0 && o.sigma <= 100, "sigma", o.sigma);
  require(o.lambda_fine >= 0, "lambda_fine", o.lambda_fine);
  require(o.eps_fine > 0 && o.eps_fine <= o.eps, "eps_fine", o.eps_fine);
  return o;
}

class Lattice {
 public:
  Lattice(const PointCloud& cloud, const GrowingGridOptions& options)
      : options_(options),
        signals_(cloud, checked_lattice(options).nodes, options.seed),
        box_(signals_.box()),
        grid_(box_) {
    place(signals_.next_distinct(4), 2);
    for (double d = 0;; ++d) {
      const double share = std::exp(-d * d / (2 * options.sigma * options.sigma));
      if (share < kLeastShare) break;
      bell_.push_back(share);
    }
  }

  void grow(const Progress& progress) {
    while (size() < options_.nodes) {
      wins_.assign(static_cast<std::size_t>(size()), 0);
      for (std::int64_t n = std::int64_t{options_.lambda} * size(); n > 0; --n)
        ++wins_[static_cast<std::size_t>(adapt(options_.eps))];
      insert();
      // The time goes with the size to the power of three halves.
      const double share = std::min(1.0, static_cast<double>(size()) / options_.nodes);
      if (progress) progress("growing", kGrown * std::pow(share, 1.5));
    }
  }

  void fine_tune(const Progress& progress) {
    const std::int64_t last = std::int64_t{options_.lambda_fine} * size();
    for (std::int64_t n = 0; n < last; ++n) {
      const double time = static_cast<double>(n) / static_cast<double>(last);
      adapt(options_.eps * std::pow(options_.eps_fine / options_.eps, time));
      if (progress && n % kReportEvery == 0) progress("fine-tuning", kGrown + (1 - kGrown) * time);
    }
  }

  Mesh mesh(const Vec3& origin) const {
    std::vector<std::array<int, 3>> triangles;
    for (int r = 0; r + 1 < rows(); ++r)
      for (int c = 0; c + 1 < columns_; ++c) {
        const int a = r * columns_ + c, b = a + columns_;
        triangles.push_back({a, a + 1, b + 1});
        triangles.push_back({a, b + 1, b});
      }
    return triangle_mesh(triangles, grid_.positions(), origin);
  }

 private:
  int size() const { return static_cast<int>(grid_.positions().size()); }
  int rows() const { return size() / columns_; }

  void place(const std::vector<Vec3>& positions, int columns) {
    columns_ = columns;
    grid_ = NodeGrid(box_);
    for (std::size_t i = 0; i < positions.size(); ++i)
      grid_.insert(static_cast<int>(i), positions[i]);
  }

  // Moves the node nearest to the next signal, and those around it in the lattice. Returns it.
  int adapt(double eps) {
    const Vec3 signal = signals_.next();
    const int winner = grid_.nearest_two(signal).first;
    const int row = winner / columns_, column = winner % columns_,
              reach = static_cast<int>(bell_.size()) - 1;
    for (int r = std::max(row - reach, 0); r <= std::min(row + reach, rows() - 1); ++r) {
      const int off = std::abs(r - row), rest = reach - off;
      for (int c = std::max(column - rest, 0); c <= std::min(column + rest, columns_ - 1); ++c) {
        const int node = r * columns_ + c;
        const Vec3& p = grid_.position(node);
        const double share = bell_[static_cast<std::size_t>(off + std::abs(c - column))];
        grid_.move(node, p + eps * share * (signal - p));
      }
    }
    return winner;
  }

  // Inserts a row or a column between the node that won most and its farthest neighbour.
  void insert() {
    const int q = static_cast<int>(std::max_element(wins_.begin(), wins_.end()) - wins_.begin());
    const int f = farthest_neighbor(q);
    if (std::abs(f - q) == columns_)
      insert_row(std::max(q, f) / columns_);
    else
      insert_column(std::max(q, f) % columns_);
  }

  void insert_row(int row) {
    std::vector<Vec3> nodes = grid_.positions(), between;
    const auto next = nodes.begin() + row * columns_, previous = next - columns_;
    for (int c = 0; c < columns_; ++c) between.push_back((previous[c] + next[c]) / 2);
    nodes.insert(next, between.begin(), between.end());
    place(nodes, columns_);
  }

  void insert_column(int column) {
    std::vector<Vec3> nodes;
    for (int node = 0; node < size(); ++node) {
      const Vec3& p = grid_.position(node);
      if (node % columns_ == column) nodes.push_back((grid_.position(node - 1) + p) / 2);
      nodes.push_back(p);
    }
    place(nodes, columns_ + 1);
  }

  int farthest_neighbor(int q) const {
    const int row = q / columns_, column = q % columns_;
    std::vector<int> neighbors;
    if (row > 0) neighbors.push_back(q - columns_);
    if (column > 0) neighbors.push_back(q - 1);
    if (column + 1 < columns_) neighbors.push_back(q + 1);
    if (row + 1 < rows()) neighbors.push_back(q + columns_);
    const auto distance = [&](int node) {
      return (grid_.position(node) - grid_.position(q)).squaredNorm();
    };
    return *std::max_element(neighbors.begin(), neighbors.end(),
                             [&](int a, int b) { return distance(a) < distance(b); });
  }

  const GrowingGridOptions& options_;
  Signals signals_;
  Box3 box_;
  NodeGrid grid_;
  int columns_ = 2;
  std::vector<double> bell_;  // share of the winner's way that a node moves, by its distance
  std::vector<int> wins_;     // of the nodes, since the lattice grew
};

}  // namespace

Mesh growing_grid(const PointCloud& cloud, const GrowingGridOptions& options,
                  const Progress& progress) {
  Lattice lattice(cloud, options);
  lattice.grow(progress);
  lattice.fine_tune(progress);
  return lattice.mesh(cloud.origin);
}

}  // namespace scanworld::sim
