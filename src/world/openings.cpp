// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "openings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "../parallel.h"
#include "../polygon.h"
#include "validate.h"

namespace scanworld {

namespace {

using Box2 = Eigen::AlignedBox2d;

constexpr double kFacesCosine = 0.95;  // cosine between the faces of a wall
constexpr double kOnWall = 0.03;       // [m] places are on a face
constexpr double kBeyond = 0.1;        // [m] behind a face, where what a line of sight ends at is
constexpr double kAside = 0.1;         // [m] of a gap, where the wall around it is
constexpr double kHiddenCell = 0.1;    // [m] in which places are looked for before a face
constexpr double kSameCorner = 0.002;  // [m] corners are one

// A gap of a face, and what was seen of it.
struct SeenGap {
  std::size_t face;
  WallGap gap;
  std::size_t lines = 0;  // of sight that go through
  double hidden = 0;      // share that places stand before
  double expected = 0;    // places on as much of the face

  double area() const { return gap.clear.volume(); }
};

// What was seen of the gaps of a face.
void look_at(const WallFace& face, const SeenScan& scan, const OpeningOptions& options,
             std::vector<SeenGap>& gaps) {
  std::size_t on_face = 0;
  std::vector<std::vector<char>> hidden;
  const auto columns = [](const Box2& box) {
    return static_cast<std::size_t>(std::ceil(box.sizes().x() / kHiddenCell));
  };
  const auto rows = [](const Box2& box) {
    return static_cast<std::size_t>(std::ceil(box.sizes().y() / kHiddenCell));
  };
  for (const SeenGap& c : gaps) hidden.emplace_back(columns(c.gap.clear) * rows(c.gap.clear));
  for (const Vec3& place : scan.places) {
    const double distance = face.plane.signed_distance(place);
    if (distance < -kOnWall || distance > options.shadow_depth) continue;
    const Vec2 p = face.frame.to_plane(place);
    if (distance < kOnWall && face.holds(p)) {
      ++on_face;
      continue;
    }
    for (std::size_t k = 0; k < gaps.size(); ++k) {
      const Box2& box = gaps[k].gap.clear;
      if (!box.contains(p)) continue;
      const Vec2 at = (p - box.min()) / kHiddenCell;
      const auto x = std::min(columns(box) - 1, static_cast<std::size_t>(at.x())),
                 y = std::min(rows(box) - 1, static_cast<std::size_t>(at.y()));
      hidden[k][y * columns(box) + x] = 1;
    }
  }
  for (const SightLine& line : scan.lines) {
    const auto place = line.crossing(face.plane, kBeyond);
    if (!place) continue;
    const Vec2 p = face.frame.to_plane(*place);
    for (SeenGap& c : gaps) c.lines += c.gap.clear.contains(p);
  }
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    gaps[k].hidden = static_cast<double>(std::count(hidden[k].begin(), hidden[k].end(), 1)) /
                     static_cast<double>(hidden[k].size());
    gaps[k].expected = static_cast<double>(on_face) / face.area * gaps[k].area();
  }
}

class OpeningFinder {
 public:
  OpeningFinder(const World& world, const SeenScan& scan, const OpeningOptions& options)
      : world_(world), scan_(scan), options_(options), faces_(wall_faces_of(world)) {}

  FoundOpenings find() {
    std::vector<std::vector<SeenGap>> found(faces_.size());
    parallel_for(faces_.size(), [&](std::size_t f) {
      if (!is_wall(faces_[f])) return;
      for (const WallGap& gap : gaps_of(world_, faces_[f], options_.gaps))
        if (may_be_opening(faces_[f], gap)) found[f].push_back({f, gap});
      if (!found[f].empty()) look_at(faces_[f], scan_, options_, found[f]);
      std::erase_if(found[f], [&](const SeenGap& c) { return !is_seen(c); });
    });
    for (const auto& own : found) gaps_.insert(gaps_.end(), own.begin(), own.end());
    std::vector<char> taken(gaps_.size());
    for (const std::size_t first : largest_first()) {
      if (taken[first]) continue;
      const std::vector<std::size_t> same = same_as(first, taken);
      for (const std::size_t k : same) taken[k] = 1;
      describe(same);
    }
    return std::move(result_);
  }

