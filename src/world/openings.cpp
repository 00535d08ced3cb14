// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "openings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "../polygon.h"

namespace scanworld {

namespace {

using Box2 = Eigen::AlignedBox2d;

constexpr double kSame = 0.002;  // [m] places are one

// An opening in one face of a wall.
struct Gap {
  std::size_t surface = 0;  // index
  Loop loop;
  std::vector<Vec2> ring;  // in the wall's upright frame
  Box2 clear;
  bool is_low = false;    // begins at the wall's bottom
  double measured = 0;    // [m] of its outline that other measured surfaces share
  double length = 0;      // [m] of its outline, but for the bottom of a notch
  std::size_t lines = 0;  // of sight that go through it

  double width() const { return clear.sizes().x(); }
  double height() const { return clear.sizes().y(); }
};

// Whether a box lies in a ring, but for `kSame` at its sides.
bool holds(const std::vector<Vec2>& ring, const Box2& box) {
  if (!is_inside({ring}, box.center())) return false;
  const Box2 inner(Vec2(box.min().array() + kSame), Vec2(box.max().array() - kSame));
  if (inner.isEmpty()) return false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    // The part of an edge within the box (Liang and Barsky 1984).
    const Vec2 &p = ring[i], way = ring[(i + 1) % ring.size()] - p;
    double low = 0, high = 1;
    for (int a = 0; a < 2 && low < high; ++a) {
      if (std::abs(way[a]) < 1e-12) {
        if (p[a] <= inner.min()[a] || p[a] >= inner.max()[a]) high = low;
        continue;
      }
      const double s = (inner.min()[a] - p[a]) / way[a], t = (inner.max()[a] - p[a]) / way[a];
      low = std::max(low, std::min(s, t)), high = std::min(high, std::max(s, t));
    }
    if (low < high) return false;
  }
  return true;
}

// The largest upright rectangle in a ring whose sides go through its corners, and whose bottom is
// no more than `lift` [m] over the ring's.
Box2 largest_rectangle(const std::vector<Vec2>& ring, double lift) {
  std::set<double> xs, ys;
  for (const Vec2& p : ring) xs.insert(p.x()), ys.insert(p.y());
  Box2 best(Vec2::Zero(), Vec2::Zero());
  for (auto y0 = ys.begin(); y0 != ys.end(); ++y0) {
    if (*y0 > *ys.begin() + lift) break;
    for (auto y1 = std::next(y0); y1 != ys.end(); ++y1)
      for (auto x0 = xs.begin(); x0 != xs.end(); ++x0)
        for (auto x1 = xs.end(); --x1 != x0;) {
          const Box2 box(Vec2(*x0, *y0), Vec2(*x1, *y1));
          if (box.volume() <= best.volume()) break;
          if (holds(ring, box)) best = box;
        }
  }
  return best;
}

class OpeningFinder {
 public:
  OpeningFinder(const World& world, std::span<const SightLine> lines, const OpeningOptions& options)
      : world_(world), lines_(lines), options_(options) {
    for (const Surface& s : world.surfaces) {
      if (s.source != Source::measured) continue;
      add_edges(s.outer);
      for (const Loop& hole : s.holes) add_edges(hole);
    }
  }

  std::vector<Opening> find() {
    for (std::size_t s = 0; s < world_.surfaces.size(); ++s)
      if (world_.surfaces[s].kind == Kind::wall) add_gaps(s);
    std::vector<char> done(gaps_.size());
    std::vector<Opening> openings;
    for (std::size_t k = 0; k < gaps_.size(); ++k) {
      if (done[k]) continue;
      const std::optional<std::size_t> twin = twin_of(k);
      if (twin) done[*twin] = 1;
      if (const auto opening = describe(gaps_[k], twin ? &gaps_[*twin] : nullptr)) {
        openings.push_back(*opening);
        openings.back().id = static_cast<int>(openings.size()) - 1;
      }
    }
    return openings;
  }

 private:
  const Vec3& at(int vertex) const { return world_.vertices[static_cast<std::size_t>(vertex)]; }

  void add_edges(const Loop& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k)
      ++edges_[std::minmax(loop[k], loop[(k + 1) % loop.size()])];
  }

  void add_gaps(std::size_t s) {
    const Surface& surface = world_.surfaces[s];
    const PlaneFrame frame = upright_frame(surface.plane, world_.frame.up, at(surface.outer[0]));
    std::vector<Vec2> outer;
    for (int v : surface.outer) outer.push_back(frame.to_plane(at(v)));
    const double bottom = std::min_element(outer.begin(), outer.end(), [](auto& a, auto& b) {
                            return a.y() < b.y();
                          })->y();
    for (const Loop& hole : surface.holes) {
      std::vector<Vec2> ring;
      for (int v : hole) ring.push_back(frame.to_plane(at(v)));
      add_gap(s, hole, ring, bottom, false);
    }
    const std::size_t n = outer.size();
    for (std::size_t k = 0; k < n; ++k)
      if (const std::size_t count = notch_at(outer, k); count > 0) {
        Loop loop;
        std::vector<Vec2> ring;
        for (std::size_t i = 0; i <= count; ++i) {
          loop.push_back(surface.outer[(k + i) % n]);
          ring.push_back(outer[(k + i) % n]);
        }
        add_gap(s, loop, ring, bottom, true);
        k += count - 1;
      }
  }

