// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "split_clutter.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "../polygon.h"
#include "hull_volume.h"
#include "solids.h"
#include "support_points.h"

namespace scanworld {

namespace {

constexpr int kDirections = 24, kSlices = 6, kTilts = 13;

// Points with so much around them.
std::vector<Vec3> corners_around(const std::vector<Vec3>& directions, const SupportPoints& support,
                                 double margin) {
  std::vector<Vec3> corners;
  for (std::size_t k = 0; k < directions.size(); ++k)
    corners.push_back(support.points[k] + margin * directions[k]);
  return corners;
}

double volume_around(const std::vector<Vec3>& directions, const SupportPoints& support,
                     double margin) {
  return hull_volume(corners_around(directions, support, margin));
}

struct Cut {
  Plane plane;
  double left = 0;  // [m3] of the two hulls together
};

// The axes across which a thing may be cut: upwards, and those of its plan.
std::array<Vec3, 3> axes_of(const std::vector<Vec3>& points, const Vec3& up) {
  const PlaneFrame frame = frame_of({up, 0});
  std::vector<Vec2> plan;
  for (const Vec3& p : points) plan.push_back(frame.to_plane(p));
  const double angle = principal_angle(plan);
  const Vec3 along = std::cos(angle) * frame.u + std::sin(angle) * frame.v;
  return {up, along, up.cross(along)};
}

// The point that lies deepest in a hull.
Vec3 deepest(const std::vector<Vec3>& points, const Mesh& hull) {
  std::vector<Plane> faces;
  for (const auto& t : hull.triangles) {
    const auto at = [&](std::size_t k) -> const Vec3& {
      return hull.vertices[static_cast<std::size_t>(t[k])];
    };
    const Vec3 normal = (at(1) - at(0)).cross(at(2) - at(0));
    if (normal.norm() > 1e-12) faces.push_back(plane_through(at(0), normal.normalized()));
  }
  Vec3 best = points[0];
  double most = -1e300;
  for (const Vec3& p : points) {
    double depth = 1e300;
    for (const Plane& face : faces) {
      depth = std::min(depth, -face.signed_distance(p));
      if (depth <= most) break;
    }
    if (depth > most) most = depth, best = p;
  }
  return best;
}

// The best of the cuts through a point.
Cut best_cut_through(const std::vector<Vec3>& points, const Vec3& notch,
                     const std::vector<Vec3>& directions, double thickness) {
  Cut best{.plane = {}, .left = 1e300};
  std::vector<Vec3> tilts = even_directions(2 * kTilts);
  tilts.resize(kTilts);  // the others are nearly their opposites
  for (const Vec3& tilt : tilts) {
    const Plane plane = plane_through(notch, tilt);
    SupportPoints low, high;
    for (const Vec3& p : points) (plane.signed_distance(p) < 0 ? low : high).add(directions, p);
    if (low.height.empty() || high.height.empty()) continue;
    const double left = volume_around(directions, low, thickness / 2) +
                        volume_around(directions, high, thickness / 2);
    if (left < best.left) best = {plane, left};
  }
  return best;
}

// The best of the cuts across one axis.
Cut best_cut(const std::vector<Vec3>& points, const Vec3& axis, const std::vector<Vec3>& directions,
             double thickness) {
  double low = 1e300, high = -1e300;
  for (const Vec3& p : points) low = std::min(low, axis.dot(p)), high = std::max(high, axis.dot(p));
  Cut best{.plane = {}, .left = 1e300};
  const int slices = std::min(kSlices, static_cast<int>((high - low) / thickness));
  if (slices < 2) return best;
  std::vector<SupportPoints> below(static_cast<std::size_t>(slices)), above;
  const double step = (high - low) / slices;
  for (const Vec3& p : points) {
    const int slice = std::min(slices - 1, static_cast<int>((axis.dot(p) - low) / step));
    below[static_cast<std::size_t>(slice)].add(directions, p);
  }
  above = below;
  for (std::size_t k = 1; k < below.size(); ++k) below[k].add(below[k - 1]);
  for (std::size_t k = above.size() - 1; k > 0; --k) above[k - 1].add(above[k]);
  for (std::size_t k = 1; k < below.size(); ++k) {
    const double left = volume_around(directions, below[k - 1], thickness / 2) +
                        volume_around(directions, above[k], thickness / 2);
    if (left < best.left) best = {{axis, -(low + static_cast<double>(k) * step)}, left};
  }
  return best;
}

// A part of a thing, and the cut that would leave most free.
struct PartOfThing {
  std::vector<Vec3> points;
  std::optional<Plane> cut;
  double gain = 0;  // [m3]
};

PartOfThing look_at(std::vector<Vec3> points, const Vec3& up, double thickness,
                    const std::vector<Vec3>& directions, const IsSimple& is_simple,
                    const SplitClutterOptions& options) {
  PartOfThing part{std::move(points)};
  SupportPoints all;
  for (const Vec3& p : part.points) all.add(directions, p);
  const std::vector<Vec3> corners = corners_around(directions, all, thickness / 2);
  const double whole = hull_volume(corners);
  const double least = std::max(options.min_volume, options.min_gain * whole);
  if (whole <= least) return part;
  const Vec3 notch = deepest(part.points, mesh_of(ConvexHull{corners}));
  Cut best = best_cut_through(part.points, notch, directions, thickness);
  for (const Vec3& axis : axes_of(part.points, up))
    if (const Cut cut = best_cut(part.points, axis, directions, thickness); cut.left < best.left)
      best = cut;
  if (whole - best.left > least && !is_simple(part.points))
    part.cut = best.plane, part.gain = whole - best.left;
  return part;
}

}  // namespace

std::vector<std::vector<Vec3>> split_clutter(std::vector<Vec3> points, const Vec3& up,
                                             double thickness, const IsSimple& is_simple,
                                             const SplitClutterOptions& options) {
  const std::vector<Vec3> directions = even_directions(kDirections);
  const auto look = [&](std::vector<Vec3> some) {
    return look_at(std::move(some), up, thickness, directions, is_simple, options);
  };
  std::vector<PartOfThing> parts;
  parts.push_back(look(std::move(points)));
  while (parts.size() < static_cast<std::size_t>(options.max_parts)) {
    const auto best = std::max_element(
        parts.begin(), parts.end(),
        [](const PartOfThing& a, const PartOfThing& b) { return a.gain < b.gain; });
    if (!best->cut) break;
    std::vector<Vec3> low, high;
    for (const Vec3& p : best->points)
      (best->cut->signed_distance(p) < 0 ? low : high).push_back(p);
    *best = look(std::move(low));
    parts.push_back(look(std::move(high)));
  }
  std::vector<std::vector<Vec3>> result;
  for (PartOfThing& part : parts) result.push_back(std::move(part.points));
  return result;
}

}  // namespace scanworld
