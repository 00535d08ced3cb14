// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "raster_outlines.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "../polygon.h"

namespace scanworld::surface {

namespace {

class RasterTracer {
 public:
  explicit RasterTracer(const Raster& raster)
      : raster_(raster),
        out_(static_cast<std::size_t>(raster.width + 1) *
             static_cast<std::size_t>(raster.height + 1)) {}

  std::vector<std::vector<Vec2>> trace() {
    for (int y = 0; y < raster_.height; ++y)
      for (int x = 0; x < raster_.width; ++x) {
        if (!raster_.is_set(x, y)) continue;
        if (!raster_.is_set(x, y - 1)) out(x, y) |= 1;
        if (!raster_.is_set(x + 1, y)) out(x + 1, y) |= 2;
        if (!raster_.is_set(x, y + 1)) out(x + 1, y + 1) |= 4;
        if (!raster_.is_set(x - 1, y)) out(x, y + 1) |= 8;
      }
    std::vector<std::vector<Vec2>> loops;
    for (int y = 0; y <= raster_.height; ++y)
      for (int x = 0; x <= raster_.width; ++x)
        while (out(x, y) != 0) loops.push_back(trace_from(x, y));
    return loops;
  }

 private:
  // Which ways edges leave a corner of the cells: bit k for (k quarter turns from +x).
  std::uint8_t& out(int x, int y) {
    return out_[static_cast<std::size_t>(y) * static_cast<std::size_t>(raster_.width + 1) +
                static_cast<std::size_t>(x)];
  }

  std::vector<Vec2> trace_from(int x, int y) {
    constexpr int kX[] = {1, 0, -1, 0}, kY[] = {0, 1, 0, -1};
    std::vector<Vec2> middles;
    int way = std::countr_zero(out(x, y));
    while (out(x, y) != 0) {
      // Left first: cells that touch at a corner alone are apart.
      for (int turn : {1, 0, 3})
        if (out(x, y) >> ((way + turn) & 3) & 1) {
          way = (way + turn) & 3;
          break;
        }
      if (!(out(x, y) >> way & 1)) way = std::countr_zero(out(x, y));
      out(x, y) &= static_cast<std::uint8_t>(~(1 << way));
      middles.push_back(raster_.low + raster_.cell * Vec2(x + 0.5 * kX[way], y + 0.5 * kY[way]));
      x += kX[way], y += kY[way];
    }
    return middles;
  }

  const Raster& raster_;
  std::vector<std::uint8_t> out_;
};

// Appends the last point of each straight piece.
void bend(const std::vector<Vec2>& points, std::size_t first, std::size_t last, double tolerance,
          std::vector<std::size_t>& ends) {
  const Vec2 chord = points[last] - points[first];
  const double length = chord.norm();
  double farthest = tolerance;
  std::size_t at = last;
  for (std::size_t i = first + 1; i < last; ++i) {
    const Vec2 to = points[i] - points[first];
    const double off =
        length > 0 ? std::abs(chord.x() * to.y() - chord.y() * to.x()) / length : to.norm();
    if (off > farthest) farthest = off, at = i;
  }
  if (at == last) return ends.push_back(last);
  bend(points, first, at, tolerance, ends);
  bend(points, at, last, tolerance, ends);
}

std::vector<Vec2> straightened(const std::vector<Vec2>& loop, double tolerance) {
  const std::vector<Vec2> line = around(loop);
  std::vector<Vec2> ring;
  for (std::size_t end : straight_ends(line, tolerance)) ring.push_back(line[end]);
  ring.pop_back();
  return ring;
}

}  // namespace

std::vector<std::vector<Vec2>> trace_raster(const Raster& raster) {
  return RasterTracer(raster).trace();
}

std::vector<Vec2> around(std::vector<Vec2> loop) {
  const auto low = std::min_element(loop.begin(), loop.end(), [](const Vec2& a, const Vec2& b) {
    return a.x() + a.y() < b.x() + b.y();
  });
  std::rotate(loop.begin(), low, loop.end());
  loop.push_back(loop.front());
  return loop;
}

std::vector<std::size_t> straight_ends(const std::vector<Vec2>& points, double tolerance) {
  std::vector<std::size_t> ends = {0};
  bend(points, 0, points.size() - 1, tolerance, ends);
  return ends;
}

std::vector<Ring> outline_rings(const Raster& raster, double tolerance) {
  using Loops = std::vector<std::vector<Vec2>>;
  Loops outer, holes;
  for (std::vector<Vec2>& loop : trace_raster(raster))
    (doubled_area(loop) > 0 ? outer : holes).push_back(std::move(loop));
  // The smallest first: a hole is one in the first that holds it.
  std::stable_sort(outer.begin(), outer.end(),
                   [](const auto& a, const auto& b) { return doubled_area(a) < doubled_area(b); });
  std::vector<Loops> parts;
  for (const auto& loop : outer) parts.push_back({loop});
  for (std::vector<Vec2>& hole : holes) {
    const auto holder = std::find_if(parts.begin(), parts.end(), [&](const Loops& part) {
      return doubled_area(part[0]) > -doubled_area(hole) && is_inside({part[0]}, hole[0]);
    });
    if (holder != parts.end()) holder->push_back(std::move(hole));
  }
  std::vector<Ring> rings;
  for (const Loops& part : parts)
    for (std::size_t k = 0; k < part.size(); ++k) {
      std::vector<Vec2> points = straightened(part[k], tolerance * raster.cell);
      if (points.size() >= 3)
        rings.push_back({std::move(points), k > 0});
      else if (k == 0)
        break;
    }
  return rings;
}

}  // namespace scanworld::surface
