// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "refacet.h"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "../error.h"
#include "geos.h"
#include "round_solids.h"
#include "validate.h"

namespace scanworld {

namespace {

constexpr double kSameAngle = 1e-3;  // [rad] from a ridge or an end: on it
constexpr double kMostMoved = 0.1;   // [m] that a corner moves
constexpr double kParallel = 0.05;   // least singular value of planes that meet in a point

// Where a point of a curve is on it, unrolled.
struct Unrolled {
  double angle = 0, height = 0;
};

// The flat strips that stand for a part of a cylinder or cone: its section is a polygon, whose ends
// are where the part ends now.
class Strips {
 public:
  Strips(const Curve& curve, double from, double to, double sagitta, std::array<double, 2> ends)
      : curve_(curve), from_(from), to_(to) {
    const double radius =
        std::max(curve.shape.radius_at(curve.low), curve.shape.radius_at(curve.high));
    count_ = std::max(
        1, static_cast<int>(std::ceil((to - from) * sides_of(radius, sagitta) / (2 * M_PI))));
    const double half = (to - from) / count_ / 2;
    // Corners are as far outside of the curve as the middles of the sides are inside.
    const double out = (1 - half * half / 6) / std::cos(half);
    corner_.assign(static_cast<std::size_t>(count_) + 1, out);
    corner_.front() = ends[0], corner_.back() = ends[1];
  }

  int count() const { return count_; }
  double angle(int ridge) const { return from_ + (to_ - from_) * ridge / count_; }
  // That a place is in.
  int strip_of(double angle) const {
    return std::clamp(static_cast<int>((angle - from_) / (to_ - from_) * count_), 0, count_ - 1);
  }
  Vec3 on_ridge(int ridge, double height) const {
    const RoundShape& s = curve_.shape;
    const double radius = corner_[static_cast<std::size_t>(ridge)] * s.radius_at(height);
    return s.point + height * s.axis + radius * level(angle(ridge));
  }
  // Of a strip, outwards.
  Plane plane(int strip) const {
    const double low = curve_.low, high = curve_.high;
    const Vec3 a = on_ridge(strip, high), b = on_ridge(strip + 1, high);
    const Vec3 along = a - on_ridge(strip, low);
    Vec3 normal = (b - a).cross(along).normalized();
    if (normal.dot(level((angle(strip) + angle(strip + 1)) / 2)) < 0) normal = -normal;
    return plane_through(a, normal);
  }

 private:
  Vec3 level(double angle) const {
    return std::cos(angle) * curve_.start + std::sin(angle) * curve_.shape.axis.cross(curve_.start);
  }

  const Curve& curve_;
  double from_, to_;
  int count_ = 1;
  std::vector<double> corner_;  // of the section, in radii
};

// The point next to another one that lies in all of some planes; nothing where they do not meet
// there.
std::optional<Vec3> meet(const std::vector<Plane>& planes, const Vec3& near) {
  const auto rows = static_cast<Eigen::Index>(planes.size());
  Eigen::MatrixXd a(rows, 3);
  Eigen::VectorXd b(rows);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    a.row(static_cast<Eigen::Index>(k)) = planes[k].normal.transpose();
    b[static_cast<Eigen::Index>(k)] = -planes[k].signed_distance(near);
  }
  Eigen::JacobiSVD<Eigen::MatrixXd> svd(a, Eigen::ComputeThinU | Eigen::ComputeThinV);
  svd.setThreshold(kParallel);
  const Vec3 step = svd.solve(b);
  if (!(step.norm() < kMostMoved)) return std::nullopt;
  const Vec3 p = near + step;
  for (const Plane& plane : planes)
    if (std::abs(plane.signed_distance(p)) > kPlanarTolerance / 2) return std::nullopt;
  return p;
}

// One curve's facets, cut anew.
class Recut {
 public:
  Recut(World world, const CurvedPart& part, double sagitta)
      : world_(std::move(world)), id_(part.id), curve_(part.curve), sagitta_(sagitta) {}

