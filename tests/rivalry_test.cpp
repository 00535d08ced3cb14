// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/rivalry.h"

#include "parallel.h"
#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// A floor and a wall that meet in the y axis: sites of the floor 0, of the wall 1.
Stages edge_stages(int strays = 0) {
  PointCloud cloud;
  Random random(1);
  add_rectangle(cloud, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.02, kNoise, random);
  add_rectangle(cloud, {0, 0, 0}, {0, 2, 0}, {0, 0, 2}, 0.02, kNoise, random);
  for (int i = 0; i < strays; ++i)
    cloud.points.push_back(
        Vec3(random.uniform(0.06, 2), random.uniform(0, 2), random.uniform(0.06, 0.3))
            .cast<float>());
  return run_stages(std::move(cloud), known_scale(kNoise, 0.02));
}

std::int32_t right_label(const Vec3& p) { return p.x() < p.z() ? 1 : 0; }

// The two clusters with the planes of their own points, whatever sites `label_of` gives them.
Clustering start_with(const Stages& s, const std::function<std::int32_t(const Vec3&)>& label_of) {
  Clustering c = label_sites(
      s.grid, [](const Vec3& p) { return std::min(p.x(), p.z()) < 0.03 ? right_label(p) : kNone; });
  for (rival::Cluster& k : c.clusters) k.moments = {};
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    c.label[i] = label_of(s.grid.sites[i].position());
    if (c.label[i] != kNone)
      c.clusters[static_cast<std::size_t>(c.label[i])].moments += s.grid.sites[i].moments();
  }
  return c;
}

Clustering run_rivalry(const Stages& s, Clustering c, const RivalryOptions& options = {}) {
  return compete(s.grid, s.neighbors, s.scale, s.local, std::move(c), options);
}

}  // namespace

TEST_CASE("sites that are in the wrong cluster go to the one whose plane explains them") {
  const Stages s = edge_stages();
  Random random(2);
  for (int wrong_share : {5, 3}) {
    const Clustering start = start_with(s, [&](const Vec3& p) {
      const std::int32_t right = right_label(p);
      return random.whole(1, wrong_share) == 1 ? 1 - right : right;
    });
    const Clustering c = run_rivalry(s, start, {.max_sweeps = 30, .stop_share = 0});
    check_clustering(s.grid, c);
    REQUIRE(c.clusters.size() == 2);
    for (std::size_t i = 0; i < c.label.size(); ++i)
      if (const Vec3 p = s.grid.sites[i].position(); std::max(p.x(), p.z()) > 0.1)
        CHECK(c.label[i] == right_label(p));
    CHECK(std::abs(c.plane(0).normal.z()) > 0.9999);
    CHECK(std::abs(c.plane(1).normal.x()) > 0.9999);
  }
}

TEST_CASE("points that no plane explains are in no cluster, wherever they were before") {
  const Stages s = edge_stages(1500);
  const Clustering c = run_rivalry(s, start_with(s, right_label));
  check_clustering(s.grid, c);
  std::size_t strays = 0, left = 0;
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    const Vec3 p = s.grid.sites[i].position();
    if (std::min(p.x(), p.z()) > 0.05) ++strays, left += c.label[i] == kNone;
    if (std::min(p.x(), p.z()) < kNoise && std::max(p.x(), p.z()) > 0.1)
      CHECK(c.label[i] == right_label(p));
  }
  CHECK(strays > 500);
  CHECK(left == strays);
}

TEST_CASE("clusters spread over free sites that they explain, a layer a sweep") {
  const Stages s = edge_stages();
  const Clustering start = label_sites(s.grid, [](const Vec3& p) {
    return p.x() > 1.5 && p.z() < 0.05 ? 0 : p.z() > 1.5 ? 1 : kNone;
  });
  std::size_t last = 0;
  for (int sweeps : {0, 1, 4, 60}) {
    const Clustering c = run_rivalry(s, start, {.max_sweeps = sweeps, .stop_share = 0});
    check_clustering(s.grid, c);
    const std::size_t labelled = site_counts(c)[0] + site_counts(c)[1];
    CHECK(labelled > last);
    last = labelled;
  }
  CHECK(static_cast<double>(last) > 0.99 * static_cast<double>(s.grid.sites.size()));
}

