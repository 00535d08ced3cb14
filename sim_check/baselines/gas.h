// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What a growing neural gas is, and the methods built on it share: nodes that follow the points,
// edges that age, and new nodes where the error is largest. Based on: B. Fritzke, A Growing Neural
// Gas Network Learns Topologies, Advances in Neural Information Processing Systems 7, 1995.
#pragma once

#include <cstdint>
#include <functional>

#include "decaying_errors.h"
#include "network.h"
#include "node_grid.h"
#include "progress.h"
#include "signals.h"

namespace scanworld::sim {

struct GasOptions {
  int max_nodes = 5000;    // growth ends with so many; a cloud needs at least as many points
  int lambda = 200;        // signals from one new node to the next
  double eps_b = 0.05;     // share of the way to the signal that the nearest node moves
  double eps_n = 0.0006;   // share that its neighbours move
  double alpha = 0.95;     // what is left of the errors of two nodes that a new one goes between
  double beta = 0.9995;    // what is left of all errors after each signal
  int max_age = 200;       // [signals of its nodes] for which an edge lives without use
  std::uint64_t seed = 1;  // of the order that the points are drawn in
};

class Gas {
 public:
  Signals signals;
  NodeGrid grid;  // relative to the cloud's origin
  Network network;

  // Starts with nodes on some points. Throws usage for options out of range, bad_input for a cloud
  // with too few points.
  Gas(const PointCloud& cloud, const GasOptions& options, int first_nodes);

  // Grows by what `step` makes of each signal until there are max_nodes, or, where edges die as
  // fast as nodes come, after four times as many signals as that should take. Tells progress up to
  // `share` of the whole.
  void grow(const std::function<void(const Vec3& signal)>& step, const Progress& progress,
            double share);

  // Parts of a step; the winner is the node nearest to the signal.
  void add_error(int winner, const Vec3& signal);
  void adapt(int winner, const Vec3& signal);  // moves it, and its neighbours
  void age_edges(int winner);  // removes old ones, and nodes that are left with none

 private:
  int add_node(const Vec3& position);
  void insert_node();
  int max_error_node() const;
  int max_error_neighbor(int node) const;

  GasOptions options_;
  DecayingErrors errors_;
};

}  // namespace scanworld::sim
