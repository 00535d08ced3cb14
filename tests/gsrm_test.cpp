// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "sim_check/baselines/gsrm.h"

#include "sim_check/baselines/hebbian.h"
#include "support/meshes.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::sim;

namespace {

GsrmOptions grown_to(int nodes) { return {.gas = {.max_nodes = nodes, .lambda = 50}}; }

// A network with its places.
struct Sheet {
  Network network;
  std::vector<Vec3> positions;

  int add(const Vec3& position) {
    positions.push_back(position);
    return network.add_node();
  }
  int connect(int a, int b) {
    const int edge = network.find_edge(a, b);
    return edge == kNothing ? network.add_edge(a, b) : edge;
  }
  void add_face(int a, int b, int c) {
    connect(a, b), connect(b, c), connect(c, a);
    REQUIRE(network.add_face(a, b, c));
  }
  std::set<std::array<int, 3>> faces() const {
    std::set<std::array<int, 3>> sorted;
    for (auto t : network.triangles()) {
      std::sort(t.begin(), t.end());
      sorted.insert(t);
    }
    return sorted;
  }
};

constexpr int kSheetSize = 8;  // nodes in a row, and rows

// Triangles with sides of 1 m.
Sheet flat_sheet() {
  Sheet sheet;
  for (int r = 0; r < kSheetSize; ++r)
    for (int c = 0; c < kSheetSize; ++c) sheet.add({c + r / 2.0, r * std::sqrt(3) / 2, 0});
  for (int r = 0; r + 1 < kSheetSize; ++r)
    for (int c = 0; c + 1 < kSheetSize; ++c) {
      const int a = r * kSheetSize + c, b = a + kSheetSize;
      sheet.add_face(a, a + 1, b);
      sheet.add_face(a + 1, b + 1, b);
    }
  return sheet;
}

int sheet_node(int row, int column) { return row * kSheetSize + column; }

}  // namespace

TEST_CASE("an edge has two faces at most, and three nodes one") {
  Sheet sheet;
  for (int i = 0; i < 5; ++i) sheet.add({1.0 * i, 0, 0});
  Network& network = sheet.network;
  CHECK_FALSE(network.add_face(0, 1, 2));  // without edges
  sheet.add_face(0, 1, 2);
  CHECK_FALSE(network.add_face(1, 2, 0));
  sheet.add_face(1, 0, 3);
  sheet.connect(0, 4), sheet.connect(1, 4);
  CHECK_FALSE(network.add_face(0, 1, 4));
  network.remove_face(network.edge(network.find_edge(0, 1)).faces[0]);
  CHECK(network.add_face(0, 1, 4));
  network.remove_edge(network.find_edge(0, 1));
  CHECK(network.triangles().empty());
  network.remove_node(0);
  CHECK(network.node_count() == 4);
  CHECK(network.common_neighbors(2, 3) == std::vector<int>{1});
}

TEST_CASE("a connection between two nodes takes the place of one that crosses it") {
  Sheet sheet;
  const int left = sheet.add({-1, 0, 0}), right = sheet.add({1, 0, 0}), top = sheet.add({0, 1, 0}),
            bottom = sheet.add({0, -1, 0}), far = sheet.add({0, 0, 5});
  sheet.add_face(left, top, bottom);
  sheet.add_face(right, top, bottom);
  for (int node : {left, right}) sheet.connect(node, far);

  learn_connection(sheet.network, sheet.positions, left, right);
  CHECK(sheet.network.find_edge(top, bottom) == kNothing);
  CHECK(sheet.faces() == std::set<std::array<int, 3>>{{left, right, top}, {left, right, bottom}});

  const int edge = sheet.network.find_edge(left, right);
  sheet.network.edge(edge).age = 9;
  learn_connection(sheet.network, sheet.positions, right, left);
  CHECK(sheet.network.edge(edge).age == 0);
  CHECK(sheet.network.triangles().size() == 2);

  sheet.positions[static_cast<std::size_t>(top)] = Vec3(0, 0.9, 0);  // within the Thales sphere
  learn_connection(sheet.network, sheet.positions, left, right);
  CHECK(sheet.network.find_edge(left, right) == kNothing);
  CHECK(sheet.network.triangles().empty());
}

