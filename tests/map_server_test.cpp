// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "exporters/map_server.h"

#include <sstream>

#include "exporters/export.h"
#include "support/scenes.h"
#include "world/level.h"
#include "world/ray_scene.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// What map_server makes of the two files: by its documentation, not by our writer.
struct ServedMap {
  double resolution = 0, x = 0, y = 0, yaw = 0;
  std::size_t width = 0, height = 0;
  // Row by row from the lowest y: 100 occupied, 0 free, -1 unknown, in mode raw also between.
  std::vector<int> cells;

  int at(const Vec2& p) const {
    const auto column = static_cast<long>(std::floor((p.x() - x) / resolution)),
               row = static_cast<long>(std::floor((p.y() - y) / resolution));
    if (column < 0 || row < 0 || column >= static_cast<long>(width) ||
        row >= static_cast<long>(height))
      return -1;
    return cells[static_cast<std::size_t>(row) * width + static_cast<std::size_t>(column)];
  }
};

ServedMap serve(const std::filesystem::path& yaml, const std::string& mode = "trinary") {
  std::map<std::string, std::string> keys;
  std::istringstream lines(read_file(yaml));
  for (std::string line; std::getline(lines, line);) {
    if (line.empty() || line[0] == '#') continue;
    const std::size_t colon = line.find(": ");
    REQUIRE(colon != std::string::npos);
    keys[line.substr(0, colon)] = line.substr(colon + 2);
  }
  ServedMap map;
  map.resolution = std::stod(keys.at("resolution"));
  CHECK(keys.at("mode") == mode);
  CHECK(keys.at("negate") == "0");
  const double occupied = std::stod(keys.at("occupied_thresh")),
               free = std::stod(keys.at("free_thresh"));
  char comma = 0;
  std::istringstream origin(keys.at("origin").substr(1));
  origin >> map.x >> comma >> map.y >> comma >> map.yaw;

  // A path that does not begin with a slash is beside the YAML.
  REQUIRE(keys.at("image")[0] != '/');
  std::istringstream pgm(read_file(yaml.parent_path() / keys.at("image")));
  std::string magic;
  int most = 0;
  pgm >> magic >> map.width >> map.height >> most;
  CHECK(magic == "P5");
  CHECK(most == 255);
  pgm.get();
  std::string pixels(map.width * map.height, '\0');
  pgm.read(pixels.data(), static_cast<std::streamsize>(pixels.size()));
  CHECK(static_cast<std::size_t>(pgm.gcount()) == pixels.size());
  CHECK(pgm.peek() == std::istringstream::traits_type::eof());
  for (std::size_t row = map.height; row-- > 0;)
    for (std::size_t column = 0; column < map.width; ++column) {
      if (mode == "raw") {
        const int value = static_cast<unsigned char>(pixels[row * map.width + column]);
        map.cells.push_back(value <= 100 ? value : -1);
        continue;
      }
      const double p = (255 - static_cast<unsigned char>(pixels[row * map.width + column])) / 255.0;
      map.cells.push_back(p > occupied ? 100 : p < free ? 0 : -1);
    }
  return map;
}

}  // namespace

TEST_CASE("what map_server reads is free where the world is, and occupied where rays end") {
  const TempFolder folder;
  for (const char* name : {"room", "office", "stairs"}) {
    const World world = read_world(in_project(std::string("worlds/") + name + ".json"));
    const auto path = folder / (std::string(name) + ".yaml");
    export_world(world, path);
    const ServedMap map = serve(path);
    CHECK(map.yaw == 0);
    const RayScene scene(world);
    Random random(21);
    int free = 0, hits = 0;
    for (int k = 0; k < 5000; ++k) {
      const Vec2 p(random.uniform(map.x, map.x + static_cast<double>(map.width) * map.resolution),
                   random.uniform(map.y, map.y + static_cast<double>(map.height) * map.resolution));
      if (map.at(p) != 0) continue;
      ++free;
      CHECK(scene.is_free({p.x(), p.y(), 0.11}, {p.x(), p.y(), 1.79}));
      // The floor is beneath: the first thing within a hand's breadth.
      const auto below = scene.cast({p.x(), p.y(), 0.101}, -Vec3::UnitZ());
      REQUIRE(below);
      CHECK(below->distance < 0.21);
      // Looking around from here, what is seen is on the map.
      const double angle = random.uniform(0, 2 * M_PI);
      const Vec3 way(std::cos(angle), std::sin(angle), 0), from(p.x(), p.y(), 0.5);
      if (const auto hit = scene.cast(from, way)) {
        ++hits;
        const Vec3 at = from + hit->distance * way;
        bool is_occupied = false;
        for (const double dx : {-1e-4, 1e-4})
          for (const double dy : {-1e-4, 1e-4})
            is_occupied |= map.at({at.x() + dx, at.y() + dy}) == 100;
        CHECK(is_occupied);
      }
    }
    CHECK(free > 1000);
    CHECK(hits > 1000);
  }
}

