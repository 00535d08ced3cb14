// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/baselines/gng.h"

#include <numeric>

#include "support/meshes.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::sim;

namespace {

// The nearest two of the nodes that are there, by looking at all.
std::pair<int, int> nearest_two_of(const std::map<int, Vec3>& nodes, const Vec3& point) {
  std::vector<std::pair<double, int>> order;
  for (const auto& [node, position] : nodes)
    order.emplace_back((position - point).squaredNorm(), node);
  std::partial_sort(order.begin(), order.begin() + 2, order.end());
  return {order[0].second, order[1].second};
}

// In a box, or a rectangle, or on a line where sides are zero; at times on a coarse lattice, so
// that many are equally far.
Vec3 place_in(const Vec3& size, Random& random) {
  const Vec3 p(random.uniform(), random.uniform(), random.uniform());
  const Vec3 coarse = (p * 4).array().round() / 4;
  return size.cwiseProduct(random.whole(0, 1) == 0 ? p : coarse);
}

std::vector<Vec3> draw(Signals& signals, std::size_t count) {
  std::vector<Vec3> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back(signals.next());
  return points;
}

std::vector<Vec3> sorted(std::vector<Vec3> points) {
  std::sort(points.begin(), points.end(), [](const Vec3& a, const Vec3& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  });
  return points;
}

GngOptions few_nodes(int nodes, bool two_faces_an_edge = true) {
  return {.gas = {.max_nodes = nodes, .lambda = 50}, .two_faces_an_edge = two_faces_an_edge};
}

}  // namespace

TEST_CASE("the grid finds the two nodes that a look at all finds, while they come, go and move") {
  Random random(1);
  for (const Vec3& size :
       {Vec3(6, 4, 2.5), Vec3(1, 1, 0), Vec3(0, 3, 0), Vec3(0.01, 5, 5), Vec3(0, 0, 0)}) {
    NodeGrid grid(Box3(Vec3::Zero(), size));
    std::map<int, Vec3> nodes;
    for (int i = 0; i < 1500; ++i) {
      const int node = random.whole(0, 400);
      const Vec3 p = random.whole(0, 20) == 0 ? place_in(Vec3(9, 9, 9), random) - Vec3(2, 2, 2)
                                              : place_in(size, random);
      const bool is_there = nodes.count(node) == 1;
      if (!is_there) {
        grid.insert(node, p);
        nodes[node] = p;
      } else if (random.whole(0, 3) == 0) {
        grid.erase(node);
        nodes.erase(node);
      } else {
        grid.move(node, p);
        nodes[node] = p;
      }
      if (nodes.size() < 2) continue;
      const Vec3 query = place_in(size + Vec3::Constant(0.1), random);
      REQUIRE(grid.nearest_two(query) == nearest_two_of(nodes, query));
    }
  }
}

TEST_CASE("each pass of the signals has each point once, in another order") {
  Random random(2);
  PointCloud cloud = cloud_of({{1, 1, 1}, {1, 1, 1}});  // one of them twice
  for (int i = 0; i < 500; ++i) cloud.points.push_back(random.direction().cast<float>());
  std::vector<Vec3> all;
  for (const Vec3f& p : cloud.points) all.push_back(p.cast<double>());

  Signals signals(cloud, 2, 1);
  const std::vector<Vec3> first = draw(signals, all.size()), second = draw(signals, all.size());
  CHECK(first != second);
  CHECK(sorted(first) == sorted(all));
  CHECK(sorted(second) == sorted(all));

  shuffle_points(cloud, 3);
  Signals others(cloud, 2, 1), of_another_seed(cloud, 2, 2);
  CHECK(draw(others, all.size()) == first);
  CHECK(draw(of_another_seed, all.size()) != first);
}

TEST_CASE("errors decay as if all were multiplied with every signal") {
  constexpr int kNodes = 20;
  for (const double beta : {1.0, 0.9995, 0.5}) {
    Random random(4);
    DecayingErrors errors(beta);
    std::vector<double> plain(kNodes);
    for (int i = 0; i < 20000; ++i) {
      const int node = random.whole(0, kNodes - 1);
      const double error = random.uniform();
      errors.add(node, error);
      plain[static_cast<std::size_t>(node)] += error;
      for (double& e : plain) e *= beta;
      errors.decay();
    }
    const double sum = std::accumulate(plain.begin(), plain.end(), 0.0);
    double shares = 0;
    for (int node = 0; node < kNodes; ++node) shares += errors[node];
    for (int node = 0; node < kNodes; ++node)
      CHECK(errors[node] / shares ==
            doctest::Approx(plain[static_cast<std::size_t>(node)] / sum).epsilon(1e-6));
  }
}

