// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Exported worlds, as the engines see them that they are written for (tests/consumers/).
#include <sstream>

#include "exporters/assimp.h"
#include "exporters/bodies.h"
#include "exporters/export.h"
#include "mesh_rays.h"
#include "support/engines.h"
#include "support/scenes.h"
#include "world/level.h"
#include "world/ray_scene.h"
#include "world/triangulate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

const std::vector<std::string> kPlaces = {"room", "office", "stairs"};

World place(const std::string& name) { return read_world(in_project("worlds/" + name + ".json")); }

// Engines have round cylinders, where our rays meet 24 flat faces.
World without_cylinders(World world) {
  std::erase_if(world.obstacles,
                [](const Obstacle& o) { return std::holds_alternative<Cylinder>(o.shape); });
  return world;
}

std::string text(const Vec3& v) { return text_of(v); }

struct Ray {
  Vec3 from, direction;
};

bool is_floor(const World& world, const Hit& hit) {
  if (!hit.is_surface) return false;
  const Surface& s = world.surfaces[hit.index];
  return s.kind == Kind::floor && s.plane.normal.dot(world.frame.up) > 0.9999;
}

bool rests_on_floor(const World& world, const RayScene& scene, const Vec3& ball, double radius) {
  const auto hit = scene.cast(ball, -world.frame.up);
  return hit && is_floor(world, *hit) && std::abs(hit->distance - radius) < 0.01;
}

// Whether what a ray meets is the free side of it, and no cupboard from within.
bool meets_front(const World& world, const RayScene& scene, const Ray& ray) {
  const auto hit = scene.cast(ray.from, ray.direction);
  return !hit || !hit->is_surface || world.surfaces[hit->index].plane.normal.dot(ray.direction) < 0;
}

// The height over the floor of a point in free space with a level floor below and nothing within
// 20 cm.
std::optional<double> height_over_floor(const World& world, const RayScene& scene, const Vec3& p) {
  if (scene.nearest(p, 0.2)) return std::nullopt;
  for (int k = 0; k < 3; ++k)
    for (double sign : {-1, 1})
      if (!meets_front(world, scene, {p, sign * Vec3::Unit(k)})) return std::nullopt;
  const auto hit = scene.cast(p, -world.frame.up);
  return hit && is_floor(world, *hit) ? std::optional(hit->distance) : std::nullopt;
}

// Places in free space, over floors.
std::vector<Vec3> free_places(const World& world, const RayScene& scene, std::size_t count,
                              std::uint64_t seed) {
  Random random(seed);
  const Box3 box = bounds(world);
  std::vector<Vec3> places;
  while (places.size() < count) {
    Vec3 p;
    for (int k = 0; k < 3; ++k) p[k] = random.uniform(box.min()[k], box.max()[k]);
    const auto height = height_over_floor(world, scene, p);
    if (height && *height < 2) places.push_back(p);
  }
  return places;
}

// Leaves out places that are near an earlier one, seen from above, so that balls do not meet.
void keep_apart(std::vector<Vec3>& places, double distance) {
  std::vector<Vec3> kept;
  for (const Vec3& p : places)
    if (std::all_of(kept.begin(), kept.end(),
                    [&](const Vec3& q) { return (p - q).head<2>().norm() > distance; }))
      kept.push_back(p);
  places = kept;
}

// A place in a room: over a floor, and amid the room's surfaces.
Vec3 place_in(const Room& room, const World& world, const RayScene& scene) {
  for (std::uint64_t seed = 1; seed < 1000; ++seed) {
    const Vec3 p = free_places(world, scene, 1, seed)[0];
    int around = 0;
    for (const Vec3& way : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 1, 0), Vec3(0, -1, 0)}) {
      const auto hit = scene.cast(p, way);
      if (hit && hit->is_surface)
        around += static_cast<int>(
            std::count(room.surfaces.begin(), room.surfaces.end(), world.surfaces[hit->index].id));
    }
    if (around >= 3) return p;
  }
  FAIL("no place in " << room.name);
  return {};
}

std::vector<Ray> free_rays(const World& world, const RayScene& scene, std::size_t count) {
  Random random(11);
  std::vector<Ray> rays;
  for (const Vec3& p : free_places(world, scene, count, 7)) {
    Ray ray{p, random.direction()};
    while (!meets_front(world, scene, ray)) ray.direction = random.direction();
    rays.push_back(ray);
  }
  return rays;
}

