// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "place.h"

namespace scanworld::sim {

struct SpotOptions {
  std::size_t count = 200;  // of spots, at most
  double size = 0.1;        // [m] of the robots that are to stand there
  double clearance = 0.15;  // [m] from a spot to anything that is not the floor
  double tolerance = 0.04;  // [m] by which the floors of two places may differ in height
  std::uint64_t seed = 1;
};

// Where robots can be: on the main floor, clear of everything.
struct Spots {
  std::vector<Vec3> floor;  // points of the floor, at the height of the reference's
  std::size_t shared = 0;   // so many, the first, are clear in all places, the rest in all worlds
  double height = 0;        // [m] of the main floor
  std::size_t tried = 0;
};

// A straight way over the floor that is clear and level in all places.
struct Lane {
  Vec3 from, to;  // on the floor
};

// The first place that is a world, else the first: where spots are looked for.
const Place& reference_of(const std::vector<Place>& places);

// Spots chosen at random, at least 1.5 sizes apart. Where a mesh is too rough to leave enough of
// them, those that the worlds agree on are added. The main floor is the lowest level that has a
// quarter as much that is level as the level that has most, which may be a ceiling. Throws
// nothing_found where there is not one spot.
Spots find_spots(const std::vector<Place>& places, const SpotOptions& options = {});

// The same spots, so low that robots of this size touch the floor of all worlds, or where there is
// none that of the reference: a millimetre below the highest of what is under the middle and the
// corners of each.
std::vector<Vec3> touching(const std::vector<Place>& places, const std::vector<Vec3>& spots,
                           double size);

// Lanes of this length from spots, in directions chosen at random, one from each spot at most;
// where no lane is clear in all places, those in all worlds.
std::vector<Lane> find_lanes(const std::vector<Place>& places, const Spots& spots, double length,
                             std::size_t count, const SpotOptions& options = {});

// Points all over what is seen of the reference, chosen by area, each moved off along the normal by
// `off` [m] to the side that is free.
std::vector<Vec3> find_probes(const std::vector<Place>& places, std::size_t count, double off,
                              std::uint64_t seed);

}  // namespace scanworld::sim
