// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "planes_of_space.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "../cell_walk.h"
#include "../parallel.h"
#include "../quantile.h"

namespace scanworld::space {

using surface::CellBox;
using surface::Raster;

namespace {

constexpr double kRivalCosine = 0.9;    // of planes that go on a wall beside each other ...
constexpr double kRivalReach = 1.5;     // [m] ... no farther apart
constexpr double kSameCosine = 0.9994;  // of the planes of ends that have one (2 degrees)
constexpr double kSureArea = 0.5;       // [m2] smaller planes come last of those with points

std::vector<Vec3> corners_of(const Raster& raster, const PlaneFrame& frame, const CellBox& box) {
  std::vector<Vec3> corners;
  for (const auto& [x, y] :
       {std::pair{box.x0, box.y0}, {box.x1, box.y0}, {box.x1, box.y1}, {box.x0, box.y1}})
    corners.push_back(frame.to_space(raster.low + raster.cell * Vec2(x, y)));
  return corners;
}

class PlaneMaker {
 public:
  PlaneMaker(const SpaceInput& in, const Sight& sight, const CellSet& free,
             const PlanesOptions& options)
      : in_(in), sight_(sight), free_(free), options_(options), plane_of_(in.covers.size(), -1) {}

  std::vector<SpacePlane> make() {
    find_leaders();
    find_rivals();
    for (std::size_t k = 0; k < in_.covers.size(); ++k) add_surface(k);
    for (const surface::Seam& seam : in_.seams) go_on_at(seam);
    for (std::size_t a = 0; a < in_.covers.size(); ++a)
      for (const std::size_t b : rivals_[a])
        if (a < b) add_step(a, b);
    find_backs();
    add_edges();
    for (std::optional<SpacePlane>& back : backs_)
      if (back) planes_.push_back(std::move(*back));
    std::stable_sort(planes_.begin(), planes_.end(), [](const SpacePlane& a, const SpacePlane& b) {
      return turn_of(a) != turn_of(b) ? turn_of(a) < turn_of(b) : a.size > b.size;
    });
    return std::move(planes_);
  }

 private:
  static int turn_of(const SpacePlane& p) {
    switch (p.kind) {
      case SpacePlane::Kind::surface:
        return p.is_late ? 2 : p.size > kSureArea ? 0 : 3;
      case SpacePlane::Kind::step:
        return 1;
      default:
        return 4;
    }
  }

  bool cuts(std::size_t k) const { return in_.covers[k].area >= options_.min_area; }

  // How far a surface is off the plane of another: the distances of half and of 95 % of it.
  std::array<double, 2> distances_off(const Cover& cover, const Plane& plane) const {
    std::vector<double> off;
    for (int y = 0; y < cover.supported.height; y += 2)
      for (int x = 0; x < cover.supported.width; x += 2)
        if (cover.supported.is_set(x, y))
          off.push_back(
              std::abs(plane.signed_distance(cover.frame.to_space(cover.supported.middle(x, y)))));
    if (off.empty()) return {0, 0};
    return {median(off), quantile(off, 0.95)};
  }

  bool comes_near(const Box3& box, const Plane& plane) const {
    const double extent = plane.normal.cwiseAbs().dot(box.sizes()) / 2;
    return std::abs(plane.signed_distance(box.center())) <= extent + options_.same_far;
  }

  // For each surface the largest one that it is nearly in the plane of.
  void find_leaders() {
    const std::size_t count = in_.covers.size();
    leader_.resize(count);
    std::iota(leader_.begin(), leader_.end(), std::size_t{0});
    std::vector<std::size_t> order = leader_;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return in_.covers[a].area > in_.covers[b].area;
    });
    const double near = std::max(options_.same_plane, 2 * in_.noise);
    for (std::size_t i = 0; i < count && cuts(order[i]); ++i) {
      const std::size_t a = order[i];
      if (leader_[a] != a) continue;
      const Box3 reach = grown(in_.patches[a].box, options_.same_reach);
      for (std::size_t j = i + 1; j < count && cuts(order[j]); ++j) {
        const std::size_t b = order[j];
        if (leader_[b] != b || in_.covers[a].plane.normal.dot(in_.covers[b].plane.normal) <
                                   std::cos(options_.same_angle))
          continue;
        const bool is_near = reach.intersects(in_.patches[b].box);
        if (!is_near && !comes_near(in_.patches[b].box, in_.covers[a].plane)) continue;
        const auto [middle, most] = distances_off(in_.covers[b], in_.covers[a].plane);
        const double off = is_near ? near : options_.same_far;
        if (middle <= off && most <= 2 * off) leader_[b] = a;
      }
    }
  }

