// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The house keeps its rule of one direction: who may include whom, and which library is seen where.
#include <algorithm>
#include <fstream>
#include <map>
#include <set>

#include "support/support.h"

using namespace scanworld::test;

namespace fs = std::filesystem;

namespace {

// The room of a file of the project: "ground", "scan", "thesis", "world", "reconstruct",
// "exporters", "apps" ...
std::string room_of(const fs::path& file) {
  static const std::set<std::string> ground = {
      "types",          "error",       "parallel",      "progress",      "options",    "files",
      "report",         "version",     "mix",           "disjoint_sets", "point_sums", "polygon",
      "mesh_rays",      "segments",    "circle",        "cell_walk",     "cell_set",   "cell_sight",
      "occupancy_grid", "noise_map",   "replay",        "curve",         "quantile",   "text",
      "turn",           "known_files", "output_folder", "viewers",       "min_cut"};
  const fs::path path = file.lexically_relative(fs::path(SCANWORLD_SOURCE_DIR).lexically_normal());
  const std::string top = path.begin()->string();
  if (top != "src") return top;
  if (std::distance(path.begin(), path.end()) == 3) return (++path.begin())->string();
  return ground.count(path.stem().string()) ? "ground" : "reconstruct";
}

// What the files of a room may include, beside their own.
const std::map<std::string, std::set<std::string>> kMayInclude = {
    {"ground", {}},
    {"scan", {"ground"}},
    {"thesis", {"ground"}},
    {"rival", {"ground"}},
    {"surface", {"ground"}},
    {"space", {"ground", "surface"}},
    {"world", {"ground"}},
    {"terrain", {"ground", "surface", "world"}},
    {"reconstruct", {"ground", "scan", "thesis", "rival", "space", "surface", "terrain", "world"}},
    {"exporters", {"ground", "world"}},
    {"sim_check", {"ground", "world", "exporters"}},
    {"viewer", {"ground", "world", "exporters"}},
    {"apps",
     {"ground", "scan", "thesis", "rival", "space", "surface", "world", "reconstruct", "exporters",
      "sim_check", "viewer"}},
    {"bench",
     {"ground", "scan", "thesis", "rival", "space", "surface", "world", "reconstruct",
      "exporters"}},
};

// The start of a library's header names, and the file that may include them; Bullet is written in
// one room and simulated in another.
const std::vector<std::pair<std::string, std::vector<std::string>>> kLibraries = {
    {"tbb/", {"src/parallel.cpp"}},
    {"oneapi/", {"src/parallel.cpp"}},
    {"assimp/", {"exporters/assimp.cpp"}},
    {"tiny_gltf.h", {"exporters/gltf.cpp"}},
    {"embree3/", {"src/mesh_rays.cpp"}},
    {"boost/", {"src/min_cut.cpp"}},
    {"geos", {"src/world/geos.cpp"}},
    {"libqhull", {"src/world/solids.cpp"}},
    {"zlib.h", {"src/scan/file.cpp"}},
    {"liblzf/", {"src/scan/pcd.cpp"}},
    {"toml", {"apps/settings.cpp"}},
    {"png.h", {"viewer/png.cpp"}},
    {"tinyxml2.h", {"exporters/xml.cpp"}},
    {"bt", {"exporters/bullet_shapes.h", "sim_check/bullet_file.cpp"}},
    {"BulletCollision/", {"exporters/bullet_shapes.cpp", "sim_check/bullet.cpp"}},
    {"LinearMath/", {"sim_check/bullet.cpp"}},
    {"ode/", {"sim_check/ode.cpp"}},
    {"mujoco/", {"sim_check/mujoco.cpp"}},
    {"BulletWorldImporter/", {"sim_check/bullet_file.cpp"}},
};

struct Include {
  fs::path from;
  int line;
  std::string name;
  bool quoted;
};

// The include that a line is, if it is one.
std::optional<Include> include_of(const fs::path& from, int line, const std::string& text) {
  const std::string start = "#include ";
  if (!text.starts_with(start) || text.size() < start.size() + 3) return std::nullopt;
  const bool quoted = text[start.size()] == '"';
  const std::size_t end = text.find(quoted ? '"' : '>', start.size() + 1);
  return Include{from, line, text.substr(start.size() + 1, end - start.size() - 1), quoted};
}

std::vector<Include> all_includes() {
  std::vector<Include> includes;
  for (const char* folder : {"src", "exporters", "sim_check", "viewer", "apps", "bench"})
    for (const auto& entry : fs::recursive_directory_iterator(in_project(folder))) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream file(entry.path());
      std::string text;
      for (int line = 1; std::getline(file, text); ++line)
        if (auto include = include_of(entry.path().lexically_normal(), line, text))
          includes.push_back(*include);
    }
  return includes;
}

// The file of the project that an include means.
fs::path resolve(const Include& include) {
  for (const fs::path& base : {include.from.parent_path(), in_project("src"), in_project("")})
    if (fs::exists(base / include.name)) return (base / include.name).lexically_normal();
  return {};
}

}  // namespace

TEST_CASE("rooms include only what stands below them") {
  std::size_t checked = 0;
  for (const Include& include : all_includes()) {
    if (!include.quoted) continue;
    const fs::path target = resolve(include);
    INFO(include.from.string() << ":" << include.line << " includes " << include.name);
    REQUIRE_FALSE(target.empty());
    const std::string from = room_of(include.from), to = room_of(target);
    REQUIRE(kMayInclude.count(from) == 1);
    CHECK((from == to || kMayInclude.at(from).count(to) == 1));
    ++checked;
  }
  CHECK(checked > 150);
}

TEST_CASE(
    "only reconstruct sees all stages, and a library is seen by the one file that is there for "
    "it") {
  for (const Include& include : all_includes()) {
    const std::string from =
        include.from.lexically_relative(fs::path(SCANWORLD_SOURCE_DIR).lexically_normal()).string();
    for (const auto& [library, allowed] : kLibraries)
      if (!include.quoted && include.name.starts_with(library)) {
        INFO(from << ":" << include.line << " includes " << include.name);
        CHECK(std::ranges::count(allowed, from) == 1);
      }
  }
}
