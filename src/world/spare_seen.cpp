// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "spare_seen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "solids.h"

namespace scanworld {

namespace {

using CoverCell = std::array<int, 3>;

// From one cell to another, both included.
struct CellBlock {
  CoverCell low, high;

  double count() const {
    double all = 1;
    for (std::size_t k = 0; k < 3; ++k) all *= high[k] - low[k] + 1;
    return all;
  }
};

// Points by the cell that they are in.
class PointCells {
 public:
  using Indices = std::vector<std::uint32_t>;

  PointCells(std::span<const Vec3> points, double cell) : points_(points), cell_(cell) {
    for (const Vec3& p : points) low_ = low_.cwiseMin(p);
    for (std::uint32_t i = 0; i < points.size(); ++i)
      cells_[key_of(cell_of(points[i]))].push_back(i);
  }

  double cell() const { return cell_; }
  const Vec3& point(std::uint32_t i) const { return points_[i]; }
  const Indices& at(const CoverCell& c) const { return cells_.at(key_of(c)); }
  CoverCell cell_of(const Vec3& p) const {
    const Vec3 at = ((p - low_) / cell_).array().floor().min(kFarthest).max(-1.0);
    return {static_cast<int>(at.x()), static_cast<int>(at.y()), static_cast<int>(at.z())};
  }
  // All that have points, in the order of their places.
  std::vector<CoverCell> all() const {
    std::vector<CoverCell> cells;
    for (const auto& [key, some] : cells_) cells.push_back(cell_of(points_[some.front()]));
    std::sort(cells.begin(), cells.end());
    return cells;
  }
  // Calls body(points) for the cells of a block that have points.
  template <typename Body>
  void for_each_in(const CellBlock& block, const Body& body) const {
    for (int x = block.low[0]; x <= block.high[0]; ++x)
      for (int y = block.low[1]; y <= block.high[1]; ++y)
        for (int z = block.low[2]; z <= block.high[2]; ++z)
          if (const auto found = cells_.find(key_of({x, y, z})); found != cells_.end())
            body(found->second);
  }
  bool has_near(const Vec3& p, double distance) const {
    const Vec3 margin = Vec3::Constant(distance);
    bool found = false;
    for_each_in({cell_of(p - margin), cell_of(p + margin)}, [&](const Indices& some) {
      found = found || std::any_of(some.begin(), some.end(), [&](std::uint32_t i) {
                return (points_[i] - p).squaredNorm() <= distance * distance;
              });
    });
    return found;
  }

 private:
  static constexpr int kBits = 21;  // of a cell along each axis; the lowest is -1
  static constexpr double kFarthest = (1 << kBits) - 2;

  static std::uint64_t key_of(const CoverCell& c) {
    const auto bits = [&](std::size_t k) { return static_cast<std::uint64_t>(c[k] + 1); };
    return bits(2) << 2 * kBits | bits(1) << kBits | bits(0);
  }

  std::span<const Vec3> points_;
  double cell_;
  Vec3 low_ = Vec3::Constant(1e300);
  std::unordered_map<std::uint64_t, Indices> cells_;
};

// A solid by its faces, which look outwards.
struct FacedSolid {
  Mesh mesh;
  std::vector<Plane> faces;