  // Nothing where it cannot be done.
  std::optional<World> run() {
    for (std::size_t s = 0; s < world_.surfaces.size(); ++s)
      if (world_.surfaces[s].curve == id_) facets_.push_back(s);
    if (facets_.empty()) return std::move(world_);
    if (curve_.shape.type == CurveType::sphere || !find_loops() || !place_ends()) return {};
    for (const std::vector<Edge>& loop : loops_)
      if (!cut_loop(loop)) return {};
    if (!replace_facets()) return {};
    replace_chains();
    return validate(world_).empty() ? std::optional(std::move(world_)) : std::nullopt;
  }

 private:
  // Of the outline of all facets together.
  struct Edge {
    int from = 0, to = 0;                    // vertices
    double angle = 0;                        // of the middle of the facet that has it
    std::optional<std::size_t> beyond = {};  // surface that has it too
    bool is_cut = false;                     // where what goes all around is cut open
  };
  struct RimCorner {
    int vertex = 0;
    Unrolled at;
  };

  Vec3& vertex(int index) { return world_.vertices[static_cast<std::size_t>(index)]; }

  template <typename Body>
  void for_each_edge(const Surface& s, Body body) const {
    const auto go = [&](const Loop& loop) {
      for (std::size_t i = 0; i < loop.size(); ++i) body(loop[i], loop[(i + 1) % loop.size()]);
    };
    go(s.outer);
    for (const Loop& hole : s.holes) go(hole);
  }

  // The outline of the facets, by the edges that only one of them has.
  bool find_loops() {
    std::map<std::pair<int, int>, double> inner;  // middles of facets
    std::map<std::pair<int, int>, std::size_t> others;
    for (std::size_t s = 0; s < world_.surfaces.size(); ++s) {
      const Surface& surface = world_.surfaces[s];
      const bool is_own = surface.curve == id_;
      const double middle = is_own ? unrolled(centroid(world_, surface)).angle : 0;
      for_each_edge(surface, [&](int a, int b) {
        if (is_own)
          inner[{a, b}] = middle;
        else
          others[{a, b}] = s;
      });
    }
    std::multimap<int, Edge> next;
    std::map<int, std::set<std::size_t>> facets_at;
    for (std::size_t f : facets_)
      for_each_edge(world_.surfaces[f], [&](int a, int) { facets_at[a].insert(f); });
    for (const auto& [ends, middle] : inner) {
      const auto [a, b] = ends;
      Edge edge{a, b, middle};
      if (const auto there = inner.find({b, a}); there != inner.end()) {
        edge.is_cut = std::abs(there->second - middle) > M_PI;
        if (!edge.is_cut) continue;
      }
      if (const auto other = others.find({b, a}); other != others.end())
        edge.beyond = other->second;
      next.emplace(a, edge);
    }
    for (const auto& [v, at] : facets_at)
      if (at.size() > 1) ridges_.insert(v);
    while (!next.empty()) {
      std::vector<Edge> loop;
      for (auto e = next.begin(); e != next.end(); e = next_edge(next, loop.back()))
        loop.push_back(e->second), next.erase(e);
      if (loop.empty() || loop.back().to != loop.front().from) return false;
      loops_.push_back(std::move(loop));
    }
    return !loops_.empty();
  }

  // At the cut the outline stays on its side.
  static std::multimap<int, Edge>::iterator next_edge(std::multimap<int, Edge>& next,
                                                      const Edge& last) {
    const auto [begin, end] = next.equal_range(last.to);
    if (begin == end) return next.end();
    return std::min_element(begin, end, [&](const auto& a, const auto& b) {
      return std::abs(a.second.angle - last.angle) < std::abs(b.second.angle - last.angle);
    });
  }

  // As seen from a facet.
  Unrolled unrolled(const Vec3& p, double middle) const {
    Unrolled at = unrolled(p);
    at.angle += 2 * M_PI * std::round((middle - at.angle) / (2 * M_PI));
    return at;
  }
  Unrolled unrolled(const Vec3& p) const {
    double angle = curve_.angle_of(p);
    if (angle > (curve_.sweep + 2 * M_PI) / 2) angle -= 2 * M_PI;
    return {angle, curve_.height_of(p)};
  }

