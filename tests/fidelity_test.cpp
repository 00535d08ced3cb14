// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/fidelity.h"

#include <algorithm>

#include "parallel.h"
#include "support/scenes.h"
#include "world/assemble.h"
#include "world/virtual_scan.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

constexpr double kScanNoise = 0.006;  // [m]

World world_named(const char* name) {
  return read_world(in_project(std::string("worlds/") + name + ".json"));
}

PointCloud scan_of(const World& world, std::size_t points = 60000,
                   const std::vector<Vec3>& poses = {}) {
  return virtual_scan(world, {.poses = poses, .points = points, .noise = kScanNoise}).cloud;
}

FidelityOptions options_for(double spacing) { return {.noise = kScanNoise, .spacing = spacing}; }

const Criterion& criterion(const Fidelity& fidelity, std::string_view name) {
  const auto found = std::find_if(fidelity.criteria.begin(), fidelity.criteria.end(),
                                  [&](const Criterion& c) { return contains(c.name, name); });
  REQUIRE(found != fidelity.criteria.end());
  return *found;
}

std::size_t largest_wall(const World& world) {
  std::size_t best = 0;
  double most = 0;
  for (std::size_t s = 0; s < world.surfaces.size(); ++s)
    if (world.surfaces[s].kind == Kind::wall && area(world, world.surfaces[s]) > most)
      best = s, most = area(world, world.surfaces[s]);
  return best;
}

// Moves a surface alone, whose neighbours stay where they are.
void move_surface(World& world, std::size_t index, double along_normal) {
  Surface& surface = world.surfaces[index];
  const auto move_loop = [&](Loop& loop) {
    for (int& v : loop) {
      world.vertices.push_back(world.vertices[static_cast<std::size_t>(v)] +
                               along_normal * surface.plane.normal);
      v = static_cast<int>(world.vertices.size()) - 1;
    }
  };
  move_loop(surface.outer);
  for (Loop& hole : surface.holes) move_loop(hole);
  surface.plane.offset -= along_normal;
}

// All that was measured, to be compared bit for bit.
std::vector<double> figures(const Fidelity& f) {
  std::vector<double> all = {static_cast<double>(f.points),
                             static_cast<double>(f.rays),
                             f.scan_to_world.median,
                             f.scan_to_world.p95,
                             f.world_to_scan.median,
                             f.world_to_scan.p95,
                             f.coverage,
                             f.unexplained,
                             f.free_space_violations.value_or(-1),
                             f.leaks.value_or(-1)};
  for (const SurfaceFidelity& s : f.surfaces)
    for (double v : {static_cast<double>(s.points), s.rms, s.offset, s.coverage.value_or(-1)})
      all.push_back(v);
  return all;
}

// A floor of one square metre and points over it.
Fidelity over_floor(const std::vector<Vec3>& points, const FidelityOptions& options = {}) {
  const World world = assemble_world(
      {{.plane = {Vec3::UnitZ(), 0}, .outer = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}, {});
  return measure_fidelity(world, cloud_of(points), options);
}

}  // namespace

