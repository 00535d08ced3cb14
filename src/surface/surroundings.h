// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "patch.h"

namespace scanworld::surface {

// What a scan holds, thinned: for looking around. In no order that the points' order changes.
struct Surroundings {
  std::vector<Vec3f> points;
  std::vector<std::int32_t> planes;        // of each point, or -1
  std::vector<Eigen::AlignedBox3f> boxes;  // of each kRun points
  std::vector<Vec3> viewpoints;            // where they are known ...
  std::vector<std::int32_t> viewers;       // ... from which of them each point was seen, or -1

  static constexpr std::size_t kRun = 256;
};

Surroundings surroundings_of(std::vector<Vec3f> points, std::vector<std::int32_t> planes);

// Calls body(distance, where, plane) for what is around a patch, up to a depth [m]: its distance
// from the patch's plane, where it is in the patch's frame, and its own plane or -1.
template <typename Body>
void look_around(const Patch& patch, const Surroundings& around, double depth, const Body& body) {
  const Eigen::AlignedBox3f reach = grown(patch.box, depth).cast<float>();
  for (std::size_t run = 0; run < around.boxes.size(); ++run) {
    if (!reach.intersects(around.boxes[run])) continue;
    const std::size_t begin = run * Surroundings::kRun;
    for (std::size_t i = begin; i < std::min(begin + Surroundings::kRun, around.points.size());
         ++i) {
      const Vec3 p = around.points[i].cast<double>();
      const double distance = patch.plane.signed_distance(p);
      if (std::abs(distance) < depth) body(distance, patch.frame.to_plane(p), around.planes[i]);
    }
  }
}

}  // namespace scanworld::surface