  // How far the facets go around, and where their ends are.
  bool place_ends() {
    double from = INFINITY, to = -INFINITY;
    for (const auto& loop : loops_)
      for (const Edge& e : loop) {
        const double angle = unrolled(vertex(e.from), e.angle).angle;
        from = std::min(from, angle), to = std::max(to, angle);
      }
    if (!(to - from > kSameAngle && to - from < 2 * M_PI + kSameAngle)) return false;
    std::array<double, 2> sum{}, count{};
    for (const auto& loop : loops_)
      for (const Edge& e : loop) {
        const Vec3& p = vertex(e.from);
        const double angle = unrolled(p, e.angle).angle;
        const double radii = curve_.shape.way_to(p).norm() / curve_.shape.radius_at(p);
        if (angle < from + kSameAngle) sum[0] += radii, ++count[0];
        if (angle > to - kSameAngle) sum[1] += radii, ++count[1];
      }
    strips_.emplace(curve_, from, to, sagitta_, std::array{sum[0] / count[0], sum[1] / count[1]});
    return true;
  }

  std::optional<Plane> plane_beyond(const Edge& e) const {
    if (!e.beyond) return std::nullopt;
    return world_.surfaces[*e.beyond].plane;
  }

  // Moves the corners of an outline onto the strips, and has it cross their ridges in corners.
  bool cut_loop(const std::vector<Edge>& loop) {
    const std::size_t n = loop.size();
    std::vector<std::size_t> kept;  // edges that begin at a corner which is no end of a ridge alone
    for (std::size_t k = 0; k < n; ++k) {
      const Edge &before = loop[(k + n - 1) % n], &after = loop[k];
      if (before.beyond != after.beyond || before.is_cut != after.is_cut ||
          !ridges_.count(after.from))
        kept.push_back(k);
    }
    if (kept.size() < 2) return false;
    std::vector<RimCorner> ring;
    for (std::size_t c = 0; c < kept.size(); ++c) {
      const std::size_t first = kept[c], end = kept[(c + 1) % kept.size()];
      std::vector<Edge> chain;
      for (std::size_t k = first; chain.empty() || k != end; k = (k + 1) % n)
        chain.push_back(loop[k]);
      if (!move_corner(loop[(first + n - 1) % n], loop[first])) return false;
      ring.push_back(
          {chain.front().from, unrolled(old_at(chain.front().from), chain.front().angle)});
      const std::vector<RimCorner> inserted = cross_ridges(chain);
      std::vector<int> names;
      for (const RimCorner& r : inserted) names.push_back(r.vertex), ring.push_back(r);
      std::vector<int> old;
      for (std::size_t k = 1; k < chain.size(); ++k) old.push_back(chain[k].from);
      if (chain.front().beyond)
        chains_.push_back({*chain.front().beyond, chain.front().from, chain.back().to, old, names});
    }
    rings_.push_back(std::move(ring));
    return true;
  }

  // Where a vertex was.
  Vec3 old_at(int v) {
    const auto found = old_.find(v);
    return found == old_.end() ? vertex(v) : found->second;
  }

  bool move_corner(const Edge& before, const Edge& after) {
    const Vec3 at = vertex(after.from);
    std::vector<Plane> planes;
    const double angle = unrolled(at, after.angle).angle;
    const bool at_end = angle < strips_->angle(0) + kSameAngle ||
                        angle > strips_->angle(strips_->count()) - kSameAngle;
    if (at_end) return true;
    planes.push_back(strips_->plane(strips_->strip_of(angle)));
    if (const auto p = plane_beyond(before)) planes.push_back(*p);
    if (const auto p = plane_beyond(after); p && before.beyond != after.beyond)
      planes.push_back(*p);
    const auto moved = meet(planes, at);
    if (!moved) return false;
    old_[after.from] = at;
    vertex(after.from) = *moved;
    return true;
  }