  // How many edges a notch has that begins at a corner: the outline goes up there, and comes down
  // again to the same height farther to the right. 0 where there is none.
  std::size_t notch_at(const std::vector<Vec2>& ring, std::size_t first) const {
    const std::size_t n = ring.size();
    const Vec2& start = ring[first];
    const Vec2 up = ring[(first + 1) % n] - start;
    if (up.y() < options_.min_height || std::abs(up.x()) > 0.3 * up.y()) return 0;
    for (std::size_t count = 2; count < n - 1; ++count) {
      const Vec2& p = ring[(first + count) % n];
      if (p.y() > start.y() + options_.sill) continue;
      const bool is_back = p.x() > start.x() + options_.min_width &&
                           p.y() > start.y() - options_.sill &&
                           std::abs((p - ring[(first + count - 1) % n]).x()) < 0.3 * up.y();
      return is_back ? count : 0;
    }
    return 0;
  }

  void add_gap(std::size_t s, const Loop& loop, const std::vector<Vec2>& ring, double bottom,
               bool is_notch) {
    Gap gap{.surface = s, .loop = loop, .ring = ring, .clear = {}, .is_low = is_notch};
    Box2 box;
    for (const Vec2& p : ring) box.extend(p);
    gap.is_low |= box.min().y() < bottom + options_.sill;
    // What comes down to the floor on one side alone, as beside a skirting, is low still.
    gap.clear =
        largest_rectangle(ring, gap.is_low ? options_.sill : std::numeric_limits<double>::max());
    if (gap.clear.volume() < options_.squareness * std::abs(doubled_area(ring)) / 2 ||
        gap.width() < options_.min_width || gap.height() < options_.min_height)
      return;
    for (std::size_t k = 0; k + is_notch < loop.size(); ++k) {
      const int a = loop[k], b = loop[(k + 1) % loop.size()];
      const double length = (at(a) - at(b)).norm();
      gap.length += length;
      const auto found = edges_.find(std::minmax(a, b));
      if (found != edges_.end() && found->second > 1) gap.measured += length;
    }
    const Surface& surface = world_.surfaces[s];
    const PlaneFrame frame = upright_frame(surface.plane, world_.frame.up, at(surface.outer[0]));
    for (const SightLine& line : lines_) {
      const double from = surface.plane.signed_distance(line.from),
                   to = surface.plane.signed_distance(line.to);
      if ((from > 0) == (to > 0) || std::abs(to) < 0.1) continue;
      const Vec2 p = frame.to_plane(line.from + (line.to - line.from) * (from / (from - to)));
      gap.lines += box.contains(p) && is_inside({ring}, p);
    }
    gaps_.push_back(std::move(gap));
  }

  // The same opening in the other face of the wall.
  std::optional<std::size_t> twin_of(std::size_t k) const {
    const Gap& gap = gaps_[k];
    const Plane& plane = world_.surfaces[gap.surface].plane;
    const Box3 box = box_of(gap.loop);
    for (std::size_t i = k + 1; i < gaps_.size(); ++i) {
      const Plane& other = world_.surfaces[gaps_[i].surface].plane;
      if (plane.normal.dot(other.normal) > -0.95) continue;
      const Box3 its = box_of(gaps_[i].loop);
      const Vec3 apart = its.center() - box.center();
      const double behind = -plane.normal.dot(apart);
      if (behind > 0 && behind < options_.max_thickness &&
          (apart + behind * plane.normal).norm() < 0.25 * box.diagonal().norm())
        return i;
    }
    return std::nullopt;
  }

  Box3 box_of(const Loop& loop) const {
    Box3 box;
    for (int v : loop) box.extend(at(v));
    return box;
  }

  std::optional<Opening> describe(const Gap& gap, const Gap* twin) const {
    const double width = twin ? std::min(gap.width(), twin->width()) : gap.width(),
                 height = twin ? std::min(gap.height(), twin->height()) : gap.height();
    OpeningKind kind = OpeningKind::window;
    if (gap.is_low) {
      // In one face alone, and nobody saw through: a thing stands there.
      if (!twin && !lines_.empty() && gap.lines == 0) return std::nullopt;
      if (height < options_.min_door_height && !twin) return std::nullopt;
      kind = height >= options_.min_door_height && height <= options_.max_door_height &&
                     width <= options_.max_door_width
                 ? OpeningKind::door
                 : OpeningKind::passage;
    }
    std::string evidence = twin ? "open in both faces of the wall" : "open in one face";
    const double measured = gap.measured + (twin ? twin->measured : 0),
                 length = gap.length + (twin ? twin->length : 0);
    evidence += fmt::format(", {:.0f} % of its sides measured", 100 * measured / length);
    if (const std::size_t lines = std::max(gap.lines, twin ? twin->lines : 0); !lines_.empty())
      evidence += lines > 0 ? fmt::format(", {} lines of sight go through", lines)
                            : ", no line of sight goes through";
    return Opening{.kind = kind,
                   .surface = world_.surfaces[gap.surface].id,
                   .loop = gap.loop,
                   .width = width,
                   .height = height,
                   .evidence = evidence};
  }

  const World& world_;
  const std::span<const SightLine> lines_;
  const OpeningOptions& options_;
  std::map<std::pair<int, int>, int> edges_;  // how many measured surfaces have each
  std::vector<Gap> gaps_;
};

}  // namespace

std::vector<Opening> find_openings(const World& world, std::span<const SightLine> sight_lines,
                                   const OpeningOptions& options) {
  return OpeningFinder(world, sight_lines, options).find();
}

}  // namespace scanworld
