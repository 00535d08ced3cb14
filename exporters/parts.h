// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// A surface or an obstacle as exporters write it: one named mesh.
struct ExportPart {
  std::string
      name;  // "floor_0", "wall_12", "obstacle_3": unique, the same between runs and formats
  int id;    // of the surface or obstacle
  bool is_surface;
  Kind kind;    // of the surface; obstacles count as other
  Color color;  // of the surface where it has one, else by kind
  Mesh mesh;    // vertices of this part alone
};

// All surfaces, then all obstacles, in the order of the world. Throws check_failed naming the
// surface that is no valid polygon. With the option `merge` they are one part named "world", in the
// colour of the first.
std::vector<ExportPart> export_parts(const World& world, const ExportOptions& options = {});

// The names that surfaces and obstacles have in every format.
std::string name_of(const Surface& surface);
std::string name_of(const Obstacle& obstacle);

// What a file's name says of the place, for formats that name it; letters, digits, '.', '_' and '-'
// are kept, all else becomes '_'.
std::string safe_name(const std::filesystem::path& path);

// The colour that stands for a kind where there is none from the scan.
Color color_of(Kind kind);
Color color_of(const Surface& surface);

}  // namespace scanworld
