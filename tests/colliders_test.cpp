// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/colliders.h"

#include <functional>

#include "polygon.h"
#include "support/scenes.h"
#include "world/assemble.h"
#include "world/ray_scene.h"
#include "world/thickness.h"
#include "world/validate.h"
#include "world/virtual_scan.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A polygon that looks to where its corners are counter-clockwise.
FoundSurface face(const std::vector<Vec3>& outer,
                  const std::vector<std::vector<Vec3>>& holes = {}) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < outer.size(); ++i)
    sum += (outer[i] - outer[0]).cross(outer[i + 1] - outer[0]);
  return {.plane = plane_through(outer[0], sum.normalized()), .outer = outer, .holes = holes};
}

// The faces of a prism over a counter-clockwise plan, seen from inside (a room) or outside (a
// thing).
std::vector<FoundSurface> prism(const std::vector<Vec2>& plan, double low, double high, bool inside,
                                bool bottom = true) {
  std::vector<std::vector<Vec3>> rings(2);
  for (const Vec2& p : plan) {
    rings[0].insert(rings[0].begin(), {p.x(), p.y(), low});
    rings[1].push_back({p.x(), p.y(), high});
  }
  if (!bottom) rings.erase(rings.begin());
  for (std::size_t i = 0; i < plan.size(); ++i) {
    const Vec2 &p = plan[i], &q = plan[(i + 1) % plan.size()];
    rings.push_back(
        {{p.x(), p.y(), low}, {q.x(), q.y(), low}, {q.x(), q.y(), high}, {p.x(), p.y(), high}});
  }
  std::vector<FoundSurface> faces;
  for (auto& ring : rings) {
    if (inside) std::reverse(ring.begin(), ring.end());
    faces.push_back(face(ring));
  }
  return faces;
}

std::vector<Vec2> ring_of(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

World with_colliders(World world) {
  set_thickness(world, pair_faces(world));
  world.colliders = make_colliders(world);
  CHECK(validate(world).empty());
  return world;
}

World world_of(const std::vector<std::vector<FoundSurface>>& groups) {
  std::vector<FoundSurface> all;
  for (const auto& group : groups) all.insert(all.end(), group.begin(), group.end());
  return with_colliders(assemble_world(all, {}));
}

// A world of the colliders alone.
World solids_of(const World& world) {
  World solids;
  for (const Collider& c : world.colliders) {
    Obstacle obstacle{.id = static_cast<int>(solids.obstacles.size()), .shape = {}};
    if (const auto* box = std::get_if<OrientedBox>(&c.shape)) {
      obstacle.shape = *box;
    } else {
      const auto& p = std::get<ConvexPrism>(c.shape);
      ConvexHull hull{p.base};
      for (const Vec3& v : p.base) hull.vertices.push_back(v + p.extrusion);
      obstacle.shape = hull;
    }
    solids.obstacles.push_back(obstacle);
  }
  return solids;
}

// From these places rays meet colliders where they meet surfaces, and none gets out.
void check_closed(const World& world, const std::vector<Vec3>& places, int rays = 2000) {
  const World solids = solids_of(world);
  const RayScene surfaces(world), colliders(solids);
  Random random(4);
  for (const Vec3& place : places)
    for (int i = 0; i < rays; ++i) {
      const Vec3 way = random.direction();
      const auto truth = surfaces.cast(place, way), hit = colliders.cast(place, way);
      if (!truth || !truth->is_surface) continue;
      REQUIRE_MESSAGE(hit, place.transpose() << " along " << way.transpose());
      const double cosine = std::abs(world.surfaces[truth->index].plane.normal.dot(way));
      const double off = (hit->distance - truth->distance) * cosine;
      CHECK_MESSAGE((off > -0.0015 && off < 0.0025),
                    place.transpose() << " along " << way.transpose() << ": " << off);
    }
}

Vec3 point_in(const Collider& c, Random& random) {
  const Vec3 share(random.uniform(), random.uniform(), random.uniform());
  if (const auto* box = std::get_if<OrientedBox>(&c.shape))
    return box->center + box->rotation * (share - Vec3::Constant(0.5)).cwiseProduct(box->size);
  const auto& p = std::get<ConvexPrism>(c.shape);
  Vec3 sum = Vec3::Zero();
  double weight = 0;
  for (const Vec3& v : p.base) {
    const double w = -std::log(random.uniform(1e-9, 1));
    sum += w * v, weight += w;
  }
  return sum / weight + share.z() * p.extrusion;
}

// The share of the colliders' volume, roughly, that is in free space.
double free_share(const World& world, const std::function<bool(const Vec3&)>& is_free) {
  Random random(6);
  int bad = 0, all = 0;
  for (const Collider& c : world.colliders)
    for (int i = 0; i < 300; ++i, ++all) bad += is_free(point_in(c, random));
  return static_cast<double>(bad) / all;
}

bool is_within(const Vec3& p, const Vec3& low, const Vec3& high, double margin = 0.0011) {
  return ((p - low).array() > margin).all() && ((high - p).array() > margin).all();
}

std::size_t boxes(const World& world) {
  return static_cast<std::size_t>(
      std::count_if(world.colliders.begin(), world.colliders.end(),
                    [](const Collider& c) { return c.shape.index() == 0; }));
}

}  // namespace

