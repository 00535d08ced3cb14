// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "wall_gaps.h"

#include <algorithm>
#include <cmath>

#include "../polygon.h"
#include "surface_rings.h"

namespace scanworld {

namespace {

using Box2 = Eigen::AlignedBox2d;

constexpr double kSameCosine = 0.9999, kSameOffset = 0.002;  // [m] surfaces are in one plane
constexpr double kUprightWall = 0.3;  // cosine of a wall's normal to up, at most
constexpr double kSquare = 0.2;       // of a side's normal to a direction in the wall, at most
constexpr double kSlope = 0.3;        // of an edge that ends a gap, off upright or level
constexpr double kLeastEdge = 0.05;   // [m] of such an edge
constexpr double kSame = 0.005;       // [m] places are one
constexpr double kBeside = 0.1;       // [m] before a wall, where a floor ends that is at it
constexpr double kRoom = 0.4;         // [m] from a wall, so far a floor goes at least
constexpr double kFloor = 2;          // [m2] smaller ones may be tables
constexpr double kBesideCosine = 0.95, kClose = 0.1;  // [m] of what closes a gap of a face
constexpr double kInside = 0.012;        // [m] less of a surface in a row does not close it
constexpr double kNearSide = 0.1;        // [m] off a side of a gap, where what is beside it begins
constexpr double kThinnest = 0.1;        // [m] of a wall, as deep as what is beside its face
constexpr std::size_t kMostGaps = 64;    // of a face
constexpr std::size_t kMostSteps = 400;  // along each axis of a face; of more the longest edges

// How far something is behind a face [m], less than 0 before it.
struct Depth {
  double low = 1e300, high = -1e300;
};

// A side of a gap: of a surface in the face, or within the wall.
struct Side {
  double at = 0;             // along the axis that it is square to
  double low = 0, high = 0;  // along the other one
  bool is_within = false, is_measured = false;
};

// A face in cells whose borders go through its sides.
class GapFinder {
 public:
  GapFinder(const World& world, const WallFace& face, const WallGapOptions& options)
      : world_(world), face_(face), options_(options) {}

  std::vector<WallGap> find() {
    find_sides();
    for (int axis = 0; axis < 2; ++axis) place_steps(axis);
    if (columns() == 0 || rows() == 0) return {};
    fill_cells();
    place_walls();
    std::vector<WallGap> gaps;
    while (gaps.size() < kMostGaps) {
      const auto best = largest();
      if (!best) break;
      gaps.push_back(describe(*best));
      for (std::size_t y = best->y0; y < best->y1; ++y)
        for (std::size_t x = best->x0; x < best->x1; ++x)
          filled_[cell(x, y)] = shut_[cell(x, y)] = 1;
    }
    return gaps;
  }

 private:
  struct Cells {
    std::size_t x0, x1, y0, y1;
  };
  enum Edge { kLeft, kRight, kBottom, kTop };

  std::size_t columns() const { return steps_[0].size() < 2 ? 0 : steps_[0].size() - 1; }
  std::size_t rows() const { return steps_[1].size() < 2 ? 0 : steps_[1].size() - 1; }
  std::size_t cell(std::size_t x, std::size_t y) const { return y * columns() + x; }

  void find_sides() {
    for (std::size_t k = 0; k < face_.surfaces.size(); ++k)
      for (const auto& ring : face_.rings[k]) add_edges(ring, world_.surfaces[face_.surfaces[k]]);
    const Box2 near(face_.box.min().array() - kSame, face_.box.max().array() + kSame);
    for (std::size_t i = 0; i < world_.surfaces.size(); ++i) {
      const Surface& s = world_.surfaces[i];
      const double cosine = s.plane.normal.dot(face_.plane.normal);
      const bool is_square = std::abs(cosine) < kSquare && !s.ground;
      if (!is_square && std::abs(cosine) < kBesideCosine) continue;
      const auto [box, depth] = extent_of(s);
      if (!near.intersects(box)) continue;
      if (is_square) {
        add_within(s, box, depth);
        add_floor(s, box, depth);
      } else if (cosine > 0) {
        add_beside(i, box, depth);
      } else {
        add_back(s, depth);
      }
    }
  }

  void add_edges(const std::vector<Vec2>& ring, const Surface& surface) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
      const Vec2 way = (b - a).cwiseAbs();
      for (int axis = 0; axis < 2; ++axis)
        if (way[1 - axis] >= kLeastEdge && way[axis] <= kSlope * way[1 - axis])
          sides_[axis].push_back({(a[axis] + b[axis]) / 2, std::min(a[1 - axis], b[1 - axis]),
                                  std::max(a[1 - axis], b[1 - axis]), false,
                                  surface.source == Source::measured});
    }
  }

