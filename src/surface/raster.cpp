// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "raster.h"

#include <algorithm>

namespace scanworld::surface {

namespace {

// Along one line of cells: sets those no more than `reach` from one that has `value`, to `value`.
void spread(std::uint8_t* cells, int count, std::size_t stride, int reach, std::uint8_t value,
            std::vector<std::uint8_t>& line) {
  line.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i)
    line[static_cast<std::size_t>(i)] = cells[static_cast<std::size_t>(i) * stride];
  int last = -reach - 1;  // the last cell with the value
  for (int i = 0; i < count; ++i) {
    if (line[static_cast<std::size_t>(i)] == value) last = i;
    if (i - last <= reach) cells[static_cast<std::size_t>(i) * stride] = value;
  }
  last = count + reach;
  for (int i = count - 1; i >= 0; --i) {
    if (line[static_cast<std::size_t>(i)] == value) last = i;
    if (last - i <= reach) cells[static_cast<std::size_t>(i) * stride] = value;
  }
}

void spread(Raster& raster, int reach, std::uint8_t value) {
  std::vector<std::uint8_t> line;
  for (int y = 0; y < raster.height; ++y)
    spread(&raster.bits[raster.index(0, y)], raster.width, 1, reach, value, line);
  for (int x = 0; x < raster.width; ++x)
    spread(&raster.bits[raster.index(x, 0)], raster.height, static_cast<std::size_t>(raster.width),
           reach, value, line);
}

}  // namespace

Raster raster_around(const Eigen::AlignedBox2d& box, double margin, double cell) {
  const Vec2 low = ((box.min().array() - margin) / cell).floor(),
             high = ((box.max().array() + margin) / cell).ceil();
  Raster raster{.low = cell * low,
                .cell = cell,
                .width = static_cast<int>(high.x() - low.x()),
                .height = static_cast<int>(high.y() - low.y())};
  raster.bits.assign(raster.index(0, raster.height), 0);
  return raster;
}

void set(Raster& raster, const Vec2& p) {
  if (const auto at = raster.find(p)) raster.bits[*at] = 1;
}

Raster grow(const Raster& raster, int reach) {
  Raster grown = raster;
  spread(grown, reach, 1);
  return grown;
}

Raster close(const Raster& raster, int reach) {
  Raster closed = raster;
  spread(closed, reach, 1);
  spread(closed, reach, 0);
  return closed;
}

Raster enclosed_by(const Raster& raster) {
  std::vector<int> ways(raster.bits.size());
  const auto walk = [&](int x, int y, int dx, int dy) {
    for (bool met = false; raster.contains(x, y); x += dx, y += dy) {
      const std::size_t i = raster.index(x, y);
      met |= raster.bits[i] != 0;
      ways[i] += met;
    }
  };
  for (int y = 0; y < raster.height; ++y) walk(0, y, 1, 0), walk(raster.width - 1, y, -1, 0);
  for (int x = 0; x < raster.width; ++x) walk(x, 0, 0, 1), walk(x, raster.height - 1, 0, -1);
  Raster enclosed = empty_like(raster);
  for (std::size_t i = 0; i < ways.size(); ++i) enclosed.bits[i] = ways[i] == 4;
  return enclosed;
}

std::vector<CellBox> rectangles_of(const Raster& raster) {
  std::vector<CellBox> done, open;
  for (int y = 0; y <= raster.height; ++y) {
    std::vector<CellBox> row;
    for (int x = 0; x < raster.width; ++x) {
      if (!raster.is_set(x, y)) continue;
      const int start = x;
      while (raster.is_set(x, y)) ++x;
      row.push_back({start, x, y, y + 1});
    }
    for (const CellBox& before : open) {
      const auto same = std::find_if(row.begin(), row.end(), [&](const CellBox& r) {
        return r.x0 == before.x0 && r.x1 == before.x1;
      });
      if (same == row.end())
        done.push_back(before);
      else
        same->y0 = before.y0;
    }
    open = std::move(row);
  }
  return done;
}

}  // namespace scanworld::surface
