// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "occupancy_grid.h"

#include <octomap/octomap.h>

#include <set>

#include "cell_walk.h"
#include "exporters/grid.h"
#include "parallel.h"
#include "scan/read_scan.h"
#include "scan/write_scan.h"
#include "support/scenes.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

const OccupancyOptions kTenth{.resolution = 0.1};

double probability_of(double log_odds) { return 1 / (1 + std::exp(-log_odds)); }

double probability_at(const OccupancyGrid& grid, const Vec3& p) {
  return grid.probability(grid.cell_of(p));
}

// A room seen from two places in it, with strays about.
PointCloud seen_room() {
  PointCloud cloud = room_points({4, 3, 2.5}, 0.05, 0.005);
  Random random(8);
  for (int i = 0; i < 200; ++i)
    cloud.points.emplace_back(random.uniform(-2, 6), random.uniform(-2, 5), random.uniform(-1, 4));
  cloud.viewpoints = {{1, 1, 1.5}, {3, 2, 1.5}};
  return cloud;
}

std::unique_ptr<octomap::OcTree> read_tree(const std::filesystem::path& path) {
  std::unique_ptr<octomap::AbstractOcTree> any(octomap::AbstractOcTree::read(path.string()));
  auto* tree = dynamic_cast<octomap::OcTree*>(any.get());
  REQUIRE(tree);
  any.release();
  return std::unique_ptr<octomap::OcTree>(tree);
}

std::size_t known_cells(const OccupancyGrid& grid) {
  std::size_t known = 0;
  for (const auto& block : grid.blocks)
    for (const auto& cell : block.cells) known += cell.is_known();
  return known;
}

}  // namespace

TEST_CASE("a ray makes the cells that it passes freer and the one that it ends in more occupied") {
  PointCloud cloud = cloud_of({{2.05, 0.05, 0.05}});
  cloud.viewpoints = {{0.05, 0.05, 0.05}};
  const OccupancyGrid grid = make_occupancy_grid(cloud, kTenth);
  CHECK(probability_at(grid, {2.05, 0.05, 0.05}) == doctest::Approx(0.7));
  for (int i = 0; i < 20; ++i)
    CHECK(probability_at(grid, {0.1 * i + 0.05, 0.05, 0.05}) == doctest::Approx(0.4));
  CHECK(known_cells(grid) == 21);
  CHECK(probability_at(grid, {2.15, 0.05, 0.05}) == 0.5);
  CHECK(probability_at(grid, {1.05, 0.15, 0.05}) == 0.5);
  CHECK(probability_at(grid, {1e9, 0, 0}) == 0.5);
}

TEST_CASE("a cell was seen by the viewpoint that most of its points know, not by the nearest") {
  PointCloud cloud = cloud_of({{2.05, 0.05, 0.05}, {2.04, 0.05, 0.05}, {2.03, 0.05, 0.05}});
  cloud.viewpoints = {{0.05, 0.05, 0.05}, {2.05, 1.05, 0.05}};
  const auto is_through = [&](const Vec3& p) {
    return probability_at(make_occupancy_grid(cloud, kTenth), p) < 0.5;
  };
  CHECK_FALSE(is_through({1.05, 0.05, 0.05}));
  CHECK(is_through({2.05, 0.55, 0.05}));
  cloud.viewers = {0, 1, 0};
  CHECK(is_through({1.05, 0.05, 0.05}));
  CHECK_FALSE(is_through({2.05, 0.55, 0.05}));
}

TEST_CASE("a single viewpoint has not seen what others are known to have not") {
  PointCloud cloud = cloud_of({{2.05, 0.05, 0.05}, {3.05, 0.05, 0.05}, {3.04, 0.05, 0.05}});
  cloud.viewpoints = {{0.05, 0.05, 0.05}};
  cloud.viewers = {0, -1, -1};
  cloud.points.push_back({2.04f, 0.05f, 0.05f});
  cloud.viewers.push_back(0);
  const OccupancyGrid grid = make_occupancy_grid(cloud, kTenth);
  CHECK(probability_at(grid, {1.05, 0.05, 0.05}) < 0.5);
  CHECK(probability_at(grid, {2.55, 0.05, 0.05}) == 0.5);  // hidden behind the first
}

TEST_CASE("a walk goes from neighbour to neighbour, along the line, to the cell before the last") {
  Random random(4);
  for (int i = 0; i < 2000; ++i) {
    const auto place = [&] {
      return Vec3(random.uniform(-50, 50), random.uniform(-50, 50), random.uniform(-50, 50));
    };
    const Vec3 from = place();
    const Eigen::Vector3i to = place().array().floor().cast<int>();
    const Vec3 end = to.cast<double>() + Vec3::Constant(0.5), way = (end - from).normalized();
    std::vector<Eigen::Vector3i> cells;
    walk_cells(from, to, [&](std::uint64_t code) {
      cells.push_back(cell_at(code));
      CHECK(morton_of(cells.back()) == code);
      return true;
    });
    REQUIRE_FALSE(cells.empty());
    CHECK(cells.front() == Eigen::Vector3i(from.array().floor().cast<int>()));
    cells.push_back(to);
    for (std::size_t k = 0; k + 1 < cells.size(); ++k) {
      CHECK((cells[k + 1] - cells[k]).cwiseAbs().sum() == 1);
      const Vec3 off = cells[k].cast<double>() + Vec3::Constant(0.5) - from;
      CHECK((off - off.dot(way) * way).norm() < std::sqrt(3) / 2 + 1e-9);
    }
  }
}