 private:
  bool is_wall(const WallFace& face) const {
    return std::any_of(face.surfaces.begin(), face.surfaces.end(),
                       [&](std::size_t s) { return world_.surfaces[s].kind == Kind::wall; });
  }

  // Whether there is enough wall around a gap, or a casing, and no niche in it.
  bool may_be_opening(const WallFace& face, const WallGap& gap) const {
    const bool is_cased = gap.is_low && gap.measured >= options_.min_measured && is_door(gap.clear);
    return (gap.clear.volume() <= options_.max_size * face.area || is_cased) &&
           (gap.is_low ? !is_niche(face, gap) : is_in_wall(face, gap));
  }

  // Whether a gap is beside a part of the face that is as large, or in one of half of that: the
  // bays of a shelf are beside the fronts of what stands in it.
  bool is_in_wall(const WallFace& face, const WallGap& gap) const {
    for (std::size_t k = 0; k < face.surfaces.size(); ++k) {
      const Surface& surface = world_.surfaces[face.surfaces[k]];
      const double least = gap.clear.volume() * (face.boxes[k].contains(gap.clear) ? 0.5 : 1.0);
      if (surface.kind == Kind::wall && face.boxes[k].exteriorDistance(gap.clear) < kAside &&
          area(world_, surface) >= least)
        return true;
    }
    return false;
  }

  bool is_door(const Box2& clear) const {
    const Vec2 size = clear.sizes();
    return size.y() >= options_.min_door_height && size.y() <= options_.max_door_height &&
           size.x() <= options_.max_door_width;
  }

  // Whether another part of the wall closes much of a gap a little deeper.
  bool is_niche(const WallFace& face, const WallGap& gap) const {
    constexpr int kAsked = 5;  // places along each side
    int closed = 0;
    for (int k = 0; k < kAsked * kAsked; ++k) {
      const Vec2 share((k % kAsked + 0.5) / kAsked, (k / kAsked + 0.5) / kAsked);
      const Vec3 place =
          face.frame.to_space(gap.clear.min() + share.cwiseProduct(gap.clear.sizes()));
      closed += std::any_of(faces_.begin(), faces_.end(), [&](const WallFace& other) {
        const double depth = other.plane.signed_distance(place);
        return other.plane.normal.dot(face.plane.normal) > kFacesCosine && depth > kBeyond &&
               depth < options_.gaps.max_thickness && other.holds(other.frame.to_plane(place));
      });
    }
    return 2 * closed > kAsked * kAsked;
  }

  // Where viewpoints are known, lines of sight tell; what begins at the floor they must go through,
  // else a thing stands there.
  bool is_seen(const SeenGap& c) const {
    if (scan_.lines.empty()) return true;
    return static_cast<double>(c.lines) >= std::max(1.0, options_.min_seen * c.expected) ||
           (!c.gap.is_low && c.hidden <= options_.max_hidden);
  }

  std::vector<std::size_t> largest_first() const {
    std::vector<std::size_t> order(gaps_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return gaps_[a].area() > gaps_[b].area();
    });
    return order;
  }

  // A gap's rectangle in the frame of a face.
  Box2 seen_from(const WallFace& face, const SeenGap& c) const {
    const WallFace& own = faces_[c.face];
    Box2 box;
    for (const auto corner : {Box2::BottomLeft, Box2::TopRight})
      box.extend(face.frame.to_plane(own.frame.to_space(c.gap.clear.corner(corner))));
    return box;
  }

  bool are_one(const SeenGap& a, const SeenGap& b) const {
    const WallFace &face = faces_[a.face], &other = faces_[b.face];
    if (std::abs(face.plane.normal.dot(other.plane.normal)) < kFacesCosine) return false;
    const Vec3 middle = other.frame.to_space(b.gap.clear.center());
    if (std::abs(face.plane.signed_distance(middle)) > options_.gaps.max_thickness) return false;
    const Box2 both = a.gap.clear.intersection(seen_from(face, b));
    return !both.isEmpty() && both.volume() > options_.same * std::min(a.area(), b.area());
  }

  // The gaps that are one opening with this one, which comes first.
  std::vector<std::size_t> same_as(std::size_t first, const std::vector<char>& taken) const {
    std::vector<std::size_t> same = {first};
    for (std::size_t k = 0; k < gaps_.size(); ++k)
      if (k != first && !taken[k] && are_one(gaps_[first], gaps_[k])) same.push_back(k);
    return same;
  }

