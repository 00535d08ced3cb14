// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/rays.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "cell_walk.h"
#include "support/space.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

bool is_same_ray(const space::Ray& a, const space::Ray& b) {
  return a.from == b.from && a.to == b.to && a.own == b.own && a.weight == b.weight &&
         a.from_viewpoint == b.from_viewpoint;
}

double weight_of(const std::vector<space::Ray>& rays) {
  return std::accumulate(rays.begin(), rays.end(), 0.0,
                         [](double sum, const space::Ray& r) { return sum + r.weight; });
}

// The same places in another order.
surface::Surroundings reordered(const surface::Surroundings& around, std::uint64_t seed) {
  std::vector<std::size_t> order(around.points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(seed);
  shuffle(order, random);
  surface::Surroundings other = around;
  for (std::size_t i = 0; i < order.size(); ++i) {
    other.points[i] = around.points[order[i]], other.planes[i] = around.planes[order[i]];
    other.viewers[i] = around.viewers[order[i]];
  }
  return other;
}

struct RayInput {
  SpaceStages stages;
  surface::PatchRays patches;

  explicit RayInput(const LabelledScan& scan) : stages(run_space(scan)), patches(scan.patches()) {}
  std::vector<space::Ray> find(double noise = 0.003, const space::RayOptions& options = {}) const {
    return find(stages.around, noise, options);
  }
  std::vector<space::Ray> find(const surface::Surroundings& around, double noise = 0.003,
                               const space::RayOptions& options = {}) const {
    return space::find_rays(around, around.viewers, stages.outlook.covers, patches, noise, options);
  }
};

// Loose places seen from the origin.
std::vector<space::Ray> rays_to(const std::vector<Vec3>& places) {
  surface::Surroundings around = surface::surroundings_of(
      cloud_of(places).points, std::vector<std::int32_t>(places.size(), -1));
  around.viewpoints = {Vec3::Zero()};
  const std::vector<std::int32_t> viewers(places.size(), 0);
  return space::find_rays(around, viewers, {}, surface::PatchRays(std::vector<surface::Patch>{}),
                          0);
}

}  // namespace

TEST_CASE("rays do not hang on the order of the points") {
  const RayInput in(seen_from(table_room_sides(), {kScanner, {3.6, 1.4, 0.4}}));
  const std::vector<space::Ray> rays = in.find();
  CHECK(rays.size() > 3000);
  for (const std::uint64_t seed : {1, 2}) {
    const std::vector<space::Ray> again = in.find(reordered(in.stages.around, seed));
    CHECK(std::equal(rays.begin(), rays.end(), again.begin(), again.end(), is_same_ray));
  }
}

TEST_CASE("rays end before the plane that was seen, by four times the noise at least") {
  const RayInput in(seen_from(room_sides(), {kScanner}));
  for (const double noise : {0.003, 0.05}) {
    const double before = std::max(0.08, 4 * noise);
    std::size_t count = 0;
    for (const space::Ray& ray : in.find(noise)) {
      CHECK(ray.from == kScanner);
      CHECK(ray.from_viewpoint);
      REQUIRE(ray.own >= 0);
      const Plane& plane = in.stages.patches[static_cast<std::size_t>(ray.own)].plane;
      // Within the points' own noise.
      CHECK(plane.signed_distance(ray.to) ==
            doctest::Approx(before).scale(0).epsilon(0.02 / before));
      ++count;
    }
    CHECK(count > 3000);
  }
}

TEST_CASE("rays to loose places end before them, and none goes to what is too near") {
  const std::vector<space::Ray> rays = rays_to({{0.29, 0, 0}, {0, 2, 0}, {0, 0, -0.31}});
  REQUIRE(rays.size() == 2);
  for (const space::Ray& ray : rays) {
    CHECK(ray.own == -1);
    CHECK(ray.weight == doctest::Approx(0.09 * 0.09));
    CHECK(ray.to.norm() == doctest::Approx(ray.to.y() > 0 ? 1.92 : 0.23));
  }
}