TEST_CASE("post-processing mends a sheet with faults of each kind") {
  const std::set<std::array<int, 3>> whole = flat_sheet().faces();
  Sheet sheet = flat_sheet();
  Network& network = sheet.network;

  SUBCASE("a hole of three edges") {
    network.remove_face(
        network.edge(network.find_edge(sheet_node(3, 3), sheet_node(3, 4))).faces[0]);
  }
  SUBCASE("a hole of four edges") {
    network.remove_edge(network.find_edge(sheet_node(3, 3), sheet_node(3, 4)));
  }
  SUBCASE("a fold") {
    const int a = sheet_node(0, 3), b = sheet_node(0, 4);
    sheet.add_face(a, b,
                   sheet.add(sheet.positions[static_cast<std::size_t>(a)] + Vec3(0.5, 0.8, 0.2)));
  }
  SUBCASE("a face with a wide corner") {
    const int a = sheet_node(0, 3), b = sheet_node(0, 4);
    sheet.add_face(a, b,
                   sheet.add(sheet.positions[static_cast<std::size_t>(a)] + Vec3(0.5, -0.1, 0)));
  }
  SUBCASE("a face with a wide corner amid others") {
    const int a = sheet_node(3, 3), b = sheet_node(3, 4), c = sheet_node(4, 3);
    const auto at = [&](int node) -> Vec3& {
      return sheet.positions[static_cast<std::size_t>(node)];
    };
    at(c) = 0.45 * (at(a) + at(b)) + 0.1 * at(c);
  }
  SUBCASE("loose edges in a row, and others between two nodes") {
    const int first = sheet.add({4, 2, 1}), second = sheet.add({4, 2, 2});
    sheet.connect(sheet_node(3, 3), first);
    sheet.connect(first, second);
    sheet.connect(sheet_node(0, 0), sheet_node(0, 5));
  }
  SUBCASE("a face on its own") {
    sheet.add_face(sheet.add({0, 0, 9}), sheet.add({1, 0, 9}), sheet.add({0, 1, 9}));
  }
  post_process(network, sheet.positions);
  CHECK(sheet.faces() == whole);
}

TEST_CASE("post-processing joins two edges that go straight on and have no faces") {
  Sheet sheet = flat_sheet();
  // A notch in the border, with a chain over it, and one from its bottom so that no ear is cut.
  const int a = sheet_node(0, 3), b = sheet_node(0, 4);
  sheet.network.remove_edge(sheet.network.find_edge(a, b));
  double height = 0;
  SUBCASE("straight") { height = 0.01; }
  SUBCASE("bent") { height = 0.1; }
  const int middle = sheet.add(Vec3(3.5, 0, height));
  sheet.connect(a, middle);
  sheet.connect(middle, b);
  const int above = sheet.add(Vec3(2, 0, 3));
  sheet.connect(sheet_node(1, 3), above);
  sheet.connect(above, sheet_node(0, 0));
  post_process(sheet.network, sheet.positions);
  const bool is_closed = sheet.faces() == flat_sheet().faces();
  CHECK(is_closed == (height < 0.05));
  CHECK_FALSE(sheet.network.has_node(middle));
}

TEST_CASE("GSRM makes of the room as many faces as another implementation does, and as good ones") {
  struct Oracle {
    int nodes;
    double vertices, faces;
    int border;
    double error;
  };
  const FurnishedRoom room(170000);
  for (const Oracle& o : {Oracle{1000, 995, 1954, 82, 0.043}, {5000, 4934, 9726, 432, 0.010}}) {
    const Mesh mesh = gsrm(room.cloud, {.gas = {.max_nodes = o.nodes}});
    check_dense_mesh(mesh);
    CHECK(static_cast<double>(mesh.vertices.size()) == doctest::Approx(o.vertices).epsilon(0.02));
    CHECK(static_cast<double>(mesh.triangles.size()) == doctest::Approx(o.faces).epsilon(0.02));
    CHECK(border_edges(mesh) > o.border / 2);
    CHECK(border_edges(mesh) < o.border * 2);
    const double error = mean_error(mesh, room.sides, 300);
    CHECK(error > o.error / 5);
    CHECK(error < o.error);
  }
}

