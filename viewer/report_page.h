// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "world/world.h"

namespace scanworld {

// report.json for people: what was found, how true it is, where the time went, with pictures and
// the floor plan; one file without scripts. `report`: the text of report.json. Throws bad_input
// where that is none, and check_failed naming a surface that is no valid polygon.
std::string report_page_of(const World& world, const std::string& title, const std::string& report);

}  // namespace scanworld
