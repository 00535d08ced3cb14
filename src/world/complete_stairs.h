// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "openings.h"
#include "ways.h"

namespace scanworld {

struct StairsOptions {
  bool is_on = true;
  double cell = 0.05;         // [m] in which it is asked what of a tread or a riser is there
  double same = 0.05;         // [m] a surface is no farther off the tread that it is ...
  double same_cosine = 0.9;   // ... and looks the same way
  double min_missing = 0.25;  // share of a tread or a riser; with less missing it is as it is
  double max_lines = 10;      // of sight, for each m2 of what is missing; more tell that it is open
};

OptionList list_options(StairsOptions& options);

// Adds the treads, and the risers beside them, that nothing was seen of in flights of stairs: those
// of which others of the flight tell where they are. They are inferred, and as thick as half a
// riser. What lines of sight go through stays open. The world's surfaces keep their ids.
World complete_stairs(World world, std::span<const SightLine> lines,
                      const StairsOptions& options = {}, const WayOptions& ways = {});

}  // namespace scanworld