  void find_rivals() {
    rivals_.resize(in_.covers.size());
    for (std::size_t a = 0; a < rivals_.size(); ++a) {
      if (!cuts(a)) continue;
      const Box3 near = grown(in_.patches[a].box, kRivalReach);
      for (std::size_t b = 0; b < rivals_.size(); ++b)
        if (leader_[a] != leader_[b] && cuts(b) &&
            in_.covers[a].plane.normal.dot(in_.covers[b].plane.normal) > kRivalCosine &&
            near.intersects(in_.patches[b].box))
          rivals_[a].push_back(b);
    }
  }

  // Whether another plane goes on the wall at a place of plane k.
  bool is_rivals(std::size_t k, const Vec3& place) const {
    return std::any_of(rivals_[k].begin(), rivals_[k].end(), [&](std::size_t other) {
      const Cover& c = in_.covers[other];
      if (std::abs(c.plane.signed_distance(place)) > options_.step_depth) return false;
      const auto at = c.supported.find(c.frame.to_plane(place));
      return at && c.distance[*at] <= 1.5 * c.supported.cell;
    });
  }

  void add_surface(std::size_t k) {
    if (!cuts(k)) return;
    const Cover& cover = in_.covers[k];
    Raster region = cover.supported;
    for (int y = 0; y < region.height; ++y)
      for (int x = 0; x < region.width; ++x) {
        const std::size_t i = region.index(x, y);
        if (region.bits[i] || cover.distance[i] > cover.reach) continue;
        region.bits[i] =
            rivals_[k].empty() || !is_rivals(k, cover.frame.to_space(region.middle(x, y)));
      }
    SpacePlane plane{.plane = in_.covers[leader_[k]].plane,
                     .kind = SpacePlane::Kind::surface,
                     .patch = static_cast<int>(k),
                     .size = cover.area};
    for (const CellBox& box : rectangles_of(region)) {
      plane.regions.push_back(corners_of(region, cover.frame, box));
      for (Vec3& p : plane.regions.back()) p = plane.plane.project(p);
    }
    plane_of_[k] = static_cast<int>(planes_.size());
    planes_.push_back(std::move(plane));
  }

  // A strip of a plane along from..to, as wide as `low` to `high` along a direction.
  static void add_strip(SpacePlane& plane, const Vec3& from, const Vec3& to, const Vec3& across,
                        double low, double high) {
    std::vector<Vec3> strip = {from + low * across, to + low * across, to + high * across,
                               from + high * across};
    for (Vec3& p : strip) p = plane.plane.project(p);
    plane.regions.push_back(std::move(strip));
  }

  // Each of two planes that meet goes on a little beyond the other.
  void go_on_at(const surface::Seam& seam) {
    for (const auto& [own, other] : {std::pair{seam.a, seam.b}, {seam.b, seam.a}}) {
      const int k = plane_of_[static_cast<std::size_t>(own)];
      if (k < 0 || plane_of_[static_cast<std::size_t>(other)] < 0) continue;
      const Vec3& across = in_.covers[static_cast<std::size_t>(other)].plane.normal;
      for (const surface::Interval& i : seam.seen)
        add_strip(planes_[static_cast<std::size_t>(k)], seam.line.at(i.low), seam.line.at(i.high),
                  across, -options_.seam_reach, options_.seam_reach);
    }
  }

  // Places of a plane that are beside what another plane of the same wall has points on.
  std::vector<Vec3> places_beside(const Cover& a, const Cover& b) const {
    std::vector<Vec3> places;
    for (int y = 0; y < a.supported.height; ++y)
      for (int x = 0; x < a.supported.width; ++x) {
        if (!a.supported.is_set(x, y)) continue;
        const Vec3 p = a.frame.to_space(a.supported.middle(x, y));
        if (std::abs(b.plane.signed_distance(p)) > options_.step_depth) continue;
        const auto at = b.supported.find(b.frame.to_plane(p));
        if (at && b.distance[*at] <= 4 * b.supported.cell) places.push_back(p);
      }
    return places;
  }

  // Whether another plane stands between where two go on beside each other.
  bool is_parted(const std::vector<Vec3>& places, const Vec3& normal) const {
    const std::size_t stride = std::max<std::size_t>(1, places.size() / 40);
    std::size_t asked = 0, parted = 0;
    for (std::size_t i = 0; i < places.size(); i += stride) {
      ++asked;
      parted += std::any_of(in_.covers.begin(), in_.covers.end(), [&](const Cover& c) {
        if (c.area < options_.min_area || std::abs(c.plane.normal.dot(normal)) > 0.5 ||
            std::abs(c.plane.signed_distance(places[i])) > options_.step_depth)
          return false;
        const auto at = c.supported.find(c.frame.to_plane(places[i]));
        return at && c.distance[*at] < 4 * c.supported.cell;
      });
    }
    return 5 * parted > 2 * asked;
  }