TEST_CASE("all three kinds of cells come back, and what is outside is unknown") {
  const TempFolder folder;
  export_world(read_world(in_project("worlds/office.json")), folder / "o.yaml");
  const ServedMap map = serve(folder / "o.yaml");
  for (const int kind : {-1, 0, 100})
    CHECK(std::count(map.cells.begin(), map.cells.end(), kind) > 100);
  CHECK(map.at({1, 1}) == 0);
  CHECK(map.at({9, 6.8}) == -1);  // beyond the office
}

TEST_CASE("the resolution, the band and the storey are as asked for") {
  const TempFolder folder;
  const World world = read_world(in_project("worlds/office.json"));
  export_world(world, folder / "a.yaml", {.resolution = 0.2});
  const ServedMap coarse = serve(folder / "a.yaml");
  CHECK(coarse.resolution == 0.2);
  CHECK(coarse.width < 60);
  // A table of 0.74 m is over a robot that is 0.6 m high, but for its legs.
  const Vec2 table(2.1, -2.7);
  export_world(world, folder / "b.yaml", {.band_high = 0.6});
  CHECK(serve(folder / "b.yaml").at(table) == 0);
  export_world(world, folder / "c.yaml");
  CHECK(serve(folder / "c.yaml").at(table) == 100);
  export_world(world, folder / "d.yaml", {.storey = 0});
  CHECK(serve(folder / "d.yaml").cells == serve(folder / "c.yaml").cells);
  CHECK(contains(
      error_of(Cause::usage, [&] { export_world(world, folder / "e.yaml", {.storey = 3}); }),
      "no storey 3"));
}

TEST_CASE("the pair of files has one name, whatever is in it, and appears whole or not at all") {
  const TempFolder folder;
  const World world = read_world(in_project("worlds/room.json"));
  export_world(world, folder / "my: \"room\".yaml");
  CHECK(serve(folder / "my: \"room\".yaml").cells.size() > 100);
  export_world(world, folder / "x.pgm", {}, "map_server");
  CHECK(serve(folder / "x.yaml").cells.size() > 100);
  const TempFolder empty;
  const World wide = scaled(small_world(), 1250);
  CHECK(contains(error_of(Cause::usage, [&] { export_world(wide, empty / "w.yaml"); }), "0.05 m"));
  CHECK(std::filesystem::is_empty(empty.path()));
  export_world(wide, empty / "w.yaml", {.resolution = 5});
  CHECK(serve(empty / "w.yaml").at({1000, 1000}) == 0);
}

TEST_CASE("an empty world has a map of one unknown cell") {
  const TempFolder folder;
  export_world({}, folder / "e.yaml");
  CHECK(serve(folder / "e.yaml").cells == std::vector<int>{-1});
}

TEST_CASE("the map of a scan has odds in the room, walls around it, and nothing known outside") {
  PointCloud scan = room_points({4, 3, 2.5}, 0.03, 0.004);
  scan.origin = {500000, 5000000, 100};
  const TempFolder folder;
  export_scan(scan, folder / "hits.yaml");
  const ServedMap hits = serve(folder / "hits.yaml", "raw");
  CHECK(std::all_of(hits.cells.begin(), hits.cells.end(),
                    [](int c) { return c == -1 || c > 60; }));  // nobody looked through anything
  for (const Vec3& from : {Vec3(1, 1, 1), Vec3(2, 2, 1.2), Vec3(3, 1, 1.5), Vec3(1, 2, 1.1)})
    scan.viewpoints.push_back(from);
  export_scan(scan, folder / "seen.yaml");
  const ServedMap map = serve(folder / "seen.yaml", "raw");
  const auto at = [&](double x, double y) { return map.at(Vec2(500000 + x, 5000000 + y)); };
  for (double x = 0.2; x < 3.9; x += 0.3)
    for (double y = 0.2; y < 2.9; y += 0.3) CHECK((at(x, y) >= 0 && at(x, y) < 50));
  int walls = 0;
  for (double x = 0.1; x < 3.9; x += 0.1) walls += std::max(at(x, -0.02), at(x, 0.02)) >= 65;
  CHECK(walls > 35);
  for (double x = -0.05; x < 4; x += 0.5) CHECK(at(x, -0.06) == -1);
}
