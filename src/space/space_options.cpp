// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of space by their names.
#include <fmt/format.h>

#include "../error.h"
#include "space.h"

namespace scanworld::space {

const char* name_of(Unknown unknown) {
  constexpr const char* kNames[] = {"behind", "solid", "free", "open"};
  return kNames[static_cast<std::size_t>(unknown)];
}

Unknown unknown_named(const std::string& name) {
  for (const Unknown unknown : {Unknown::solid, Unknown::free, Unknown::open})
    if (name == name_of(unknown)) return unknown;
  throw Error(Cause::usage, fmt::format("--unknown: '{}' is none of solid, free and open", name));
}

OptionList list_options(SpaceOptions& o) {
  return {
      {"space.on", &o.is_on, "", "whether surfaces are where free space meets solid"},
      {"space.cover.reach_share", &o.cover.reach_share, "",
       "of a plane's size, so far it may go on beyond its points", 0},
      {"space.cover.min_reach", &o.cover.min_reach, "m", "but so far at least", 0},
      {"space.cover.max_reach", &o.cover.max_reach, "m", "and at most", 0},
      {"space.cover.floor_reach", &o.cover.floor_reach, "m",
       "and at most, of a floor with a ceiling", 0},
      {"space.sight.cell", &o.cover.sight.cell, "m",
       "edge of the cells in which points hide what is behind them", 0.02},
      {"space.sight.viewers", &o.cover.sight.viewers, "",
       "viewpoints that are asked about a place, the nearest ones", 1},
      {"space.sight.min_cosine", &o.cover.sight.min_cosine, "",
       "of a line of sight to a normal; what is seen more aslant is unsure", 0, 1},
      {"space.sight.look_ahead", &o.cover.sight.look_ahead, "m",
       "where no viewpoint is known: what stands so near before a plane hides it", 0},
      {"space.sight.look_below", &o.cover.sight.look_below, "m",
       "where no viewpoint is known: a floor is none only if something is so near below", 0},
      {"space.rays.site", &o.rays.site, "m", "one line of sight for the points of so large a cube",
       0.02},
      {"space.rays.before", &o.rays.before, "m", "a line of sight ends so far before what was seen",
       0},
      {"space.rays.on_plane", &o.rays.on_plane, "", "weight of a line of sight to a plane", 0},
      {"space.rays.loose", &o.rays.loose, "", "and to anything else", 0},
      {"space.rays.mutual", &o.rays.mutual, "", "and between planes, where no viewpoint is known",
       0},
      {"space.planes.seam_reach", &o.planes.seam_reach, "m",
       "a plane goes on to both sides of where another one ends on it", 0},
      {"space.planes.edge_depth", &o.planes.edge_depth, "m",
       "the end of a face cuts so deep to both sides of it", 0},
      {"space.planes.min_emptiness", &o.planes.min_emptiness, "",
       "beyond the end of a face; else its points just end there", 0, 1},
      {"space.planes.min_step", &o.planes.min_step, "m", "between two planes of one wall", 0},
      {"space.planes.min_behind", &o.planes.min_behind, "",
       "share of a plate that lines of sight pass behind", 0, 1},
      {"space.planes.thin", &o.planes.thin, "m", "thickness of a plate seen from one side", 0.001},
      {"space.planes.thin_wall", &o.planes.thin_wall, "m", "where it is large and upright", 0.001},
      {"space.arrange.pad", &o.arrange.pad, "m", "around all points and viewpoints", 0.01},
      {"space.labels.front", &o.labels.front, "",
       "price of each m2 with points that what is before it is not free", 0},
      {"space.labels.back", &o.labels.back, "", "that what is behind it is not solid", 0},
      {"space.labels.supported", &o.labels.supported, "", "of a surface with points", 0},
      {"space.labels.reversed", &o.labels.reversed, "", "of one the wrong way round", 0},
      {"space.labels.empty", &o.labels.empty, "", "of one where points should be", 0},
      {"space.labels.beside", &o.labels.beside, "", "of one beside points", 0},
      {"space.labels.extended", &o.labels.extended, "", "and more, as far as it is from them", 0},
      {"space.labels.bare", &o.labels.bare, "", "of one in no plane with points", 0},
      {"space.labels.bare_facet", &o.labels.bare_facet, "m2", "and of each facet of it", 0},
      {"space.labels.of_plate", &o.labels.of_plate, "", "but the back of a plate", 0},
      {"space.labels.open", &o.labels.open, "",
       "of an open side to what is unknown, where a plane goes on", 0},
      {"space.labels.open_floor", &o.labels.open_floor, "", "where a floor goes on", 0},
      {"space.labels.open_over_floor", &o.labels.open_over_floor, "",
       "where free is over unknown, above where the floor of a room goes on", 0},
      {"space.labels.open_bare", &o.labels.open_bare, "", "and elsewhere", 0},
      {"space.labels.border", &o.labels.border, "", "of an open side at the border of all", 0},
      {"space.labels.border_crossed", &o.labels.border_crossed, "", "where lines of sight go", 0},
      {"space.labels.volume", &o.labels.volume, "",
       "of each m3 of free space that no line of sight crosses", 0},
      {"space.labels.min_volume", &o.labels.min_volume, "m3",
       "of free space with no viewpoint in it; less is none", 0},
      {"space.labels.slit_width", &o.labels.slit_width, "m",
       "of a gap in what is solid; what is narrower is none", 0},
      {"space.labels.slit_solid", &o.labels.slit_solid, "",
       "where so much of what is around it is solid", 0, 1},
      {"space.labels.rounds", &o.labels.rounds, "", "of cuts, at most", 1, 20},
      {"space.interfaces.max_empty", &o.interfaces.max_empty, "",
       "share of a facet where points should be; with more it is an opening", 0, 1},
      {"space.interfaces.same", &o.interfaces.same, "m", "corners nearer than this are one", 0,
       0.0009},
      {"space.interfaces.narrow", &o.interfaces.narrow, "m",
       "openings are no narrower, nor is what hangs beside a surface alone", 0},
      {"space.interfaces.min_area", &o.interfaces.min_area, "m2", "of a loop that is kept", 0},
  };
}

}  // namespace scanworld::space