  static Vec3 mean_of(const std::vector<Vec3>& places) {
    Vec3 mean = Vec3::Zero();
    for (const Vec3& p : places) mean += p / static_cast<double>(places.size());
    return mean;
  }

  // Two planes of one wall that are apart where they meet: one straight step between them.
  void add_step(std::size_t a, std::size_t b) {
    const Cover &one = in_.covers[a], &other = in_.covers[b];
    const std::vector<Vec3> places = places_beside(one, other);
    if (places.size() < 6) return;
    const std::vector<Vec3> places_there = places_beside(other, one);
    if (places_there.empty()) return;
    std::vector<double> apart;
    for (const Vec3& p : places) apart.push_back(std::abs(other.plane.signed_distance(p)));
    const Vec3 middle = mean_of(places);
    const double height = median(apart);
    if (height < std::max(options_.min_step, 2 * in_.noise) || height > 0.2) return;
    Mat3 spread = Mat3::Zero();
    for (const Vec3& p : places) spread += (p - middle) * (p - middle).transpose();
    const Eigen::SelfAdjointEigenSolver<Mat3> axes(spread / static_cast<double>(places.size()));
    const double along = std::sqrt(std::max(0.0, axes.eigenvalues()[2])),
                 across = std::sqrt(std::max(0.0, axes.eigenvalues()[1]));
    if (along < 0.1 || across > 0.45 * along || is_parted(places, one.plane.normal)) return;
    const Vec3 way = axes.eigenvectors().col(2);
    double low = 1e9, high = -1e9;
    for (const Vec3& p : places) {
      const double t = way.dot(p - middle);
      low = std::min(low, t), high = std::max(high, t);
    }
    // It is as far from the places of both.
    const Vec3 between = (middle + mean_of(places_there)) / 2;
    SpacePlane step{.plane = plane_through(between, way.cross(one.plane.normal).normalized()),
                    .kind = SpacePlane::Kind::step,
                    .size = high - low};
    add_strip(step, middle + way * (low - 0.1), middle + way * (high + 0.1), one.plane.normal,
              -options_.step_depth, options_.step_depth);
    planes_.push_back(std::move(step));
    for (const std::size_t k : {a, b})
      planes_[static_cast<std::size_t>(plane_of_[k])].is_late = true;
  }

  // The mean emptiness of a face just beyond an edge of it; nothing where it is not known.
  std::optional<double> emptiness_beyond(const surface::SharedEdge::Part& part,
                                         const Vec3& outward) const {
    const Cover& c = in_.covers[static_cast<std::size_t>(part.patch)];
    const Vec3 way = part.to - part.from;
    const double length = way.norm(), cell = c.supported.cell;
    double sum = 0;
    int count = 0;
    for (double t = cell / 2; t < length; t += cell)
      for (double s = 1.5; s < 5; ++s) {
        const Vec3 p = part.from + way * (t / length) + outward * (s * cell);
        if (const auto at = c.supported.find(c.frame.to_plane(p))) sum += c.empty[*at], ++count;
      }
    if (count == 0) return std::nullopt;
    return sum / count;
  }

  // The surface that an edge of another one lies on, if there is one.
  std::optional<std::size_t> surface_at(const surface::SharedEdge::Part& part) const {
    const auto own = static_cast<std::size_t>(part.patch);
    for (std::size_t k = 0; k < in_.covers.size(); ++k) {
      if (k == own || plane_of_[k] < 0) continue;
      const Plane& plane = in_.covers[k].plane;
      if (std::abs(plane.normal.dot(in_.covers[own].plane.normal)) < kRivalCosine &&
          std::abs(plane.signed_distance(part.from)) < options_.on_plane &&
          std::abs(plane.signed_distance(part.to)) < options_.on_plane)
        return k;
    }
    return std::nullopt;
  }

