// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "gng.h"

#include <algorithm>

namespace scanworld::sim {

namespace {

// Connects the two nodes nearest to a signal, and moves the nearest.
void gng_step(Gas& gas, const Vec3& signal) {
  const auto [winner, second] = gas.grid.nearest_two(signal);
  const int edge = gas.network.find_edge(winner, second);
  if (edge == kNothing)
    gas.network.add_edge(winner, second);
  else
    gas.network.edge(edge).age = 0;
  gas.add_error(winner, signal);
  gas.adapt(winner, signal);
  gas.age_edges(winner);
}

// Each three nodes that are connected, from the lowest to the highest.
std::vector<std::array<int, 3>> cliques_of(const Network& network) {
  std::vector<std::array<int, 3>> cliques;
  for (int e = 0; e < network.edge_end(); ++e) {
    if (!network.edge(e).exists()) continue;
    const auto [a, b] = std::minmax(network.edge(e).nodes[0], network.edge(e).nodes[1]);
    for (int c : network.common_neighbors(a, b))
      if (c > b) cliques.push_back({a, b, c});
  }
  return cliques;
}

}  // namespace

Mesh gng_with_cliques(const PointCloud& cloud, const GngOptions& options,
                      const Progress& progress) {
  Gas gas(cloud, options.gas, 2);
  gas.network.add_edge(0, 1);
  gas.grow([&](const Vec3& signal) { gng_step(gas, signal); }, progress, 1);
  std::vector<std::array<int, 3>> cliques = cliques_of(gas.network);
  if (options.two_faces_an_edge)
    std::erase_if(cliques, [&](const auto& c) { return !gas.network.add_face(c[0], c[1], c[2]); });
  return triangle_mesh(cliques, gas.grid.positions(), cloud.origin);
}

}  // namespace scanworld::sim
