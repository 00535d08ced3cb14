// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "options.h"
#include "progress.h"
#include "replay.h"
#include "report.h"
#include "rival/rival.h"
#include "space/space.h"
#include "surface/surface.h"
#include "terrain/ground.h"
#include "thesis/thesis.h"
#include "world/colliders.h"
#include "world/complete_stairs.h"
#include "world/leaves.h"
#include "world/level.h"
#include "world/obstacles.h"
#include "world/rooms.h"
#include "world/thickness.h"
#include "world/world.h"

namespace scanworld {

enum class Method { rival, thesis };

struct ReconstructOptions {
  Method method = Method::rival;
  rival::RivalOptions rival;
  thesis::ThesisOptions thesis;
  surface::SurfaceOptions surface;  // the polygons of rival
  space::SpaceOptions space;
  terrain::GroundOptions ground;
  ObstacleOptions obstacles;  // and what no polygon explains
  ThicknessOptions thickness;
  ColliderOptions colliders;
  LeafOptions leaves;
  StairsOptions stairs;
  RoomOptions rooms;
  LevelOptions frame;
  double floor_tolerance = 0.02;  // [m] what lies no higher on a floor is that floor: carpets
  bool record = false;            // also make a replay
};

struct ReconstructResult {
  World world;  // without provenance inputs, which only the caller knows
  Report report;
  std::vector<std::int32_t> labels;  // for each point of the cloud the id of its surface, -1 =
                                     // none, on a curve or on a facet of ground
  std::vector<std::int32_t>
      curve_labels;  // for each point the id of its curve, -1 = none; empty where there are none
  std::optional<Replay> replay;  // where it was asked for
};

// Makes a world of a scan. The same points and options give the same world, whatever the number of
// threads and the order of the points. The world is valid: what is not and cannot be mended is left
// out, with a warning. Throws nothing_found where the scan holds no plane.
ReconstructResult reconstruct(const PointCloud& cloud, const ReconstructOptions& options = {},
                              const Progress& progress = {});

// The method of this name; throws usage where there is none.
Method method_named(const std::string& name);
const char* name_of(Method method);

// All options by name, for a command line, a file or a report.
OptionList list_options(ReconstructOptions& options);

// The names of the presets.
const std::vector<std::string>& preset_names();

// The preset that suits a scan where none is asked for: rgbd for a depth camera's image, else
// indoor.
std::string preset_for(const PointCloud& cloud);

// Changes options for a kind of scan. Throws usage where there is no preset of this name.
void apply_preset(ReconstructOptions& options, const std::string& preset);

}  // namespace scanworld
