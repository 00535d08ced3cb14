// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "camera_frame.h"

namespace scanworld {

namespace {

// A line fitted to (t, value) pairs by least squares.
struct Line {
  double n = 0, t = 0, v = 0, tt = 0, tv = 0, vv = 0;

  void add(double x, double y) { n += 1, t += x, v += y, tt += x * x, tv += x * y, vv += y * y; }
  double slope() const { return (n * tv - t * v) / (n * tt - t * t); }
  // Share of the values' variance that the line leaves unexplained.
  double unexplained() const {
    return 1 - (n * tv - t * v) * (n * tv - t * v) / ((n * tt - t * t) * (n * vv - v * v));
  }
};

}  // namespace

bool is_camera_image(const PointCloud& cloud, std::uint64_t width) {
  Line across, down;
  std::size_t next = 0, skip = 0;  // the input position after the last point; the next one left out
  for (const Vec3f& point : cloud.points) {
    for (; skip < cloud.skipped.size() && cloud.skipped[skip] == next; ++skip) ++next;
    const std::size_t pixel = next++;
    const Vec3 p = point.cast<double>() + cloud.origin;
    if (p.isZero()) continue;  // some cameras write 0 0 0 where they saw nothing
    if (p.z() <= 0) return false;
    across.add(static_cast<double>(pixel % width), p.x() / p.z());
    down.add(static_cast<double>(pixel / width), p.y() / p.z());
  }
  return across.n > 100 && across.unexplained() < 0.01 && down.unexplained() < 0.01 &&
         across.slope() > 0 && down.slope() > 0;
}

}  // namespace scanworld
