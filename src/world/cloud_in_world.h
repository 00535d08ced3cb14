// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "world.h"

namespace scanworld {

// A cloud as seen in the frame of a world. It refers to the cloud.
class CloudInWorld {
 public:
  CloudInWorld(const PointCloud& cloud, const Frame& frame) : cloud_(cloud), frame_(frame) {}

  // From the cloud's coordinates, as stored, to the world's.
  Vec3 to_world(const Vec3& p) const { return frame_.to_world(p + cloud_.origin); }

  std::size_t size() const { return cloud_.points.size(); }
  Vec3 point(std::size_t i) const { return to_world(cloud_.points[i].cast<double>()); }
  const PointCloud& cloud() const { return cloud_; }

  std::vector<Vec3> viewpoints() const {
    std::vector<Vec3> all;
    for (const Vec3& v : cloud_.viewpoints) all.push_back(to_world(v));
    return all;
  }

 private:
  const PointCloud& cloud_;
  const Frame frame_;
};

}  // namespace scanworld
