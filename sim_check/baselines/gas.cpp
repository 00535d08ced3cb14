// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "gas.h"

#include "require.h"

namespace scanworld::sim {

namespace {

constexpr std::int64_t kPatience = 4;  // times the signals that growth should take
constexpr int kReports = 100;          // of progress in these

const GasOptions& checked_gas(const GasOptions& o, int first_nodes) {
  require(o.max_nodes > first_nodes, "max_nodes", o.max_nodes);
  require(o.lambda >= 1, "lambda", o.lambda);
  require(o.eps_b > 0 && o.eps_b <= 1, "eps_b", o.eps_b);
  require(o.eps_n >= 0 && o.eps_n <= 1, "eps_n", o.eps_n);
  require(o.alpha >= 0 && o.alpha <= 1, "alpha", o.alpha);
  require(o.beta > 0 && o.beta <= 1, "beta", o.beta);
  require(o.max_age >= 1, "max_age", o.max_age);
  return o;
}

}  // namespace

Gas::Gas(const PointCloud& cloud, const GasOptions& options, int first_nodes)
    : signals(cloud, checked_gas(options, first_nodes).max_nodes, options.seed),
      grid(signals.box()),
      options_(options),
      errors_(options.beta) {
  for (const Vec3& p : signals.next_distinct(static_cast<std::size_t>(first_nodes))) add_node(p);
}

void Gas::grow(const std::function<void(const Vec3& signal)>& step, const Progress& progress,
               double share) {
  const std::int64_t usual = std::int64_t{options_.lambda} * options_.max_nodes,
                     last = kPatience * usual, report = usual / kReports + 1;
  for (std::int64_t n = 1; network.node_count() < options_.max_nodes && n <= last; ++n) {
    step(signals.next());
    errors_.decay();
    if (n % options_.lambda == 0) insert_node();
    if (progress && n % report == 0)
      progress("growing", share * network.node_count() / options_.max_nodes);
  }
}

void Gas::add_error(int winner, const Vec3& signal) {
  errors_.add(winner, (signal - grid.position(winner)).squaredNorm());
}

void Gas::adapt(int winner, const Vec3& signal) {
  const auto follow = [&](int node, double eps) {
    const Vec3& p = grid.position(node);
    grid.move(node, p + eps * (signal - p));
  };
  follow(winner, options_.eps_b);
  for (int e : network.edges_of(winner)) follow(network.edge(e).other(winner), options_.eps_n);
}

void Gas::age_edges(int winner) {
  const auto remove_if_lone = [&](int node) {
    if (!network.edges_of(node).empty()) return;
    network.remove_node(node);
    grid.erase(node);
  };
  const std::vector<int> edges = network.edges_of(winner);  // a copy, as some are removed
  for (int e : edges) {
    if (++network.edge(e).age <= options_.max_age) continue;
    const int neighbor = network.edge(e).other(winner);
    network.remove_edge(e);
    remove_if_lone(neighbor);
  }
  remove_if_lone(winner);
}

int Gas::add_node(const Vec3& position) {
  const int node = network.add_node();
  grid.insert(node, position);
  errors_[node] = 0;
  return node;
}

// Between the node with the largest error and its neighbour with the largest.
void Gas::insert_node() {
  const int q = max_error_node(), f = max_error_neighbor(q);
  if (f == kNothing) return;
  const int r = add_node((grid.position(q) + grid.position(f)) / 2);
  network.remove_edge(network.find_edge(q, f));
  network.add_edge(q, r);
  network.add_edge(f, r);
  errors_[q] *= options_.alpha;
  errors_[f] *= options_.alpha;
  errors_[r] = (errors_[q] + errors_[f]) / 2;
}

int Gas::max_error_node() const {
  int max = kNothing;
  for (int node = 0; node < network.node_end(); ++node)
    if (network.has_node(node) && (max == kNothing || errors_[node] > errors_[max])) max = node;
  return max;
}

int Gas::max_error_neighbor(int node) const {
  int max = kNothing;
  for (int e : network.edges_of(node)) {
    const int neighbor = network.edge(e).other(node);
    if (max == kNothing || errors_[neighbor] > errors_[max]) max = neighbor;
  }
  return max;
}

}  // namespace scanworld::sim
