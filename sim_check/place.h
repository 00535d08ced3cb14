// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "exporters/bodies.h"
#include "world/world.h"

namespace scanworld::sim {

// What a place is made of: a world's solids, the triangles of a mesh, one level plane, or nothing.
enum class Sort { world, mesh, plane, empty };

const char* name_of(Sort sort);

// A place that robots are put into: one row of a comparison. +Z is up.
struct Place {
  std::string name;
  Sort sort = Sort::mesh;
  Mesh seen;                       // what rays meet; where there are no solids robots touch it too
  std::vector<ExportBody> solids;  // what robots touch
  double height = 0;               // [m] of a plane
  double load_seconds = 0;         // to read it and make it ready for an engine
  std::optional<World> world;      // turned upright, where it was made from one
  Frame built;                     // the world's before that
};

struct PlaceOptions {
  double unit = 0;       // [m] of one unit of meshes; 0: a metre, or what the format says
  char up = 0;           // 'z' or 'y', the axis of meshes that is up; 0: as usual for the format
  bool as_mesh = false;  // robots touch the triangles of worlds, not their solids
};

// Reads a world (its folder or world.json), a .bullet file, or a mesh of any format that assimp
// reads, in its own coordinates but for unit and axes. Throws bad_input naming the file where it is
// not readable, empty, not finite, or so large or small that its unit is in doubt.
Place read_place(const std::filesystem::path& path, const PlaceOptions& options = {});

// A mesh or a world as a place.
Place place_of(std::string name, Mesh mesh);
Place place_of(std::string name, const World& world, const PlaceOptions& options = {});

// Brings all into the coordinates of the first world, or without one of the first place. What has
// no frame of its own is in the scan's coordinates or in the world's, whichever fits. Returns the
// frame that all are in then. Throws bad_input naming what is elsewhere.
Frame align(std::vector<Place>& places);

// Moves everything of a place: rotation * p + shift.
void move(Place& place, const Eigen::Quaterniond& rotation, const Vec3& shift);

}  // namespace scanworld::sim
