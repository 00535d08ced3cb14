// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

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
// surface that is no valid polygon.
std::vector<ExportPart> export_parts(const World& world);

// The colour that stands for a kind where there is none from the scan.
Color color_of(Kind kind);

}  // namespace scanworld