TEST_CASE("points are on a rough surface as far off as its own points were, but no farther") {
  Random random(3);
  std::vector<Vec3> points;
  for (int k = 0; k < 4000; ++k)
    points.emplace_back(random.uniform(), random.uniform(), 0.015 * random.gauss());
  World world = assemble_world(
      {{.plane = {Vec3::UnitZ(), 0}, .outer = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}, {});
  const auto unexplained = [&](double roughness) {
    world.surfaces[0].support.rms = roughness;
    return measure_fidelity(world, cloud_of(points), {.noise = 0.002}).unexplained;
  };
  CHECK(unexplained(0) > 0.3);
  CHECK(unexplained(0.015) < 0.002);
  for (Vec3& p : points) p.z() *= 10;
  CHECK(unexplained(0.15) > 0.5);
}

TEST_CASE("a world is faithful to a scan of itself, with and without poses") {
  for (const char* name : {"room", "office", "stairs"}) {
    INFO(name);
    const World world = world_named(name);
    PointCloud cloud = scan_of(world, 150000);
    const Fidelity fidelity = measure_fidelity(world, cloud, options_for(0.04));
    for (const Criterion& c : fidelity.criteria) {
      INFO(c.name << " " << c.value.value_or(-1));
      CHECK(c.is_met());
    }
    CHECK(fidelity.is_faithful());
    CHECK(fidelity.scan_to_world.median < 0.68 * kScanNoise);  // noise is along the ray
    CHECK(fidelity.unexplained < 0.001);
    CHECK(fidelity.free_space_violations.value() < 0.001);
    CHECK(fidelity.leaks.value() < 0.002);
    CHECK(fidelity.rays > 50000);
    cloud.viewpoints.clear();
    const Fidelity without = measure_fidelity(world, cloud, options_for(0.04));
    CHECK(without.is_faithful());
    CHECK_FALSE(without.free_space_violations);
    CHECK_FALSE(without.leaks);
    CHECK(without.rays == 0);
    CHECK(without.coverage == fidelity.coverage);
  }
}

TEST_CASE("a wall that is moved by 5 cm is named, whichever way it is moved") {
  const World world = world_named("office");
  const PointCloud cloud = scan_of(world, 150000);
  const std::size_t wall = largest_wall(world);
  for (double by : {-0.05, 0.05}) {
    World moved = world;
    move_surface(moved, wall, by);
    const Fidelity fidelity = measure_fidelity(moved, cloud, options_for(0.04));
    CHECK_FALSE(fidelity.is_faithful());
    CHECK(fidelity.misplaced == std::vector<int>{world.surfaces[wall].id});
    CHECK(fidelity.surfaces[wall].offset == doctest::Approx(-by).scale(0).epsilon(0.05));
    CHECK(fidelity.surfaces[wall].rms > 0.04);
    CHECK_FALSE(criterion(fidelity, "off their points").is_met());
  }
}

TEST_CASE("doors that are closed block rays that went through them") {
  World world = world_named("office");
  const PointCloud cloud = scan_of(world, 100000, {place_scanners(world)[0]});
  const Fidelity open = measure_fidelity(world, cloud, options_for(0.03));
  CHECK(open.free_space_violations.value() < 0.001);
  for (const Opening& opening : World(world).openings) {
    if (opening.kind == OpeningKind::window) continue;
    Surface leaf = world.surfaces[static_cast<std::size_t>(opening.surface)];
    leaf.id = static_cast<int>(world.surfaces.size());
    leaf.outer = opening.loop;
    leaf.holes.clear();
    world.surfaces.push_back(leaf);
  }
  const Fidelity closed = measure_fidelity(world, cloud, options_for(0.03));
  CHECK(closed.free_space_violations.value() > 0.02);
  CHECK_FALSE(criterion(closed, "free-space").is_met());
  CHECK(closed.unexplained < 0.001);  // what was seen through the doors is still there
}

TEST_CASE("a wall that is missing leaves points unexplained and lets rays leak") {
  World world = world_named("room");
  const PointCloud cloud = scan_of(world);
  world.surfaces.erase(world.surfaces.begin() + static_cast<std::ptrdiff_t>(largest_wall(world)));
  const Fidelity fidelity = measure_fidelity(world, cloud, options_for(0.04));
  CHECK(fidelity.unexplained > 0.05);
  CHECK(fidelity.leaks.value() > 0.05);
  CHECK(fidelity.free_space_violations.value() < 0.001);
  CHECK_FALSE(criterion(fidelity, "unexplained").is_met());
  CHECK_FALSE(criterion(fidelity, "leaks").is_met());
}

TEST_CASE("a surface where nothing was seen lowers the coverage, unless it is inferred") {
  World world = world_named("room");
  const PointCloud cloud = scan_of(world);
  const Fidelity before = measure_fidelity(world, cloud, options_for(0.04));
  Surface stray = world.surfaces[largest_wall(world)];
  const double wall = area(world, stray);
  world.surfaces.push_back(stray);
  move_surface(world, world.surfaces.size() - 1, 1);
  double whole = 0;
  for (const Surface& s : world.surfaces) whole += area(world, s);
  const Fidelity after = measure_fidelity(world, cloud, options_for(0.04));
  // But where it ends at other surfaces.
  CHECK(after.coverage < before.coverage - 0.7 * wall / whole);
  CHECK(after.surfaces.back().coverage.value() < 0.25);
  world.surfaces.back().source = Source::inferred;
  const Fidelity inferred = measure_fidelity(world, cloud, options_for(0.04));
  CHECK(inferred.coverage == before.coverage);
  CHECK_FALSE(inferred.surfaces.back().coverage);
}

TEST_CASE("distances, shares and a surface's own figures are those computed by hand") {
  // Of 20 points 10 are on the floor, 9 two centimetres over it, one 30 cm beside it.
  std::vector<Vec3> points;
  for (int i = 0; i < 10; ++i) points.emplace_back(0.05 + 0.1 * i, 0.5, 0);
  for (int i = 0; i < 9; ++i) points.emplace_back(0.05 + 0.1 * i, 0.25, 0.02);
  points.emplace_back(1.3, 0.5, 0);
  const Fidelity f = over_floor(points, {.noise = 0.006});
  CHECK(f.points == 20);
  CHECK(f.tolerance == doctest::Approx(0.024));
  CHECK(f.scan_to_world.median < 1e-6);
  CHECK(f.scan_to_world.p95 == doctest::Approx(0.02).scale(0).epsilon(1e-4));
  CHECK(f.unexplained == doctest::Approx(0.05));
  CHECK(over_floor(points, {.noise = 0.004}).unexplained == doctest::Approx(0.5));
  CHECK(f.surfaces[0].points == 19);
  CHECK(f.surfaces[0].rms == doctest::Approx(0.02 * std::sqrt(9.0 / 19)).scale(0).epsilon(1e-4));
  CHECK(f.surfaces[0].area == doctest::Approx(1));
  CHECK(over_floor({{0.5, 0.5, 3}, {0.5, 0.5, 0}}).scan_to_world.p95 == doctest::Approx(0.5));
}

TEST_CASE("the distance to the scan is that of the places on a surface, the coverage their share") {
  // One point in the middle of the square: half of it is nearer than sqrt(1 / 2 pi).
  const Fidelity one = over_floor({{0.5, 0.5, 0}}, {.spacing = 0.05, .max_distance = 2});
  CHECK(one.world_to_scan.median == doctest::Approx(std::sqrt(0.5 / M_PI)).scale(0).epsilon(0.01));
  const double cover = std::hypot(0.2, 0.04);
  CHECK(one.coverage == doctest::Approx(M_PI * cover * cover).scale(0).epsilon(0.01));
  // Points all along one side.
  std::vector<Vec3> side;
  for (int i = 0; i <= 1000; ++i) side.emplace_back(0.001 * i, 0, 0);
  const Fidelity strip = over_floor(side, {.max_distance = 2});
  CHECK(strip.world_to_scan.median == doctest::Approx(0.5).scale(0).epsilon(0.01));
  CHECK(strip.world_to_scan.p95 == doctest::Approx(0.95).scale(0).epsilon(0.01));
}

TEST_CASE("points in an obstacle are explained") {
  World world = small_world();
  std::vector<Vec3> points = {{1, 1, 0}, {3, 1, 0}, {2, 1.5, 0.4}, {2.1, 1.5, 0.6}};
  CHECK(measure_fidelity(world, cloud_of(points)).unexplained == doctest::Approx(0.5));
  world.obstacles.push_back({.shape = OrientedBox{{2, 1.5, 0.5}, {1, 1, 1}}});
  const Fidelity f = measure_fidelity(world, cloud_of(points));
  CHECK(f.unexplained == 0);
  CHECK(f.scan_to_world.p95 < 1e-6);
}

TEST_CASE("the order of the points and the number of threads change nothing") {
  World world = world_named("room");
  move_surface(world, largest_wall(world), 0.03);
  PointCloud cloud = scan_of(world_named("office"), 80000);
  FidelityOptions options = options_for(0.04);
  options.points = 20000;
  std::vector<double> first;
  for (int threads : {1, 2, 4})
    for (bool shuffled : {false, true}) {
      const ThreadLimit limit(threads);
      if (shuffled) shuffle_points(cloud, static_cast<std::uint64_t>(threads));
      const Fidelity fidelity = measure_fidelity(world, cloud, options);
      CHECK(fidelity.points > 19000);
      CHECK(fidelity.points < 21000);
      if (first.empty()) first = figures(fidelity);
      CHECK(figures(fidelity) == first);
    }
}

TEST_CASE("a part of the points tells what all of them tell") {
  const World world = world_named("office");
  const PointCloud cloud = virtual_scan(world, {.points = 150000, .outliers = 0.02}).cloud;
  FidelityOptions some = options_for(0.04), all = options_for(0.04);
  some.points = 30000, all.points = 1000000;
  const Fidelity a = measure_fidelity(world, cloud, some), b = measure_fidelity(world, cloud, all);
  CHECK(b.points == 150000);
  CHECK(a.unexplained == doctest::Approx(b.unexplained).scale(0).epsilon(0.15));
  CHECK(a.scan_to_world.median == doctest::Approx(b.scan_to_world.median).scale(0).epsilon(0.03));
  CHECK(a.coverage == b.coverage);
}

TEST_CASE("scan and world may have different origins") {
  const World world = world_named("room");
  const PointCloud cloud = scan_of(world);
  const Fidelity plain = measure_fidelity(world, cloud, options_for(0.04));
  // The same place in map coordinates: the file's are the sum of origin and coordinate in both.
  const Vec3 far(512000, 5120000, 256);
  World moved = world;
  moved.frame.origin = far;
  PointCloud other = cloud;
  other.origin = far + Vec3(16, -32, 0);
  for (Vec3f& p : other.points) p -= Vec3f(16, -32, 0);
  for (Vec3& v : other.viewpoints) v -= Vec3(16, -32, 0);
  const Fidelity there = measure_fidelity(moved, other, options_for(0.04));
  CHECK(there.is_faithful());
  CHECK(there.scan_to_world.median ==
        doctest::Approx(plain.scan_to_world.median).scale(0).epsilon(0.001));
  CHECK(there.free_space_violations.value() < 0.001);
}

TEST_CASE("a depth camera's far points may be farther off") {
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 100; ++k)
      points.emplace_back(0.01 * i, 0.01 * k, (i + k) % 2 ? 0.04 : -0.04);
  PointCloud cloud = cloud_of(points);
  cloud.viewpoints = {{0.5, 0.5, 4}};
  const World world = assemble_world(
      {{.plane = {Vec3::UnitZ(), 0}, .outer = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}}, {});
  CHECK(measure_fidelity(world, cloud, {.noise = 0.001}).unexplained == 1);
  const Fidelity f = measure_fidelity(world, cloud, {.noise = 0.001, .depth_step = 0.0015});
  CHECK(f.unexplained == 0);
  CHECK(f.noise > 0.02);
}

