// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface.h"

#include <algorithm>
#include <set>

#include "../parallel.h"
#include "outlines.h"

namespace scanworld::surface {

namespace {

// Intervals in order, those that overlap as one.
void merge(std::vector<Interval>& list) {
  std::sort(list.begin(), list.end(),
            [](const Interval& a, const Interval& b) { return a.low < b.low; });
  std::size_t last = 0;
  for (std::size_t k = 1; k < list.size(); ++k) {
    if (list[k].low <= list[last].high)
      list[last].high = std::max(list[last].high, list[k].high);
    else
      list[++last] = list[k];
  }
  if (!list.empty()) list.resize(last + 1);
}

double seen_length(const CutLine& line) {
  double sum = 0;
  for (const Interval& i : line.seen) sum += i.length();
  return sum;
}

// The line of a shared edge in a patch, by its parts there; it may cut a little beyond.
std::optional<CutLine> line_of(const SharedEdge& edge, int patch, int plane, const Plane& own,
                               double extension) {
  const auto line = intersect(own, edge.plane, 0.5);
  if (!line) return std::nullopt;
  CutLine cut{.other = plane, .line = *line};
  for (const SharedEdge::Part& part : edge.parts) {
    if (part.patch != patch) continue;
    const double from = line->direction.dot(part.from), to = line->direction.dot(part.to);
    cut.seen.push_back({std::min(from, to), std::max(from, to)});
  }
  merge(cut.seen);
  cut.reach = {cut.seen.front().low - extension, cut.seen.back().high + extension};
  return cut;
}

// The planes around a patch's rectangle, in the order of the arrangement's lines.
std::array<Plane, 4> frame_planes(const Patch& patch) {
  const Vec3 low = patch.frame.to_space(patch.hit.low),
             high = patch.frame.to_space(patch.hit.high());
  return {plane_through(low, patch.frame.v), plane_through(high, patch.frame.u),
          plane_through(high, patch.frame.v), plane_through(low, patch.frame.u)};
}

// Of the least area: what the largest piece of a plane needs, as the plane was told by evidence.
constexpr double kMainPart = 0.25;

std::vector<CornerPolygon> outline(const Patch& patch, int own, int first_frame,
                                   const std::vector<CutLine>& lines,
                                   const SurfaceOptions& options) {
  if (patch.hit.bits.empty()) return {};
  const Arrangement arrangement = arrange(patch, lines);
  std::vector<char> chosen;
  // A small or ragged patch would rather be nothing; then its outline may cost less.
  ChoiceOptions choice = options.choice;
  for (int round = 0; round < 4 && std::count(chosen.begin(), chosen.end(), 1) == 0; ++round) {
    chosen = choose_cells(arrangement, lines, patch.frame, choice);
    choice.sure_price /= 3, choice.seam_price /= 3, choice.edge_price /= 3, choice.open_price /= 3;
  }
  const auto plane_of = [&](int line) {
    const auto l = static_cast<std::size_t>(line);
    return l < lines.size() ? lines[l].other : first_frame + static_cast<int>(l - lines.size());
  };
  std::vector<CornerPolygon> polygons;
  std::vector<double> areas;
  const std::vector<Outline> parts = trace_outlines(arrangement, chosen);
  const auto less_covered = [](const Outline& a, const Outline& b) {
    return a.covered < b.covered;
  };
  const auto most = std::max_element(parts.begin(), parts.end(), less_covered);
  for (auto part = parts.begin(); part != parts.end(); ++part) {
    const double least = part == most ? kMainPart * options.min_area : options.min_area;
    if (part->covered + part->empty < least || part->loops.empty()) continue;
    CornerPolygon polygon{.patch = own, .loops = {}};
    for (const Outline::Loop& loop : part->loops) {
      std::vector<Corner> corners;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        const int before = plane_of(loop[(k + loop.size() - 1) % loop.size()].line);
        const int next = plane_of(loop[k].line);
        std::array<int, 3> planes = {own, before, next};
        std::sort(planes.begin(), planes.end());
        const Vec2& at = arrangement.vertices[static_cast<std::size_t>(loop[k].vertex)];
        corners.push_back({planes, next, patch.frame.to_space(at)});
      }
      polygon.loops.push_back(std::move(corners));
    }
    polygons.push_back(std::move(polygon));
    areas.push_back(part->covered);
  }
  // The largest comes first.
  if (const auto largest = std::max_element(areas.begin(), areas.end()); largest != areas.end())
    std::swap(polygons[0], polygons[static_cast<std::size_t>(largest - areas.begin())]);
  return polygons;
}

}  // namespace

