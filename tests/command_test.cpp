// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The command as a user runs it: what it prints, leaves behind and returns.
#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>

#include "scan/read_scan.h"
#include "scan/write_scan.h"
#include "support/scenes.h"
#include "world/validate.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

fs::path room_scan(const TempFolder& folder) {
  const fs::path path = folder / "room.ply";
  write_scan(path, room_points({5, 4, 2.7}, 0.03, 0.005));
  return path;
}

// Nothing in the folder but what was there before.
std::size_t entries(const fs::path& folder) {
  return static_cast<std::size_t>(
      std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("build writes its folder with world, report and exports") {
  const TempFolder folder;
  const Outcome outcome = run({"build", room_scan(folder), "-o", folder / "world", "--labels"});
  CHECK_MESSAGE(outcome.code == 0, outcome.err);
  CHECK(contains(outcome.out, "6 surfaces (1 floor, 1 ceiling, 4 wall, 0 other) and 12 triangles"));
  CHECK(outcome.err.empty());
  for (const char* name : {"world.json", "report.json", "world.obj", "world.mtl", "world.stl",
                           "world.glb", "world.bullet", "labels.ply", "report.html"})
    CHECK(fs::exists(folder / "world" / name));
  CHECK(entries(folder / "world") == 10);  // with the list of its files
  CHECK(validate(read_world(folder / "world")).empty());
  CHECK(entries(folder.path()) == 2);

  const Json report = Json::parse(read_file(folder / "world" / "report.json"));
  CHECK(report["method"] == "rival");
  REQUIRE(report["planes"].size() == 6);
  for (const Json& plane : report["planes"]) {
    CHECK(plane["points"].get<int>() > 1000);
    CHECK(plane["rms"].get<double>() <= plane["noise"].get<double>());
  }
  for (const char* length : {"scale", "noise", "spacing"}) CHECK(report[length].get<double>() > 0);
  const Json& noise = report["noise_model"];
  CHECK(noise["low"].get<double>() > 0);
  CHECK(noise["low"] < noise["middle"]);
  CHECK(noise["middle"] < noise["high"]);
  CHECK(report["triangles"] == 12);
  CHECK(report["peak_memory_mb"].get<double>() > 1);
  CHECK(report["world_hash"] == world_hash(read_world(folder / "world")));
  CHECK(report["stages"].size() == 40);
  CHECK(report["complete_seconds"].get<double>() > 0);
}

TEST_CASE("build replaces a world of its own and no other folder") {
  const TempFolder folder;
  const fs::path scan = room_scan(folder);
  CHECK(run({"build", scan, "-o", folder / "w"}).code == 0);
  CHECK(run({"build", scan, "-o", folder / "w", "--export", "none"}).code == 0);
  CHECK(entries(folder / "w") == 4);
  fs::create_directory(folder / "mine");
  write_file(folder / "mine/thesis.tex", "years of work");
  const Outcome outcome = run({"build", scan, "-o", folder / "mine"});
  CHECK(outcome.code == 2);
  CHECK(contains(outcome.err, "mine"));
  CHECK(read_file(folder / "mine/thesis.tex") == "years of work");
  CHECK(entries(folder / "mine") == 1);
}

TEST_CASE("no run harms its inputs, nor files that it did not write, and it tells before reading") {
  const TempFolder folder;
  const fs::path scan = room_scan(folder), world = folder / "w", absent = folder / "absent.ply";
  REQUIRE(run({"build", scan, "-o", world, "--export", "none", "--labels"}).code == 0);
  fs::create_symlink("w/labels.ply", folder / "link.ply");
  fs::copy_file(scan, folder / "scan.ply");
  const std::string poses = write_file(folder / "poses.txt", "1 1 1\n");
  const auto refused = [&](const std::vector<std::string>& arguments, const std::string& told) {
    const Outcome outcome = run(arguments);
    INFO(arguments[0] << ": " << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, told));
  };
  const std::string world_json = read_file(world / "world.json");
  refused({"build", world / "labels.ply", "-o", world}, "labels.ply");
  refused({"build", folder / "link.ply", "-o", world}, "link.ply");
  refused({"build", absent, "--poses", poses, "-o", folder.path()}, "poses.txt");
  refused({"build", absent, "--config", write_file(folder / "c.toml", ""), "-o", folder.path()},
          "c.toml");
  refused({"scan", world / "world.json", "-o", world / "world.json"}, "world.json");
  refused({"export", world, "-o", world / "world.json"}, "world.json");
  refused({"export", world, "-o", world, "--all"}, "world.json");
  refused({"export", scan, "-o", scan, "--format", "bt"}, "room.ply");
  refused({"view", world, scan, "-o", folder / "link.ply"}, "view writes");
  write_file(world / "view.html", "<p>mine");
  refused({"view", world}, "view.html");
  refused({"build", absent, "-o", world}, "view.html");
  write_file(folder / "x.mtl", "mine");
  refused({"export", world, "-o", folder / "x.obj"}, "x.mtl");
  write_file(folder / "x.labels.ply", "mine");
  refused({"scan", world, "-o", folder / "x.ply", "--labels"}, "x.labels.ply");
  CHECK(read_file(world / "world.json") == world_json);
  CHECK(read_file(scan) == read_file(folder / "scan.ply"));
}

TEST_CASE(
    "the same bytes of world.json for 1, 2 and 4 threads, and for the same points in another "
    "order") {
  const TempFolder folder;
  fs::create_directory(folder / "a");
  fs::create_directory(folder / "b");
  PointCloud cloud = read_scan({in_project("data/office.ply")});
  cloud.points.resize(150000);
  write_scan(folder / "a/scan.ply", cloud);
  shuffle_points(cloud, 5);
  write_scan(folder / "b/scan.ply", cloud);
  std::string first;
  for (const char* threads : {"1", "2", "4"})
    for (const char* order : {"a", "b"}) {
      REQUIRE(run({"build", folder / order / "scan.ply", "-o", folder / "w", "--export", "none",
                   "--threads", threads})
                  .code == 0);
      const std::string text = read_file(folder / "w" / "world.json");
      if (first.empty()) first = text;
      CHECK(text == first);
    }
}

TEST_CASE("--json prints the report, --progress json and -v tell of the stages on stderr") {
  const TempFolder folder;
  const fs::path scan = room_scan(folder);
  const Outcome quiet = run({"build", scan, "-o", folder / "w", "--json"});
  CHECK(Json::parse(quiet.out) == Json::parse(read_file(folder / "w" / "report.json")));
  CHECK(quiet.err.empty());
  const Outcome loud = run({"build", scan, "-o", folder / "w", "-v", "--progress", "json"});
  CHECK(contains(loud.err, "{\"stage\":\"Rivalry\""));
  CHECK(contains(loud.err, "Sorting into voxels"));
  CHECK(contains(run({"build", scan, "-o", folder / "w", "--progress", "bar"}).err,
                 "Labelling space"));
}

TEST_CASE(
    "options come from presets, a file and the command line, the later over the earlier, and are "
    "recorded") {
  const TempFolder folder;
  const fs::path scan = room_scan(folder),
                 config = write_file(folder / "c.toml",
                                     "[thesis.filter]\nmin_size = 0.07\nmin_points = 2\n");
  const Outcome outcome = run({"build", scan, "-o", folder / "w", "--preset", "fast", "--config",
                               config, "--set", "thesis.filter.min_points=3"});
  CHECK_MESSAGE(outcome.code == 0, outcome.err);
  const auto options = read_world(folder / "w").provenance.options;
  CHECK(options.at("thesis.filter.points_per_cube") == OptionValue(16.0));
  CHECK(options.at("thesis.filter.min_size") == OptionValue(0.07));
  CHECK(options.at("thesis.filter.min_points") == OptionValue(std::int64_t{3}));
  CHECK(options.at("preset") == OptionValue(std::string("fast")));
  CHECK(contains(run({"build", "--options"}).out, "thesis.filter.min_size"));
}

TEST_CASE(
    "a mistake in the request is found before the scan is read, with exit code 2 or the file "
    "named") {
  const TempFolder folder;
  const fs::path absent = folder / "absent.ply", out = folder / "w";
  CHECK(run({}).code == 2);
  CHECK(run({"fly"}).code == 2);
  CHECK(run({"build"}).code == 2);
  CHECK(run({"build", absent}).code == 2);
  CHECK(run({"build", absent, "-o", out, "--method", "magic"}).code == 2);
  CHECK(run({"build", absent, "-o", out, "--preset", "space"}).code == 2);
  CHECK(run({"build", absent, "-o", out, "--threads", "-1"}).code == 2);
  CHECK(run({"build", absent, "-o", out, "--export", "stl,blend"}).code == 2);
  const Outcome unknown = run({"build", absent, "-o", out, "--set", "thesis.filter.minsize=1"});
  CHECK(unknown.code == 2);
  CHECK(contains(unknown.err, "thesis.filter.min_size"));
  CHECK(run({"build", absent, "-o", out, "--set", "thesis.filter.min_size"}).code == 2);
  CHECK(run({"build", absent, "-o", out, "--set", "thesis.filter.min_size=-1"}).code == 2);
  const Outcome config = run({"build", absent, "-o", out, "--config",
                              write_file(folder / "c.toml", "\n[thesis.filter]\nmin_sise = 1\n")});
  CHECK(config.code == 2);
  CHECK(contains(config.err, "c.toml:3:"));
  const Outcome broken =
      run({"build", absent, "-o", out, "--config", write_file(folder / "d.toml", "a = = 1\n")});
  CHECK(broken.code == 3);
  CHECK(contains(broken.err, "d.toml:1:"));
  CHECK(run({"build", absent, "-o", out, "--poses", folder / "no.txt"}).code == 3);
  CHECK_FALSE(fs::exists(out));
}

TEST_CASE(
    "bad scans give a message with the file, exit code 3 or 4, no output, and take neither time "
    "nor memory") {
  const TempFolder folder;
  const auto xyz = [](auto point, int count) {
    std::string text;
    for (int i = 0; i < count; ++i) text += point(i) + "\n";
    return text;
  };
  const std::string ply = "ply\nformat binary_little_endian 1.0\nelement vertex ",
                    floats = "\nproperty float x\nproperty float y\nproperty float z\nend_header\n";
  struct Bad {
    const char* name;
    std::string bytes;
    int code;
    const char* told;
  };
  const std::vector<Bad> cases = {
      {"empty.ply", "", 3, "empty"},
      {"cut_header.ply", ply, 3, "header"},
      {"cut_body.ply", ply + "1000" + floats + std::string(11999, 'x'), 3, "room for 999"},
      {"huge.ply", ply + "1000000000000" + floats + "1234", 3, "1000000000000"},
      {"nan.xyz", xyz([](int) { return std::string("nan inf 1"); }, 100), 3, "finite"},
      {"one.xyz", "1 2 3\n", 4, "no plane"},
      {"equal.xyz", xyz([](int) { return std::string("1 2 3"); }, 1000), 4, "no plane"},
      {"million.xyz", xyz([](int) { return std::string("1 2 3"); }, 1000000), 4, "no plane"},
      {"line.xyz", xyz([](int i) { return std::to_string(0.01 * i) + " 0 0"; }, 5000), 4,
       "no plane"},
      {"word.xyz", xyz([](int i) { return std::string(i == 700 ? "1 two 3" : "1 2 3"); }, 1000), 3,
       ":701:"},
      {"binary.xyz", std::string(5000, '\0'), 3, "binary.xyz"},
      {"short.xyz", "1 2\n3 4\n", 3, ":1:"},
  };
  for (const Bad& bad : cases) {
    const fs::path scan = write_file(folder / bad.name, bad.bytes);
    const std::size_t before = entries(folder.path());
    const Outcome outcome = run({"build", scan, "-o", folder / "w"});
    INFO(bad.name << ": " << outcome.err);
    CHECK(outcome.code == bad.code);
    CHECK(contains(outcome.err, bad.told));
    if (bad.code == 3) CHECK(contains(outcome.err, bad.name));
    CHECK(outcome.out.empty());
    CHECK(entries(folder.path()) == before);
    CHECK(outcome.seconds < 20);  // under sanitizers too
    CHECK(outcome.peak_kb < 1500000);
    CHECK(run({"info", scan}).code == (bad.code == 3 ? 3 : 0));
  }
  CHECK(run({"build", folder / "absent.ply", "-o", folder / "w"}).code == 3);
  CHECK(run({"build", folder.path(), "-o", folder / "w"}).code == 3);
}

TEST_CASE("NaN among good points costs those points, not the world, and is told") {
  const TempFolder folder;
  std::string text = "nan 1 2\n";
  for (const Vec3f& p : room_points({5, 4, 2.7}, 0.05, 0.005).points)
    text +=
        std::to_string(p.x()) + " " + std::to_string(p.y()) + " " + std::to_string(p.z()) + "\n";
  const Outcome outcome =
      run({"build", write_file(folder / "s.xyz", text + "1 inf 3\n"), "-o", folder / "w"});
  CHECK(outcome.code == 0);
  CHECK(contains(outcome.err, "2 of "));
  CHECK(contains(outcome.err, "the first is point 1"));
  CHECK(read_world(folder / "w").surfaces.size() == 6);
}

TEST_CASE("a place that may not be written to is told before the scan is read") {
  const TempFolder folder;
  const fs::path scan = room_scan(folder);
  const Outcome in_file = run({"build", scan, "-o", scan / "w"});
  CHECK(in_file.code == 1);
  CHECK(contains(in_file.err, "room.ply"));
  CHECK(run({"build", scan, "-o", "/proc/nowhere"}).code == 1);
  CHECK(run({"export", in_project("worlds/room.json"), "-o", "/proc/nowhere.stl"}).code == 1);
  CHECK(run({"scan", in_project("worlds/room.json"), "-o", "/proc/nowhere.ply", "--points", "1000"})
            .code == 1);
}

TEST_CASE("info tells of scans, meshes and worlds, as text and as JSON") {
  const TempFolder folder;
  const Json scan = Json::parse(run({"info", in_project("data/office.ply"), "--json"}).out);
  CHECK(scan["is"] == "scan");
  CHECK(scan["points"] == 390000);
  const Json world = Json::parse(run({"info", in_project("worlds/office.json"), "--json"}).out);
  CHECK(world["is"] == "world");
  CHECK(world["rooms"] == 6);
  CHECK(run({"export", in_project("worlds/office.json"), "-o", folder / "o.glb"}).code == 0);
  const Json mesh = Json::parse(run({"info", folder / "o.glb", "--json"}).out);
  CHECK(mesh["is"] == "mesh");
  CHECK(mesh["triangles"].get<int>() > 300);
  CHECK(contains(run({"info", in_project("worlds/office.json")}).out, "rooms          6"));
}

TEST_CASE("check says what is wrong with a world, with exit code 5") {
  const TempFolder folder;
  const Outcome good = run({"check", in_project("worlds/office.json")});
  CHECK(good.code == 0);
  CHECK(contains(good.out, "valid"));
  World broken = small_world();
  broken.vertices[2].z() = 0.5;
  write_world(folder / "bad.json", broken);
  const Outcome bad = run({"check", folder / "bad.json"});
  CHECK(bad.code == 5);
  CHECK(contains(bad.out, "surface 0: vertex 2 of outer is 0.5000 m off the plane"));
  const Json json = Json::parse(run({"check", folder / "bad.json", "--json"}).out);
  CHECK(json["valid"] == false);
  CHECK(json["reasons"].size() == 1);
  CHECK(run({"check", write_file(folder / "no.json", "{")}).code == 3);
}

TEST_CASE("a world that is not valid is refused by all that would use it, with exit code 3") {
  const TempFolder folder;
  World missing = small_world(), no_up = small_world();
  missing.surfaces[0].outer[0] = 99999;
  no_up.frame.up.setZero();
  write_world(folder / "missing.json", missing);
  write_world(folder / "no_up.json", no_up);
  const std::map<std::string, std::string> told = {
      {"missing.json", "surface 0: outer has the vertex 99999"},
      {"no_up.json", "frame: up is not of length 1"}};
  for (const auto& [name, why] : told)
    for (const std::vector<std::string>& arguments : {std::vector<std::string>{"info"},
                                                      {"export", "-o", folder / "x.stl"},
                                                      {"scan", "-o", folder / "x.ply"},
                                                      {"view", "-o", folder / "x.html"}}) {
      std::vector<std::string> whole = arguments;
      whole.insert(whole.begin() + 1, folder / name);
      const Outcome outcome = run(whole);
      INFO(arguments[0] << ": " << outcome.err);
      CHECK(outcome.code == 3);
      CHECK(contains(outcome.err, name + ": not valid: " + why));
    }
  CHECK(entries(folder.path()) == 2);
}

TEST_CASE(
    "build tells its verdict and what was not asked, and warns in the report where it is bad") {
  const TempFolder folder;
  std::string floor, stray;
  Random random(1);
  for (int i = 0; i < 100; ++i)
    for (int k = 0; k < 100; ++k)
      floor += fmt::format("{} {} {}\n", 0.04 * i, 0.04 * k, 0.003 * random.gauss());
  for (int i = 0; i < 2000; ++i)
    stray += fmt::format("{} {} {}\n", 4 * random.uniform(), 4 * random.uniform(),
                         0.3 + 2 * random.uniform());
  const auto build = [&](const std::string& points) {
    write_file(folder / "s.xyz", points);
    return run({"build", folder / "s.xyz", "-o", folder / "w", "--export", "none", "-q"});
  };
  const auto warnings = [&] {
    return Json::parse(read_file(folder / "w" / "report.json"))["warnings"].dump();
  };
  const Outcome good = build(floor);
  CHECK(contains(good.out,
                 "\nthe world is faithful; not asked: free-space violations, leaks (no "
                 "viewpoints)\n"));
  CHECK_FALSE(contains(warnings(), "faithful"));
  const Outcome bad = build(floor + stray);
  CHECK(bad.code == 0);
  CHECK(contains(bad.out, "\nthe world is not faithful: unexplained points "));
  CHECK(contains(warnings(), "the world is not faithful: "));
}

TEST_CASE(
    "check measures a world against its scan as build did, with or without poses, and gives a "
    "verdict") {
  const TempFolder folder;
  const fs::path world = in_project("worlds/room.json"), scan = folder / "s.ply",
                 poses = folder / "p.txt";
  CHECK(run({"scan", world, "-o", scan, "--points", "60000", "--save-poses", poses}).code == 0);
  const Outcome good = run({"check", world, scan, "--poses", poses});
  CHECK_MESSAGE(good.code == 0, good.out);
  for (const char* told : {"valid", "coverage", "leaks", "verdict: faithful\n"})
    CHECK(contains(good.out, told));
  CHECK(contains(run({"check", world, scan}).out,
                 "leaks                          not asked: no viewpoints"));

  const Outcome made =
      run({"build", scan, "--poses", poses, "-o", folder / "w", "--export", "none"});
  CHECK(made.code == 0);
  CHECK(contains(made.out, "\nthe world is faithful\n"));
  const Json built = Json::parse(read_file(folder / "w" / "report.json"))["fidelity"];
  const Json checked =
      Json::parse(run({"check", folder / "w", scan, "--poses", poses, "--json"}).out)["fidelity"];
  CHECK(checked == built);
  CHECK(checked["free_space_violations"].is_number());
  CHECK(
      Json::parse(run({"check", folder / "w", scan, "--json"}).out)["fidelity"]["leaks"].is_null());

  World less = read_world(world);
  std::erase_if(less.surfaces, [](const Surface& s) { return s.kind == Kind::floor; });
  less.rooms.clear();
  write_world(folder / "less.json", less);
  const Outcome bad = run({"check", folder / "less.json", scan, "--poses", poses});
  CHECK(bad.code == 5);
  CHECK(contains(bad.out, "FAILED"));
  CHECK(contains(bad.out, "verdict: not faithful: "));
  CHECK(contains(bad.err, "not faithful"));

  less.frame.origin = {0, 500, 0};
  write_world(folder / "far.json", less);
  const Outcome far = run({"check", folder / "far.json", scan});
  CHECK(far.code == 3);
  CHECK(contains(far.err, "different places"));
  CHECK(run({"check", world, "--poses", poses}).code == 2);
  CHECK(run({"check", world, folder / "absent.ply"}).code == 3);
}

TEST_CASE("check tells where surfaces that meet are not joined, and fails for it if asked to") {
  const TempFolder folder;
  CHECK(contains(run({"check", in_project("worlds/office.json"), "--exact"}).out,
                 "surfaces that meet share their vertices"));
  // The wall ends in the middle of the floor's edge.
  World world = small_world();
  for (int v : {4, 5}) world.vertices[static_cast<std::size_t>(v)].x() -= 0.25;
  world.surfaces[1].outer = {0, 4, 5, static_cast<int>(world.vertices.size())};
  world.vertices.push_back({3.75, 0, 0});
  for (int v : {4, 5}) {
    Vec3& p = world.vertices[static_cast<std::size_t>(v)];
    p.x() = p.x() < 1 ? 0 : 3.75;
  }
  write_world(folder / "t.json", world);
  const Outcome told = run({"check", folder / "t.json"});
  CHECK(told.code == 0);
  CHECK(contains(told.out, "of surface 0 passes vertex"));
  CHECK(contains(told.out, "1 T-junctions and 0 cracks"));
  CHECK(run({"check", folder / "t.json", "--exact"}).code == 5);
  const Json json = Json::parse(run({"check", folder / "t.json", "--json"}).out);
  CHECK(json["valid"] == true);
  CHECK(json["t_junctions"] == 1);
  CHECK(json["not_joined"].size() == 1);
}

TEST_CASE("a tilted scan is warned of, and built upright with its floor at 0 if asked for") {
  const TempFolder folder;
  PointCloud cloud = room_points({5, 4, 2.7}, 0.05, 0.005);
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.04, Vec3::UnitX()));
  for (Vec3f& p : cloud.points) p = (tilt * p.cast<double>() + Vec3(0, 0, 7)).cast<float>();
  write_scan(folder / "tilted.ply", cloud);
  const Outcome as_is =
      run({"build", folder / "tilted.ply", "-o", folder / "w", "--export", "none"});
  CHECK(as_is.code == 0);
  CHECK(contains(as_is.err, "tilted by 2.3 degrees; --level makes it upright"));
  CHECK(read_world(folder / "w").frame.rotation.coeffs() ==
        Eigen::Quaterniond::Identity().coeffs());
  const Outcome level = run({"build", folder / "tilted.ply", "-o", folder / "w", "--export", "none",
                             "--level", "--floor-at-zero"});
  CHECK(level.code == 0);
  CHECK_FALSE(contains(level.err, "tilted"));
  const World world = read_world(folder / "w");
  CHECK(world.frame.up == Vec3::UnitZ());
  CHECK(std::get<bool>(world.provenance.options.at("frame.level")));
  CHECK(std::abs(bounds(world).min().z()) < 0.003);
  CHECK(bounds(world).max().z() == doctest::Approx(2.7).scale(0).epsilon(0.005));
  const Json info = Json::parse(run({"info", folder / "w", "--json"}).out);
  CHECK(info["tilt_degrees"] == 0);
  CHECK(info["rotation"][0].get<double>() == doctest::Approx(std::sin(0.02)).epsilon(0.01));
  CHECK(info["bounds"]["min"][2].get<double>() == doctest::Approx(7).scale(0).epsilon(0.01));
  CHECK(std::abs(info["own_bounds"]["min"][2].get<double>()) < 0.003);
  CHECK(run({"build", folder / "tilted.ply", "-o", folder / "s", "--export", "none", "--set",
             "frame.level=true"})
            .code == 0);
  CHECK(read_world(folder / "s").frame.up == Vec3::UnitZ());
}

