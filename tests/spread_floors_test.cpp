// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/spread_floors.h"

#include <set>

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

LabelledPoints label(const Stages& s, const rival::LabelOptions& options = {}) {
  return label_points(s.cloud, s.grid, s.neighbors, s.scale, s.confirm(), options);
}

LabelledPoints spread(const Stages& s, const LabelledPoints& before) {
  return spread_floors(s.cloud, s.grid, s.neighbors, before, Vec3::UnitZ(), 0.02);
}

// The planes of points of a room's floor that a test picks, off the walls.
template <typename Pick>
std::set<int> planes_of(const Stages& s, const LabelledPoints& labelled, const Pick& pick) {
  std::set<int> planes;
  for (std::size_t i = 0; i < s.cloud.points.size(); ++i) {
    const Vec3f& p = s.cloud.points[i];
    if (std::abs(p.z()) < 0.05F && p.y() > 0.2F && p.y() < 2.8F && pick(p))
      planes.insert(labelled.labels[i]);
  }
  planes.erase(kNone);
  return planes;
}

// A room of 4 m x 3 m; its floor is higher where `is_raised`.
template <typename IsRaised>
Stages room_with(double raise, const IsRaised& is_raised) {
  PointCloud cloud = room_points({4, 3, 2.5}, 0.03, 0.002);
  for (Vec3f& p : cloud.points)
    if (std::abs(p.z()) < 0.01F && is_raised(p)) p.z() += static_cast<float>(raise);
  return run_stages(std::move(cloud));
}

}  // namespace

TEST_CASE("what lies on a floor becomes that floor, what is higher or on a wall does not") {
  PointCloud cloud = room_points({4, 3, 2.5}, 0.03, 0.002);
  std::vector<std::size_t> on_rug, on_box, on_panel;
  for (std::size_t i = 0; i < cloud.points.size(); ++i) {
    Vec3f& p = cloud.points[i];
    const bool is_low = std::abs(p.z())<0.01f, is_inner = p.y()> 1 && p.y() < 2;
    if (is_low && is_inner && p.x() > 1 && p.x() < 1.6f) p.z() += 0.012f, on_rug.push_back(i);
    if (is_low && is_inner && p.x() > 2.5f && p.x() < 3) p.z() += 0.06f, on_box.push_back(i);
    if (std::abs(p.x()) < 0.01f && is_inner && p.z() > 1 && p.z() < 1.5f)
      p.x() += 0.015f, on_panel.push_back(i);
  }
  const Stages s = run_stages(std::move(cloud));
  const LabelledPoints before = label(s, {.min_points = 1500});
  const LabelledPoints after = spread(s, before);
  const auto count = [&](const std::vector<std::size_t>& points) {
    return std::count_if(points.begin(), points.end(), [&](std::size_t i) {
      const std::int32_t l = after.labels[i];
      return l != kNone &&
             after.planes[static_cast<std::size_t>(l)].fit.plane.normal.cwiseAbs().z() > 0.99;
    });
  };
  CHECK(count(on_rug) > 0.98 * static_cast<double>(on_rug.size()));
  CHECK(count(on_box) == 0);
  CHECK(count(on_panel) == 0);
  for (std::size_t i = 0; i < after.labels.size(); ++i)
    if (before.labels[i] != kNone) CHECK(after.labels[i] == before.labels[i]);
}

TEST_CASE("a carpet with a plane of its own becomes the floor around it") {
  const auto on_carpet = [](const Vec3f& p) {
    return p.x() > 1 && p.x() < 2.4F && p.y() > 0.8F && p.y() < 2.2F;
  };
  const auto in_carpet = [](const Vec3f& p) {
    return p.x() > 1.1F && p.x() < 2.3F && p.y() > 0.9F && p.y() < 2.1F;
  };
  const auto beside = [](const Vec3f& p) { return p.x() > 2.6F && p.x() < 3.8F; };
  for (const double height : {0.015, 0.04}) {
    const Stages s = room_with(height, on_carpet);
    const LabelledPoints before = label(s), after = spread(s, before);
    REQUIRE(planes_of(s, before, in_carpet).size() == 1);
    CHECK(planes_of(s, before, in_carpet) != planes_of(s, before, beside));
    CHECK(planes_of(s, after, beside) == planes_of(s, before, beside));
    CHECK((planes_of(s, after, in_carpet) == planes_of(s, after, beside)) == (height < 0.02));
  }
}

TEST_CASE("two floors that meet in a low step stay two") {
  const auto is_left = [](const Vec3f& p) { return p.x() < 1.5F; };
  const Stages s = room_with(0.015, is_left);
  const LabelledPoints before = label(s);
  REQUIRE(planes_of(s, before, [](const Vec3f& p) {
            return p.x() > 0.1F && p.x() < 1.4F;
          }).size() == 1);
  const LabelledPoints after = spread(s, before);
  for (std::size_t i = 0; i < after.labels.size(); ++i)
    if (before.labels[i] != kNone) CHECK(after.labels[i] == before.labels[i]);
}
