// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <set>
#include <string>

#include "world.h"

namespace scanworld {

// What a world can be without. `inferred` are the surfaces that no point was measured on.
enum class WorldPart { obstacles, colliders, openings, surfaces, inferred };

// The parts in "obstacles,inferred"; none in "". Throws usage naming all for what is none.
std::set<WorldPart> parts_from(const std::string& text);

// A world without some of its parts. With surfaces go their openings and colliders, with openings
// their doors; the holes that openings were in stay open. Rooms stay. Solids of a world that loses
// its inferred surfaces are made anew, as one may have stood for a measured surface too. Ids stay.
World leave_out(World world, const std::set<WorldPart>& parts);

}  // namespace scanworld