TEST_CASE("what lies on a floor is that floor up to --floor-tolerance") {
  const TempFolder folder;
  PointCloud cloud = room_points({5, 4, 2.7}, 0.03, 0.002);
  for (Vec3f& p : cloud.points)
    if (p.x() > 1 && p.x() < 1.6f && p.y() > 1 && p.y() < 3 && p.z() < 0.1f) p.z() += 0.015f;
  write_scan(folder / "rug.ply", cloud);
  const auto obstacles = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {
        "build", folder / "rug.ply",          "-o",       folder / "w",
        "--set", "rival.evidence.min_area=5", "--export", "none"};
    words.insert(words.end(), more.begin(), more.end());
    REQUIRE(run(words).code == 0);
    return read_world(folder / "w").obstacles.size();
  };
  CHECK(obstacles({"--floor-tolerance", "1mm"}) > 0);
  CHECK(obstacles({}) == 0);
  const Outcome wrong =
      run({"build", folder / "rug.ply", "-o", folder / "w", "--floor-tolerance", "wide"});
  CHECK(wrong.code == 2);
  CHECK(contains(wrong.err, "--floor-tolerance: 'wide' is no length"));
}

TEST_CASE("--unknown closes what a single view left open, or leaves it out behind surfaces") {
  const TempFolder folder;
  // Three walls of a room; the camera stands in the fourth.
  PointCloud cloud = room_points({5, 4, 2.7}, 0.03, 0.002);
  std::erase_if(cloud.points, [](const Vec3f& p) { return p.y() < 0.1F && p.z() > 0.1F; });
  write_scan(folder / "view.ply", cloud);
  write_file(folder / "poses.txt", "2.5 0.3 1.3\n");
  const auto built = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"build",   folder / "view.ply",  "-o",       folder / "w",
                                      "--poses", folder / "poses.txt", "--export", "none"};
    words.insert(words.end(), more.begin(), more.end());
    REQUIRE(run(words).code == 0);
    return read_world(folder / "w");
  };
  const auto open_edges = [](const World& world) {
    std::map<std::pair<int, int>, int> uses;
    for (const Surface& s : world.surfaces)
      for (std::size_t k = 0; k < s.outer.size(); ++k)
        ++uses[std::minmax(s.outer[k], s.outer[(k + 1) % s.outer.size()])];
    return std::count_if(uses.begin(), uses.end(), [](const auto& u) { return u.second == 1; });
  };
  const World by_default = built({}), solid = built({"--unknown", "solid"}),
              open = built({"--unknown", "open"}), free = built({"--unknown", "free"});
  CHECK(by_default.provenance.options.count("unknown") == 0);
  CHECK(open_edges(by_default) > 0);
  CHECK(open_edges(solid) == 0);
  CHECK(std::get<std::string>(solid.provenance.options.at("unknown")) == "solid");
  CHECK(solid.surfaces.size() > by_default.surfaces.size());
  CHECK(open.surfaces.size() == by_default.surfaces.size());
  CHECK(free.surfaces.size() >= by_default.surfaces.size());
  for (std::size_t k = 0; k < open.surfaces.size(); ++k)
    CHECK(open.surfaces[k].thickness <= by_default.surfaces[k].thickness);
  const Outcome wrong =
      run({"build", folder / "view.ply", "-o", folder / "w", "--unknown", "shut"});
  CHECK(wrong.code == 2);
  CHECK(contains(wrong.err, "--unknown: 'shut' is none of solid, free and open"));
  for (const char* plane_by_plane : {"--method=thesis", "--preset=fast"}) {
    const Outcome vain = run(
        {"build", folder / "view.ply", "-o", folder / "v", "--unknown", "solid", plane_by_plane});
    CHECK(vain.code == 2);
    CHECK(contains(vain.err, "--unknown: surfaces found plane by plane know no unknown space"));
  }
}

