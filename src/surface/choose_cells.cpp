// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "choose_cells.h"

#include "../min_cut.h"

namespace scanworld::surface {

namespace {

double overlap(const std::vector<Interval>& list, const Interval& t) {
  double sum = 0;
  for (const Interval& i : list)
    sum += std::max(0.0, std::min(i.high, t.high) - std::max(i.low, t.low));
  return sum;
}

// Of a side that runs over `t` along its line.
double price_of(const Arrangement& arrangement, const Arrangement::Side& side,
                const std::vector<CutLine>& lines, const Interval& t,
                const ChoiceOptions& options) {
  const double length = (arrangement.vertices[static_cast<std::size_t>(side.to)] -
                         arrangement.vertices[static_cast<std::size_t>(side.from)])
                            .norm();
  if (static_cast<std::size_t>(side.line) >= lines.size()) return options.open_price * length;
  const CutLine& line = lines[static_cast<std::size_t>(side.line)];
  // A seam is likely to go on between where it is seen.
  const double seen =
      std::min(length, line.is_seam ? overlap({{line.seen.front().low, line.seen.back().high}}, t)
                                    : overlap(line.seen, t));
  const double sure = std::min(seen, overlap(line.sure, t));
  return sure * options.sure_price +
         (seen - sure) * (line.is_seam ? options.seam_price : options.edge_price) +
         (length - seen) * options.open_price;
}

}  // namespace

std::vector<char> choose_cells(const Arrangement& arrangement, const std::vector<CutLine>& lines,
                               const PlaneFrame& frame, const ChoiceOptions& options) {
  const std::size_t count = arrangement.cells.size();
  const int source = static_cast<int>(count), sink = source + 1;
  std::vector<FlowEdge<double>> edges;
  for (std::size_t c = 0; c < count; ++c) {
    const Arrangement::Cell& cell = arrangement.cells[c];
    const int own = static_cast<int>(c);
    // What is common to both does not decide.
    const double gain = cell.covered - cell.empty;
    if (gain > 0)
      edges.push_back({source, own, gain, 0});
    else
      edges.push_back({own, sink, -gain, 0});
    for (const Arrangement::Side& side : cell.sides) {
      if (side.across >= 0 && side.across < own) continue;
      const auto t = [&](int v) {
        if (static_cast<std::size_t>(side.line) >= lines.size()) return 0.0;
        const Vec3 p = frame.to_space(arrangement.vertices[static_cast<std::size_t>(v)]);
        return lines[static_cast<std::size_t>(side.line)].line.direction.dot(p);
      };
      const double from = t(side.from), to = t(side.to);
      const double price =
          price_of(arrangement, side, lines, {std::min(from, to), std::max(from, to)}, options);
      if (side.across < 0)
        edges.push_back({own, sink, price, 0});
      else
        edges.push_back({own, side.across, price, price});
    }
  }
  std::vector<char> chosen = min_cut(count + 2, source, sink, edges);
  chosen.resize(count);
  return chosen;
}

}  // namespace scanworld::surface
