// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What is put into the page; tests/browser/ looks at the page itself.
#include "viewer/page.h"

#include <nlohmann/json.hpp>

#include "reconstruct.h"
#include "support/scenes.h"
#include "viewer/replay_json.h"
#include "world/fidelity.h"
#include "world/triangulate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

using Json = nlohmann::json;

std::string bytes_of(const std::string& base64) {
  const std::string digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int held = 0;
  for (char c : base64) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(digits.find(c));
    if ((held += 6) >= 8) bytes += static_cast<char>(bits >> (held -= 8) & 255);
  }
  return bytes;
}

template <typename T>
std::vector<T> numbers_of(const Json& base64) {
  const std::string bytes = bytes_of(base64.get<std::string>());
  std::vector<T> numbers(bytes.size() / sizeof(T));
  std::copy_n(bytes.data(), numbers.size() * sizeof(T), reinterpret_cast<char*>(numbers.data()));
  return numbers;
}

// The data of a page, as the page reads it.
Json data_of(const std::string& page) {
  const std::string start = R"(<script id="scanworld-data" type="application/json">)";
  const std::size_t at = page.find(start);
  REQUIRE(at != std::string::npos);
  const std::size_t end = page.find("</script>", at);
  return Json::parse(page.substr(at + start.size(), end - at - start.size()));
}

}  // namespace

TEST_CASE("a page holds the world as it is, and the triangles that are exported") {
  const World world = full_world();
  const Json data = data_of(page_of({.title = "all", .world = world}));
  CHECK(data["schema"] == Json{{"name", "scanworld-page"}, {"version", 1}});
  CHECK(parse_world(data["world"].dump()) == world);
  const WorldMesh mesh = triangulate(world);
  CHECK(numbers_of<std::int32_t>(data["triangles"]["surface"]) == mesh.surface);
  CHECK(numbers_of<std::int32_t>(data["triangles"]["corners"]).size() ==
        3 * mesh.mesh.triangles.size());
  for (const char* key : {"scan", "fidelity", "report", "replay", "sim"})
    CHECK(data[key].is_null());
}

TEST_CASE("no text of a world can end the script that it stands in") {
  World world = full_world();
  const std::string name = "</script><script>alert(1)</script><!--";
  world.rooms[0].name = name;
  const std::string page =
      page_of({.title = name, .world = world, .report = Json{{"warnings", {name}}}.dump()});
  const std::string empty = page_of({});
  const auto count = [](const std::string& text, const std::string& part) {
    std::size_t found = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
      ++found;
    return found;
  };
  CHECK(count(page, "<script") == count(empty, "<script"));
  CHECK(count(page, "</script") == count(empty, "</script"));
  const Json data = data_of(page);
  CHECK(data["title"] == name);
  CHECK(data["world"]["rooms"][0]["name"] == name);
  CHECK(data["report"]["warnings"][0] == name);
  CHECK(data_of(page_of({.title = "not \xff UTF-8"}))["title"] == "not \xef\xbf\xbd UTF-8");
}

TEST_CASE("points of the scan come with place, surface and distance; far ones are left out") {
  const World world = read_world(in_project("worlds/room.json"));
  ScanView scan{.points = 99};
  scan.fidelity.max_distance = 0.5, scan.fidelity.tolerance = 0.04;
  const Vec3 inside = bounds(world).center();
  scan.fidelity.atlas.points = {{inside, 0.0123, 3, true}, {{1e4, 0, 0}, 0.5}, {inside, 0.5}};
  scan.fidelity.atlas.violations = {{{0, 0, 0}, {1, 2, 3}, {4, 5, 6}}};
  scan.fidelity.atlas.leaks = {{{0, 0, 0}, {7, 8, 9}}};
  const Json data = data_of(page_of({.world = world, .scan = scan}));
  const Json& shown = data["scan"];
  CHECK(shown["points"] == 99);
  CHECK(shown["left_out"] == 1);
  CHECK(shown["violations_found"] == 1);
  CHECK(shown["leaks_found"] == 1);
  CHECK(numbers_of<std::int16_t>(shown["surface"]) == std::vector<std::int16_t>{3, -1});
  CHECK(numbers_of<std::uint16_t>(shown["distance"]) == std::vector<std::uint16_t>{123, 5000});
  CHECK(numbers_of<float>(shown["violations"]) == std::vector<float>{0, 0, 0, 1, 2, 3, 4, 5, 6});
  CHECK(numbers_of<float>(shown["leaks"]) == std::vector<float>{0, 0, 0, 7, 8, 9});
  const auto positions = numbers_of<std::uint16_t>(shown["positions"]);
  REQUIRE(positions.size() == 6);
  for (std::size_t k = 0; k < 3; ++k) {
    const double low = shown["box"]["min"][k], high = shown["box"]["max"][k];
    CHECK(std::abs(low + (high - low) * positions[k] / 65535 - inside[static_cast<int>(k)]) < 1e-3);
  }
}

TEST_CASE("a world's points are on the surfaces that are nearest to them") {
  const World world = read_world(in_project("worlds/room.json"));
  PointCloud cloud;
  const WorldMesh mesh = triangulate(world);
  for (std::size_t t = 0; t < mesh.surface.size(); ++t) {
    Vec3 at = Vec3::Zero();
    for (int v : mesh.mesh.triangles[t]) at += mesh.mesh.vertices[static_cast<std::size_t>(v)] / 3;
    const Surface& s = world.surfaces[static_cast<std::size_t>(mesh.surface[t])];
    cloud.points.push_back((at + 0.004 * s.plane.normal).cast<float>());
  }
  const Fidelity fidelity = measure_fidelity(world, cloud, {.noise = 0.005, .spacing = 0.5});
  std::size_t on_own = 0;
  for (const ErrorAtlas::Point& p : fidelity.atlas.points) {
    REQUIRE(p.surface >= 0);
    CHECK(p.explained);
    CHECK(p.distance < 0.0041);
    const Surface& s = world.surfaces[static_cast<std::size_t>(p.surface)];
    on_own += std::abs(s.plane.signed_distance(p.at)) < 0.0041;
  }
  CHECK(on_own == mesh.surface.size());
}

TEST_CASE("a replay is written with all steps, and its polygons lie where its points are") {
  ReconstructOptions options;
  options.record = true;
  const ReconstructResult result = reconstruct(room_points({4, 3, 2.5}, 0.05, kNoise), options);
  const Json json = Json::parse(replay_text(*result.replay));
  CHECK(json["schema"] == Json{{"name", "scanworld-replay"}, {"version", 1}});
  CHECK(json["points"]["count"] == result.replay->points.size());
  REQUIRE(json["steps"].size() == result.replay->steps.size());
  for (std::size_t i = 0; i < json["steps"].size(); ++i) {
    const Json& step = json["steps"][i];
    const ReplayStep& wanted = result.replay->steps[i];
    CHECK(numbers_of<std::uint32_t>(step["points"]) == wanted.points);
    CHECK(numbers_of<std::int32_t>(step["cluster"]) == wanted.cluster);
    const auto sizes = numbers_of<std::int32_t>(step["polygons"]["size"]);
    REQUIRE(sizes.size() == wanted.loops.size());
    std::size_t vertices = 0;
    for (std::size_t k = 0; k < sizes.size(); ++k) {
      CHECK((sizes[k] < 0) == wanted.loops[k].is_hole);
      vertices += static_cast<std::size_t>(std::abs(sizes[k]));
    }
    CHECK(numbers_of<std::uint16_t>(step["polygons"]["vertices"]).size() == 3 * vertices);
  }
}