TEST_CASE("probabilities are kept between their bounds") {
  std::vector<Vec3> points(1000, Vec3(2.05, 0.05, 0.05));
  for (int i = 0; i < 100000; ++i) points.emplace_back(-2.05, 0.05, 0.05);
  PointCloud cloud = cloud_of(points);
  for (int i = 0; i < 4; ++i) cloud.viewpoints.emplace_back(0.02 * i + 0.01, 0.05, 0.05);
  const OccupancyGrid grid = make_occupancy_grid(cloud, kTenth);
  CHECK(probability_at(grid, {2.05, 0.05, 0.05}) == doctest::Approx(0.971));
  CHECK(probability_at(grid, {-2.05, 0.05, 0.05}) == doctest::Approx(0.971));
  // From many places in one cell, each a step, until the bound.
  PointCloud ring;
  for (int i = 0; i < 40; ++i) {
    const double angle = 2 * M_PI * i / 40;
    const Vec3 out(std::cos(angle), std::sin(angle), 0);
    ring.points.push_back((1.5 * out + Vec3(0.05, 0.05, 0.05)).cast<float>());
    ring.viewpoints.push_back(0.03 * out + Vec3(0.05, 0.05, 0.05));
  }
  CHECK(probability_at(make_occupancy_grid(ring, kTenth), {0.05, 0.05, 0.05}) ==
        doctest::Approx(0.1192).epsilon(1e-4));
  const OccupancyGrid narrow = make_occupancy_grid(seen_room(), {.lowest = 0.45, .highest = 0.6});
  double least = 1, most = 0;
  for (const auto& block : narrow.blocks)
    for (const auto& cell : block.cells) {
      if (!cell.is_known()) continue;
      const double p = probability_of(narrow.log_odds(cell));
      least = std::min(least, p), most = std::max(most, p);
    }
  CHECK(least == doctest::Approx(0.45));
  CHECK(most == doctest::Approx(0.6));
}

TEST_CASE("a grid depends neither on the order of the points nor on the number of threads") {
  PointCloud cloud = seen_room();
  const OccupancyGrid grid = make_occupancy_grid(cloud, {.resolution = 0.05});
  CHECK(grid.blocks.size() > 100);
  shuffle_points(cloud, 77);
  for (int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    CHECK(make_occupancy_grid(cloud, {.resolution = 0.05}).blocks == grid.blocks);
  }
}

TEST_CASE("a room is free where it was looked through, and walls stay") {
  const PointCloud cloud = seen_room();
  const OccupancyGrid grid = make_occupancy_grid(cloud, kTenth);
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 inside(random.uniform(0.5, 3.5), random.uniform(0.5, 2.5), random.uniform(0.5, 2));
    CHECK(probability_at(grid, inside) <= 0.7);  // a stray at most
    const Vec3 behind(random.uniform(-0.9, -0.3), random.uniform(0, 3), random.uniform(0, 2.5));
    CHECK(probability_at(grid, behind) >= 0.5);  // strays make no ways through walls
  }
  std::size_t walls = 0, kept = 0;
  for (std::size_t i = 0; i + 200 < cloud.points.size(); ++i)
    ++walls, kept += probability_at(grid, cloud.points[i].cast<double>()) > 0.5;
  CHECK(kept == walls);
}

TEST_CASE("without viewpoints there are hits alone; cells with too few points have none") {
  PointCloud cloud = seen_room();
  cloud.viewpoints.clear();
  for (const auto& block : make_occupancy_grid(cloud, kTenth).blocks)
    for (const auto& cell : block.cells) CHECK(cell.misses == 0);
  std::size_t points = 0;
  for (const auto& block : make_occupancy_grid(cloud, {.resolution = 0.1, .min_points = 3}).blocks)
    for (const auto& cell : block.cells) {
      CHECK((cell.hits == 0 || cell.hits >= 3));
      points += cell.hits;
    }
  CHECK(points > cloud.points.size() / 2);
  CHECK(points < cloud.points.size());
}