TEST_CASE("the tolerance is never more than 5 cm, however noisy the scan is said to be") {
  std::vector<Vec3> points;
  for (int i = 0; i < 40; ++i)
    for (int k = 0; k < 40; ++k) points.emplace_back(0.025 * i, 0.025 * k, 0.002 * (i % 10));
  for (const double noise : {0.001, 0.005, 0.01, 0.1, 1.0}) {
    const Fidelity f = over_floor(points, {.noise = noise});
    CHECK(f.tolerance >= 0.01);
    CHECK(f.tolerance <= 0.05);
    CHECK(criterion(f, "median").limit <= 0.02);
  }
  CHECK(over_floor(points, {.noise = 0.005}).tolerance ==
        doctest::Approx(0.02).scale(0).epsilon(0.1));
}

TEST_CASE(
    "random points are not faithful to planes through them, whatever their noise is taken for") {
  Random random(3);
  std::vector<Vec3> points;
  for (int i = 0; i < 100000; ++i)
    points.emplace_back(2 * random.uniform(), 2 * random.uniform(), 2 * random.uniform());
  std::vector<FoundSurface> planes;
  for (int i = 0; i < 4; ++i) {
    const double at = (i + 0.5) / 2;
    planes.push_back(level_rectangle(0, 0, 2, 2, at));
    planes.push_back(upright_rectangle({0, at, 0}, {2, at, 0}, 2));
  }
  const World world = world_with(planes);
  for (const double noise : {0.01, 0.05, 0.3}) {
    const Fidelity f = measure_fidelity(world, cloud_of(points), {.noise = noise});
    CHECK_FALSE(f.is_faithful());
    CHECK(f.close < 0.6);
    CHECK_FALSE(criterion(f, "close").is_met());
    CHECK_FALSE(criterion(f, "crossing").is_met());
  }
}