  // A surface in the face's frame, and its depths behind it.
  std::pair<Box2, Depth> extent_of(const Surface& s) const {
    Box2 box;
    Depth depth;
    for (int v : s.outer) {
      const Vec3& p = world_.vertices[static_cast<std::size_t>(v)];
      const double d = -face_.plane.signed_distance(p);
      depth = {std::min(depth.low, d), std::max(depth.high, d)};
      box.extend(face_.frame.to_plane(p));
    }
    return {box, depth};
  }

  // A surface square to the wall that is met a little behind the face.
  void add_within(const Surface& s, const Box2& box, const Depth& depth) {
    if (s.source != Source::measured || depth.low > options_.piece_depth ||
        depth.high < options_.piece_depth || depth.high > options_.max_thickness)
      return;
    for (int axis = 0; axis < 2; ++axis) {
      const Vec3& other = axis == 0 ? face_.frame.v : face_.frame.u;
      if (std::abs(s.plane.normal.dot(other)) <= kSquare &&
          box.sizes()[1 - axis] >= options_.min_piece)
        sides_[axis].push_back(
            {box.center()[axis], box.min()[1 - axis], box.max()[1 - axis], true, true});
    }
  }

  // What stands close before or behind a face, as a wall's other part or a picture, closes it; the
  // narrow frame of a window does not.
  void add_beside(std::size_t i, const Box2& box, const Depth& depth) {
    if (std::max(std::abs(depth.low), std::abs(depth.high)) > kClose ||
        box.sizes().minCoeff() < options_.min_piece ||
        std::binary_search(face_.surfaces.begin(), face_.surfaces.end(), i))
      return;
    add_closing(world_.surfaces[i], beside_);
  }

  // The other face of the wall closes it too: a cupboard before a wall hides a gap beside a door.
  void add_back(const Surface& s, const Depth& depth) {
    if (s.kind != Kind::wall || s.source != Source::measured || depth.low < kThinnest ||
        depth.high > options_.max_thickness)
      return;
    add_closing(s, behind_);
  }

  void add_closing(const Surface& s, std::vector<geos::Rings>& to) {
    to.push_back(rings_of(world_, s, face_.frame));
    for (const auto& ring : to.back()) add_edges(ring, s);
  }

  // One stands on it on either side of the wall, whatever is below; not on a sill or a table.
  void add_floor(const Surface& s, const Box2& box, const Depth& depth) {
    const bool is_before = depth.low < -kRoom && depth.high > -kBeside,
               is_behind = depth.high > options_.max_thickness + kRoom &&
                           depth.low < options_.max_thickness;
    if (s.kind != Kind::floor || (!is_before && !is_behind) || area(world_, s) < kFloor) return;
    floors_.push_back(box);
    sides_[1].push_back(
        {box.center().y(), box.min().x(), box.max().x(), true, s.source == Source::measured});
  }

