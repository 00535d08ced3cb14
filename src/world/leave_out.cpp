// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "leave_out.h"

#include <fmt/format.h>

#include <sstream>
#include <utility>

#include "../error.h"
#include "colliders.h"
#include "inferred_parts.h"
#include "simplify.h"

namespace scanworld {

namespace {

constexpr std::pair<const char*, WorldPart> kPartNames[] = {{"obstacles", WorldPart::obstacles},
                                                            {"colliders", WorldPart::colliders},
                                                            {"openings", WorldPart::openings},
                                                            {"surfaces", WorldPart::surfaces},
                                                            {"inferred", WorldPart::inferred}};

WorldPart part_named(const std::string& wanted) {
  std::string names;
  for (const auto& [name, part] : kPartNames) {
    if (wanted == name) return part;
    names += (names.empty() ? "" : ", ") + std::string(name);
  }
  throw Error(Cause::usage,
              fmt::format("--without: '{}' is no part of a world; there are {}", wanted, names));
}

// Removes curves that nothing is part of.
void drop_curves(World& world) {
  std::set<int> named;
  for (const Surface& s : world.surfaces)
    if (s.curve) named.insert(*s.curve);
  for (const Obstacle& o : world.obstacles)
    if (o.curve) named.insert(*o.curve);
  std::erase_if(world.curves, [&](const CurvedPart& c) { return !named.contains(c.id); });
}

}  // namespace

std::set<WorldPart> parts_from(const std::string& text) {
  std::set<WorldPart> parts;
  std::istringstream names(text);
  for (std::string name; std::getline(names, name, ',');) parts.insert(part_named(name));
  return parts;
}

World leave_out(World world, const std::set<WorldPart>& parts) {
  if (parts.empty()) return world;
  if (parts.contains(WorldPart::obstacles)) world.obstacles.clear();
  if (parts.contains(WorldPart::colliders)) world.colliders.clear();
  if (parts.contains(WorldPart::openings)) world.openings.clear();
  if (parts.contains(WorldPart::surfaces)) world.surfaces.clear();
  const bool had_solids = !world.colliders.empty();
  const bool is_less = parts.contains(WorldPart::inferred) && cut_inferred(world);
  drop_dangling(world);
  drop_curves(world);
  if (is_less && had_solids) world.colliders = make_colliders(world);
  return world;
}

}  // namespace scanworld
