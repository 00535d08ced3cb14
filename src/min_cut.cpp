// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "min_cut.h"

#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/boykov_kolmogorov_max_flow.hpp>
#include <cstdint>

namespace scanworld {

template <typename Capacity>
std::vector<char> min_cut(std::size_t nodes, int source, int sink,
                          const std::vector<FlowEdge<Capacity>>& edges) {
  using namespace boost;
  using Traits = adjacency_list_traits<vecS, vecS, directedS>;
  using Graph = adjacency_list<
      vecS, vecS, directedS,
      property<vertex_index_t, long,
               property<vertex_color_t, default_color_type,
                        property<vertex_distance_t, long,
                                 property<vertex_predecessor_t, Traits::edge_descriptor>>>>,
      property<edge_capacity_t, Capacity,
               property<edge_residual_capacity_t, Capacity,
                        property<edge_reverse_t, Traits::edge_descriptor>>>>;
  Graph graph(nodes);
  auto capacity = get(edge_capacity, graph);
  auto reverse = get(edge_reverse, graph);
  const auto add = [&](int from, int to, Capacity ahead, Capacity behind) {
    const auto there =
        add_edge(static_cast<std::size_t>(from), static_cast<std::size_t>(to), graph).first;
    const auto back =
        add_edge(static_cast<std::size_t>(to), static_cast<std::size_t>(from), graph).first;
    capacity[there] = ahead, capacity[back] = behind;
    reverse[there] = back, reverse[back] = there;
  };
  // Boost wants no more than one edge from the source to a node, and one from there to the sink.
  // What goes into the source or out of the sink is never cut, what goes from one to the other
  // always.
  std::vector<Capacity> of_source(nodes), of_sink(nodes);
  const auto add_at_end = [&](int from, int to, Capacity ahead) {
    if (to == source || from == sink) return;
    if (from == source)
      of_source[static_cast<std::size_t>(to)] += ahead;
    else
      of_sink[static_cast<std::size_t>(from)] += ahead;
  };
  for (const FlowEdge<Capacity>& e : edges) {
    if (e.from == source || e.from == sink || e.to == source || e.to == sink)
      add_at_end(e.from, e.to, e.capacity), add_at_end(e.to, e.from, e.back);
    else
      add(e.from, e.to, e.capacity, e.back);
  }
  for (int i = 0; i < static_cast<int>(nodes); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (i == source || i == sink) continue;
    if (of_source[k] > 0) add(source, i, of_source[k], 0);
    if (of_sink[k] > 0) add(i, sink, of_sink[k], 0);
  }
  boykov_kolmogorov_max_flow(graph, static_cast<std::size_t>(source),
                             static_cast<std::size_t>(sink));
  const auto color = get(vertex_color, graph);
  std::vector<char> side(nodes);
  for (std::size_t i = 0; i < nodes; ++i)
    side[i] = color[i] == color[static_cast<std::size_t>(source)];
  return side;
}

template std::vector<char> min_cut(std::size_t, int, int, const std::vector<FlowEdge<double>>&);
template std::vector<char> min_cut(std::size_t, int, int,
                                   const std::vector<FlowEdge<std::int64_t>>&);

}  // namespace scanworld