  void place_steps(int axis) {
    std::vector<Side>& sides = sides_[axis];
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& a, const Side& b) { return a.high - a.low > b.high - b.low; });
    if (sides.size() > kMostSteps) sides.resize(kMostSteps);
    // Of those that are nearly one the longest tells the place.
    std::vector<double>& steps = steps_[axis];
    const double low = face_.box.min()[axis], high = face_.box.max()[axis];
    const auto place = [&](double at) {
      if (at > low - kSame && at < high + kSame &&
          std::none_of(steps.begin(), steps.end(),
                       [&](double step) { return std::abs(step - at) < kSame; }))
        steps.push_back(at);
    };
    for (const Side& s : sides) place(s.at);
    place(low), place(high);
    std::sort(steps.begin(), steps.end());
  }

  // Cells that surfaces of the face are in.
  void fill_cells() {
    filled_.assign(columns() * rows(), 0);
    fill(face_.rings, filled_), fill(beside_, filled_);
    shut_ = filled_;
    fill(behind_, shut_);
  }

  // By three lines through each row.
  void fill(const std::vector<geos::Rings>& surfaces, std::vector<char>& cells) const {
    for (std::size_t y = 0; y < rows(); ++y)
      for (const double share : {0.1, 0.5, 0.9}) {
        const double height = steps_[1][y] + share * (steps_[1][y + 1] - steps_[1][y]);
        for (const geos::Rings& rings : surfaces) fill_row(y, crossings(rings, height), cells);
      }
  }

  static std::vector<double> crossings(const geos::Rings& rings, double height) {
    std::vector<double> found;
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const Vec2 &a = ring[i], &b = ring[(i + 1) % ring.size()];
        if ((a.y() > height) != (b.y() > height))
          found.push_back(a.x() + (b.x() - a.x()) * (height - a.y()) / (b.y() - a.y()));
      }
    std::sort(found.begin(), found.end());
    return found;
  }

  void fill_row(std::size_t y, const std::vector<double>& ends, std::vector<char>& cells) const {
    for (std::size_t k = 0; k + 1 < ends.size(); k += 2)
      for (std::size_t x = 0; x < columns(); ++x)
        if (std::min(ends[k + 1], steps_[0][x + 1]) - std::max(ends[k], steps_[0][x]) >
            std::min(kInside, 0.5 * (steps_[0][x + 1] - steps_[0][x])))
          cells[cell(x, y)] = 1;
  }

  // Where cells end at what is within the wall: for each border the cells beside it, by rows or
  // columns.
  void place_walls() {
    for (int axis = 0; axis < 2; ++axis) {
      const std::vector<double>&along = steps_[axis], &across = steps_[1 - axis];
      const std::size_t count = across.size() - 1;
      walled_[axis].assign(along.size() * count, 0), measured_[axis] = walled_[axis];
      for (const Side& s : sides_[axis]) {
        const auto near = std::min_element(along.begin(), along.end(), [&](double a, double b) {
          return std::abs(a - s.at) < std::abs(b - s.at);
        });
        if (std::abs(*near - s.at) > kSame) continue;
        const auto border = static_cast<std::size_t>(near - along.begin());
        for (std::size_t i = 0; i < count; ++i) {
          const double middle = (across[i] + across[i + 1]) / 2;
          if (middle < s.low || middle > s.high) continue;
          walled_[axis][border * count + i] |= s.is_within;
          measured_[axis][border * count + i] |= s.is_measured;
        }
      }
    }
  }

  bool is_walled(int axis, std::size_t border, std::size_t i) const {
    return walled_[axis][border * (steps_[1 - axis].size() - 1) + i];
  }

  bool is_low(const Cells& c) const {
    const double foot = steps_[1][c.y0], middle = (steps_[0][c.x0] + steps_[0][c.x1]) / 2;
    return foot < face_.box.min().y() + options_.sill ||
           std::any_of(floors_.begin(), floors_.end(), [&](const Box2& floor) {
             return std::abs(foot - floor.center().y()) < options_.sill &&
                    middle > floor.min().x() && middle < floor.max().x();
           });
  }

  // The share of a side of what is empty that something is beside, or that is measured.
  template <typename Is>
  double share_of(const Cells& c, Edge edge, const Is& is) const {
    const int axis = edge < kBottom ? 0 : 1;
    const std::vector<double>& across = steps_[1 - axis];
    const std::size_t first = axis == 0 ? c.y0 : c.x0, last = axis == 0 ? c.y1 : c.x1;
    const std::size_t border = edge == kLeft     ? c.x0
                               : edge == kRight  ? c.x1
                               : edge == kBottom ? c.y0
                                                 : c.y1;
    const bool goes_up = edge == kRight || edge == kTop;
    double sum = 0;
    for (std::size_t i = first; i < last; ++i)
      if (is(axis, border, i, goes_up)) sum += across[i + 1] - across[i];
    return sum / (across[last] - across[first]);
  }

  double support_of(const Cells& c, Edge edge) const {
    return share_of(c, edge, [&](int axis, std::size_t border, std::size_t i, bool goes_up) {
      const std::vector<double>& along = steps_[axis];
      for (std::size_t at = border; std::abs(along[at] - along[border]) < kNearSide;) {
        if (is_walled(axis, at, i)) return true;
        if (goes_up ? at == along.size() - 1 : at == 0) return false;
        const std::size_t beside = goes_up ? at++ : --at;
        if (filled_[axis == 0 ? cell(beside, i) : cell(i, beside)]) return true;
      }
      return false;
    });
  }

  double area_of(const Cells& c) const {
    return (steps_[0][c.x1] - steps_[0][c.x0]) * (steps_[1][c.y1] - steps_[1][c.y0]);
  }

  bool is_gap(const Cells& c) const {
    return steps_[0][c.x1] - steps_[0][c.x0] >= options_.min_width &&
           steps_[1][c.y1] - steps_[1][c.y0] >= options_.min_height &&
           support_of(c, kLeft) >= options_.min_support &&
           support_of(c, kRight) >= options_.min_support &&
           support_of(c, kTop) >= options_.min_support &&
           (is_low(c) || support_of(c, kBottom) >= options_.min_support);
  }

  // The largest empty rectangle of cells with enough beside it: for each range of rows the runs of
  // columns that are empty in all of them.
  std::optional<Cells> largest() const {
    std::optional<Cells> best;
    double most = options_.min_width * options_.min_height;
    std::vector<char> shut(columns());
    std::vector<char> parted(columns() + 1);
    for (std::size_t y0 = 0; y0 < rows(); ++y0) {
      std::fill(shut.begin(), shut.end(), 0), std::fill(parted.begin(), parted.end(), 0);
      for (std::size_t y1 = y0 + 1; y1 <= rows(); ++y1) {
        for (std::size_t x = 0; x < columns(); ++x) {
          shut[x] |= shut_[cell(x, y1 - 1)] || (y1 - 1 > y0 && is_walled(1, y1 - 1, x));
          parted[x] |= is_walled(0, x, y1 - 1);
        }
        for (std::size_t x0 = 0; x0 < columns();) {
          std::size_t x1 = x0 + 1;
          if (!shut[x0]) {
            while (x1 < columns() && !shut[x1] && !parted[x1]) ++x1;
            const Cells c{x0, x1, y0, y1};
            if (area_of(c) > most && is_gap(c)) best = c, most = area_of(c);
          }
          x0 = x1;
        }
      }
    }
    return best;
  }

  WallGap describe(const Cells& c) const {
    WallGap gap{
        Box2(Vec2(steps_[0][c.x0], steps_[1][c.y0]), Vec2(steps_[0][c.x1], steps_[1][c.y1])),
        is_low(c), 0};
    const Vec2 size = gap.clear.sizes();
    double length = 0;
    for (const Edge edge : {kLeft, kRight, kTop, kBottom}) {
      if (edge == kBottom && gap.is_low) continue;
      const double side = edge < kBottom ? size.y() : size.x();
      length += side;
      gap.measured +=
          side * share_of(c, edge, [&](int axis, std::size_t border, std::size_t i, bool) {
            return measured_[axis][border * (steps_[1 - axis].size() - 1) + i] != 0;
          });
    }
    gap.measured /= length;
    return gap;
  }

  const World& world_;
  const WallFace& face_;
  const WallGapOptions& options_;
  std::vector<Side> sides_[2];  // upright ones, level ones
  std::vector<Box2> floors_;
  std::vector<geos::Rings> beside_;            // surfaces close before and behind the face
  std::vector<geos::Rings> behind_;            // surfaces of the wall's other face
  std::vector<double> steps_[2];               // ascending
  std::vector<char> filled_;                   // cells
  std::vector<char> shut_;                     // cells that are filled, or by the other face
  std::vector<char> walled_[2], measured_[2];  // borders between cells, upright and level
};

}  // namespace

