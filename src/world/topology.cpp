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

const Room& room_with(const World& world, int id, const std::string& what) {
  const auto room = std::find_if(world.rooms.begin(), world.rooms.end(),
                                 [&](const Room& r) { return r.id == id; });
  if (room == world.rooms.end())
    throw Error(Cause::check_failed, fmt::format("{}: there is no room {}", what, id));
  return *room;
}

// The length of the way from the centre of one room over places to that of another.
std::optional<double> length_over(const Room& from, const std::vector<Vec3>& places,
                                  const Room& to) {
  if (!from.center || !to.center) return std::nullopt;
  double length = 0;
  Vec3 last = *from.center;
  for (const Vec3& p : places) length += (p - last).norm(), last = p;
  return length + (*to.center - last).norm();
}

// The flight that goes on from the landing that one ends on; null where none does.
const Way* next_flight(const World& world, const Way& flight) {
  if (flight.rooms[1] || !flight.floors[1]) return nullptr;
  const auto next = std::find_if(world.ways.begin(), world.ways.end(), [&](const Way& w) {
    return w.floors[0] == flight.floors[1] && !w.rooms[0] &&
           world.frame.up.dot(w.top - flight.top) > 0;
  });
  return next == world.ways.end() ? nullptr : &*next;
}

// From a flight that begins in a room; nothing where it leads to none.
std::optional<PlaceClimb> climb_from(const World& world, const Way& first) {
  PlaceClimb climb{.width = first.width};
  std::vector<Vec3> places;
  const Way* last = nullptr;
  for (const Way* w = &first; w; w = next_flight(world, *w)) {
    climb.ways.push_back(w->id);
    if (w->kind == WayKind::stairs) climb.kind = WayKind::stairs;
    climb.width = std::min(climb.width, w->width);
    places.insert(places.end(), {w->foot, w->top});
    last = w;
  }
  if (!first.rooms[0] || !last->rooms[1]) return std::nullopt;
  climb.rooms = {*first.rooms[0], *last->rooms[1]};
  if (climb.rooms[0] == climb.rooms[1]) return std::nullopt;
  climb.rise = world.frame.up.dot(last->top - first.foot);
  const std::string what = fmt::format("way {}", first.id);
  climb.length = length_over(room_with(world, climb.rooms[0], what), places,
                             room_with(world, climb.rooms[1], what));
  return climb;
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
    const std::string what = fmt::format("door at opening {}", d.opening);
    edge.length = length_over(room_with(world, d.rooms[0], what), {edge.place},
                              room_with(world, d.rooms[1], what));
    map.edges.push_back(edge);
  }
  for (const Way& w : world.ways)
    if (const auto climb = climb_from(world, w)) map.climbs.push_back(*climb);
  return map;
}

}  // namespace scanworld
