// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "rectangles.h"

namespace scanworld {

// [m] A face on the line between two cells is moved so far, into the one behind it.
inline constexpr double kBehindFace = 1e-6;

// A raster of square cells seen from above, row by row from the lowest y, in each from the lowest
// x. Borders of cells are multiples of their edge, so that the rasters of one place lie on each
// other. A cell holds its lower border, not its upper one.
struct PlanGrid {
  double cell = 0.05;          // [m] edge
  Vec2 corner = Vec2::Zero();  // of the lower left cell: its lowest x and y
  std::size_t columns = 0, rows = 0;

  std::size_t size() const { return columns * rows; }
  Vec2 center(std::size_t i) const {
    return corner + cell * Vec2(static_cast<double>(i % columns) + 0.5,
                                static_cast<double>(i / columns) + 0.5);
  }
  // The cell that a point is in.
  std::optional<std::size_t> at(const Vec2& p) const {
    const double x = std::floor((p.x() - corner.x()) / cell),
                 y = std::floor((p.y() - corner.y()) / cell);
    if (!(x >= 0 && y >= 0 && x < static_cast<double>(columns) && y < static_cast<double>(rows)))
      return std::nullopt;
    return static_cast<std::size_t>(y) * columns + static_cast<std::size_t>(x);
  }
};

// How many cells a grid over a box would have at most.
double cell_count(const Rectangle& box, double cell);

// The cells that hold a box, and one more on each side. An empty box gives one cell.
PlanGrid grid_over(const Rectangle& box, double cell);

namespace detail {

inline std::size_t clamp_cell(double x, std::size_t count) {
  return static_cast<std::size_t>(std::clamp(x, 0.0, static_cast<double>(count)));
}

// The range of x that a convex ring has between two heights; nothing where it is elsewhere.
inline std::optional<std::pair<double, double>> x_range(const std::vector<Vec2>& ring, double low,
                                                        double high) {
  double least = std::numeric_limits<double>::max(), most = -least;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 *a = &ring[i], *b = &ring[(i + 1) % ring.size()];
    if (a->y() > b->y()) std::swap(a, b);
    if (b->y() < low || a->y() > high) continue;
    const auto x_at = [&](double y) {
      return a->x() + (b->x() - a->x()) * ((y - a->y()) / (b->y() - a->y()));
    };
    for (const double x : {a->y() < low ? x_at(low) : a->x(), b->y() > high ? x_at(high) : b->x()})
      least = std::min(least, x), most = std::max(most, x);
  }
  if (least > most) return std::nullopt;
  return std::pair{least, most};
}

}  // namespace detail

// Calls visit(i) for each cell that a convex ring touches, which may be a segment or a point.
template <typename Visit>
void visit_touched(const PlanGrid& grid, const std::vector<Vec2>& ring, const Visit& visit) {
  if (ring.empty()) return;
  double low = ring[0].y(), high = low;
  for (const Vec2& p : ring) low = std::min(low, p.y()), high = std::max(high, p.y());
  const auto row_of = [&](double y) { return std::floor((y - grid.corner.y()) / grid.cell); };
  const std::size_t first = detail::clamp_cell(row_of(low), grid.rows),
                    last = detail::clamp_cell(row_of(high) + 1, grid.rows);
  for (std::size_t row = first; row < last; ++row) {
    const double y = grid.corner.y() + static_cast<double>(row) * grid.cell;
    const auto x = detail::x_range(ring, y, y + grid.cell);
    if (!x) continue;
    const auto column_of = [&](double at) {
      return std::floor((at - grid.corner.x()) / grid.cell);
    };
    const std::size_t from = detail::clamp_cell(column_of(x->first), grid.columns),
                      to = detail::clamp_cell(column_of(x->second) + 1, grid.columns);
    for (std::size_t i = from; i < to; ++i) visit(row * grid.columns + i);
  }
}

// Calls visit(i) for each cell whose centre is in a convex ring. Of rings side by side, one alone
// has a centre that is on the line between them, but for roundings.
template <typename Visit>
void visit_covered(const PlanGrid& grid, const std::vector<Vec2>& ring, const Visit& visit) {
  if (ring.size() < 3) return;
  double low = ring[0].y(), high = low;
  for (const Vec2& p : ring) low = std::min(low, p.y()), high = std::max(high, p.y());
  // The first row or column whose centre is not below.
  const auto row_at = [&](double y) {
    return detail::clamp_cell(std::ceil((y - grid.corner.y()) / grid.cell - 0.5), grid.rows);
  };
  const auto column_at = [&](double x) {
    return detail::clamp_cell(std::ceil((x - grid.corner.x()) / grid.cell - 0.5), grid.columns);
  };
  for (std::size_t row = row_at(low); row < row_at(high); ++row) {
    const double y = grid.corner.y() + (static_cast<double>(row) + 0.5) * grid.cell;
    const auto x = detail::x_range(ring, y, y);
    if (!x) continue;
    for (std::size_t i = column_at(x->first); i < column_at(x->second); ++i)
      visit(row * grid.columns + i);
  }
}

}  // namespace scanworld