  // New corners where a chain of edges crosses the ridges between the strips.
  std::vector<RimCorner> cross_ridges(const std::vector<Edge>& chain) {
    std::vector<RimCorner> found;
    for (const Edge& e : chain) {
      if (e.is_cut) continue;
      const Unrolled a = unrolled(old_at(e.from), e.angle), b = unrolled(old_at(e.to), e.angle);
      const int step = b.angle > a.angle ? 1 : -1;
      for (int r = step > 0 ? 1 : strips_->count() - 1; r > 0 && r < strips_->count(); r += step) {
        const double angle = strips_->angle(r);
        if (!(step > 0 ? angle >= a.angle && angle < b.angle : angle <= a.angle && angle > b.angle))
          continue;
        const double share = (angle - a.angle) / (b.angle - a.angle);
        double height = a.height + share * (b.height - a.height);
        if (const auto plane = plane_beyond(e)) {
          const double from = plane->signed_distance(strips_->on_ridge(r, height)),
                       to = plane->signed_distance(strips_->on_ridge(r, height + 1));
          if (std::abs(to - from) > kParallel) height += from / (from - to);
        }
        const Vec3 p = strips_->on_ridge(r, height);
        found.push_back({static_cast<int>(world_.vertices.size()), {angle, height}});
        world_.vertices.push_back(p);
      }
    }
    return found;
  }

  // The strips' parts of what the outlines go around.
  bool replace_facets() {
    geos::Rings whole;
    std::map<std::pair<double, double>, int> vertex_at;
    double low = INFINITY, high = -INFINITY;
    for (const auto& ring : rings_) {
      whole.emplace_back();
      for (const RimCorner& c : ring) {
        whole.back().emplace_back(c.at.angle, c.at.height);
        vertex_at[{c.at.angle, c.at.height}] = c.vertex;
        low = std::min(low, c.at.height), high = std::max(high, c.at.height);
      }
    }
    std::sort(whole.begin(), whole.end(),
              [](const auto& a, const auto& b) { return extent_of(a) > extent_of(b); });
    if (geos::find_flaw(whole)) return false;
    const double left = strips_->angle(0) - 1, right = strips_->angle(strips_->count()) + 1;
    std::vector<Surface> made;
    for (int k = 0; k < strips_->count(); ++k) {
      const auto box = [&](double from, double to) {
        return geos::Rings{{{from, low - 1}, {to, low - 1}, {to, high + 1}, {from, high + 1}}};
      };
      std::vector<geos::Rings> others;
      if (k > 0) others.push_back(box(left, strips_->angle(k)));
      if (k + 1 < strips_->count()) others.push_back(box(strips_->angle(k + 1), right));
      const auto parts =
          others.empty() ? std::vector<geos::Rings>{whole} : geos::subtract(whole, others, 0);
      for (const geos::Rings& rings : parts) {
        std::optional<Surface> s = facet_of(k, rings, vertex_at);
        if (!s) return false;
        made.push_back(std::move(*s));
      }
    }
    return put(std::move(made));
  }

  static double extent_of(const std::vector<Vec2>& ring) {
    Eigen::AlignedBox2d box;
    for (const Vec2& p : ring) box.extend(p);
    return box.volume();
  }

  std::optional<Surface> facet_of(int strip, const geos::Rings& rings,
                                  const std::map<std::pair<double, double>, int>& vertex_at) const {
    const Surface& like = world_.surfaces[nearest_facet(strip)];
    Surface s = like;
    s.holes.clear(), s.outer.clear(), s.thickness.reset(), s.inferred.clear();
    const Plane out = strips_->plane(strip);
    const bool is_turned = out.normal.dot(like.plane.normal) < 0;
    s.plane = is_turned ? Plane{-out.normal, -out.offset} : out;
    for (std::size_t r = 0; r < rings.size(); ++r) {
      Loop loop;
      for (const Vec2& p : rings[r]) {
        const auto found = vertex_at.find({p.x(), p.y()});
        if (found == vertex_at.end()) return std::nullopt;
        if (loop.empty() || loop.back() != found->second) loop.push_back(found->second);
      }
      if (loop.size() > 1 && loop.front() == loop.back()) loop.pop_back();
      // Seen from outside, angles go to the left: as the rings of the plane do.
      if (is_turned) std::reverse(loop.begin(), loop.end());
      if (loop.size() < 3) return std::nullopt;
      (r == 0 ? s.outer : s.holes.emplace_back()) = std::move(loop);
    }
    return s;
  }

