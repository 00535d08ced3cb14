// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <set>
#include <string>

#include "types.h"
#include "world/leave_out.h"

namespace scanworld {

// The most that an engine takes; 0 where it takes any number.
struct ExportBudget {
  std::size_t faces = 0;          // triangles to be seen
  std::size_t solids = 0;         // to collide with
  std::size_t hulls = 0;          // of these, that are neither boxes nor cylinders
  std::size_t hull_vertices = 0;  // of each such
  bool operator==(const ExportBudget&) const = default;
};

// Sets caps from "solids=64,hull_vertices=60". Throws usage naming what is no cap or number.
ExportBudget budget_from(const std::string& text);

struct ExportOptions {
  double sagitta = 0;          // [m] of the sides of cylinders; 0: 24 sides
  double friction = 0.8;       // of all solids (Coulomb); rubber on a dry floor
  double min_thickness = 0;    // [m] thinner solids grow away from the free side
  Vec3 origin = Vec3::Zero();  // [m] the point of the world that is to be the file's origin
  bool level = false;          // turn the world upright, so that up is +Z
  bool y_up = false;           // for formats that do not say which axis is up, or let one choose
  bool color_by_kind = false;  // instead of the scan's colours
  bool merge = false;          // all that is seen in one mesh, for engines that trace rays in one
  bool physics = false;        // glTF: with the solids, by extensions that are drafts
  double resolution = 0.05;    // [m] edge of the cells of grids and maps
  bool open_glass = false;     // grids and maps: panes are no obstacles, as to a lidar
  std::size_t min_points = 1;  // grids of scans: a cell with fewer points has none
  // [m] over the floor, between which things are in a robot's way (FloorPlanOptions)
  double band_low = 0.1, band_high = 1.8;
  int storey = -1;              // of maps of one: 0 for the lowest; -1 for that of the main floor
  std::set<WorldPart> without;  // parts that are left out of what is written
  ExportBudget budget;
};

}  // namespace scanworld
