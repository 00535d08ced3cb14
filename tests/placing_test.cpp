// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "thesis/placing.h"

#include <set>

#include "support/scenes.h"
#include "thesis/filter.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::thesis;

namespace {

// Which of the six faces of a room small clusters lie on.
std::set<int> faces_found(const Vec3& size, const std::vector<thesis::Cluster>& clusters) {
  std::set<int> faces;
  for (const thesis::Cluster& c : clusters)
    for (int axis = 0; axis < 3; ++axis) {
      if (std::abs(c.fit.centroid[axis]) < 0.02) faces.insert(axis);
      if (std::abs(c.fit.centroid[axis] - size[axis]) < 0.02) faces.insert(3 + axis);
    }
  return faces;
}

}  // namespace

TEST_CASE("small clusters hold enough points, all in their plane, none in two clusters") {
  const FilteredPoints filtered = filter_points(room_points({5, 4, 2.7}, 0.03, 0.005));
  const PlacingOptions options;
  const std::vector<thesis::Cluster> clusters =
      place_clusters(KdTree(filtered.points), filtered.delta, options);
  CHECK(clusters.size() > 100);
  std::set<int> taken;
  for (const thesis::Cluster& c : clusters) {
    CHECK(c.members.size() >= static_cast<std::size_t>(options.min_points));
    for (int p : c.members) {
      CHECK(taken.insert(p).second);
      CHECK(std::abs(c.fit.plane.signed_distance(filtered.points[static_cast<std::size_t>(p)])) <
            options.min_distance * filtered.delta);
    }
  }
}

TEST_CASE("with a few clusters walls are missed that are found with more") {
  const Vec3 size(6, 5, 3);
  PointCloud cloud = room_points(size, 0.03, 0.005);
  const FilteredPoints filtered = filter_points(cloud);
  const KdTree tree(filtered.points);
  const auto few = place_clusters(tree, filtered.delta, {.number_of_clusters = 4});
  const auto many = place_clusters(tree, filtered.delta, {.number_of_clusters = 200});
  CHECK(few.size() == 4);
  CHECK(many.size() == 200);
  CHECK(faces_found(size, few).size() < 6);
  CHECK(faces_found(size, many).size() == 6);
}

TEST_CASE("placing ends where there are no points, too few, or none in a plane") {
  CHECK(place_clusters(KdTree({}), 0.1).empty());
  CHECK(place_clusters(KdTree({{0, 0, 0}, {0.1, 0, 0}}), 0.1).empty());
  Random random(1);
  std::vector<Vec3> cloud;
  for (int i = 0; i < 3000; ++i)
    cloud.emplace_back(random.uniform(), random.uniform(), random.uniform());
  CHECK(place_clusters(KdTree(cloud), 0.1).size() < 20);
}