TEST_CASE("what has settled stays as it is, and all are asleep") {
  const Stages s = edge_stages(300);
  const Clustering once =
      run_rivalry(s, label_sites(s.grid, right_label), {.max_sweeps = 100, .stop_share = 0});
  const Clustering again = run_rivalry(s, once);
  CHECK(again.label == once.label);
  CHECK(std::count(once.awake.begin(), once.awake.end(), 0) ==
        static_cast<std::ptrdiff_t>(s.grid.sites.size()));
  for (std::size_t i = 0; i < once.label.size(); ++i) {
    bool others = false;
    for (std::uint32_t j : s.neighbors.of(i))
      others |= once.label[j] != kNone && once.label[j] != once.label[i];
    if (others) CHECK(once.border[i]);
  }
}

TEST_CASE("sites that are asleep do not change") {
  const Stages s = edge_stages();
  Clustering start = label_sites(s.grid, [](const Vec3& p) { return p.y() < 1 ? 0 : 1; });
  std::fill(start.awake.begin(), start.awake.end(), 0);
  CHECK(run_rivalry(s, start).label == start.label);
}

TEST_CASE("the number of threads does not matter to rivalry") {
  const Stages s = run_stages(room_points({4, 3, 2.5}, 0.03, 0.01));
  REQUIRE(s.grid.sites.size() > 3 * 4096);
  const Clustering before = run_rivalry(s, s.grow());
  for (int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    const Clustering c = run_rivalry(s, s.grow());
    CHECK(c.label == before.label);
    for (std::size_t k = 0; k < c.clusters.size(); ++k)
      CHECK(c.clusters[k].fit.plane == before.clusters[k].fit.plane);
  }
}

TEST_CASE("of two clusters in one plane, a site goes to the one that is around it") {
  const Stages s = edge_stages();
  Random random(4);
  const auto half = [](const Vec3& p) { return p.y() < 1 ? 0 : 1; };
  Clustering start = label_sites(s.grid, [&](const Vec3& p) {
    return p.x() < 0.1 ? kNone : random.whole(1, 20) == 1 ? 1 - half(p) : half(p);
  });
  const auto count_wrong = [&](double smoothness) {
    const Clustering c =
        run_rivalry(s, start, {.max_sweeps = 30, .stop_share = 0, .smoothness = smoothness});
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < c.label.size(); ++i) {
      const Vec3 p = s.grid.sites[i].position();
      if (p.x() > 0.2 && std::abs(p.y() - 1) > 0.2)
        wrong += c.label[i] != kNone && c.label[i] != half(p);
    }
    return wrong;
  };
  CHECK(count_wrong(4) == 0);
  CHECK(count_wrong(0) > 20);
}

TEST_CASE("a site does not go to a plane at an angle to its neighbourhood, though it is nearer") {
  PointCloud cloud;
  Random random(5);
  add_rectangle(cloud, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.02, 0.002, random);
  const double noise = 0.02;
  const Stages s = run_stages(std::move(cloud), known_scale(noise, 0.02));
  Clustering start = label_sites(s.grid, [](const Vec3& p) { return p.y() < 1 ? 0 : 1; });
  // The first plane a little off, the second through the line between them.
  start.clusters[0].fit.plane = {Vec3::UnitZ(), -1.2 * noise};
  start.clusters[1].fit.plane = plane_through({0, 1, 0}, Vec3(0, -1, 1).normalized());
  for (double price : {0.0, 2.0}) {
    const Clustering c =
        run_rivalry(s, start, {.max_sweeps = 1, .smoothness = 0, .wrong_normal = price});
    std::size_t between = 0;
    for (std::size_t i = 0; i < c.label.size(); ++i)
      if (std::abs(s.grid.sites[i].position().y() - 1) < 0.02 && s.grid.sites[i].points > 4) {
        CHECK(c.label[i] == (price > 0 ? 0 : 1));
        ++between;
      }
    CHECK(between > 10);
  }
}
