// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "interfaces.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "../disjoint_sets.h"
#include "../polygon.h"
#include "slits.h"

namespace scanworld::space {

namespace {

using CornerLoop = std::vector<int>;

// Facets of one plane that hang together, with one side free.
struct Sheet {
  int plane;
  std::size_t free_side;
  std::vector<int> facets;
  std::vector<CornerLoop> loops;  // counter-clockwise about the plane's normal; holes clockwise
};

// The facets between free and solid; where points should be and are not, they are openings.
FacetsBetween facets_between(const CellComplex& cells, const Evidence& evidence,
                             const std::vector<Label>& labels, const InterfaceOptions& options) {
  const Label beyond = options.is_closed ? Label::solid : Label::unknown;
  const auto label_of = [&](int cell) {
    return cell < 0 ? beyond : labels[static_cast<std::size_t>(cell)];
  };
  FacetsBetween found;
  for (std::size_t f = 0; f < cells.facets().size(); ++f) {
    const CellFacet& facet = cells.facets()[f];
    const Label a = label_of(facet.cells[0]), b = label_of(facet.cells[1]);
    if (!(a == Label::free && b == Label::solid) && !(a == Label::solid && b == Label::free))
      continue;
    const FacetEvidence& e = evidence.facets[f];
    (e.empty > options.max_empty * e.area ? found.openings : found.surfaces)
        .push_back(static_cast<int>(f));
  }
  return found;
}

std::vector<int> all_of(const FacetsBetween& facets) {
  std::vector<int> all = facets.surfaces;
  all.insert(all.end(), facets.openings.begin(), facets.openings.end());
  return all;
}

class SheetTracer {
 public:
  SheetTracer(const CellComplex& cells, const Evidence& evidence, const std::vector<Label>& labels,
              const FacetEdges& edges, const InterfaceOptions& options)
      : cells_(cells), evidence_(evidence), labels_(labels), edges_(edges), options_(options) {}

  std::vector<Interface> trace(const std::vector<int>& shown) {
    join(shown);
    trace_sheets();
    for (const Sheet& sheet : sheets_) mark_turns(sheet);
    std::vector<Interface> result;
    for (const Sheet& sheet : sheets_) cut_out(sheet, result);
    return result;
  }

 private:
  const CellFacet& facet(int f) const { return cells_.facets()[static_cast<std::size_t>(f)]; }

  // Facets of one plane and side that hang together are one sheet.
  void join(const std::vector<int>& shown) {
    for (std::vector<int>& facets : find_sheets(cells_, labels_, edges_, shown)) {
      const CellFacet& first = facet(facets[0]);
      sheets_.push_back({first.plane, free_side_of(first, labels_), std::move(facets), {}});
    }
  }

  // Sheets whose outlines pass no corner twice: one that does is parted there. Polygons that touch
  // themselves are valid, but few programs triangulate them.
  void trace_sheets() {
    std::vector<Sheet> traced;
    while (!sheets_.empty()) {
      Sheet sheet = std::move(sheets_.back());
      sheets_.pop_back();
      trace_loops(sheet);
      const auto pinch = find_pinch(sheet);
      if (!pinch || !part_at(sheet, *pinch)) traced.push_back(std::move(sheet));
    }
    sheets_ = std::move(traced);
  }

  static std::optional<int> find_pinch(const Sheet& sheet) {
    std::set<int> passed;
    for (const CornerLoop& loop : sheet.loops)
      for (const int corner : loop)
        if (!passed.insert(corner).second) return corner;
    return std::nullopt;
  }

  // Gives each facet of a sheet to the one of the parts that meet in a corner from which it is
  // reached first; false where there is but one.
  bool part_at(const Sheet& sheet, int corner) {
    const std::size_t count = sheet.facets.size();
    std::map<Edge, std::vector<std::size_t>> at_edge;
    for (std::size_t i = 0; i < count; ++i)
      edges_.visit(sheet.facets[i], [&](int a, int b) { at_edge[std::minmax(a, b)].push_back(i); });
    DisjointSets wedges(count);
    std::vector<std::vector<std::size_t>> beside(count);
    std::set<std::size_t> around;
    for (const auto& [edge, facets] : at_edge)
      for (const std::size_t i : facets) {
        const bool meets = edge.first == corner || edge.second == corner;
        if (meets) around.insert(i);
        if (i == facets[0]) continue;
        if (meets) wedges.unite(facets[0], i);
        beside[facets[0]].push_back(i), beside[i].push_back(facets[0]);
      }
    std::vector<std::size_t> reached(around.begin(), around.end());
    std::vector<int> part_of(count, -1);
    std::map<std::size_t, int> parts;
    for (const std::size_t i : reached)
      part_of[i] = parts.try_emplace(wedges.find(i), static_cast<int>(parts.size())).first->second;
    for (std::size_t k = 0; k < reached.size(); ++k)
      for (const std::size_t next : beside[reached[k]])
        if (part_of[next] < 0) part_of[next] = part_of[reached[k]], reached.push_back(next);
    if (parts.size() < 2) return false;
    for (std::size_t p = 0; p < parts.size(); ++p) {
      Sheet part{sheet.plane, sheet.free_side, {}, {}};
      for (std::size_t i = 0; i < count; ++i)
        if (part_of[i] == static_cast<int>(p)) part.facets.push_back(sheet.facets[i]);
      sheets_.push_back(std::move(part));
    }
    return true;
  }