TEST_CASE("GSRM closes a sphere, but for a few edges") {
  Random random(3);
  PointCloud cloud;
  for (int i = 0; i < 20000; ++i) cloud.points.push_back(random.direction().cast<float>());
  const Mesh mesh = gsrm(cloud, {.gas = {.max_nodes = 500}});
  check_dense_mesh(mesh);
  CHECK(mesh.vertices.size() > 480);
  for (const Vec3& v : mesh.vertices) CHECK(v.norm() == doctest::Approx(1).epsilon(0.03));
  const double edges = static_cast<double>(faces_at_edges(mesh).size());
  CHECK(border_edges(mesh) < 0.05 * edges);
  double area = 0;
  for (const auto& t : mesh.triangles) area += triangle_area(mesh, t);
  CHECK(area == doctest::Approx(4 * M_PI).epsilon(0.05));
}

TEST_CASE("GSRM keeps what holds for all meshes on degenerate points") {
  Random random(4);
  PointCloud cloud;
  const auto check = [&] { check_dense_mesh(gsrm(cloud, grown_to(150))); };
  SUBCASE("few places many times") {
    for (int i = 0; i < 2000; ++i)
      cloud.points.emplace_back(random.whole(0, 4), random.whole(0, 4), random.whole(0, 1));
    check();
  }
  SUBCASE("a plane without noise") {
    add_rectangle(cloud, Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY(), 0.02, 0, random);
    check();
  }
  SUBCASE("a line") {
    for (int i = 0; i < 500; ++i) cloud.points.emplace_back(0.1f * static_cast<float>(i), 0.f, 0.f);
    check();
  }
  SUBCASE("clutter that is no surface, far from the origin") {
    for (int i = 0; i < 3000; ++i)
      cloud.points.emplace_back(
          (Vec3::Constant(9000) + random.direction() * random.uniform()).cast<float>());
    check();
  }
}

TEST_CASE("the order of the points does not matter to GSRM, the seed does") {
  FurnishedRoom room(6000);
  const Mesh before = gsrm(room.cloud, grown_to(300));
  shuffle_points(room.cloud, 5);
  CHECK(is_same(gsrm(room.cloud, grown_to(300)), before));
  GsrmOptions other = grown_to(300);
  other.gas.seed = 2;
  CHECK_FALSE(is_same(gsrm(room.cloud, other), before));
}

TEST_CASE("the mesh of GSRM is where the origin of the cloud says") {
  FurnishedRoom room(6000);
  const Mesh before = gsrm(room.cloud, grown_to(300));
  room.cloud.origin = Vec3(5e6, -1e6, 100);
  const Mesh moved = gsrm(room.cloud, grown_to(300));
  CHECK(moved.triangles == before.triangles);
  REQUIRE(moved.vertices.size() == before.vertices.size());
  for (std::size_t i = 0; i < moved.vertices.size(); ++i)
    CHECK((moved.vertices[i] - room.cloud.origin - before.vertices[i]).norm() < 1e-8);
}

TEST_CASE("GSRM tells how far it is, and can be cancelled") {
  const FurnishedRoom room(6000);
  std::vector<double> told;
  gsrm(room.cloud, grown_to(300),
       [&](std::string_view, double fraction) { told.push_back(fraction); });
  CHECK(told.size() > 50);
  CHECK(told.size() < 150);
  CHECK(std::all_of(told.begin(), told.end(), [](double f) { return f >= 0 && f <= 1; }));
  CHECK(std::is_sorted(told.begin() + 5, told.end()));
  struct Cancelled {};
  CHECK_THROWS_AS(
      gsrm(room.cloud, grown_to(300), [](std::string_view, double) { throw Cancelled(); }),
      Cancelled);
}

TEST_CASE("GSRM refuses scans that are too small and options out of range") {
  const PointCloud cloud = FurnishedRoom(1000).cloud;
  const auto refused = [](const PointCloud& points, const GsrmOptions& options, Cause cause) {
    return error_of(cause, [&] { gsrm(points, options); });
  };
  CHECK(contains(refused({}, {}, Cause::bad_input), "0 points"));
  CHECK(contains(refused(cloud, {.gas = {.max_nodes = 9999}}, Cause::bad_input), "9999 nodes"));
  CHECK(contains(refused(cloud, {.gas = {.max_nodes = 3}}, Cause::usage), "max_nodes"));
  CHECK(contains(refused(cloud, {.post = {.min_dihedral = 4}}, Cause::usage), "min_dihedral"));
  CHECK(contains(refused(cloud, {.post = {.max_corner = 1}}, Cause::usage), "max_corner"));
  CHECK(
      contains(refused(cloud, {.post = {.min_merge_angle = -1}}, Cause::usage), "min_merge_angle"));
}