  // The ends of faces, the longest first. Those that are nearly in one plane have one.
  void add_edges() {
    std::vector<SpacePlane> made;
    struct End {
      surface::SharedEdge::Part part;
      Plane plane;
      double length;
    };
    std::vector<End> ends;
    for (const surface::SharedEdge& edge : in_.edges)
      for (const surface::SharedEdge::Part& part : edge.parts) {
        const double length = (part.to - part.from).norm();
        if (in_.covers[static_cast<std::size_t>(part.patch)].is_none() || length < 1e-6) continue;
        if (const auto on = surface_at(part)) {
          add_strip(planes_[static_cast<std::size_t>(plane_of_[*on])], part.from, part.to,
                    in_.covers[static_cast<std::size_t>(part.patch)].plane.normal,
                    -options_.seam_reach, options_.seam_reach);
          continue;
        }
        const Vec3& outward = edge.plane.normal;
        // A plate ends where its points do, whatever else could be seen.
        if (backs_[static_cast<std::size_t>(part.patch)] ||
            std::max(emptiness_beyond(part, outward).value_or(0),
                     emptiness_beyond(part, -outward).value_or(0)) >= options_.min_emptiness)
          ends.push_back({part, edge.plane, length});
      }
    std::stable_sort(ends.begin(), ends.end(),
                     [](const End& a, const End& b) { return a.length > b.length; });
    for (const End& end : ends) {
      const auto is_same = [&](const SpacePlane& p) {
        return std::abs(p.plane.normal.dot(end.plane.normal)) > kSameCosine &&
               std::abs(p.plane.signed_distance(end.plane.project(end.part.from))) <
                   options_.same_edge &&
               std::abs(p.plane.signed_distance(end.plane.project(end.part.to))) <
                   options_.same_edge;
      };
      auto own = std::find_if(made.begin(), made.end(), is_same);
      if (own == made.end())
        own = made.insert(made.end(), {.plane = end.plane, .kind = SpacePlane::Kind::edge});
      const Vec3 more = (end.part.to - end.part.from) * (options_.edge_reach / end.length);
      add_strip(*own, end.part.from - more, end.part.to + more,
                in_.covers[static_cast<std::size_t>(end.part.patch)].plane.normal,
                -options_.edge_depth, options_.edge_depth);
      own->size += end.length;
    }
    planes_.insert(planes_.end(), made.begin(), made.end());
  }

  bool is_crossed(const Vec3& place) const {
    return free_.contains(place, sight_.cell()) && !sight_.is_occupied(place);
  }

  // Whether another face is behind much of a plate.
  bool has_other_face(const Cover& plate) const {
    return std::any_of(in_.covers.begin(), in_.covers.end(), [&](const Cover& other) {
      if (other.is_none() || other.plane.normal.dot(plate.plane.normal) > -0.99) return false;
      int asked = 0, met = 0;
      for (int y = 0; y < plate.supported.height; y += 3)
        for (int x = 0; x < plate.supported.width; x += 3) {
          if (!plate.supported.is_set(x, y)) continue;
          const Vec3 p = plate.frame.to_space(plate.supported.middle(x, y));
          const double depth = -other.plane.signed_distance(p);
          ++asked;
          if (depth <= 0 || depth >= 0.6) continue;
          const auto at = other.supported.find(other.frame.to_plane(p));
          met += at && other.distance[*at] <= other.reach;
        }
      return 5 * met > 2 * asked;
    });
  }

  void find_back(std::size_t k) {
    const Cover& cover = in_.covers[k];
    int asked = 0, behind = 0;
    for (int y = 0; y < cover.supported.height; y += 2)
      for (int x = 0; x < cover.supported.width; x += 2) {
        if (!cover.supported.is_set(x, y)) continue;
        const Vec3 p = cover.frame.to_space(cover.supported.middle(x, y));
        ++asked;
        for (const double depth : {0.12, 0.22, 0.32})
          if (is_crossed(p - depth * cover.plane.normal)) {
            ++behind;
            break;
          }
      }
    if (asked == 0 || behind < options_.min_behind * asked || has_other_face(cover)) return;
    const bool is_wall = cover.area > 2 && std::abs(cover.plane.normal.dot(in_.up)) < 0.5;
    const double thickness = is_wall ? options_.thin_wall : options_.thin;
    const Vec3 back = -thickness * cover.plane.normal;
    SpacePlane plane{.plane = {-cover.plane.normal, -cover.plane.offset - thickness},
                     .kind = SpacePlane::Kind::back,
                     .patch = static_cast<int>(k),
                     .size = cover.area / 2};
    for (const CellBox& box : rectangles_of(grow(cover.supported, 2))) {
      plane.regions.push_back(corners_of(cover.supported, cover.frame, box));
      for (Vec3& p : plane.regions.back()) p += back;
    }
    backs_[k] = std::move(plane);
  }

  void find_backs() {
    backs_.resize(in_.covers.size());
    parallel_for(backs_.size(), [&](std::size_t k) {
      if (cuts(k)) find_back(k);
    });
  }

  const SpaceInput& in_;
  const Sight& sight_;
  const CellSet& free_;
  const PlanesOptions& options_;
  std::vector<int> plane_of_;  // by patch
  std::vector<std::size_t> leader_;
  std::vector<std::vector<std::size_t>> rivals_;
  std::vector<std::optional<SpacePlane>> backs_;
  std::vector<SpacePlane> planes_;
};

}  // namespace

std::vector<SpacePlane> planes_of_space(const SpaceInput& in, const Sight& sight,
                                        const CellSet& free, const PlanesOptions& options) {
  return PlaneMaker(in, sight, free, options).make();
}

}  // namespace scanworld::space
