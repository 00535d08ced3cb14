// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "viewers.h"

#include <algorithm>
#include <limits>

namespace scanworld {

std::int32_t main_viewer(std::vector<std::int32_t>& viewers, const std::vector<Vec3>& viewpoints,
                         const Vec3& place) {
  std::sort(viewers.begin(), viewers.end());
  std::int32_t main = -1;
  std::size_t most = 0;
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, next = 0; i < viewers.size(); i = next) {
    while (next < viewers.size() && viewers[next] == viewers[i]) ++next;
    if (viewers[i] < 0 || next - i < most) continue;
    const double distance =
        (viewpoints[static_cast<std::size_t>(viewers[i])] - place).squaredNorm();
    if (next - i > most || distance < nearest)
      main = viewers[i], most = next - i, nearest = distance;
  }
  return main;
}

}  // namespace scanworld
