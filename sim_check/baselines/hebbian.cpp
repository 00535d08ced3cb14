// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "hebbian.h"

#include <algorithm>

namespace scanworld::sim {

namespace {

void disconnect(Network& network, const std::vector<int>& nodes) {
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (const int e = network.find_edge(nodes[i], nodes[k]); e != kNothing)
        network.remove_edge(e);
}

}  // namespace

void learn_connection(Network& network, const std::vector<Vec3>& positions, int first, int second) {
  const auto at = [&](int node) { return positions[static_cast<std::size_t>(node)]; };
  const std::vector<int> common = network.common_neighbors(first, second);
  if (const int edge = network.find_edge(first, second); edge != kNothing) {
    network.edge(edge).age = 0;
    // It is seen under more than a right angle from within the Thales sphere over it.
    const auto is_between = [&](int c) { return (at(first) - at(c)).dot(at(second) - at(c)) < 0; };
    if (std::any_of(common.begin(), common.end(), is_between)) network.remove_edge(edge);
    return;
  }
  disconnect(network, common);
  network.add_edge(first, second);
  for (std::size_t i = 0; i < common.size() && i < 2; ++i)
    network.add_face(first, second, common[i]);
}

}  // namespace scanworld::sim
