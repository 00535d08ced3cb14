// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "gsrm.h"

#include <cmath>

#include "hebbian.h"
#include "require.h"

namespace scanworld::sim {

namespace {

constexpr double kGrowing = 0.8, kTopology = 0.9;  // share of the time that is over after these

void check_angles(const PostProcessingOptions& o) {
  require(o.min_dihedral >= 0 && o.min_dihedral <= M_PI, "min_dihedral", o.min_dihedral);
  require(o.max_corner > M_PI / 3 && o.max_corner <= M_PI, "max_corner", o.max_corner);
  require(o.min_merge_angle >= 0 && o.min_merge_angle <= M_PI, "min_merge_angle",
          o.min_merge_angle);
}

void gsrm_step(Gas& gas, const Vec3& signal) {
  const auto [winner, second] = gas.grid.nearest_two(signal);
  learn_connection(gas.network, gas.grid.positions(), winner, second);
  gas.adapt(winner, signal);
  gas.add_error(winner, signal);
  gas.age_edges(winner);
}

// Shows each point once to nodes that rest.
void learn_topology(Gas& gas) {
  gas.signals.shuffle();
  for (std::size_t i = 0; i < gas.signals.size(); ++i) {
    const auto [first, second] = gas.grid.nearest_two(gas.signals.next());
    learn_connection(gas.network, gas.grid.positions(), first, second);
  }
}

}  // namespace

Mesh gsrm(const PointCloud& cloud, const GsrmOptions& options, const Progress& progress) {
  check_angles(options.post);
  Gas gas(cloud, options.gas, 3);
  gas.grow([&](const Vec3& signal) { gsrm_step(gas, signal); }, progress, kGrowing);
  if (progress) progress("learning topology", kGrowing);
  learn_topology(gas);
  if (progress) progress("closing holes", kTopology);
  post_process(gas.network, gas.grid.positions(), options.post);
  return triangle_mesh(gas.network.triangles(), gas.grid.positions(), cloud.origin);
}

}  // namespace scanworld::sim