TEST_CASE("scan, build, check: a world scanned back has its main walls again") {
  const TempFolder folder;
  CHECK(run({"scan", in_project("worlds/room.json"), "-o", folder / "s.ply", "--points", "100000",
             "--labels", "--save-poses", folder / "p.txt"})
            .code == 0);
  CHECK(read_scan({folder / "s.labels.ply"}).points.size() == 100000);
  const Json info =
      Json::parse(run({"info", folder / "s.ply", "--poses", folder / "p.txt", "--json"}).out);
  CHECK(info["scan_index"] == true);
  CHECK(info["with_viewpoint"] == 100000);
  CHECK(contains(run({"info", folder / "s.ply"}).out, "with viewpoint 0"));
  const Outcome outcome =
      run({"build", folder / "s.ply", "--poses", folder / "p.txt", "-o", folder / "w"});
  CHECK_MESSAGE(outcome.code == 0, outcome.err);
  CHECK(run({"check", folder / "w"}).code == 0);
  const World world = read_world(folder / "w");
  const Vec3 size = bounds(world).sizes();  // reveals of door and window may be there or not
  CHECK((size - Vec3(5, 4, 2.7)).minCoeff() > -0.1);
  CHECK((Vec3(5.1, 4.3, 2.7) - size).minCoeff() > -0.1);
}