TEST_CASE("places of one cube share a ray, and those that nobody is known to have seen have none") {
  CHECK(rays_to({{1.0, 1, 1}, {1.01, 1, 1}, {1.02, 1.01, 1}}).size() == 1);
  CHECK(rays_to({{1.0, 1, 1}, {1.2, 1, 1}}).size() == 2);
  RayInput in(seen_from(room_sides(), {kScanner}));
  std::fill(in.stages.around.viewers.begin(), in.stages.around.viewers.end(), -1);
  CHECK(in.find().empty());
}

TEST_CASE("no more rays than asked for weigh as much as all of them") {
  const RayInput in(seen_from(room_sides(), {kScanner}));
  const std::vector<space::Ray> all = in.find(), some = in.find(0.003, {.most = all.size() / 3});
  CHECK(static_cast<double>(some.size()) ==
        doctest::Approx(static_cast<double>(all.size()) / 3).epsilon(0.1));
  CHECK(weight_of(some) == doctest::Approx(weight_of(all)).epsilon(0.1));
}

TEST_CASE("where no viewpoint is known rays go between patches that face each other") {
  LabelledScan scan;
  for (const RoomSide& side : room_sides()) scan.add(side.corner, side.a, side.b);
  const RayInput in(scan);
  const std::vector<space::Ray> rays = in.find();
  const Box3 room(Vec3::Zero(), kRoomSize);
  double area = 0;
  for (const space::Cover& cover : in.stages.outlook.covers) area += cover.area;
  std::size_t long_ones = 0;
  for (const space::Ray& ray : rays) {
    CHECK_FALSE(ray.from_viewpoint);
    CHECK(grown(room, 0.02).contains(ray.to));
    const Plane& own = in.stages.patches[static_cast<std::size_t>(ray.own)].plane;
    CHECK(own.signed_distance(ray.from) == doctest::Approx(0.01));
    CHECK(own.signed_distance(ray.to) > 0);
    long_ones += (ray.to - ray.from).norm() > 0.5;
  }
  CHECK(2 * long_ones > rays.size());
  CHECK(weight_of(rays) == doctest::Approx(0.5 * area).epsilon(0.1));
}

TEST_CASE("rays between patches do not go to one that looks away") {
  LabelledScan scan;
  scan.add({0, 0, 0}, {3, 0, 0}, {0, 3, 0});
  scan.add({0, 0, 1}, {3, 0, 0}, {0, 3, 0});
  std::vector<surface::Patch> patches = scan.patches();
  for (surface::Patch& p : patches)
    if (p.plane.normal.z() < 0) p = surface::flipped(p);  // both look up
  const surface::PatchRays cast(patches);
  const surface::Surroundings around = surface::surroundings_of(scan.cloud.points, scan.labels);
  const space::Sight sight(around, std::vector<std::int32_t>(around.points.size(), -1), 0.02);
  const std::vector<space::Ray> rays =
      space::find_rays(around, {}, space::find_covers(patches, {}, sight), cast, 0.003);
  CHECK_FALSE(rays.empty());
  for (const space::Ray& ray : rays) CHECK((ray.to - ray.from).norm() < 0.11);
}

TEST_CASE("the cells that a ray crosses are those of its places, but for the last one") {
  Random random(4);
  for (int turn = 0; turn < 50; ++turn) {
    const Vec3 from = 3 * random.direction(), to = 3 * random.direction();
    const double cell = 0.1;
    const std::vector<std::uint64_t> crossed =
        space::crossed_by({{.from = from, .to = to}}, cell).codes();
    const std::set<std::uint64_t> those(crossed.begin(), crossed.end());
    CHECK_FALSE(those.contains(morton_of(cell_of(to, cell))));
    CHECK(those.contains(morton_of(cell_of(from, cell))));
    // It goes to the middle of the last cell, so it is off the line by half a cell at most.
    std::size_t off = 0;
    for (const std::uint64_t code : crossed) {
      const Vec3 middle = (cell_at(code).cast<double>().array() + 0.5) * cell, way = to - from;
      const double t = std::clamp((middle - from).dot(way) / way.squaredNorm(), 0.0, 1.0);
      off += (from + t * way - middle).norm() > 1.8 * cell;
    }
    CHECK(off == 0);
    CHECK(static_cast<double>(crossed.size()) >= (to - from).lpNorm<Eigen::Infinity>() / cell - 1);
  }
}