std::vector<WallFace> wall_faces_of(const World& world) {
  std::vector<WallFace> faces;
  for (std::size_t s = 0; s < world.surfaces.size(); ++s) {
    const Surface& surface = world.surfaces[s];
    if (std::abs(surface.plane.normal.dot(world.frame.up)) > kUprightWall) continue;
    const Vec3& corner = world.vertices[static_cast<std::size_t>(surface.outer[0])];
    auto face = std::find_if(faces.begin(), faces.end(), [&](const WallFace& f) {
      return f.plane.normal.dot(surface.plane.normal) > kSameCosine &&
             std::abs(f.plane.signed_distance(corner)) < kSameOffset;
    });
    if (face == faces.end())
      face = faces.insert(
          faces.end(),
          {.plane = surface.plane, .frame = upright_frame(surface.plane, world.frame.up, corner)});
    geos::Rings rings = rings_of(world, surface, face->frame);
    Box2 box;
    for (const Vec2& p : rings[0]) box.extend(p);
    face->box.extend(box), face->boxes.push_back(box);
    face->area += area(world, surface);
    face->surfaces.push_back(s);
    face->rings.push_back(std::move(rings));
  }
  return faces;
}

std::vector<WallGap> gaps_of(const World& world, const WallFace& face,
                             const WallGapOptions& options) {
  return GapFinder(world, face, options).find();
}

}  // namespace scanworld
