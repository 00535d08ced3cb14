// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "dot.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "files.h"
#include "world/level.h"
#include "world/topology.h"

namespace scanworld {

namespace {

// Text between the quotes of a string, whose only escape in the language is that of the quote;
// labels know more.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '"' || c == '\\') result += '\\';
    if (c == '\n')
      result += "\\n";
    else if (static_cast<unsigned char>(c) >= ' ')
      result += c;
  }
  return result;
}

}  // namespace

void write_dot(const std::filesystem::path& path, const World& world, const ExportOptions&) {
  const Topology map = topology_of(world);
  const Eigen::Quaterniond upright = upright_turn(world.frame);
  std::string text =
      "// scanworld: rooms, and the doors and stairs between them; metres\n"
      "graph rooms {\n  node [shape=box];\n";
  for (const PlaceNode& room : map.nodes) {
    std::string label = escaped(room.name), more;
    if (room.area) {
      label += fmt::format("\\n{:.1f} m2", *room.area);
      more += fmt::format(", area={:.6f}", *room.area);
    }
    if (room.center) {
      const Vec3 p = upright * *room.center;
      more += fmt::format(", pos=\"{:.6f},{:.6f}\"", p.x(), p.y());
    }
    text += fmt::format("  room_{} [label=\"{}\"{}];\n", room.room, label, more);
  }
  for (const PlaceEdge& door : map.edges) {
    text += fmt::format("  room_{} -- room_{} [label=\"{:.2f} m\", opening={}, door_width={:.6f}",
                        door.rooms[0], door.rooms[1], door.width, door.opening, door.width);
    if (door.length) text += fmt::format(", length={:.6f}", *door.length);
    text += "];\n";
  }
  for (const PlaceClimb& climb : map.climbs) {
    text += fmt::format(
        "  room_{} -- room_{} [label=\"{} {:.2f} m up\", style=dashed, ways=\"{}\", rise={:.6f}, "
        "way_width={:.6f}",
        climb.rooms[0], climb.rooms[1], name_of(climb.kind), climb.rise, fmt::join(climb.ways, " "),
        climb.rise, climb.width);
    if (climb.length) text += fmt::format(", length={:.6f}", *climb.length);
    text += "];\n";
  }
  write_text(path, text + "}\n");
}

}  // namespace scanworld