TEST_CASE("export leaves out what it is asked to, of what is seen and of what is met") {
  const TempFolder folder;
  const std::string office = in_project("worlds/office.json");
  const auto exported = [&](const std::string& name, const std::string& without) {
    const Outcome outcome = run({"export", office, "-o", folder / name, "--without", without});
    CHECK_MESSAGE(outcome.code == 0, outcome.err);
    return read_file(folder / name);
  };
  struct Case {
    const char *file, *without;
    std::vector<std::string> there, gone;
  };
  const std::vector<Case> cases = {
      {"o.obj", "", {"o wall_", "o obstacle_"}, {}},
      {"o.obj", "obstacles", {"o wall_", "o floor_"}, {"obstacle"}},
      {"o.obj", "surfaces", {"o obstacle_"}, {"o wall_", "o floor_"}},
      {"o.xml", "", {"wall_", "_solid_0", "obstacle_"}, {}},
      {"o.xml", "obstacles", {"wall_", "_solid_0"}, {"obstacle_"}},
      {"o.xml", "colliders", {"wall_", "obstacle_"}, {"_solid_"}},
      {"o.xml", "colliders,obstacles", {"wall_"}, {"_solid_", "obstacle_"}},
      {"o.xml", "surfaces", {"obstacle_"}, {"wall_", "_solid_"}},
      {"o.urdf", "obstacles", {"_solid_0"}, {"obstacle_"}},
      {"o.usda", "obstacles", {"wall_", "_solid_0"}, {"obstacle_"}},
      {"o.bullet", "obstacles", {"_solid_0"}, {"obstacle_"}},
      {"o.dot", "", {" -- "}, {}},
      {"o.dot", "openings", {}, {" -- "}},
  };
  for (const Case& c : cases) {
    const std::string text = exported(c.file, c.without);
    INFO(c.file << " without " << c.without);
    for (const std::string& name : c.there) CHECK_MESSAGE(contains(text, name), name);
    for (const std::string& name : c.gone) CHECK_MESSAGE(!contains(text, name), name);
  }
  exported("o.json", "obstacles,openings");
  const World world = read_world(folder / "o.json");
  CHECK(validate(world).empty());
  CHECK(world.obstacles.empty());
  CHECK(world.doors.empty());
  CHECK(world.surfaces.size() == read_world(office).surfaces.size());
}

