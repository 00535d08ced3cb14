// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "world.h"

namespace scanworld {

// Floors at about one height.
struct Storey {
  double level = 0;              // [m] height along up of the middle of its largest floor
  double area = 0;               // [m2] of its floors
  std::vector<int> floors = {};  // index into World::surfaces
};

struct StoreyOptions {
  double min_height = 2.0;  // [m] from one storey to the next: less has no room for a person
  double min_area = 2.0;    // [m2] of a storey's largest floor: landings and steps are smaller
};

// The storeys of a world, the lowest first: the largest floor makes one, and so does the largest of
// those that are too far from it, and so on; every floor belongs to the storey nearest in height.
std::vector<Storey> find_storeys(const World& world, const StoreyOptions& options = {});

// The height of the main floor (main_floor()) along up [m]; that of the lowest vertex where there
// is no floor, 0 where there is nothing.
double main_level(const World& world);

}  // namespace scanworld