  std::size_t nearest_facet(int strip) const {
    const Vec3 normal = strips_->plane(strip).normal;
    const auto turn = [&](std::size_t f) {
      return std::abs(world_.surfaces[f].plane.normal.dot(normal));
    };
    return *std::max_element(facets_.begin(), facets_.end(),
                             [&](std::size_t a, std::size_t b) { return turn(a) < turn(b); });
  }

  // Puts new facets in the place of the old ones, which their ids say; points are shared by area.
  bool put(std::vector<Surface> made) {
    std::vector<int> ids;
    std::size_t points = 0;
    int next = next_id(world_);
    for (std::size_t f : facets_)
      ids.push_back(world_.surfaces[f].id), points += world_.surfaces[f].support.points;
    double whole = 0;
    for (const Surface& s : made) whole += area(world_, s);
    if (made.empty() || !(whole > 0)) return false;
    for (std::size_t k = 0; k < made.size(); ++k) {
      made[k].id = k < ids.size() ? ids[k] : next++;
      made[k].support.points =
          static_cast<std::size_t>(static_cast<double>(points) * area(world_, made[k]) / whole);
    }
    made_ = std::move(made);
    return true;
  }

  // The surfaces beyond go along the new corners.
  void replace_chains() {
    for (const Chain& c : chains_) {
      Surface& s = world_.surfaces[c.surface];
      const auto mend = [&](Loop& loop) {
        const auto begin = std::find(loop.begin(), loop.end(), c.to);
        if (begin == loop.end()) return;
        std::rotate(loop.begin(), begin, loop.end());
        // Now it goes from c.to by the old corners, the last first, to c.from: which is the same
        // corner where the chain goes all around.
        const std::size_t after = c.old.size() + 1;
        if (loop.size() < after || loop[after % loop.size()] != c.from) return;
        if (!std::equal(c.old.rbegin(), c.old.rend(), loop.begin() + 1)) return;
        loop.erase(loop.begin() + 1, loop.begin() + 1 + static_cast<std::ptrdiff_t>(c.old.size()));
        loop.insert(loop.begin() + 1, c.made.rbegin(), c.made.rend());
      };
      mend(s.outer);
      for (Loop& hole : s.holes) mend(hole);
    }
    std::vector<Surface> all;
    for (Surface& s : world_.surfaces)
      if (s.curve != id_) all.push_back(std::move(s));
    all.insert(all.end(), made_.begin(), made_.end());
    world_.surfaces = std::move(all);
    world_.colliders.clear(), world_.rooms.clear(), world_.doors.clear();
    world_.ways.clear();
  }

  struct Chain {
    std::size_t surface = 0;
    int from = 0, to = 0;        // corners that stay
    std::vector<int> old, made;  // between them
  };

  World world_;
  int id_;
  Curve curve_;
  double sagitta_;
  std::vector<std::size_t> facets_;
  std::set<int> ridges_;  // vertices that two facets have
  std::vector<std::vector<Edge>> loops_;
  std::optional<Strips> strips_;
  std::vector<std::vector<RimCorner>> rings_;
  std::map<int, Vec3> old_;
  std::vector<Chain> chains_;
  std::vector<Surface> made_;
};

}  // namespace

Refaceted refacet(World world, double sagitta) {
  if (!(sagitta > 0)) throw Error(Cause::usage, "the sagitta of facets should be more than 0");
  std::vector<int> kept;
  const std::vector<CurvedPart> curves = world.curves;
  for (const CurvedPart& part : curves) {
    const auto solid = std::find_if(world.obstacles.begin(), world.obstacles.end(),
                                    [&](const Obstacle& o) { return o.curve == part.id; });
    if (solid != world.obstacles.end()) {
      const double radius = std::max(part.curve.shape.radius_at(part.curve.low),
                                     part.curve.shape.radius_at(part.curve.high));
      if (std::holds_alternative<ConvexHull>(solid->shape))
        solid->shape = ConvexHull{corners_of(part.curve, sides_of(radius, sagitta))};
    } else if (auto changed = Recut(world, part, sagitta).run()) {
      world = std::move(*changed);
    } else {
      kept.push_back(part.id);
    }
  }
  return {std::move(world), std::move(kept)};
}

}  // namespace scanworld
