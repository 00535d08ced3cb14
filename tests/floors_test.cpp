// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/floors.h"

#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

constexpr double kFloorNoise = 0.004, kFloorSpacing = 0.02;

// A floor from `low` to `high` with these heights.
void add_floor(PointCloud& cloud, const Vec2& low, const Vec2& high,
               const std::function<double(double, double)>& height, std::uint64_t seed = 1) {
  Random random(seed);
  PointCloud flat;
  add_rectangle(flat, {low.x(), low.y(), 0}, {high.x() - low.x(), 0, 0}, {0, high.y() - low.y(), 0},
                kFloorSpacing, kFloorNoise, random);
  for (Vec3f p : flat.points) {
    p.z() += static_cast<float>(height(p.x(), p.y()));
    cloud.points.push_back(p);
  }
}

std::function<double(double, double)> at(double height) {
  return [=](double, double) { return height; };
}

struct Floor {
  Stages stages;
  Clustering clusters;

  Floor(PointCloud cloud, const std::function<std::int32_t(const Vec3&)>& label_of)
      : stages(run_stages(std::move(cloud), known_scale(kFloorNoise, kFloorSpacing))),
        clusters(label_sites(stages.grid, label_of)) {
    stages.scale.flatness = {.max_bend = 0.02, .max_sag = 0.002};
  }
  Clustering joined() const {
    const Clustering c = join_floors(stages.grid, stages.scale, clusters, Vec3::UnitZ());
    check_clustering(stages.grid, c);
    return c;
  }
  Clustering folded() const {
    return fold_floors(stages.grid, stages.scale, clusters, Vec3::UnitZ());
  }
};

double height_at(const Plane& plane, double x, double y) {
  return -(plane.offset + plane.normal.x() * x + plane.normal.y() * y) / plane.normal.z();
}

}  // namespace

TEST_CASE("what a floor shows twice at one place is one floor") {
  for (const double offset : {-0.03, 0.02, 0.04}) {
    CAPTURE(offset);
    PointCloud cloud;
    add_floor(cloud, {0, 0}, {4, 4}, at(0));
    add_floor(cloud, {1, 1}, {2.5, 2.5}, at(offset), 2);
    const Floor floor(std::move(cloud), [&](const Vec3& p) {
      const bool is_there = p.x() > 1 && p.x() < 2.5 && p.y() > 1 && p.y() < 2.5;
      return is_there && std::abs(p.z() - offset) < std::abs(p.z()) ? 1 : 0;
    });
    CHECK(floor.joined().clusters.size() == 1);
  }
}

TEST_CASE("a floor that bows is one surface, though its pieces are off each other's planes") {
  PointCloud cloud;
  add_floor(cloud, {0, 0}, {6, 4}, [](double x, double) { return -0.0012 * x * x; });
  const Floor floor(std::move(cloud), [](const Vec3& p) { return p.x() < 4 ? 0 : 1; });
  CHECK(floor.joined().clusters.size() == 1);
}

TEST_CASE(
    "a gap in a floor parts it only where a wall stands in it or its sides are on two levels") {
  const auto floors = [](double step, bool has_wall) {
    PointCloud cloud;
    add_floor(cloud, {0, 0}, {3, 3}, at(0));
    add_floor(cloud, {3.12, 0}, {6, 3}, at(step), 2);
    Random random(3);
    if (has_wall)
      for (const double x : {3.0, 3.12})
        add_rectangle(cloud, {x, 0, 0}, {0, 3, 0}, {0, 0, 2.5}, kFloorSpacing, kFloorNoise, random);
    return Floor(std::move(cloud),
                 [](const Vec3& p) {
                   return p.z() > 0.05 ? (p.x() < 3.06 ? 2 : 3) : p.x() < 3.06 ? 0 : 1;
                 })
        .joined()
        .clusters.size();
  };
  CHECK(floors(0, false) == 1);
  CHECK(floors(0.008, false) == 1);
  CHECK(floors(0.02, false) == 2);
  CHECK(floors(0, true) == 4);
}

TEST_CASE("a threshold of a centimetre and a half and a step of two stay") {
  PointCloud cloud;
  add_floor(cloud, {0, 0}, {3, 3}, at(0));
  add_floor(cloud, {3.15, 0}, {6, 3}, at(0), 2);
  add_floor(cloud, {3, 0}, {3.15, 3}, at(0.015), 3);
  const Floor threshold(std::move(cloud), [](const Vec3& p) {
    return p.x() < 3 ? 0 : p.x() > 3.15 ? 1 : 2;
  });
  std::size_t raised = 0;
  for (const rival::Cluster& c : threshold.joined().clusters)
    raised += c.fit.centroid.z() > 0.012 && area_of(c.fit) < 1;
  CHECK(raised == 1);

  PointCloud steps;
  add_floor(steps, {0, 0}, {3, 3}, at(0));
  add_floor(steps, {3, 0}, {6, 3}, at(0.02), 2);
  const Floor two(std::move(steps), [](const Vec3& p) { return p.x() < 3 ? 0 : 1; });
  CHECK(two.joined().clusters.size() == 2);
}

TEST_CASE("table tops side by side stay two") {
  PointCloud cloud;
  add_floor(cloud, {0, 0}, {4, 4}, at(0));
  add_floor(cloud, {1, 1}, {2, 1.8}, at(0.75), 2);
  add_floor(cloud, {2.02, 1}, {3, 1.8}, at(0.755), 3);
  const Floor floor(std::move(cloud), [](const Vec3& p) {
    return p.z() < 0.4 ? 0 : p.x() < 2.01 ? 1 : 2;
  });
  CHECK(floor.joined().clusters.size() == 3);
}

TEST_CASE("facets of a floor meet in a line, each on its own side of it") {
  PointCloud cloud;
  add_floor(cloud, {0, 0}, {6, 4}, [](double x, double) { return x < 4 ? 0 : -0.03 * (x - 4); });
  // Noise lets the larger one have some of the lesser's, and its plane is off.
  Floor floor(std::move(cloud), [](const Vec3& p) { return p.x() < 4.25 ? 0 : 1; });
  const Clustering c = floor.folded();
  REQUIRE(c.clusters.size() == 2);
  const auto step = [&](double x) {
    return height_at(c.plane(1), x, 2) - height_at(c.plane(0), x, 2);
  };
  CHECK(std::abs(step(4.25)) < 0.004);
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    const Vec3 p = floor.stages.grid.sites[i].position();
    const double over = height_at(c.plane(1), p.x(), p.y()) - height_at(c.plane(0), p.x(), p.y());
    if (std::abs(p.x() - 4.25) < 0.5 && std::abs(over) > 0.001)
      CHECK((c.label[i] == 1) == (over < 0));
  }
}