  FacedSolid(const Solid& solid, const Frame& frame)
      : mesh(mesh_of(Obstacle{.shape = solid}, frame)) {
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
      if (const Vec3 normal = vector_area(mesh, t); normal.norm() > 1e-12)
        faces.push_back(plane_through(corner(t, 0), normal.normalized()));
  }
  const Vec3& corner(std::size_t triangle, std::size_t k) const {
    return mesh.vertices[static_cast<std::size_t>(mesh.triangles[triangle][k])];
  }
  bool holds(const Vec3& p, double depth) const {
    return std::all_of(faces.begin(), faces.end(),
                       [&](const Plane& face) { return face.signed_distance(p) <= -depth; });
  }
  template <typename Points>
  double count_deep(const Points& points, double depth) const {
    return static_cast<double>(std::count_if(points.begin(), points.end(),
                                             [&](const Vec3& p) { return holds(p, depth); }));
  }
  // The least of the widths across its faces.
  double width() const {
    double least = 1e300;
    for (const Plane& face : faces) {
      double width = 0;
      for (const Vec3& v : mesh.vertices) width = std::max(width, -face.signed_distance(v));
      least = std::min(least, width);
    }
    return least;
  }
};

// The part of a triangle that has no points around [m2]: by the middles of the small ones that it
// consists of.
double bare_area(const FacedSolid& solid, std::size_t triangle, const PointCells& cells) {
  constexpr double kMostSmall = 200;  // along an edge
  const Vec3 a = solid.corner(triangle, 0);
  const Vec3 u = solid.corner(triangle, 1) - a, v = solid.corner(triangle, 2) - a;
  const double longest = std::max({u.norm(), v.norm(), (u - v).norm()});
  const int n = static_cast<int>(std::min(longest / cells.cell() + 1, kMostSmall));
  int bare = 0;
  const auto look = [&](double i, double j) {
    bare += !cells.has_near(a + (i * u + j * v) / n, cells.cell());
  };
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      look(i + 1 / 3.0, j + 1 / 3.0);
      if (i + j + 1 < n) look(i + 2 / 3.0, j + 2 / 3.0);
    }
  return vector_area(solid.mesh, triangle).norm() * bare / (static_cast<double>(n) * n);
}

// Axes that most faces of a thing are parallel to in plan, and up: those across which its points
// lie in fewest places.
Mat3 axes_of_faces(std::span<const Vec3> points, const Vec3& up, double cell) {
  constexpr int kSteps = 90;           // of a right angle
  constexpr std::size_t kMost = 4000;  // points
  const PlaneFrame frame = frame_of({up, 0});
  const std::size_t stride = points.size() / kMost + 1;
  double most = -1, best = 0;
  for (int k = 0; k < kSteps; ++k) {
    const double angle = k * M_PI / 2 / kSteps, c = std::cos(angle), s = std::sin(angle);
    std::unordered_map<int, double> along, across;
    for (std::size_t i = 0; i < points.size(); i += stride) {
      const Vec2 q = frame.to_plane(points[i]) / (cell / 2);
      ++along[static_cast<int>(std::floor(c * q.x() + s * q.y()))];
      ++across[static_cast<int>(std::floor(c * q.y() - s * q.x()))];
    }
    double sum = 0;  // of whole numbers
    for (const auto* counts : {&along, &across})
      for (const auto& [place, count] : *counts) sum += count * count;
    if (sum > most) most = sum, best = angle;
  }
  Mat3 axes;
  axes.col(0) = std::cos(best) * frame.u + std::sin(best) * frame.v;
  axes.col(1) = up.cross(axes.col(0));
  axes.col(2) = up;
  return axes;
}

// Joins cells with points to boxes, in the points' own axes.
class BoxCover {
 public:
  BoxCover(std::span<const Vec3> points, double cell, const SpareSeenOptions& options)
      : cells_(points, cell), options_(options), covered_(points.size()) {}

  std::vector<Box3> run() {
    struct Seed {
      double gain;
      CoverCell at;
    };
    std::vector<Seed> seeds;
    for (const CoverCell& at : cells_.all()) seeds.push_back({best_around(at).gain, at});
    std::stable_sort(seeds.begin(), seeds.end(),
                     [](const Seed& a, const Seed& b) { return a.gain > b.gain; });
    std::vector<Box3> boxes;
    for (const Seed& seed : seeds)
      if (open_in(cells_.at(seed.at)) > 0) boxes.push_back(take(best_around(seed.at).block));
    return without_needless(std::move(boxes));
  }

 private:
  using Indices = PointCells::Indices;
  static constexpr double kEmptyPrice = 2;  // of a cell without points, in such with
  struct Choice {
    CellBlock block;
    double gain;
  };

  std::size_t open_in(const Indices& some) const {
    return static_cast<std::size_t>(
        std::count_if(some.begin(), some.end(), [&](std::uint32_t i) { return !covered_[i]; }));
  }

  // Whether enough of a layer's cells have points.
  bool is_filled(const CellBlock& layer) const {
    double filled = 0;
    cells_.for_each_in(layer, [&](const Indices&) { ++filled; });
    return filled >= options_.min_filled * layer.count();
  }

  void grow(CellBlock& block, std::size_t axis) const {
    for (int way : {-1, 1})
      for (;;) {
        CellBlock layer = block;
        int& end = way < 0 ? block.low[axis] : block.high[axis];
        layer.low[axis] = layer.high[axis] = end + way;
        if (end + way < 0 || !is_filled(layer)) break;
        end += way;
      }
  }

