// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival/merge.h"

#include <map>

#include "rival/contacts.h"
#include "support/stages.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::rival;

namespace {

// Two halves of a floor: the second turned by `angle` about the edge in common and raised by
// `step`.
Stages two_halves(double angle, double step, double noise) {
  PointCloud cloud;
  Random random(1);
  add_rectangle(cloud, {-1.5, 0, 0}, {1.5, 0, 0}, {0, 2, 0}, 0.02, noise, random);
  add_rectangle(cloud, {0, 0, step}, {1.5 * std::cos(angle), 0, 1.5 * std::sin(angle)}, {0, 2, 0},
                0.02, noise, random);
  return run_stages(std::move(cloud), known_scale(noise, 0.02));
}

Clustering merge_halves(const Stages& s) {
  const Clustering c =
      merge_clusters(s.grid, s.neighbors, s.scale,
                     label_sites(s.grid, [](const Vec3& p) { return p.x() < 0 ? 0 : 1; }));
  check_clustering(s.grid, c);
  return c;
}

}  // namespace

TEST_CASE("neighbouring pieces of one plane are united") {
  for (double noise : {0.002, 0.01, 0.02}) {
    const Stages s = two_halves(0, 0, noise);
    const Clustering c = merge_halves(s);
    CHECK(c.clusters.size() == 1);
    CHECK(site_counts(c)[0] == s.grid.sites.size());
  }
  // Many pieces too, and across rows of them.
  const Stages s = two_halves(0, 0, 0.005);
  const Clustering c =
      merge_clusters(s.grid, s.neighbors, s.scale, label_sites(s.grid, [](const Vec3& p) {
                       return static_cast<std::int32_t>((p.x() + 1.6) / 0.4) +
                              8 * static_cast<std::int32_t>((p.y() + 0.1) / 0.4);
                     }));
  CHECK(c.clusters.size() == 1);
}

TEST_CASE("pieces at an angle or on two levels stay two") {
  CHECK(merge_halves(two_halves(0.2, 0, 0.005)).clusters.size() == 2);
  CHECK(merge_halves(two_halves(1.57, 0, 0.005)).clusters.size() == 2);
  CHECK(merge_halves(two_halves(0, 0.03, 0.005)).clusters.size() == 2);
  // A step of two noises is certain where so many points tell its height, and one of less than a
  // centimetre is none for a robot.
  CHECK(merge_halves(two_halves(0, 0.03, 0.015)).clusters.size() == 2);
  CHECK(merge_halves(two_halves(0, 0.006, 0.005)).clusters.size() == 1);
}

TEST_CASE("pieces of one plane that do not meet stay two") {
  PointCloud cloud;
  Random random(2);
  add_rectangle(cloud, {-2, 0, 0}, {1.5, 0, 0}, {0, 2, 0}, 0.02, 0.005, random);
  add_rectangle(cloud, {0.5, 0, 0}, {1.5, 0, 0}, {0, 2, 0}, 0.02, 0.005, random);
  CHECK(merge_halves(run_stages(std::move(cloud), known_scale(0.005, 0.02))).clusters.size() == 2);
}

TEST_CASE("layers of one noisy wall are united") {
  PointCloud cloud;
  Random random(3);
  const double noise = 0.02;
  add_rectangle(cloud, {0, 0, 0}, {3, 0, 0}, {0, 3, 0}, 0.02, noise, random);
  RivalOptions options = known_scale(noise, 0.02);
  options.scale.voxel = 0.02;  // so that a layer is some voxels thick
  const Stages s = run_stages(std::move(cloud), options);
  // A layer of a third of its points, beside the rest; and one so far off and so small that a plane
  // for both does not fit it.
  for (double height : {0.4, 1.5}) {
    const Clustering c = merge_clusters(
        s.grid, s.neighbors, s.scale,
        label_sites(s.grid, [&](const Vec3& p) { return p.z() > height * noise ? 1 : 0; }));
    check_clustering(s.grid, c);
    CHECK(c.clusters.size() == 1);
  }
}

TEST_CASE("two sides of a wall, thicker than noise, stay two") {
  PointCloud cloud;
  Random random(4);
  add_rectangle(cloud, {0, 0, 0}, {2, 0, 0}, {0, 2, 0}, 0.02, 0.005, random);
  add_rectangle(cloud, {0, 0, 0.05}, {2, 0, 0}, {0, 2, 0}, 0.02, 0.005, random);
  const Stages s = run_stages(std::move(cloud), known_scale(0.005, 0.02));
  const Clustering c =
      merge_clusters(s.grid, s.neighbors, s.scale,
                     label_sites(s.grid, [](const Vec3& p) { return p.z() > 0.025 ? 1 : 0; }));
  CHECK(c.clusters.size() == 2);
}

TEST_CASE("contacts hold the sites of a cluster that have some of another one around them") {
  const Stages s = run_stages(room_points({3, 3, 2.5}, 0.03, 0.005));
  const Clustering c = label_sites(s.grid, [](const Vec3& p) {
    const int at = static_cast<int>(std::floor(p.x()) + 5 * std::floor(p.y()) + std::floor(p.z()));
    return at % 5 == 0 ? kNone : (at + 50) % 5 - 1;
  });
  std::map<std::pair<std::int32_t, std::int32_t>, Moments> expected;
  for (std::size_t i = 0; i < c.label.size(); ++i) {
    std::map<std::int32_t, int> others;
    for (std::uint32_t j : s.neighbors.of(i)) others[c.label[j]] = 1;
    for (const auto& [other, one] : others)
      if (c.label[i] != kNone && other != kNone && other != c.label[i])
        expected[{c.label[i], other}] += s.grid.sites[i].moments();
  }
  const std::vector<Contact> contacts = find_contacts(s.grid, s.neighbors, c);
  REQUIRE(contacts.size() == expected.size());
  REQUIRE(contacts.size() > 4);
  auto at = expected.begin();
  for (const Contact& contact : contacts) {
    CHECK(std::pair(contact.a, contact.b) == at->first);
    CHECK(contact.moments.n == at->second.n);
    CHECK((contact.moments.mean() - at->second.mean()).norm() < 1e-9);
    ++at;
  }
}

TEST_CASE("sites that rivalry left without others around them hardly matter for contacts") {
  const Stages s = run_stages(room_points({3, 3, 2.5}, 0.03, 0.005));
  Clustering c = compete(s.grid, s.neighbors, s.scale, s.local, s.grow());
  const auto quick = find_contacts(s.grid, s.neighbors, c);
  CHECK(std::count(c.border.begin(), c.border.end(), 0) > 1000);
  std::fill(c.awake.begin(), c.awake.end(), 1);
  const auto all = find_contacts(s.grid, s.neighbors, c);
  REQUIRE(quick.size() == all.size());
  double seen = 0, there = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    CHECK(quick[k].moments.n <= all[k].moments.n);
    seen += quick[k].moments.n, there += all[k].moments.n;
  }
  CHECK(seen >= 0.95 * there);
}
