// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "find_frame.h"

#include <algorithm>
#include <cmath>

namespace scanworld {

namespace {

constexpr double kMaxPitch = 0.87;  // [rad] of a camera: 50 degrees

}  // namespace

Frame find_frame(const PointCloud& cloud, const std::vector<FoundSurface>& surfaces) {
  Frame frame{.origin = cloud.origin,
              .assumed = {"coordinates are metres: the scan does not say otherwise"}};
  if (!cloud.camera_frame) {
    frame.assumed.push_back("up is +z: the scan does not say otherwise");
    return frame;
  }
  frame.up = -Vec3::UnitY();
  std::string assumed = "up is -y: the scan is one image of a camera, in whose frame y points down";
  std::size_t most = 0;
  for (const FoundSurface& s : surfaces) {
    if (-s.plane.normal.y() <= std::cos(kMaxPitch) || s.support.points <= most) continue;
    most = s.support.points;
    frame.up = s.plane.normal;
    assumed =
        "up is the normal of the largest surface that faces against the camera's y axis: the scan "
        "is "
        "one image of a camera, in whose frame y points down";
  }
  frame.assumed.push_back(assumed);
  return frame;
}

}  // namespace scanworld
