// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "../types.h"

namespace scanworld::surface {

// Square cells of a plane, each of which is set or not.
struct Raster {
  Vec2 low = Vec2::Zero();  // [m] corner of the first cell
  double cell = 0;          // [m] edge of a cell
  int width = 0, height = 0;
  std::vector<std::uint8_t> bits;  // row by row

  bool contains(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  bool is_set(int x, int y) const { return contains(x, y) && bits[index(x, y)]; }
  // The index of the cell around a point, if there is one.
  std::optional<std::size_t> find(const Vec2& p) const {
    const Vec2 q = (p - low) / cell;
    if (!(q.x() >= 0 && q.y() >= 0 && q.x() < width && q.y() < height)) return std::nullopt;
    return index(static_cast<int>(q.x()), static_cast<int>(q.y()));
  }
  bool is_set(const Vec2& p) const {
    const auto at = find(p);
    return at && bits[*at];
  }
  int column(std::size_t i) const { return static_cast<int>(i % static_cast<std::size_t>(width)); }
  int row(std::size_t i) const { return static_cast<int>(i / static_cast<std::size_t>(width)); }
  Vec2 middle(int x, int y) const { return low + cell * Vec2(x + 0.5, y + 0.5); }
  Vec2 middle(std::size_t i) const { return middle(column(i), row(i)); }
  Vec2 high() const { return low + cell * Vec2(width, height); }
};

// One of the same size, nothing set.
inline Raster empty_like(Raster raster) {
  raster.bits.assign(raster.bits.size(), 0);
  return raster;
}

// Cells that hold a box and a margin [m] around it, none set. At whole cells, so that they do not
// hang on a single point.
Raster raster_around(const Eigen::AlignedBox2d& box, double margin, double cell);

// Sets the cell around a point, if there is one.
void set(Raster& raster, const Vec2& p);

// Sets all cells no more than `reach` cells along both axes from one that is set.
Raster grow(const Raster& raster, int reach);

// Grows and shrinks by the same: gaps up to twice `reach` are closed, the outline stays.
Raster close(const Raster& raster, int reach);

// The cells that have set ones to both sides, along both axes.
Raster enclosed_by(const Raster& raster);

// Cells of some columns and rows.
struct CellBox {
  int x0, x1, y0, y1;  // from, and up to but without
};

// The set cells as rectangles: runs of a row, with the same runs of the rows after it.
std::vector<CellBox> rectangles_of(const Raster& raster);

}  // namespace scanworld::surface
