// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "topology.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "../error.h"

namespace scanworld {

namespace {

// The middle of an opening, at the height of its lowest vertex.
Vec3 threshold_of(const World& world, const Loop& loop) {
  Box3 box;
  for (int v : loop) box.extend(world.vertices[static_cast<std::size_t>(v)]);
  double low = std::numeric_limits<double>::max();
  for (int v : loop)
    low = std::min(low, world.frame.up.dot(world.vertices[static_cast<std::size_t>(v)]));
  const Vec3 middle = box.center();
  return middle + (low - world.frame.up.dot(middle)) * world.frame.up;
}

}  // namespace

Topology topology_of(const World& world) {
  Topology map;
  for (const Room& r : world.rooms) map.nodes.push_back({r.id, r.name, r.area, r.center});
  for (const Door& d : world.doors) {
    const auto opening = std::find_if(world.openings.begin(), world.openings.end(),
                                      [&](const Opening& o) { return o.id == d.opening; });
    if (opening == world.openings.end())
      throw Error(Cause::check_failed, fmt::format("door: there is no opening {}", d.opening));
    PlaceEdge edge{.opening = d.opening,
                   .rooms = d.rooms,
                   .kind = opening->kind,
                   .width = opening->width,
                   .height = opening->height,
                   .place = threshold_of(world, opening->loop)};
    double length = 0;
    bool is_known = true;
    for (int id : d.rooms) {
      const auto room = std::find_if(world.rooms.begin(), world.rooms.end(),
                                     [&](const Room& r) { return r.id == id; });
      if (room == world.rooms.end())
        throw Error(Cause::check_failed,
                    fmt::format("door at opening {}: there is no room {}", d.opening, id));
      if (room->center)
        length += (*room->center - edge.place).norm();
      else
        is_known = false;
    }
    if (is_known) edge.length = length;
    map.edges.push_back(edge);
  }
  return map;
}

}  // namespace scanworld