std::vector<std::vector<CutLine>> lines_of(const std::vector<Patch>& patches,
                                           const std::vector<Seam>& seams,
                                           const SeamOptions& options) {
  std::vector<std::vector<CutLine>> lines(patches.size());
  for (const Seam& seam : seams) {
    CutLine line{.other = seam.b,
                 .line = seam.line,
                 .seen = seam.seen,
                 .sure = seam.sure,
                 .reach = {seam.seen.front().low - options.extension,
                           seam.seen.back().high + options.extension},
                 .is_seam = true};
    lines[static_cast<std::size_t>(seam.a)].push_back(line);
    line.other = seam.a;
    lines[static_cast<std::size_t>(seam.b)].push_back(line);
  }
  for (auto& list : lines)
    std::sort(list.begin(), list.end(), [](const CutLine& a, const CutLine& b) {
      const double p = seen_length(a), q = seen_length(b);
      return p != q ? p > q : a.other < b.other;
    });
  return lines;
}

std::vector<FreeEdge> find_free_edges(const PointCloud& cloud, const Members& members,
                                      const std::vector<Patch>& patches,
                                      const std::vector<std::vector<CutLine>>& lines,
                                      const FreeEdgeOptions& options) {
  std::vector<std::vector<FreeEdge>> found(patches.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    if (patches[k].covered.bits.empty()) return;
    found[k] = find_free_edges(cloud, members.of(k), patches[k], lines[k], options);
    for (FreeEdge& edge : found[k]) edge.patch = static_cast<int>(k);
  });
  std::vector<FreeEdge> edges;
  for (const auto& list : found) edges.insert(edges.end(), list.begin(), list.end());
  return edges;
}

Pieces outline_patches(const std::vector<Patch>& patches, std::vector<std::vector<CutLine>> lines,
                       const std::vector<SharedEdge>& edges, const SurfaceOptions& options) {
  Pieces pieces{.patches = static_cast<int>(patches.size()),
                .edges = static_cast<int>(edges.size())};
  for (const Patch& patch : patches) pieces.planes.push_back(patch.plane);
  for (const SharedEdge& edge : edges) {
    const int plane = static_cast<int>(pieces.planes.size());
    std::set<int> there;
    for (const SharedEdge::Part& part : edge.parts) there.insert(part.patch);
    for (int patch : there) {
      const auto k = static_cast<std::size_t>(patch);
      if (const auto line = line_of(edge, patch, plane, patches[k].plane, options.seams.extension))
        lines[k].push_back(*line);
    }
    pieces.planes.push_back(edge.plane);
  }
  const int first_frame = static_cast<int>(pieces.planes.size());
  for (const Patch& patch : patches)
    for (const Plane& plane : frame_planes(patch)) pieces.planes.push_back(plane);
  std::vector<std::vector<CornerPolygon>> found(patches.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    const int own = static_cast<int>(k);
    found[k] = outline(patches[k], own, first_frame + 4 * own, lines[k], options);
  });
  for (const auto& list : found)
    pieces.polygons.insert(pieces.polygons.end(), list.begin(), list.end());
  return pieces;
}

