// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "../world/cloud_in_world.h"
#include "../world/openings.h"
#include "facets.h"

namespace scanworld::terrain {

struct GroundOptions {
  bool is_on = true;
  HeightOptions heights;
  double min_area = 4;     // [m2] that was seen of ground that no floor fits; less is left
  double min_seen = 0.25;  // share of it; what is seen in few places may be anything
  double min_floor = 4;    // [m2] of a floor that ground goes on from
  double max_facets = 20;  // [1/m2] of a piece of it; stairs and heaps need more, and are none
  double max_off = 0.2;    // share of a floor's cells off the ground; a floor with more is none
  double error = 0.75;     // [tolerance] facets are off the ground by no more
  double margin = 0.2;     // [m] ground goes on so far under the floors beside it
  double beyond = 1;       // [m] ground goes on so far beyond what is seen of it
};

OptionList list_options(GroundOptions& options);

// The lengths that ground is looked at in [m].
struct GroundScale {
  double tolerance = 0.02;  // floors and ground are no farther apart
  double spacing = 0.02;    // between neighbouring places
};

// A world with ground that no plane fits.
struct Ground {
  World world;
  std::vector<std::int32_t> new_id;  // for each surface before its id now, or -1
  std::size_t facets = 0;            // of ground: the last surfaces
  surface::Raster cells;             // of the plane that up is normal to, frame_of({up, 0})
  std::vector<std::vector<std::int32_t>>
      id_of_cell;  // of each storey the facet in each cell, or -1
};

inline std::size_t count_of(const Ground& ground) { return ground.facets; }

// Finds the ground, of each storey, that no floor of a world fits, from the places where the scan
// has something, and adds it as facets; they take the place of the floors that are off it. Ground
// is where a way leads from a floor without a step; it goes on over gaps and a little under what
// stands on it, but not where one looks down through it. Of the world only surfaces are looked at,
// and ids are new.
Ground find_ground(World world, const std::vector<Vec3>& places,
                   const std::vector<SightLine>& lines, const GroundScale& scale,
                   const GroundOptions& options = {});

// Gives the points of no surface that lie no farther than `tolerance` [m] off ground to its facet,
// and the facets their support.
std::vector<std::int32_t> label_ground(const CloudInWorld& cloud, std::vector<std::int32_t> labels,
                                       double tolerance, Ground& ground);

}  // namespace scanworld::terrain