TEST_CASE("a room is a box a face, off its inside, and closed") {
  const World world = world_of({prism(ring_of(0, 0, 5, 4), 0, 2.5, true)});
  CHECK(world.colliders.size() == 6);
  CHECK(boxes(world) == 6);
  CHECK(free_share(world, [](const Vec3& p) { return is_within(p, {0, 0, 0}, {5, 4, 2.5}); }) == 0);
  check_closed(world, {{2.5, 2, 1.2}, {0.01, 0.01, 0.01}, {4.9, 3.99, 2.4}});
  for (const Collider& c : world.colliders)
    CHECK(std::get<OrientedBox>(c.shape).size.minCoeff() == doctest::Approx(0.1));
}

TEST_CASE("a room turned in space is no different") {
  World world = assemble_world(prism(ring_of(0, 0, 5, 4), 0, 2.5, true), {});
  const Eigen::AngleAxisd turn(0.7, Vec3(0.1, 0.2, 1).normalized());
  for (Vec3& v : world.vertices) v = turn * v + Vec3(100, -50, 7);
  for (Surface& s : world.surfaces) {
    const Vec3 normal = turn * s.plane.normal;
    s.plane = plane_through(world.vertices[static_cast<std::size_t>(s.outer[0])], normal);
  }
  world.frame.up = turn * Vec3::UnitZ();
  world = with_colliders(world);
  CHECK(boxes(world) == 6);
  check_closed(world, {turn * Vec3(2.5, 2, 1.2) + Vec3(100, -50, 7)});
}

TEST_CASE("a room with a corner has one box for its floor") {
  const std::vector<Vec2> plan = {{0, 0}, {6, 0}, {6, 3}, {3, 3}, {3, 5}, {0, 5}};
  const World world = world_of({prism(plan, 0, 2.5, true)});
  std::size_t floor_boxes = 0;
  for (const Collider& c : world.colliders)
    floor_boxes += world.surfaces[static_cast<std::size_t>(c.surface)].kind == Kind::floor;
  CHECK(floor_boxes == 1);
  CHECK(world.colliders.size() == 6 + 1 + 2);
  CHECK(free_share(world, [](const Vec3& p) {
          return is_within(p, {0, 0, 0}, {6, 3, 2.5}) || is_within(p, {0, 0, 0}, {3, 5, 2.5});
        }) == 0);
  check_closed(world, {{1, 1, 1}, {5.9, 2.9, 0.1}, {2.9, 4.9, 2.4}});
}