  void describe(const std::vector<std::size_t>& same) {
    const SeenGap& main = gaps_[same[0]];
    const WallFace& face = faces_[main.face];
    Box2 clear = main.gap.clear;
    bool is_low = false, is_through = false;
    double measured = 0;
    std::size_t lines = 0;
    for (const std::size_t k : same) {
      const SeenGap& c = gaps_[k];
      const Box2 its = seen_from(face, c);
      for (int axis = 0; axis < 2; ++axis) {
        if (its.min()[axis] < main.gap.clear.min()[axis] + options_.max_apart)
          clear.min()[axis] = std::max(clear.min()[axis], its.min()[axis]);
        if (its.max()[axis] > main.gap.clear.max()[axis] - options_.max_apart)
          clear.max()[axis] = std::min(clear.max()[axis], its.max()[axis]);
      }
      is_low |= c.gap.is_low;
      is_through |= faces_[c.face].plane.normal.dot(face.plane.normal) < 0;
      measured = std::max(measured, c.gap.measured);
      lines = std::max(lines, c.lines);
    }
    if (scan_.lines.empty() && !is_through && main.hidden > options_.max_hidden_blind) return;
    const Vec2 size = clear.sizes();
    OpeningKind kind = OpeningKind::window;
    if (is_low) {
      if (size.y() < options_.min_door_height && !is_through) return;
      kind = is_door(clear) ? OpeningKind::door : OpeningKind::passage;
    }
    std::string evidence = is_through ? "open in both faces of the wall" : "open in one face";
    evidence += fmt::format(", {:.0f} % of its sides measured", 100 * measured);
    if (!scan_.lines.empty())
      evidence += lines > 0 ? fmt::format(", {} lines of sight go through", lines)
                            : ", no line of sight goes through";
    const Surface& surface = world_.surfaces[surface_beside(face, clear)];
    result_.openings.push_back({.id = static_cast<int>(result_.openings.size()),
                                .kind = kind,
                                .surface = surface.id,
                                .loop = loop_of(face, surface.plane, clear),
                                .width = size.x(),
                                .height = size.y(),
                                .evidence = evidence});
  }

  // The largest surface of a face that is beside a rectangle.
  std::size_t surface_beside(const WallFace& face, const Box2& clear) const {
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t k = 0; k < face.surfaces.size(); ++k) {
      const Box2& box = face.boxes[k];
      const double apart = box.exteriorDistance(clear) - 1e-9 * box.volume();
      if (apart < least) least = apart, best = k;
    }
    return face.surfaces[best];
  }

  // Counter-clockwise seen against the face's normal, in the plane of one of its surfaces: those of
  // a wall in pieces are a little apart. Corners of the face that lie there are used again.
  Loop loop_of(const WallFace& face, const Plane& plane, const Box2& clear) {
    Loop loop;
    for (const auto corner : {Box2::BottomLeft, Box2::BottomRight, Box2::TopRight, Box2::TopLeft})
      loop.push_back(
          vertex_at(face, plane, plane.project(face.frame.to_space(clear.corner(corner)))));
    return loop;
  }

  int vertex_at(const WallFace& face, const Plane& plane, const Vec3& place) {
    std::optional<int> nearest;
    double least = kSameCorner;
    const auto look = [&](int v) {
      const Vec3& vertex = world_.vertices[static_cast<std::size_t>(v)];
      if (std::abs(plane.signed_distance(vertex)) > kPlanarTolerance) return;
      if (const double d = (vertex - place).norm(); d < least) least = d, nearest = v;
    };
    for (const std::size_t s : face.surfaces) {
      for (int v : world_.surfaces[s].outer) look(v);
      for (const Loop& hole : world_.surfaces[s].holes)
        for (int v : hole) look(v);
    }
    if (nearest) return *nearest;
    result_.corners.push_back(place);
    return static_cast<int>(world_.vertices.size() + result_.corners.size()) - 1;
  }

  const World& world_;
  const SeenScan& scan_;
  const OpeningOptions& options_;
  const std::vector<WallFace> faces_;
  std::vector<SeenGap> gaps_;
  FoundOpenings result_;
};

}  // namespace

FoundOpenings find_openings(const World& world, const SeenScan& scan,
                            const OpeningOptions& options) {
  return OpeningFinder(world, scan, options).find();
}

}  // namespace scanworld
