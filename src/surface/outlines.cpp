// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "outlines.h"

#include "trace_loops.h"

namespace scanworld::surface {

namespace {

using Side = Arrangement::Side;

// The connected part that each chosen cell is in, or -1; and how many there are.
int number_parts(const Arrangement& arrangement, const std::vector<char>& chosen,
                 std::vector<int>& part) {
  part.assign(chosen.size(), -1);
  int count = 0;
  std::vector<std::size_t> open;
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    if (!chosen[c] || part[c] >= 0) continue;
    part[c] = count;
    open.assign(1, c);
    while (!open.empty()) {
      const std::size_t at = open.back();
      open.pop_back();
      for (const Side& side : arrangement.cells[at].sides) {
        if (side.across < 0) continue;
        const auto next = static_cast<std::size_t>(side.across);
        if (chosen[next] && part[next] < 0) part[next] = count, open.push_back(next);
      }
    }
    ++count;
  }
  return count;
}

// The corners of a loop of sides: where it goes over to another line.
Outline::Loop corners_of(const std::vector<HalfEdge>& sides, const std::vector<std::size_t>& loop) {
  Outline::Loop corners;
  for (std::size_t k = 0; k < loop.size(); ++k) {
    const HalfEdge& side = sides[loop[k]];
    if (side.tag != sides[loop[(k + loop.size() - 1) % loop.size()]].tag)
      corners.push_back({side.from, side.tag});
  }
  return corners;
}

}  // namespace

std::vector<Outline> trace_outlines(const Arrangement& arrangement,
                                    const std::vector<char>& chosen) {
  std::vector<int> part;
  std::vector<Outline> outlines(static_cast<std::size_t>(number_parts(arrangement, chosen, part)));
  std::vector<std::vector<HalfEdge>> sides(outlines.size());
  for (std::size_t c = 0; c < chosen.size(); ++c) {
    if (part[c] < 0) continue;
    const auto k = static_cast<std::size_t>(part[c]);
    const Arrangement::Cell& cell = arrangement.cells[c];
    outlines[k].covered += cell.covered, outlines[k].empty += cell.empty;
    for (const Side& side : cell.sides) sides[k].push_back({side.from, side.to, side.line});
  }
  const auto at = [&](int v) { return arrangement.vertices[static_cast<std::size_t>(v)]; };
  for (std::size_t k = 0; k < outlines.size(); ++k)
    for (const auto& loop : trace_loops(sides[k], at))
      if (Outline::Loop corners = corners_of(sides[k], loop); corners.size() >= 3)
        outlines[k].loops.push_back(std::move(corners));
  return outlines;
}

}  // namespace scanworld::surface