  // Of the blocks that grow from a cell along one axis after the other, the one with most cells
  // whose points no box holds yet, less those without points.
  Choice best_around(const CoverCell& seed) const {
    Choice best{{seed, seed}, -1e300};
    std::array<std::size_t, 3> order = {0, 1, 2};
    do {
      CellBlock block{seed, seed};
      for (std::size_t axis : order) grow(block, axis);
      double open = 0, filled = 0;
      cells_.for_each_in(block, [&](const Indices& some) {
        open += static_cast<double>(open_in(some)) / static_cast<double>(some.size()), ++filled;
      });
      const double gain = open - kEmptyPrice * (block.count() - filled);
      if (gain > best.gain) best = {block, gain};
    } while (std::next_permutation(order.begin(), order.end()));
    return best;
  }

  // Calls body(i) for the points in a box, and so close to it that they need no other.
  template <typename Body>
  void for_each_held(const Box3& box, const Body& body) const {
    const double margin = cells_.cell() / 2;
    const CellBlock around{cells_.cell_of(box.min() - Vec3::Constant(margin)),
                           cells_.cell_of(box.max() + Vec3::Constant(margin))};
    cells_.for_each_in(around, [&](const Indices& some) {
      for (std::uint32_t i : some)
        if (box.exteriorDistance(cells_.point(i)) <= margin) body(i);
    });
  }

  // The box of a block's points.
  Box3 take(const CellBlock& block) {
    Box3 box;
    cells_.for_each_in(block, [&](const Indices& some) {
      for (std::uint32_t i : some) box.extend(cells_.point(i));
    });
    for_each_held(box, [&](std::uint32_t i) { covered_[i] = 1; });
    return box;
  }

  // Without those whose points are held by others, but for a few: the smallest go first.
  std::vector<Box3> without_needless(std::vector<Box3> boxes) const {
    std::vector<int> holders(covered_.size());
    for (const Box3& box : boxes) for_each_held(box, [&](std::uint32_t i) { ++holders[i]; });
    std::stable_sort(boxes.begin(), boxes.end(), [](const Box3& a, const Box3& b) {
      return a.diagonal().norm() < b.diagonal().norm();
    });
    std::erase_if(boxes, [&](const Box3& box) {
      int own = 0;
      for_each_held(box, [&](std::uint32_t i) { own += holders[i] == 1; });
      const bool is_needless = own < options_.min_points;
      if (is_needless) for_each_held(box, [&](std::uint32_t i) { --holders[i]; });
      return is_needless;
    });
    return boxes;
  }

  PointCells cells_;
  const SpareSeenOptions& options_;
  std::vector<char> covered_;
};

double free_inside(const FacedSolid& faced, std::span<const Vec3> points, const SeenSpace& seen,
                   const SpareSeenOptions& options) {
  const double width = faced.width();
  if (width < 2 * seen.cell) {
    const PointCells cells(points, seen.cell);
    double bare = 0;
    for (std::size_t t = 0; t < faced.mesh.triangles.size(); ++t)
      bare += bare_area(faced, t, cells);
    return width / 2 * bare;
  }
  const double inside = std::max(seen.cell, width / 4);
  if (!seen.from_viewpoints &&
      faced.count_deep(points, inside) > options.max_deep * static_cast<double>(points.size()))
    return volume_of(faced.mesh);
  Box3 box;
  for (const Vec3& v : faced.mesh.vertices) box.extend(v);
  return faced.count_deep(seen.in(box), options.depth) * std::pow(seen.cell, 3);
}

}  // namespace

double free_volume(const Solid& solid, const Frame& frame, std::span<const Vec3> points,
                   const SeenSpace& seen, const SpareSeenOptions& options) {
  return free_inside(FacedSolid(solid, frame), points, seen, options);
}

bool spares_free(const Solid& solid, const Frame& frame, std::span<const Vec3> points,
                 const SeenSpace& seen, const SpareSeenOptions& options) {
  const FacedSolid faced(solid, frame);
  return free_inside(faced, points, seen, options) <=
         std::max(options.min_free, options.min_share * volume_of(faced.mesh));
}

std::vector<OrientedBox> cover_by_boxes(std::span<const Vec3> points, const Vec3& up, double cell,
                                        double noise, const SpareSeenOptions& options) {
  constexpr double kLeastSize = 0.005;  // [m] however good the scan
  const Mat3 axes = axes_of_faces(points, up, cell);
  std::vector<Vec3> turned;
  for (const Vec3& p : points) turned.push_back(axes.transpose() * p);
  std::vector<OrientedBox> boxes;
  for (const Box3& box : BoxCover(turned, cell, options).run())
    boxes.push_back({axes * box.center(), box.sizes().cwiseMax(std::max(noise, kLeastSize)),
                     Eigen::Quaterniond(axes).normalized()});
  return boxes;
}

}  // namespace scanworld