  // Of the edges that leave a corner the first one clockwise from where the loop came from.
  int turn(int before, int at, const std::vector<int>& next, const Vec3& normal) const {
    const Vec3 back = cells_.vertex(before) - cells_.vertex(at);
    int best = next[0];
    double least = 1e9;
    for (const int candidate : next) {
      const Vec3 way = cells_.vertex(candidate) - cells_.vertex(at);
      double angle = std::atan2(normal.dot(way.cross(back)), way.dot(back));
      if (angle <= 1e-9) angle += 2 * std::numbers::pi;
      if (angle < least) least = angle, best = candidate;
    }
    return best;
  }

  void trace_loops(Sheet& sheet) const {
    std::map<Edge, int> count;
    for (const int f : sheet.facets) edges_.visit(f, [&](int a, int b) { ++count[{a, b}]; });
    std::map<int, std::vector<int>> next;
    for (const auto& [edge, times] : count) {
      const auto back = count.find({edge.second, edge.first});
      const int left = times - (back == count.end() ? 0 : back->second);
      if (left > 0) next[edge.first].push_back(edge.second);
    }
    const Vec3& normal = cells_.plane(sheet.plane).normal;
    while (!next.empty()) {
      CornerLoop loop;
      const int start = next.begin()->first;
      int before = -1, at = start;
      do {
        const auto leaving = next.find(at);
        if (leaving == next.end()) break;
        const int to = before < 0 ? leaving->second[0] : turn(before, at, leaving->second, normal);
        std::erase(leaving->second, to);
        if (leaving->second.empty()) next.erase(leaving);
        loop.push_back(at);
        before = at, at = to;
      } while (at != start);
      if (at == start) part(loop, sheet.loops);
    }
  }

  // A loop that passes a corner twice is several.
  static void part(const CornerLoop& loop, std::vector<CornerLoop>& parts) {
    CornerLoop open;
    for (const int corner : loop) {
      const auto passed = std::find(open.begin(), open.end(), corner);
      if (passed != open.end()) {
        if (open.end() - passed >= 3) parts.emplace_back(passed, open.end());
        open.erase(passed, open.end());
      }
      open.push_back(corner);
    }
    if (open.size() >= 3) parts.push_back(std::move(open));
  }

  // Corners where some loop turns; at others all go straight on.
  void mark_turns(const Sheet& sheet) {
    constexpr double kStraight = 1e-6;  // [m]
    for (const CornerLoop& loop : sheet.loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const Vec3 &a = cells_.vertex(loop[(i + loop.size() - 1) % loop.size()]),
                   &b = cells_.vertex(loop[i]), &c = cells_.vertex(loop[(i + 1) % loop.size()]);
        const double off = (b - a).cross(c - a).norm() / std::max(1e-9, (c - a).norm());
        if (off > kStraight || (b - a).dot(c - b) < 0) turns_.insert(loop[i]);
      }
  }

  std::vector<Vec3> ring_of(const CornerLoop& loop) const {
    std::vector<Vec3> ring;
    for (const int corner : loop)
      if (turns_.contains(corner)) ring.push_back(cells_.vertex(corner));
    return ring;
  }

  // The polygons of a sheet, each with the holes in it.
  void cut_out(const Sheet& sheet, std::vector<Interface>& result) const {
    const PlaneFrame frame = frame_of(cells_.plane(sheet.plane));
    struct Ring {
      std::vector<Vec3> points;
      std::vector<Vec2> flat;
      double area;
    };
    std::vector<Ring> outers, holes;
    for (const CornerLoop& loop : sheet.loops) {
      Ring ring{ring_of(loop), {}, 0};
      if (ring.points.size() < 3) continue;
      for (const Vec3& p : ring.points) ring.flat.push_back(frame.to_plane(p));
      ring.area = doubled_area(ring.flat) / 2;
      if (std::abs(ring.area) < options_.min_area) continue;
      (ring.area > 0 ? outers : holes).push_back(std::move(ring));
    }
    double area = 0, supported = 0;
    for (const int f : sheet.facets) {
      const FacetEvidence& e = evidence_.facets[static_cast<std::size_t>(f)];
      area += e.area, supported += e.supported[sheet.free_side];
    }
    const auto placed = [&](std::vector<Vec3> ring) {
      if (sheet.free_side == 1) std::reverse(ring.begin(), ring.end());
      return ring;
    };
    for (Ring& outer : outers) {
      Interface shown{.plane = sheet.plane,
                      .is_flipped = sheet.free_side == 1,
                      .loops = {placed(outer.points)},
                      .area = area,
                      .supported = supported,
                      .facets = sheet.facets};
      for (const Ring& hole : holes) {
        // A place just inside of the hole.
        Vec2 middle = Vec2::Zero();
        for (const Vec2& p : hole.flat) middle += p / static_cast<double>(hole.flat.size());
        if (is_inside({outer.flat}, 0.999 * hole.flat[0] + 0.001 * middle) ||
            is_inside({outer.flat}, hole.flat[0]))
          shown.loops.push_back(placed(hole.points));
      }
      result.push_back(std::move(shown));
    }
  }

  const CellComplex& cells_;
  const Evidence& evidence_;
  const std::vector<Label>& labels_;
  const FacetEdges& edges_;
  const InterfaceOptions& options_;
  std::vector<Sheet> sheets_;
  std::set<int> turns_;
};

}  // namespace

std::vector<Interface> find_interfaces(const CellComplex& cells, const Evidence& evidence,
                                       const std::vector<Label>& labels,
                                       const InterfaceOptions& options) {
  const FacetsBetween between = facets_between(cells, evidence, labels, options);
  const FacetEdges edges(cells, all_of(between), options.same);
  const std::vector<int> shown = close_slits(cells, labels, edges, between, options.narrow);
  return SheetTracer(cells, evidence, labels, edges, options).trace(shown);
}

}  // namespace scanworld::space