TEST_CASE("--without goes with --all and --sagitta") {
  const TempFolder folder;
  for (const char* without : {"obstacles", "surfaces", "colliders,obstacles", "openings"}) {
    INFO(without);
    const Outcome outcome = run({"export", in_project("worlds/office.json"), "-o", folder / "all",
                                 "--all", "--without", without, "--sagitta", "5mm"});
    CHECK_MESSAGE(outcome.code == 0, outcome.err);
    for (const char* name : {"world.stl", "world.glb", "world.ply", "world.dae", "world.bullet",
                             "world.sdf", "world.json"})
      CHECK_MESSAGE(fs::exists(folder / "all" / name), name);
    CHECK(validate(read_world(folder / "all/world.json")).empty());
  }
}

TEST_CASE("export without an unknown part, without anything left, or of a scan is refused") {
  const TempFolder folder;
  const auto refused = [&](const fs::path& input, const std::string& without,
                           const std::vector<std::string>& more, const std::string& told) {
    std::vector<std::string> arguments = {"export", input, "--without", without};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = run(arguments);
    INFO(without << ": " << outcome.err);
    CHECK(outcome.code == 2);
    CHECK(contains(outcome.err, told));
  };
  const fs::path room = in_project("worlds/room.json"), out = folder / "o.obj";
  refused(folder / "absent.json", "obstacles,walls", {"-o", out},
          "'walls' is no part of a world; there are obstacles, colliders, openings, surfaces, "
          "inferred");
  refused(room, "surfaces,obstacles", {"-o", out}, "--without leaves nothing of the world");
  refused(room, "surfaces,obstacles", {"-o", folder / "all", "--all"}, "--without leaves nothing");
  refused(in_project("data/office.ply"), "obstacles", {"-o", folder / "o.bt"}, "not a scan");
  CHECK(entries(folder.path()) == 0);
}

TEST_CASE("each verb helps with an example") {
  for (const char* verb : {"build", "info", "export", "scan", "check"}) {
    const Outcome outcome = run({verb, "--help"});
    CHECK(outcome.code == 0);
    CHECK(contains(outcome.out, std::string("scanworld ") + verb));
    CHECK(contains(outcome.out, "Example"));
  }
  CHECK(contains(run({"--version"}).out, "scanworld 0."));
}
