// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// `scanworld view` and what `build` writes to look at, as a user runs them.
#include <nlohmann/json.hpp>

#include "scan/write_scan.h"
#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace fs = std::filesystem;

namespace {

fs::path office_file() { return in_project("worlds/office.json"); }

}  // namespace

TEST_CASE("view writes a page, a picture or a plan by the extension, and says where") {
  const TempFolder folder;
  const std::pair<const char*, const char*> kinds[] = {
      {"w.html", "<!doctype html>"}, {"w.png", "\x89PNG"}, {"w.svg", "<?xml"}};
  for (const auto& [name, start] : kinds) {
    const Outcome outcome = run({"view", office_file(), "-o", folder / name});
    CHECK_MESSAGE(outcome.code == 0, outcome.err);
    CHECK(outcome.out == (folder / name).string() + "\n");
    CHECK(read_file(folder / name).starts_with(start));
  }
  const Outcome outcome = run({"view", office_file(), "-o", folder / "w.jpg"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "w.jpg: view writes .html, .png and .svg"));
  const Outcome scan = run({"view", office_file(), folder / "s.ply", "-o", folder / "x.png"});
  CHECK(scan.code == 2);
  CHECK(contains(scan.err, "x.png: a scan is shown on pages only"));
}

TEST_CASE("the picture of a world is the same bytes twice, and another from another place") {
  const TempFolder folder;
  const auto picture = [&](const char* from, const char* name) {
    const Outcome outcome =
        run({"view", office_file(), "-o", folder / name, "--from", from, "--size", "320", "200"});
    CHECK_MESSAGE(outcome.code == 0, outcome.err);
    return read_file(folder / name);
  };
  const std::string first = picture("iso", "a.png");
  CHECK(picture("iso", "b.png") == first);
  CHECK(picture("top", "c.png") != first);
  CHECK(picture("1,1,1.5", "d.png") != first);
  CHECK(run({"view", office_file(), "-o", folder / "e.png", "--from", "behind"}).code == 2);
  CHECK_FALSE(fs::exists(folder / "e.png"));
}

TEST_CASE("a page of a folder goes into it, with the report, replay and sim_check that are there") {
  const TempFolder folder;
  const fs::path scan = folder / "room.ply", world = folder / "room.v2";
  write_scan(scan, room_points({4, 3, 2.5}, 0.04, kNoise));
  REQUIRE(run({"build", scan, "-o", world.string() + "/", "--record"}).code == 0);
  CHECK(contains(read_file(world / "report.html"), "<h1>room.v2</h1>"));
  CHECK(fs::exists(world / "replay.json"));
  write_file(world / "sim_check.json", R"({"verdict": "all promises are kept"})");
  const Outcome outcome = run({"view", world, scan});
  CHECK_MESSAGE(outcome.code == 0, outcome.err);
  CHECK(outcome.err.empty());
  const std::string page = read_file(world / "view.html");
  for (const char* part : {R"("title":"room.v2")", "scanworld-replay", "scanworld-report",
                           "all promises are kept", R"("points":)"})
    CHECK_MESSAGE(contains(page, part), part);

  // The report of another world is left out, and a damaged file is no page.
  World other = read_world(world);
  other.vertices[0].x() += 1e-5;
  write_world(world / "world.json", other);
  const Outcome changed = run({"view", world});
  CHECK(changed.code == 0);
  CHECK(contains(changed.err, "report.json: is left out, as it is the report of another world"));
  write_file(world / "replay.json", "{");
  fs::remove(world / "view.html");
  const Outcome damaged = run({"view", world});
  CHECK(damaged.code == 3);
  CHECK(contains(damaged.err, "replay.json: no JSON"));
  CHECK_FALSE(fs::exists(world / "view.html"));
}

TEST_CASE("a result of sim_check is taken from a file or a folder, and missed where it is none") {
  const TempFolder folder;
  fs::create_directory(folder / "result");
  write_file(folder / "result" / "sim_check.json", R"({"verdict": "all promises are kept"})");
  for (const fs::path& result : {folder / "result", folder / "result" / "sim_check.json"}) {
    REQUIRE(run({"view", office_file(), "-o", folder / "w.html", "--sim-check", result}).code == 0);
    CHECK(contains(read_file(folder / "w.html"), "all promises are kept"));
  }
  const Outcome none =
      run({"view", office_file(), "-o", folder / "n.html", "--sim-check", folder.path()});
  CHECK(none.code == 3);
  CHECK(contains(none.err, "sim_check.json: cannot be opened"));
  CHECK_FALSE(fs::exists(folder / "n.html"));
}

TEST_CASE("build --view writes the same world, and a page of it") {
  const TempFolder folder;
  const fs::path scan = folder / "room.ply";
  write_scan(scan, room_points({4, 3, 2.5}, 0.04, kNoise));
  REQUIRE(run({"build", scan, "-o", folder / "plain"}).code == 0);
  REQUIRE(run({"build", scan, "-o", folder / "seen", "--view", "--record"}).code == 0);
  CHECK(read_file(folder / "plain" / "world.json") == read_file(folder / "seen" / "world.json"));
  CHECK_FALSE(fs::exists(folder / "plain" / "view.html"));
  const std::string page = read_file(folder / "seen" / "view.html");
  CHECK(contains(page, "scanworld-replay"));
  CHECK(contains(page, R"("title":"seen")"));
  CHECK(contains(read_file(folder / "plain" / "report.html"), "<h1>plain</h1>"));
}

TEST_CASE("view refuses what is no world, and leaves nothing") {
  const TempFolder folder;
  const fs::path broken = write_file(folder / "broken.json", R"({"schema": 7})");
  const Outcome outcome = run({"view", broken});
  CHECK(outcome.code == 3);
  CHECK(contains(outcome.err, "broken.json"));
  CHECK_FALSE(fs::exists(folder / "broken.html"));
  World world = small_world();
  world.surfaces[0].plane.offset += 1;
  write_world(folder / "bent.json", world);
  const Outcome invalid = run({"view", folder / "bent.json"});
  CHECK(invalid.code == 3);
  CHECK(contains(invalid.err, "not valid"));
  CHECK(run({"view", office_file(), "--poses", folder / "poses.txt"}).code == 2);
}