std::string orders_of(const std::vector<Ray>& rays, const std::string& order = "ray") {
  std::string orders;
  for (const Ray& r : rays) orders += order + " " + text(r.from) + " " + text(r.direction) + "\n";
  return orders;
}

// The share of rays whose depth in an engine is that of the world to 2 mm.
double share_alike(const RayScene& scene, const std::vector<Ray>& rays,
                   const std::vector<double>& depths) {
  REQUIRE(depths.size() == rays.size());
  std::size_t alike = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const auto hit = scene.cast(rays[i].from, rays[i].direction);
    alike += std::abs((hit ? hit->distance : -1) - depths[i]) < 0.002;
  }
  return static_cast<double>(alike) / static_cast<double>(rays.size());
}

std::vector<double> depths_in(const Engine& engine, const std::filesystem::path& file,
                              const std::vector<Ray>& rays, const std::string& order = "ray") {
  std::vector<double> depths;
  for (const std::string& line : ask(engine, file, orders_of(rays, order)))
    depths.push_back(numbers_in(line).at(0));
  return depths;
}

std::vector<double> depths_in(const MeshRays& mesh, const std::vector<Ray>& rays) {
  std::vector<double> depths;
  for (const Ray& r : rays) {
    const auto hit = mesh.cast(r.from, r.direction);
    depths.push_back(hit ? hit->distance : -1);
  }
  return depths;
}

// The kinds of rays whose depth is to be exact. Bullet meets convex solids by iteration, some
// millimetres off, which is why there is a mesh for rays.
std::vector<std::string> exact_rays(const Engine& engine) {
  if (engine.extension == "bullet") return {"ray"};
  return {"ray", "probe"};
}

// A door, from one side of the wall to the other.
struct Doorway {
  int id;
  Vec3 middle, normal, along;
  double width, height;
};

std::vector<Doorway> doorways(const World& world) {
  std::vector<Doorway> all;
  for (const Opening& o : world.openings) {
    if (o.kind == OpeningKind::window) continue;
    const auto s = std::find_if(world.surfaces.begin(), world.surfaces.end(),
                                [&](const Surface& surface) { return surface.id == o.surface; });
    Box3 box;
    for (int v : o.loop) box.extend(world.vertices[static_cast<std::size_t>(v)]);
    const Vec3 along = s->plane.normal.cross(world.frame.up).normalized();
    all.push_back({o.id, box.center(), s->plane.normal, along, o.width, o.height});
  }
  return all;
}

// What a robot that is 10 cm smaller than the door does to get from 60 cm before it to 60 cm
// behind, 5 cm over the floor.
std::string sweep_order(const Doorway& door) {
  const Vec3 size(0.4, door.width - 0.1, std::min(door.height, 1.8) - 0.1);
  const Vec3 middle = door.middle + Vec3(0, 0, 0.05 + size.z() / 2 - door.height / 2);
  return "sweep " + text(middle + 0.6 * door.normal) + " " + text(middle - 0.6 * door.normal) +
         " " + text(size) + " " + text_of(std::atan2(door.normal.y(), door.normal.x())) + "\n";
}

// Rays through a door, on a grid over it.
std::vector<Ray> rays_through(const Doorway& door) {
  std::vector<Ray> rays;
  for (double u : {-0.45, -0.2, 0.0, 0.2, 0.45})
    for (double v : {-0.45, 0.0, 0.45})
      rays.push_back({door.middle + u * door.width * door.along + v * door.height * Vec3::UnitZ() +
                          0.3 * door.normal,
                      -door.normal});
  return rays;
}

}  // namespace

TEST_CASE("the same rays meet the world at the same depth in every engine") {
  for (const std::string& name : kPlaces) {
    const World world = without_cylinders(place(name));
    const RayScene scene(world);
    const std::vector<Ray> rays = free_rays(world, scene, 1000);
    const TempFolder folder;
    for (const Engine& engine : present({kBullet, kBullet64, kMuJoCo, kMuJoCo3, kDart, kUrdf})) {
      const auto file = folder / ("world." + engine.extension);
      export_world(world, file);
      for (const std::string& order : exact_rays(engine))
        CHECK_MESSAGE(share_alike(scene, rays, depths_in(engine, file, rays, order)) == 1,
                      name << " in " << engine.name << ": " << order);
    }
    CHECK_MESSAGE(share_alike(scene, rays, depths_in(MeshRays(reread(world, "stl")), rays)) == 1,
                  name << " in STL");
  }
}

