// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "known_files.h"

#include <fnmatch.h>

#include <algorithm>
#include <array>
#include <span>
#include <string>

#include "files.h"

namespace scanworld {

namespace {

struct KnownFile {
  const char* pattern;  // of its name
  const char* mark;     // that is in it
};

constexpr KnownFile kGuests[] = {
    {"view.html", "The scanworld authors"},
    {"sim_check.json", "\"keeps_promises\""},
    {"sim_check.csv", "place,figure,robot,"},
    {"sim_check.md", "\nVerdict: "},
    {"sim_check.svg", "<svg "},
};

// What `build`, `export --all`, `sim_check` and `table5` wrote.
constexpr KnownFile kFiles[] = {
    {"world.json", "\"name\": \"scanworld\""},
    {"report.json", "scanworld-report"},
    {"report.html", "<p>Made by scanworld "},
    {"replay.json", "scanworld-replay"},
    {"labels.ply", "property int plane_id"},
    {"world.obj", "# scanworld: metres"},
    {"world.mtl", "# scanworld"},
    {"world.stl", "binary STL by scanworld"},
    {"world.glb", "\"generator\":\"scanworld "},
    {"world.ply", "property int surface_id"},
    {"world.bullet", "BULLET"},
    {"world.usda", "Made by scanworld"},
    {"world.urdf", "<visual name=\"surfaces\">"},
    {"world.sdf", "<uri>model://world_model</uri>"},
    {"world.xml", "<default class=\"collision\">"},
    {"world.dae", "COLLADA"},
    {"world.3mf", "PK"},
    {"world.bt", "# by scanworld"},
    {"world.ot", "# by scanworld"},
    {"world.yaml", "# scanworld: "},
    {"world.pgm", "P5\n"},
    {"world.graphml", "<graph id=\"rooms\""},
    {"world.dot", "// scanworld: "},
    {"world.landmarks.yaml", "# scanworld: "},
    {"world.landmarks.csv", "id,kind,relief,"},
    {"README.md", "# A world by scanworld"},
    {"model.config", "Made by scanworld"},
    {"model.sdf", "<uri>model://world_model/"},
    {"surfaces.obj", "# scanworld: metres"},
    {"surfaces.mtl", "# scanworld"},
    {"*_solid_*.obj", "o "},
    {"obstacle_*.obj", "o obstacle_"},
    {"table5.md", "# Table 5 on "},
    {"g*.ply", "comment scanworld, metres"},
};

constexpr const char* kFolders[] = {"world_meshes", "world_model", "world_model/meshes",
                                    "meshes",       "rival",       "thesis"};

bool is_one_of(std::span<const KnownFile> known, const std::filesystem::path& file) {
  return std::ranges::any_of(known, [&](const KnownFile& k) {
    return ::fnmatch(k.pattern, file.filename().c_str(), 0) == 0 && bears_mark(file, k.mark);
  });
}

}  // namespace

bool is_known_file(const std::filesystem::path& folder, const std::filesystem::path& file) {
  return is_known_guest(folder, file) || is_one_of(kFiles, folder / file);
}

bool is_known_folder(const std::filesystem::path& folder) {
  return std::ranges::count(kFolders, folder) > 0;
}

bool is_known_guest(const std::filesystem::path& folder, const std::filesystem::path& file) {
  return !file.has_parent_path() && is_one_of(kGuests, folder / file);
}

}  // namespace scanworld