TEST_CASE("what is not asked is said: rays without viewpoints, floors where there are none") {
  const Fidelity with_floor = over_floor({{0.5, 0.5, 0}});
  CHECK(criterion(with_floor, "leaks").lacking == "viewpoints");
  CHECK(criterion(with_floor, "gaps in floors").value);
  World wall = world_with({upright_rectangle({0, 0, 0}, {1, 0, 0}, 1)});
  const Fidelity without = measure_fidelity(wall, cloud_of({{0.5, 0, 0.5}}));
  for (const char* name : {"floor pieces", "steps in floors", "gaps in floors"}) {
    CHECK_FALSE(criterion(without, name).value);
    CHECK(criterion(without, name).lacking == "floor");
    CHECK(criterion(without, name).is_met());
  }
}

TEST_CASE("a floor in steps, with gaps or a floating piece is not faithful") {
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 100; ++k) points.emplace_back(0.04 * (i + 0.5), 0.04 * (k + 0.5), 0.004);
  const auto judged = [&](const std::vector<FoundSurface>& floors) {
    World world = world_with(floors);
    for (Surface& s : world.surfaces) s.kind = Kind::floor;
    return measure_fidelity(world, cloud_of(points), {.noise = 0.002});
  };
  CHECK(judged({level_rectangle(0, 0, 4, 4, 0)}).criteria.size() == 15);
  const Fidelity stepped =
      judged({level_rectangle(0, 0, 2, 4, 0), level_rectangle(2, 0, 4, 4, 0.008)});
  CHECK_FALSE(criterion(stepped, "steps in").is_met());
  CHECK(criterion(stepped, "gaps").is_met());
  const Fidelity parted =
      judged({level_rectangle(0, 0, 1.9, 4, 0), level_rectangle(2, 0, 4, 4, 0)});
  CHECK_FALSE(criterion(parted, "gaps").is_met());
  CHECK(criterion(parted, "steps").is_met());
  std::vector<FoundSurface> strips;
  for (int i = 0; i < 4; ++i) strips.push_back(level_rectangle(i, 0, i + 1, 4, 0));
  CHECK_FALSE(criterion(judged(strips), "pieces").is_met());
  const Fidelity floating =
      judged({level_rectangle(0, 0, 2, 4, 0), level_rectangle(2.6, 0, 4, 4, 0)});
  CHECK_FALSE(criterion(floating, "floating").is_met());
}

TEST_CASE("scans of another place and empty ones are refused") {
  World world = world_named("room");
  const PointCloud cloud = scan_of(world, 5000);
  world.frame.origin = {100, 0, 0};
  CHECK(contains(error_of(Cause::bad_input, [&] { measure_fidelity(world, cloud); }),
                 "different places"));
  CHECK(contains(error_of(Cause::bad_input, [&] { measure_fidelity({}, cloud); }),
                 "different places"));
  error_of(Cause::bad_input, [&] { measure_fidelity(world, {}); });
}
