// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../options.h"
#include "storeys.h"
#include "ways.h"
#include "world.h"

namespace scanworld {

struct RoomOptions {
  StoreyOptions storeys;
  WayOptions ways;
  double cell = 0.05;  // [m] edge; where a storey would have more than 4 million, they are larger
  // [m] over the floor, where walls are looked for: above cupboards and the heads of doors (2 to
  // 2.2 m), so that lintels part rooms even where an opening was not told.
  double cut = 2.3;
  double below_ceiling = 0.15;  // [m] but so far below the storey's lowest ceilings
  double step = 0.5;            // [m] floors so far from the level of a storey are walked on still
  double min_gap = 0.5;         // [m] between walls: narrower ones lead nowhere
  double min_area = 1.0;        // [m2] of a room
  // Share of a room's border that is walls which look into it. Ground before a house has a wall on
  // one side of four at most, and none look into a cupboard; of rooms some walls may be unseen.
  double min_enclosed = 0.3;
  double max_thickness = 0.6;  // [m] of the walls that doors lead through
};

OptionList list_options(RoomOptions& options);

// The topological map of a world.
struct RoomMap {
  std::vector<Room> rooms;  // ids from 0: by storey from the lowest, then the largest first
  std::vector<Door> doors;  // in the order of the world's openings
  std::vector<Way> ways;    // with the rooms that they begin and end in
};

inline std::size_t count_of(const RoomMap& map) { return map.rooms.size(); }

// The rooms of each storey and the doors between them; what the world says of rooms and doors so
// far does not matter. A room is floor that hangs together where walls are cut at a height above
// furniture and all openings are closed along their loops. It has the ids of the surfaces that
// bound it: floors, the walls that are cut and look into it, and the lowest ceilings over it. A
// door is an opening of kind door or passage with different rooms on its two sides; those that lead
// outside, or to where there is no room, are none. docs/maps.md tells how.
RoomMap find_rooms(const World& world, const RoomOptions& options = {});

// Gives a world the rooms that were found, the doors and the ways.
void set_rooms(World& world, RoomMap map);

}  // namespace scanworld
