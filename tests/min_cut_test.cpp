// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "min_cut.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// Whole capacities, of which many are 0 or equal; between the same two nodes there may be several.
template <typename Capacity>
std::vector<FlowEdge<Capacity>> random_network(Random& random, int nodes) {
  std::vector<FlowEdge<Capacity>> edges;
  const int count = random.whole(nodes, 4 * nodes);
  for (int k = 0; k < count; ++k) {
    const int from = random.whole(0, nodes - 1), to = random.whole(0, nodes - 1);
    if (from == to) continue;
    const auto capacity = [&] { return static_cast<Capacity>(std::max(0, random.whole(-3, 9))); };
    edges.push_back({from, to, capacity(), capacity()});
  }
  return edges;
}

// What flows out of the nodes of the source's side can carry.
template <typename Capacity, typename IsSource>
Capacity price_of_cut(const std::vector<FlowEdge<Capacity>>& edges, const IsSource& is_source) {
  Capacity sum = 0;
  for (const FlowEdge<Capacity>& e : edges) {
    if (is_source(e.from) && !is_source(e.to)) sum += e.capacity;
    if (is_source(e.to) && !is_source(e.from)) sum += e.back;
  }
  return sum;
}

// The least price of all cuts, tried one by one.
template <typename Capacity>
Capacity least_price(const std::vector<FlowEdge<Capacity>>& edges, int nodes, int source,
                     int sink) {
  Capacity least = std::numeric_limits<Capacity>::max();
  for (int sides = 0; sides < 1 << nodes; ++sides) {
    const auto is_source = [&](int node) { return (sides >> node & 1) != 0; };
    if (is_source(source) && !is_source(sink))
      least = std::min(least, price_of_cut(edges, is_source));
  }
  return least;
}

}  // namespace

TEST_CASE_TEMPLATE("no cut of a network is cheaper than the least one", Capacity, std::int64_t,
                   double) {
  Random random(1);
  for (int turn = 0; turn < 300; ++turn) {
    const int nodes = random.whole(2, 9), source = random.whole(0, nodes - 1),
              sink = (source + random.whole(1, nodes - 1)) % nodes;
    const auto edges = random_network<Capacity>(random, nodes);
    const std::vector<char> side = min_cut(static_cast<std::size_t>(nodes), source, sink, edges);
    REQUIRE(side.size() == static_cast<std::size_t>(nodes));
    const auto is_source = [&](int node) { return side[static_cast<std::size_t>(node)] != 0; };
    CHECK(is_source(source));
    CHECK_FALSE(is_source(sink));
    CHECK(price_of_cut(edges, is_source) == least_price(edges, nodes, source, sink));
  }
}

TEST_CASE("the direction of an edge matters: a way back alone carries nothing") {
  const std::vector<FlowEdge<std::int64_t>> edges = {{0, 1, 5, 0}, {2, 1, 9, 0}, {2, 3, 5, 0}};
  CHECK(min_cut(4, 0, 3, edges) == std::vector<char>{1, 1, 0, 0});
}

TEST_CASE("large whole capacities are told apart by one") {
  constexpr std::int64_t large = std::int64_t{1} << 56;  // more than a double can tell apart
  for (const std::int64_t more : {-1, 1}) {
    const std::vector<FlowEdge<std::int64_t>> edges = {{0, 1, large, 0}, {1, 2, large + more, 0}};
    CHECK(min_cut(3, 0, 2, edges) == std::vector<char>{1, more < 0, 0});
  }
}

TEST_CASE("what no flow reaches is not the source's, and a network without edges is cut as well") {
  CHECK(min_cut<double>(3, 1, 2, {}) == std::vector<char>{0, 1, 0});
  CHECK(min_cut<std::int64_t>(4, 0, 3, {{0, 1, 1, 0}}) == std::vector<char>{1, 1, 0, 0});
}
