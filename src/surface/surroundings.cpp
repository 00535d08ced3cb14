// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surroundings.h"

#include <utility>

namespace scanworld::surface {

Surroundings surroundings_of(std::vector<Vec3f> points, std::vector<std::int32_t> planes) {
  Surroundings s{.points = std::move(points), .planes = std::move(planes)};
  for (std::size_t i = 0; i < s.points.size(); ++i) {
    if (i % Surroundings::kRun == 0) s.boxes.emplace_back();
    s.boxes.back().extend(s.points[i]);
  }
  return s;
}

}  // namespace scanworld::surface
