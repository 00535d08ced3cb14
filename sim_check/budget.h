// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "place.h"
#include "world/simplify.h"

namespace scanworld::sim {

struct BudgetOptions {
  double size = 0.1;         // [m] of the box that is tested for contact
  std::size_t probes = 200;  // places all over what is seen, at which it is tested
  int rounds = 5;
  std::uint64_t seed = 1;
};

// What a world is like with less in it.
struct BudgetTry {
  SimplifyOptions simplified;
  std::size_t surfaces = 0, obstacles = 0, solids = 0;
  double seconds = 0;  // of a contact test, the mean
};

struct Budget {
  double limit = 0;                     // [s] of a contact test in Bullet, the mean
  std::vector<BudgetTry> tries;         // the first one as it was
  bool is_met = false;                  // by the last one
  World world;                          // the one that meets it, else as it was
  std::vector<std::string> in_the_way;  // where it is not met: the slowest places, in words
};

inline std::size_t count_of(const Budget& budget) { return budget.world.colliders.size(); }

// Takes more and more out of a world, until a contact test takes no longer than the limit on this
// machine: obstacles become simple, then small things go, from 5 cm to 40 cm.
Budget meet_budget(const World& world, double limit, const BudgetOptions& options = {});

// The places where contact tests take longest, and what solids are there, in words.
std::vector<std::string> slowest_places(const Place& place, const BudgetOptions& options = {},
                                        std::size_t count = 5);

}  // namespace scanworld::sim