TEST_CASE("the mesh of a growing neural gas lies on the room") {
  FurnishedRoom room(20000);
  room.cloud.origin = Vec3(100, 200, 300);
  for (RoomSide& side : room.sides) side.corner += room.cloud.origin;
  const Mesh mesh = gng_with_cliques(room.cloud, few_nodes(1500));
  check_dense_mesh(mesh);
  CHECK(mesh.vertices.size() > 1250);
  CHECK(mesh.vertices.size() <= 1500);
  CHECK(mesh.triangles.size() > mesh.vertices.size());
  CHECK(mean_error(mesh, room.sides) < 0.02);
}

TEST_CASE("each three nodes that are connected are a triangle, unless an edge has two already") {
  const FurnishedRoom room(5000);
  const Mesh capped = gng_with_cliques(room.cloud, few_nodes(400)),
             all = gng_with_cliques(room.cloud, few_nodes(400, false));
  check_dense_mesh(capped);
  check_dense_mesh(all, 400);
  CHECK(capped.triangles.size() < all.triangles.size());

  // The vertices are the same, but numbered in another order.
  std::map<std::array<double, 3>, int> index;
  for (const Vec3& v : all.vertices)
    index.emplace(std::array{v.x(), v.y(), v.z()}, static_cast<int>(index.size()));
  Mesh kept{all.vertices, capped.triangles};
  for (auto& t : kept.triangles) {
    for (int& i : t) {
      const Vec3& v = capped.vertices[static_cast<std::size_t>(i)];
      i = index.at({v.x(), v.y(), v.z()});
    }
    std::sort(t.begin(), t.end());
  }
  const std::set<std::array<int, 3>> is_kept(kept.triangles.begin(), kept.triangles.end());
  auto faces = faces_at_edges(kept);
  std::size_t found = 0;
  for (auto t : all.triangles) {
    std::sort(t.begin(), t.end());
    if (is_kept.count(t) == 1)
      ++found;
    else
      CHECK(std::max({faces[{t[0], t[1]}], faces[{t[1], t[2]}], faces[{t[0], t[2]}]}) == 2);
  }
  CHECK(found == is_kept.size());

  const auto edges = faces_at_edges(all);
  const auto is_edge = [&](int a, int b) { return edges.count(std::minmax({a, b})) == 1; };
  std::size_t cliques = 0;
  const int count = static_cast<int>(all.vertices.size());
  for (const auto& [edge, unused] : edges)
    for (int c = edge.second + 1; c < count; ++c)
      cliques += is_edge(edge.first, c) && is_edge(edge.second, c);
  CHECK(cliques == all.triangles.size());
}

TEST_CASE("the order of the points does not matter to a growing neural gas, the seed does") {
  FurnishedRoom room(5000);
  const Mesh before = gng_with_cliques(room.cloud, few_nodes(200));
  shuffle_points(room.cloud, 5);
  CHECK(is_same(gng_with_cliques(room.cloud, few_nodes(200)), before));
  GngOptions other = few_nodes(200);
  other.gas.seed = 2;
  CHECK_FALSE(is_same(gng_with_cliques(room.cloud, other), before));
}

TEST_CASE("growth ends on points that cannot carry so many nodes") {
  std::vector<Vec3> points;
  for (int i = 0; i < 60; ++i) points.emplace_back(i % 3, i % 3 == 1, 0);
  const Mesh mesh = gng_with_cliques(
      cloud_of(points), {.gas = {.max_nodes = 50, .lambda = 20, .eps_b = 1, .max_age = 1}});
  check_dense_mesh(mesh);
  CHECK(mesh.vertices.size() < 50);
}

TEST_CASE("a growing neural gas refuses scans that are too small and options out of range") {
  const PointCloud cloud = FurnishedRoom(1000).cloud;
  const auto refused = [](const PointCloud& points, const GasOptions& gas, Cause cause) {
    return error_of(cause, [&] { gng_with_cliques(points, {.gas = gas}); });
  };
  CHECK(contains(refused({}, {}, Cause::bad_input), "0 points"));
  CHECK(contains(
      refused(cloud_of(std::vector<Vec3>(99, Vec3(1, 2, 3))), {.max_nodes = 50}, Cause::bad_input),
      "different"));
  CHECK(contains(refused(cloud, {.max_nodes = 100000}, Cause::bad_input), "100000 nodes"));
  CHECK(contains(refused(cloud, {.max_nodes = 2}, Cause::usage), "max_nodes"));
  CHECK(contains(refused(cloud, {.max_nodes = 50, .lambda = 0}, Cause::usage), "lambda"));
  CHECK(contains(refused(cloud, {.max_nodes = 50, .eps_b = 1.5}, Cause::usage), "eps_b"));
  CHECK(contains(refused(cloud, {.max_nodes = 50, .eps_n = -1}, Cause::usage), "eps_n"));
  CHECK(contains(refused(cloud, {.max_nodes = 50, .alpha = NAN}, Cause::usage), "alpha"));
  CHECK(contains(refused(cloud, {.max_nodes = 50, .beta = 0}, Cause::usage), "beta"));
  CHECK(contains(refused(cloud, {.max_nodes = 50, .max_age = 0}, Cause::usage), "max_age"));
}