TEST_CASE("liboctomap reads the probabilities as they are") {
  const TempFolder folder;
  const OccupancyGrid grid = make_occupancy_grid(seen_room(), kTenth);
  write_grid(folder / "grid.ot", grid, OctreeKind::log_odds);
  const auto tree = read_tree(folder / "grid.ot");
  std::size_t known = 0;
  for (const auto& block : grid.blocks)
    for (std::size_t i = 0; i < block.cells.size(); ++i) {
      const Eigen::Vector3i cell = cell_at(block.key << 9 | i);
      const Vec3 p = (cell.cast<double>() + Vec3::Constant(0.5)) * 0.1;
      const auto* node = tree->search(p.x(), p.y(), p.z());
      REQUIRE((node != nullptr) == block.cells[i].is_known());
      if (!node) continue;
      CHECK(node->getOccupancy() == doctest::Approx(grid.probability(cell)).epsilon(1e-6));
      ++known;
    }
  CHECK(known > 10000);
  const std::size_t nodes = tree->size();
  tree->prune();
  CHECK(tree->size() == nodes);

  // A binary file holds what is more likely.
  write_grid(folder / "grid.bt", grid, OctreeKind::binary);
  octomap::OcTree binary(1.0);
  REQUIRE(binary.readBinary((folder / "grid.bt").string()));
  tree->toMaxLikelihood();
  tree->prune();
  CHECK(*tree == binary);
}

TEST_CASE("one scan gives the cells that liboctomap makes of it") {
  // One point a cell, seen from one place: then both count alike.
  PointCloud cloud;
  std::set<std::uint64_t> taken;
  const OccupancyGrid units{.options = {.resolution = 0.05}};
  for (const Vec3f& p : room_points({4, 3, 2.5}, 0.05, 0.005).points)
    if (taken.insert(morton_of(units.cell_of(p.cast<double>()))).second) cloud.points.push_back(p);
  cloud.viewpoints = {{1.01, 1.02, 1.53}};
  const OccupancyGrid grid = make_occupancy_grid(cloud, units.options);

  octomap::OcTree tree(0.05);
  octomap::Pointcloud points;
  for (const Vec3f& p : cloud.points) points.push_back(p.x(), p.y(), p.z());
  tree.insertPointCloud(points, {1.01f, 1.02f, 1.53f}, -1, false, true);
  tree.expand();
  std::size_t same = 0, all = 0;
  for (auto leaf = tree.begin_leafs(); leaf != tree.end_leafs(); ++leaf) {
    const auto p = leaf.getCoordinate();
    const double ours = probability_at(grid, {p.x(), p.y(), p.z()});
    ++all, same += std::abs(ours - leaf->getOccupancy()) < 1e-6;
  }
  CHECK(all > 20000);
  // Single precision decides otherwise where a ray goes through a corner.
  CHECK(same > all - all / 1000);
  CHECK(known_cells(grid) < all + all / 1000);
}

TEST_CASE("what cannot be is refused") {
  PointCloud far = cloud_of({{0, 0, 0}, {5000, 0, 0}});
  const std::string why =
      error_of(Cause::usage, [&] { make_occupancy_grid(far, {.resolution = 0.1}); });
  CHECK(contains(why, "5000.0 m"));
  CHECK(contains(why, "0.16 m"));
  CHECK(make_occupancy_grid(far, {.resolution = 0.16}).blocks.size() == 2);
  CHECK(make_occupancy_grid({}).blocks.empty());
  for (const OccupancyOptions& o : {OccupancyOptions{.resolution = 0}, OccupancyOptions{.hit = 0.3},
                                    OccupancyOptions{.miss = 1}, OccupancyOptions{.lowest = 0.99},
                                    OccupancyOptions{.min_points = 0}})
    error_of(Cause::usage, [&] { make_occupancy_grid(far, o); });
}

TEST_CASE("the command makes grids of scans, and says which formats need a world") {
  const TempFolder folder;
  PointCloud cloud = seen_room();
  cloud.origin = {524288, 0, 0};
  write_scan(folder / "room.ply", cloud);
  write_file(folder / "poses.txt", "524289 1 1.5\n524291 2 1.5\n");
  const std::string scan = (folder / "room.ply").string(), grid = (folder / "grid.ot").string();

  const Outcome made = run({"export", scan, "-o", grid, "--poses", (folder / "poses.txt").string(),
                            "--resolution", "0.1"});
  CHECK(made.code == 0);
  const PointCloud back = read_scan({folder / "room.ply"});
  PointCloud seen = back;
  for (const Vec3& v : cloud.viewpoints) seen.viewpoints.push_back(v + cloud.origin - back.origin);
  write_grid(folder / "expected.ot", make_occupancy_grid(seen, kTenth), OctreeKind::log_odds);
  CHECK(read_file(grid) == read_file(folder / "expected.ot"));
  CHECK(contains(read_file(grid), "origin 524288 0 0\n"));
  CHECK(run({"export", scan, "-o", (folder / "grid.bt").string()}).code == 0);

  const Outcome refused = run({"export", scan, "-o", (folder / "room.stl").string()});
  CHECK(refused.code == 2);
  CHECK(contains(refused.err, "stl is made of a world"));
  CHECK(contains(refused.err, "bt, ot"));
  CHECK(run({"export", scan, "-o", (folder / "all").string(), "--all"}).code == 2);
  CHECK(run({"export", scan, "-o", grid, "--level"}).code == 2);
  CHECK(run({"export", in_project("worlds/room.json").string(), "-o", grid, "--poses", "p"}).code ==
        2);
}
