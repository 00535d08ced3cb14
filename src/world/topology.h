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

struct Topology {
  std::vector<PlaceNode> nodes;
  std::vector<PlaceEdge> edges;
};

// The rooms and doors of a world as a graph, in its order. Throws check_failed naming a door whose
// opening or rooms do not exist.
Topology topology_of(const World& world);

}  // namespace scanworld
