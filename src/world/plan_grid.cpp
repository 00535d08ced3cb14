// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "plan_grid.h"

namespace scanworld {

double cell_count(const Rectangle& box, double cell) {
  if (box.isEmpty()) return 1;
  return (box.sizes().x() / cell + 4) * (box.sizes().y() / cell + 4);
}

PlanGrid grid_over(const Rectangle& box, double cell) {
  if (box.isEmpty()) return {.cell = cell, .columns = 1, .rows = 1};
  const Vec2 first = (box.min() / cell).array().floor() - 1,
             last = (box.max() / cell).array().floor() + 1;
  return {.cell = cell,
          .corner = first * cell,
          .columns = static_cast<std::size_t>(last.x() - first.x()) + 1,
          .rows = static_cast<std::size_t>(last.y() - first.y()) + 1};
}

}  // namespace scanworld