TEST_CASE("rays pass through every door, in every engine as in the world") {
  for (const std::string& name : kPlaces) {
    const World world = place(name);
    const RayScene scene(world);
    std::vector<Ray> rays;
    for (const Doorway& door : doorways(world))
      for (const Ray& ray : rays_through(door)) {
        CHECK_MESSAGE(scene.is_free(ray.from, ray.from + 0.6 * ray.direction),
                      name << " " << door.id);
        rays.push_back(ray);
      }
    const TempFolder folder;
    for (const char* format : {"stl", "obj", "ply", "dae", "3mf", "glb"})
      for (double depth : depths_in(MeshRays(reread(world, format)), rays))
        CHECK_MESSAGE((depth < 0 || depth > 0.6), name << " in " << format);
    for (const Engine& engine : present({kBullet, kBullet64, kMuJoCo, kMuJoCo3, kDart, kUrdf})) {
      const auto file = folder / ("world." + engine.extension);
      export_world(world, file);
      for (const std::string order : {"ray", "probe"})
        for (double depth : depths_in(engine, file, rays, order))
          CHECK_MESSAGE((depth < 0 || depth > 0.6), name << " in " << engine.name);
    }
  }
}

TEST_CASE("a robot that fits gets through every door, and not through the wall beside it") {
  for (const std::string name : {"office", "stairs"}) {
    const World world = place(name);
    std::string orders;
    const auto doors = doorways(world);
    REQUIRE(!doors.empty());
    for (Doorway door : doors) {
      orders += sweep_order(door);
      door.middle += 0.5 * door.width * door.along;
      orders += sweep_order(door);
    }
    const TempFolder folder;
    for (const Engine& engine : {kBullet, kMuJoCo}) {
      const auto file = folder / ("world." + engine.extension);
      export_world(world, file);
      const std::vector<std::string> answers = ask(engine, file, orders);
      REQUIRE(answers.size() == 2 * doors.size());
      for (std::size_t i = 0; i < doors.size(); ++i) {
        CHECK_MESSAGE(answers[2 * i] == "free",
                      name << " " << doors[i].id << " in " << engine.name);
        CHECK_MESSAGE(answers[2 * i + 1] == "blocked",
                      name << " " << doors[i].id << " in " << engine.name);
      }
    }
  }
}

TEST_CASE("balls that are dropped in each room and all over a place come to rest on its floor") {
  const double radius = 0.1, seconds = 3;
  for (const std::string& name : kPlaces) {
    const World world = place(name);
    const RayScene scene(world);
    std::vector<Vec3> from = free_places(world, scene, 20, 3);
    for (const Room& room : world.rooms) from.push_back(place_in(room, world, scene));
    keep_apart(from, 6 * radius);
    std::string orders = "drop " + text_of(radius) + " " + text_of(seconds);
    for (const Vec3& p : from) orders += " " + text(p);
    const TempFolder folder;
    for (const Engine& engine : present({kBullet, kBullet64, kMuJoCo, kMuJoCo3, kDart})) {
      const auto file = folder / ("world." + engine.extension);
      export_world(world, file);
      const auto lines = ask(engine, file, orders + "\n");
      REQUIRE_MESSAGE(lines.size() == 1, engine.name << ": " << (lines.empty() ? "" : lines[0]));
      const std::vector<double> ends = numbers_in(lines[0]);
      REQUIRE(ends.size() == 3 * from.size());
      for (std::size_t i = 0; i < from.size(); ++i) {
        const Vec3 end(ends[3 * i], ends[3 * i + 1], ends[3 * i + 2]);
        CHECK_MESSAGE(rests_on_floor(world, scene, end, radius),
                      name << " in " << engine.name << " from " << text(from[i]));
      }
    }
  }
}