OptionList list_options(SurfaceOptions& o) {
  return {
      {"surface.patch.margin", &o.patch.margin, "m", "around the points of a plane", 0.05},
      {"surface.facets.sagitta", &o.facets.sagitta, "m",
       "from a chord of a facet to the curve that it stands for, at most", 1e-3},
      {"surface.facets.min_turn", &o.facets.min_turn, "rad",
       "between neighbouring facets, as planes at less do not meet", 0.05, 1.5},
      {"surface.facing.places", &o.facing.places, "",
       "of a surface that are looked from to find its free side", 1},
      {"surface.facing.directions", &o.facing.directions, "", "from each place to each side", 1},
      {"surface.facing.horizon", &o.facing.horizon, "m", "what is farther counts as so far", 0},
      {"surface.facing.margin", &o.facing.margin, "m",
       "before a place, where a line of sight may meet something", 0},
      {"surface.facing.min_lead", &o.facing.min_lead, "",
       "share of a surface's points by which normals must prefer one side", 0, 1},
      {"surface.facing.max_behind", &o.facing.max_behind, "",
       "places that a viewpoint sees from behind, for each that it sees from before, else it does "
       "not count",
       0},
      {"surface.sky.level", &o.facing.sky.level, "",
       "cosine off upright of ground, roofs and ceilings; steeper is a wall", 0, 1},
      {"surface.sky.min_lead", &o.facing.sky.min_lead, "",
       "share of a wall's places by which one side must be free more often", 0, 1},
      {"surface.sky.headroom", &o.facing.sky.headroom, "m",
       "nobody looks at what is lower over a floor from below", 0},
      {"surface.sky.layers", &o.facing.sky.layers, "m",
       "what is no higher over a surface is more of it, and hides no sky", 0},
      {"surface.sky.min_walled", &o.facing.sky.min_walled, "",
       "of the ways from below a ceiling that meet the walls of a room", 0, 1},
      {"surface.gaps.shadow_depth", &o.gaps.shadow_depth, "m",
       "what stands no farther before a surface hides it", 0},
      {"surface.gaps.shadow_cosine", &o.gaps.shadow_cosine, "",
       "unless it is a plane at a larger angle to it", 0, 1},
      {"surface.gaps.level", &o.gaps.level, "", "cosine off upright of surfaces that one stands on",
       0, 1},
      {"surface.gaps.depth_below", &o.gaps.depth_below, "m",
       "so far something below such a surface tells that a hole in it is one", 0},
      {"surface.gaps.hidden_evidence", &o.gaps.hidden_evidence, "",
       "for the surface where something hides it, where 1 is for a place with points", -1, 1},
      {"surface.gaps.hidden_share", &o.gaps.hidden_share, "",
       "of a gap; then all of it counts as hidden", 0, 1},
      {"surface.gaps.max_tilt", &o.gaps.max_tilt, "rad", "between the two faces of a wall", 0, 0.7},
      {"surface.gaps.max_thickness", &o.gaps.max_thickness, "m", "of a wall", 0},
      {"surface.gaps.open_evidence", &o.gaps.open_evidence, "",
       "where the other face of a wall says so much against itself, what is hidden is an opening",
       -1, 0},
      {"surface.through.margin", &o.gaps.through.margin, "m",
       "before a place, where its line of sight may meet something", 0},
      {"surface.through.behind", &o.gaps.through.behind, "m",
       "places nearer to a surface do not tell that it was seen through", 0},
      {"surface.through.min_cosine", &o.gaps.through.min_cosine, "",
       "of the angle of a line of sight to the normal of what it goes through", 0, 1},
      {"surface.through.lines", &o.gaps.through.lines, "",
       "of sight through a cell and the eight around it", 1},
      {"surface.through.most", &o.gaps.through.most, "",
       "places that are looked at, when there are several viewpoints", 1},
      {"surface.gaps.ground_price", &o.gaps.ground_price, "",
       "of a floor without points and with nothing below, where 1 is for others", 0, 1},
      {"surface.seams.min_sine", &o.seams.min_sine, "", "of the angle between planes that can meet",
       0.01, 1},
      {"surface.seams.fold_sine", &o.seams.fold_sine, "",
       "and of the angle between the facets of one that bends", 1e-3, 1},
      {"surface.seams.gap", &o.seams.gap, "m", "planes meet if both come so near to their line", 0},
      {"surface.seams.min_length", &o.seams.min_length, "m", "over this length", 0},
      {"surface.seams.extension", &o.seams.extension, "m", "a seam may cut so far beyond", 0},
      {"surface.free_edges.near_seam", &o.free_edges.near_seam, "cell",
       "outlines no farther from a seam are explained by it", 0},
      {"surface.free_edges.tolerance", &o.free_edges.tolerance, "cell",
       "an outline is straight where it is off a chord by no more", 0},
      {"surface.free_edges.min_length", &o.free_edges.min_length, "m", "of a straight piece", 0},
      {"surface.free_edges.snap_angle", &o.free_edges.snap_angle, "rad",
       "pieces are parallel or square to a seam if they nearly are", 0, 0.7},
      {"surface.free_edges.max_chamfer", &o.free_edges.max_chamfer, "m",
       "of a corner between two such pieces that the outline cuts off", 0},
      {"surface.shared_edges.max_angle", &o.shared_edges.max_angle, "rad",
       "between the planes of edges that are one", 0, 0.7},
      {"surface.shared_edges.max_offset", &o.shared_edges.max_offset, "m",
       "edges that are one are no farther off each other's planes", 0},
      {"surface.shared_edges.max_gap", &o.shared_edges.max_gap, "m", "nor farther apart", 0},
      {"surface.shared_edges.reach", &o.shared_edges.reach, "m",
       "an edge goes on in what it ends so near to", 0},
      {"surface.shared_edges.length", &o.shared_edges.length, "m", "over so much to both sides", 0},
      {"surface.shared_edges.reveal_reach", &o.shared_edges.reveal_reach, "m",
       "what is no farther off an edge's plane", 0},
      {"surface.shared_edges.reveal_depth", &o.shared_edges.reveal_depth, "m",
       "and so far behind the face may be the edge's reveal", 0},
      {"surface.shared_edges.reveal_spread", &o.shared_edges.reveal_spread, "m",
       "if half of it lies within so much", 0},
      {"surface.shared_edges.reveal_sites", &o.shared_edges.reveal_sites, "",
       "so many places at least make a reveal", 1},
      {"surface.choice.sure_price", &o.choice.sure_price, "m",
       "of an outline along a seam that both surfaces reach", 0},
      {"surface.choice.seam_price", &o.choice.seam_price, "m", "along one that they come near to",
       0},
      {"surface.choice.edge_price", &o.choice.edge_price, "m", "along an end that the points show",
       0},
      {"surface.choice.open_price", &o.choice.open_price, "m", "anywhere else", 0},
      {"surface.reveals.max_tilt", &o.reveals.max_tilt, "rad",
       "between the faces of a wall whose ends are closed", 0, 0.7},
      {"surface.reveals.min_thickness", &o.reveals.min_thickness, "m", "of such a wall", 0},
      {"surface.reveals.max_thickness", &o.reveals.max_thickness, "m", "of such a wall", 0},
      {"surface.reveals.min_length", &o.reveals.min_length, "m", "of a closed end", 0},
      {"surface.weld.same", &o.weld.same, "m",
       "corners, planes that only cut, and lines nearer than this are one", 0, 0.05},
      {"surface.weld.off_plane", &o.weld.off_plane, "m",
       "if that takes corners no farther off the polygons' planes", 0, 0.0009},
      {"surface.weld.min_area", &o.weld.min_area, "m2", "of a loop that is kept", 0},
      {"surface.min_area", &o.min_area, "m2",
       "smaller pieces are left out, but a plane's largest at a quarter", 0},
  };
}

}  // namespace scanworld::surface
