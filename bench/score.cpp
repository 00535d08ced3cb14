// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "score.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <utility>

namespace scanworld::bench {

namespace {

constexpr std::size_t kMinPoints = 100;
constexpr std::size_t kMinSquares = 20;
constexpr double kSquare = 0.05;  // [m]
// The noise of a point moves it along its ray. Where the cosine of incidence is smaller than this,
// where the ray met the plane is not known to a square.
constexpr double kMinFacing = 0.01;

// How many points the planes have, and pairs of a true and a found plane share.
struct Overlaps {
  std::map<std::int32_t, std::size_t> truth, found;
  std::map<std::pair<std::int32_t, std::int32_t>, std::size_t> both;

  double iou(std::int32_t t, std::int32_t f, std::size_t shared) const {
    return static_cast<double>(shared) / static_cast<double>(truth.at(t) + found.at(f) - shared);
  }
};

Overlaps count_overlaps(const std::vector<std::int32_t>& truth,
                        const std::vector<std::int32_t>& found) {
  assert(truth.size() == found.size());
  Overlaps overlaps;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    if (truth[i] >= 0) ++overlaps.truth[truth[i]];
    if (found[i] >= 0) ++overlaps.found[found[i]];
    if (truth[i] >= 0 && found[i] >= 0) ++overlaps.both[{truth[i], found[i]}];
  }
  return overlaps;
}

// The plane of the other side that a plane matches best; of equals the one with the lowest id.
struct Match {
  double iou = 0;
  std::int32_t plane = -1;

  void offer(double other_iou, std::int32_t other) {
    if (other_iou > iou) *this = {other_iou, other};
  }
};

double share(std::size_t part, std::size_t whole) {
  return whole == 0 ? 0 : static_cast<double>(part) / static_cast<double>(whole);
}

double f1(double precision, double recall) {
  return precision + recall > 0 ? 2 * precision * recall / (precision + recall) : 0;
}

std::size_t at_least(double iou, const std::vector<double>& ious) {
  return static_cast<std::size_t>(
      std::count_if(ious.begin(), ious.end(), [&](double x) { return x >= iou; }));
}

// The points of each surface that has some, where their rays met it, as squares in its plane.
std::map<std::int32_t, std::vector<std::pair<std::int64_t, std::int64_t>>> squares_seen(
    const World& world, const VirtualScan& scan) {
  std::map<std::int32_t, Plane> planes;
  for (const Surface& s : world.surfaces) planes[s.id] = s.plane;
  std::map<std::int32_t, std::vector<std::pair<std::int64_t, std::int64_t>>> squares;
  for (std::size_t i = 0; i < scan.surface.size(); ++i) {
    if (scan.surface[i] < 0) continue;
    const Plane& plane = planes.at(scan.surface[i]);
    const Vec3 point = scan.cloud.points[i].cast<double>(),
               ray = (point - scan.cloud.viewpoints[static_cast<std::size_t>(scan.pose[i])])
                         .normalized();
    const double facing = plane.normal.dot(ray);
    if (std::abs(facing) < kMinFacing) continue;
    const Vec2 at =
        frame_of(plane).to_plane(point - ray * (plane.signed_distance(point) / facing)) / kSquare;
    squares[scan.surface[i]].emplace_back(std::floor(at.x()), std::floor(at.y()));
  }
  return squares;
}

}  // namespace

PlaneScore score_planes(const std::vector<std::int32_t>& truth,
                        const std::vector<std::int32_t>& found,
                        const std::set<std::int32_t>& counted) {
  const Overlaps overlaps = count_overlaps(truth, found);
  std::map<std::int32_t, Match> best_of_true, best_of_found;
  for (const auto& [pair, shared] : overlaps.both) {
    const auto [t, f] = pair;
    const double iou = overlaps.iou(t, f, shared);
    best_of_true[t].offer(iou, f);
    best_of_found[f].offer(iou, t);
  }
  std::vector<double> true_ious, found_ious;  // of the planes that count
  for (std::int32_t t : counted) true_ious.push_back(best_of_true[t].iou);
  for (const auto& [f, points] : overlaps.found) {
    const Match& match = best_of_found[f];
    if (match.iou < 0.5 || counted.count(match.plane)) found_ious.push_back(match.iou);
  }
  const auto precision = [&](double iou) {
    return share(at_least(iou, found_ious), found_ious.size());
  };
  const auto recall = [&](double iou) { return share(at_least(iou, true_ious), true_ious.size()); };
  double sum = 0;
  for (double iou : true_ious) sum += iou;
  return {.asked_for = counted.size(),
          .found = overlaps.found.size(),
          .precision = precision(0.5),
          .recall = recall(0.5),
          .f1_50 = f1(precision(0.5), recall(0.5)),
          .f1_75 = f1(precision(0.75), recall(0.75)),
          .mean_iou = counted.empty() ? 0 : sum / static_cast<double>(counted.size())};
}

std::set<std::int32_t> planes_asked_for(const World& world, const VirtualScan& scan) {
  std::map<std::int32_t, std::size_t> points;
  for (std::int32_t id : scan.surface)
    if (id >= 0) ++points[id];
  std::set<std::int32_t> asked_for;
  for (auto& [id, squares] : squares_seen(world, scan)) {
    std::sort(squares.begin(), squares.end());
    const auto end = std::unique(squares.begin(), squares.end());
    if (points[id] >= kMinPoints && static_cast<std::size_t>(end - squares.begin()) >= kMinSquares)
      asked_for.insert(id);
  }
  return asked_for;
}

}  // namespace scanworld::bench