TEST_CASE("solids have the same names in every engine, and gravity is against the world's up") {
  World world = place("office");
  world = moved(world, Eigen::Quaterniond(Eigen::AngleAxisd(0.1, Vec3::UnitX())), Vec3::Zero());
  std::string expected;
  for (const ExportBody& body : export_bodies(prepare_export(world, {}), {}))
    expected += body.name + " ";
  const TempFolder folder;
  for (const Engine& engine : present({kBullet, kBullet64, kMuJoCo, kMuJoCo3, kDart, kUrdf})) {
    const auto file = folder / ("world." + engine.extension);
    export_world(world, file);
    CHECK_MESSAGE(ask(engine, file, "names\n") == std::vector{expected}, engine.name);
    if (engine.name == kUrdf.name) continue;  // has no gravity
    const auto answers = ask(engine, file, "gravity\n");
    REQUIRE(answers.size() == 1);
    const std::vector<double> g = numbers_in(answers[0]);
    CHECK((Vec3(g[0], g[1], g[2]) + 9.81 * world.frame.up).norm() < 1e-4);
  }
}

TEST_CASE("the world of a scan is the same in every engine, and holds what falls on its floor") {
  const TempFolder folder;
  const Outcome built = run({"build", in_project("data/office.ply").string(), "-o",
                             folder / "office", "--export", "none"});
  REQUIRE_MESSAGE(built.code == 0, built.err);
  const World world = without_cylinders(read_world(folder / "office"));
  export_all(world, folder / "all");
  const RayScene scene(world);
  const std::vector<Ray> rays = free_rays(world, scene, 1000);
  std::vector<Vec3> from = free_places(world, scene, 20, 3);
  keep_apart(from, 0.6);
  std::string drop = "drop 0.1 3";
  for (const Vec3& p : from) drop += " " + text(p);
  for (const Engine& engine : present({kBullet, kBullet64, kMuJoCo, kMuJoCo3, kDart, kUrdf})) {
    const auto file = folder / "all" / ("world." + engine.extension);
    CHECK_MESSAGE(share_alike(scene, rays, depths_in(engine, file, rays)) == 1, engine.name);
    // Solids are as thick as walls, so that rays that leave by a window may meet its sides.
    if (exact_rays(engine).size() > 1)
      CHECK_MESSAGE(share_alike(scene, rays, depths_in(engine, file, rays, "probe")) > 0.95,
                    engine.name);
    if (engine.name == kUrdf.name) continue;  // has no balls
    const auto lines = ask(engine, file, drop + "\n");
    REQUIRE(lines.size() == 1);
    const std::vector<double> ends = numbers_in(lines[0]);
    for (std::size_t i = 0; i < from.size(); ++i)
      CHECK_MESSAGE(
          rests_on_floor(world, scene, {ends[3 * i], ends[3 * i + 1], ends[3 * i + 2]}, 0.1),
          engine.name << " from " << text(from[i]));
  }
}

TEST_CASE("an exported folder works after it was moved, also with odd characters in its name") {
  const World world = place("office");
  const RayScene scene(world);
  const std::vector<Ray> rays = free_rays(world, scene, 20);
  const TempFolder folder;
  const auto moved_to = folder / "a \"place\" & <more> \u00fc";
  CHECK(export_all(world, folder / "all").empty());
  std::filesystem::rename(folder / "all", moved_to);
  for (const Engine& engine : present({kBullet, kMuJoCo, kMuJoCo3, kDart, kUrdf}))
    CHECK_MESSAGE(ask(engine, moved_to / ("world." + engine.extension), orders_of(rays)).size() ==
                      rays.size(),
                  engine.name);
  CHECK(read_mesh(moved_to / "world.obj").triangles.size() > 0);
}

TEST_CASE("file names with odd characters are written so that engines load them") {
  for (const Engine& engine : present({kBullet, kMuJoCo, kMuJoCo3, kDart, kUrdf})) {
    const TempFolder folder;
    const auto file = folder / ("3 rooms & \"more\" <of> \u00fc." + engine.extension);
    export_world(small_world(), file);
    CHECK_MESSAGE(ask(engine, file, "names\n").size() == 1, engine.name);
  }
}

TEST_CASE("an empty world and a world five kilometres wide load in every engine") {
  const World one = small_world(), wide = scaled(one, 1250);
  for (const Engine& engine : present({kBullet, kBullet64, kMuJoCo, kMuJoCo3, kDart, kUrdf})) {
    const TempFolder folder;
    const auto names = [&](const World& world, const std::string& name) {
      const auto file = folder / (name + "." + engine.extension);
      export_world(world, file);
      return ask(engine, file, "names\n");
    };
    CHECK_MESSAGE(names({}, "empty").size() == 1, engine.name);
    CHECK_MESSAGE(names(one, "one") == names(wide, "wide"), engine.name);
  }
}