TEST_CASE("rooms that are no rectangles have prisms, closed as well") {
  Random random(8);
  for (int round = 0; round < 20; ++round) {
    std::vector<Vec2> plan;
    const int corners = random.whole(3, 9);
    for (int i = 0; i < corners; ++i) {
      const double r = random.uniform(2, 4),
                   angle = 2 * M_PI * (i + random.uniform(-0.2, 0.2)) / corners;
      plan.push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    const World world = world_of({prism(plan, 0, 2.5, true)});
    check_closed(world, {{0, 0, 1}, {0.1, 0.2, 0.01}}, 1000);
    const std::vector<std::vector<Vec2>> rings = {plan};
    CHECK(free_share(world, [&](const Vec3& p) {
            return p.z() > 0.0011 && p.z() < 2.4989 && is_inside(rings, p.head<2>()) &&
                   distance_to_ring(p.head<2>(), plan) > 0.0011;
          }) == 0);
  }
}

TEST_CASE("doors and windows stay open, and both faces of a wall have the same boxes") {
  // Two rooms, a wall of 10 cm between them with a door and a window in it.
  const auto wall = [](double x) {
    FoundSurface s = face({{x, 0, 0},
                           {x, 1, 0},
                           {x, 1, 2.1},
                           {x, 1.9, 2.1},
                           {x, 1.9, 0},
                           {x, 5, 0},
                           {x, 5, 2.6},
                           {x, 0, 2.6}},
                          {{{x, 3, 0.9}, {x, 3, 2.1}, {x, 4, 2.1}, {x, 4, 0.9}}});
    if (x == 4) {
      s.plane = s.plane.flipped();
      std::reverse(s.outer.begin(), s.outer.end());
      std::reverse(s.holes[0].begin(), s.holes[0].end());
    }
    return s;
  };
  std::vector<FoundSurface> all = {
      wall(4),
      wall(4.1),
      face({{0, 0, 0}, {8.1, 0, 0}, {8.1, 5, 0}, {0, 5, 0}}),
      face({{0, 0, 2.6}, {0, 5, 2.6}, {4, 5, 2.6}, {4, 0, 2.6}}),
      face({{4.1, 0, 2.6}, {4.1, 5, 2.6}, {8.1, 5, 2.6}, {8.1, 0, 2.6}}),
      face({{0, 0, 0}, {0, 5, 0}, {0, 5, 2.6}, {0, 0, 2.6}}),
      face({{8.1, 0, 0}, {8.1, 0, 2.6}, {8.1, 5, 2.6}, {8.1, 5, 0}})};
  for (double x : {0.0, 4.1}) {
    all.push_back(face({{x, 0, 0}, {x, 0, 2.6}, {x + 4, 0, 2.6}, {x + 4, 0, 0}}));
    all.push_back(face({{x, 5, 0}, {x + 4, 5, 0}, {x + 4, 5, 2.6}, {x, 5, 2.6}}));
  }
  // What one sees in the openings.
  all.push_back(face({{4, 1, 0}, {4, 1, 2.1}, {4.1, 1, 2.1}, {4.1, 1, 0}}));
  all.push_back(face({{4, 1.9, 0}, {4.1, 1.9, 0}, {4.1, 1.9, 2.1}, {4, 1.9, 2.1}}));
  all.push_back(face({{4, 1, 2.1}, {4, 1.9, 2.1}, {4.1, 1.9, 2.1}, {4.1, 1, 2.1}}));
  all.push_back(face({{4, 3, 0.9}, {4.1, 3, 0.9}, {4.1, 4, 0.9}, {4, 4, 0.9}}));
  all.push_back(face({{4, 3, 2.1}, {4, 4, 2.1}, {4.1, 4, 2.1}, {4.1, 3, 2.1}}));
  all.push_back(face({{4, 3, 0.9}, {4, 3, 2.1}, {4.1, 3, 2.1}, {4.1, 3, 0.9}}));
  all.push_back(face({{4, 4, 0.9}, {4.1, 4, 0.9}, {4.1, 4, 2.1}, {4, 4, 2.1}}));
  const World world = with_colliders(assemble_world(all, {}));
  std::size_t in_wall = 0;
  for (const Collider& c : world.colliders) in_wall += c.surface <= 1;
  CHECK(in_wall == 5);  // and none for the jambs
  CHECK(world.colliders.size() <= 14);
  const World solids = solids_of(world);
  const RayScene scene(solids);
  CHECK(scene.is_free({3, 1.002, 0.003}, {5, 1.002, 0.003}));
  CHECK(scene.is_free({3, 1.898, 2.098}, {5, 1.898, 2.098}));
  CHECK(scene.is_free({3, 3.002, 0.902}, {5, 3.998, 2.098}));
  CHECK(free_share(world, [](const Vec3& p) {
          return is_within(p, {0, 0, 0}, {4, 5, 2.6}) || is_within(p, {4.1, 0, 0}, {8.1, 5, 2.6}) ||
                 is_within(p, {3.9, 1, 0}, {4.2, 1.9, 2.1}) ||
                 is_within(p, {3.9, 3, 0.9}, {4.2, 4, 2.1});
        }) == 0);
  check_closed(world, {{2, 2, 1}, {6, 1, 2}, {3.99, 4.9, 0.05}});
}

TEST_CASE("a free-standing partition is one box as thick as it is") {
  for (double thickness : {0.03, 0.1, 0.25}) {
    const World world = world_of({prism(ring_of(1, 1, 4, 1 + thickness), 0, 1.8, false, false),
                                  {face({{-1, -1, 0}, {6, -1, 0}, {6, 4, 0}, {-1, 4, 0}})}});
    CHECK(world.colliders.size() == 2);
    CHECK(free_share(world, [&](const Vec3& p) {
            return p.z() > 0.0011 && !is_within(p, {1, 1, -1}, {4, 1 + thickness, 1.8}, -0.0011);
          }) == 0);
  }
}

TEST_CASE("things that are closed around are one box; a table leaves the room under it") {
  const FoundSurface floor = face({{-2, -2, 0}, {4, -2, 0}, {4, 4, 0}, {-2, 4, 0}});
  const World cupboard = world_of({{floor}, prism(ring_of(0, 0, 1, 0.5), 0, 0.9, false, false)});
  CHECK(cupboard.colliders.size() == 2);
  check_closed(cupboard, {{2, 2, 1}, {-1, 0.2, 0.3}, {0.5, 0.2, 1.5}});

  const World table = world_of({{floor}, prism(ring_of(0, 0, 1.6, 0.8), 0.7, 0.74, false)});
  CHECK(table.colliders.size() == 2);
  const World solids = solids_of(table);
  CHECK(RayScene(solids).is_free({-1, 0.4, 0.698}, {3, 0.4, 0.698}));

  const World top =
      world_of({{floor, face({{0, 0, 0.74}, {1, 0, 0.74}, {1, 1, 0.74}, {0, 1, 0.74}})}});
  REQUIRE(top.colliders.size() == 2);
  CHECK(std::get<OrientedBox>(top.colliders[1].shape).size.z() == doctest::Approx(0.04));
}

TEST_CASE("stairs are closed, with no more than a box a step for tread and riser") {
  std::vector<FoundSurface> all = {face({{-2, 0, 0}, {0, 0, 0}, {0, 1, 0}, {-2, 1, 0}})};
  const int steps = 6;
  for (int i = 0; i < steps; ++i) {
    const double x = 0.28 * i, z = 0.17 * i;
    all.push_back(face({{x, 0, z}, {x, 0, z + 0.17}, {x, 1, z + 0.17}, {x, 1, z}}));
    all.push_back(face(
        {{x, 0, z + 0.17}, {x + 0.28, 0, z + 0.17}, {x + 0.28, 1, z + 0.17}, {x, 1, z + 0.17}}));
  }
  const World world = world_of({all});
  CHECK(world.colliders.size() <= 1 + 2 * steps);
  CHECK(free_share(world, [&](const Vec3& p) {
          if (p.x() < 0 || p.x() > 0.28 * steps) return p.x() < -0.0011 && p.z() > 0.0011;
          return p.z() > 0.17 * (std::floor((p.x() + 0.0011) / 0.28) + 1) + 0.0011;
        }) == 0);
  check_closed(world, {{-1, 0.5, 1.2}, {0.8, 0.1, 2}});
}

TEST_CASE("a ramp is a box along it") {
  const World world = world_of({{face({{0, 0, 0}, {3, 0, 0.6}, {3, 1.5, 0.6}, {0, 1.5, 0}}),
                                 face({{-3, -1, 0}, {0, -1, 0}, {0, 2, 0}, {-3, 2, 0}})}});
  CHECK(boxes(world) == 2);
  CHECK(free_share(world,
                   [](const Vec3& p) { return p.z() > std::max(0.0, 0.2 * p.x()) + 0.0012; }) == 0);
  check_closed(world, {{-1, 0.5, 1}, {1.5, 0.7, 2}});
}

TEST_CASE("what one looks down into is not floored over") {
  // Two storeys and a hole between them.
  const std::vector<Vec3> hole = {{2, 2, 2.8}, {2, 3, 2.8}, {4, 3, 2.8}, {4, 2, 2.8}};
  const World world =
      world_of({{face({{0, 0, 0}, {6, 0, 0}, {6, 5, 0}, {0, 5, 0}}),
                 face({{0, 0, 2.8}, {6, 0, 2.8}, {6, 5, 2.8}, {0, 5, 2.8}}, {hole})}});
  const World solids = solids_of(world);
  const RayScene scene(solids);
  CHECK(world.colliders.size() == 5);
  CHECK(scene.is_free({2.002, 2.002, 4}, {2.002, 2.002, 1}));
  CHECK(scene.is_free({3.998, 2.998, 4}, {3.998, 2.998, 1}));
  CHECK_FALSE(scene.is_free({1.99, 2.5, 4}, {1.99, 2.5, 1}));
  // A hole that nobody looked into is nothing but a floor that was hidden.
  const World hidden =
      world_of({{face({{0, 0, 2.8}, {6, 0, 2.8}, {6, 5, 2.8}, {0, 5, 2.8}}, {hole})}});
  CHECK(hidden.colliders.size() == 1);
}

TEST_CASE("floors of one height are one box, those that differ are not") {
  const auto floor = [](double x, double z) {
    return face({{x, 0, z}, {x + 3, 0, z}, {x + 3, 4, z}, {x, 4, z}});
  };
  CHECK(world_of({{floor(0, 0), floor(3.1, 0.0005), floor(6.2, 0)}}).colliders.size() == 1);
  CHECK(world_of({{floor(0, 0), floor(3.1, 0.02), floor(6.2, 0)}}).colliders.size() == 2);
}

TEST_CASE("the worlds have few colliders, closed and off all that can be seen") {
  for (const char* name : {"room", "office", "stairs"}) {
    CAPTURE(name);
    const World world =
        with_colliders(read_world(in_project(std::string("worlds/") + name + ".json")));
    CHECK(world.colliders.size() < world.surfaces.size());
    const std::vector<Vec3> places = place_scanners(world);
    check_closed(world, places, 3000);
    const RayScene scene(world);
    CHECK(free_share(world, [&](const Vec3& p) {
            return std::any_of(places.begin(), places.end(), [&](const Vec3& place) {
              const Vec3 way = (p - place).normalized();
              const auto hit = scene.cast(place, way);
              if (!hit || !hit->is_surface) return false;
              const Plane& plane = world.surfaces[hit->index].plane;
              return plane.signed_distance(p) > 0.0015 && hit->distance > (p - place).norm();
            });
          }) < 0.001);
  }
}

TEST_CASE("the same colliders whatever the order of the surfaces") {
  const World world = with_colliders(read_world(in_project("worlds/stairs.json")));
  CHECK(make_colliders(world) == world.colliders);
  const World none = with_colliders({});
  CHECK(none.colliders.empty());
}

TEST_CASE("ground has a prism straight down under each facet, with sides in common") {
  World world = assemble_world(
      {face({{0, 0, 0}, {4, 0, 0}, {4, 3, 1}}), face({{0, 0, 0}, {4, 3, 1}, {0, 3, 0.5}})},
      Frame{});
  for (Surface& s : world.surfaces) s.ground = true;
  const std::vector<Collider> colliders = make_colliders(world);
  REQUIRE(colliders.size() == 2);
  for (const Collider& c : colliders) {
    const auto& prism = std::get<ConvexPrism>(c.shape);
    CHECK(prism.extrusion == Vec3(0, 0, -0.5));
    const Surface& s = *find_surface(world, c.surface);
    REQUIRE(prism.base.size() == s.outer.size());
    for (const Vec3& p : prism.base)
      CHECK(std::any_of(s.outer.begin(), s.outer.end(), [&](int v) {
        return (world.vertices[static_cast<std::size_t>(v)] - p).norm() < 1e-9;
      }));
  }
}
