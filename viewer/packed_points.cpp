// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "packed_points.h"

#include <algorithm>
#include <cmath>

namespace scanworld {

nlohmann::ordered_json box_json(const Box3& box) {
  const auto json = [](const Vec3& v) { return nlohmann::ordered_json{v.x(), v.y(), v.z()}; };
  return {{"min", json(box.min())}, {"max", json(box.max())}};
}

std::vector<std::uint16_t> pack(const std::vector<Vec3>& points, const Box3& box) {
  std::vector<std::uint16_t> packed;
  packed.reserve(3 * points.size());
  const Vec3 size = box.sizes();
  for (const Vec3& p : points)
    for (int k = 0; k < 3; ++k) {
      const double share = size[k] > 0 ? (p[k] - box.min()[k]) / size[k] : 0;
      packed.push_back(
          static_cast<std::uint16_t>(std::lround(65535 * std::clamp(share, 0.0, 1.0))));
    }
  return packed;
}

}  // namespace scanworld
