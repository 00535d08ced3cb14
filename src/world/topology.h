// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "world.h"

namespace scanworld {

// A room of the topological map.
struct PlaceNode {
  int room = 0;  // id
  std::string name;
  std::optional<double> area;  // [m2]
  std::optional<Vec3> center;
};

// A way between two rooms.
struct PlaceEdge {
  int opening = 0;             // id
  std::array<int, 2> rooms{};  // ids
  OpeningKind kind = OpeningKind::door;
  double width = 0, height = 0;  // [m] clear
  Vec3 place = Vec3::Zero();     // the middle of the opening, at the height of its foot
  // [m] from the centre of one room straight to `place` and on straight to the centre of the other:
  // the least that it can be. Missing where a centre is not known.
  std::optional<double> length;
};

// Stairs or a ramp between two rooms: flights from landing to landing.
struct PlaceClimb {
  std::vector<int> ways;         // ids, from the foot to the top
  std::array<int, 2> rooms{};    // ids, of the lower and the upper one
  WayKind kind = WayKind::ramp;  // stairs if one is
  double width = 0;              // [m] the least
  double rise = 0;               // [m] from the foot to the top
  std::optional<double> length;  // [m] as of PlaceEdge, from each foot straight to its top and on
};

struct Topology {
  std::vector<PlaceNode> nodes;
  std::vector<PlaceEdge> edges;
  std::vector<PlaceClimb> climbs;
};

// The rooms and doors of a world as a graph, in its order. Throws check_failed naming a door whose
// opening or rooms do not exist.
Topology topology_of(const World& world);

}  // namespace scanworld
