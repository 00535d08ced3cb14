// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "landmarks.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "surface_rings.h"

namespace scanworld {

namespace {

using Mat2 = Eigen::Matrix2d;

constexpr double kRounding = 1e-6;  // [m] vertices are no better known

// How well the plane of a surface is known at any point of it.
struct PlaneVariance {
  PlaneFrame frame;
  Vec2 middle = Vec2::Zero();
  Mat2 inverse = Mat2::Zero();  // of the second moments
  double of_middle = 0;         // [m2]; 0 where nothing was measured

  double at(const Vec3& p) const {
    const Vec2 d = frame.to_plane(p) - middle;
    return of_middle * (1 + d.dot(inverse * d)) + kRounding * kRounding;
  }
};

PlaneVariance variance_of(const World& world, const Surface& surface) {
  PlaneVariance v{.frame = rings_frame(world, surface)};
  if (surface.support.points == 0) return v;
  double area = 0;
  Mat2 second = Mat2::Zero();
  // Triangles with the origin, those of holes and of dents counting against the others.
  for (const auto& ring : rings_of(world, surface))
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 &a = ring[k], &b = ring[(k + 1) % ring.size()];
      const double twice = a.x() * b.y() - a.y() * b.x();
      area += twice / 2;
      v.middle += twice * (a + b) / 6;
      second +=
          twice * (a * a.transpose() + b * b.transpose() + (a + b) * (a + b).transpose()) / 24;
    }
  v.middle /= area;
  second = second / area - v.middle * v.middle.transpose();
  v.inverse = second.inverse();
  v.of_middle =
      surface.support.rms * surface.support.rms / static_cast<double>(surface.support.points);
  return v;
}

// A side of a surface, from a to b in its loop.
struct Side {
  std::size_t surface;
  int a, b;
};

class LandmarkFinder {
 public:
  LandmarkFinder(const World& world, const LandmarkOptions& options)
      : world_(world), options_(options), at_(world.vertices.size()), edges_at_(at_.size()) {
    for (std::size_t s = 0; s < world.surfaces.size(); ++s) {
      const Surface& surface = world.surfaces[s];
      variances_.push_back(variance_of(world, surface));
      add(s, surface.outer);
      for (const Loop& hole : surface.holes) add(s, hole);
    }
  }

  std::vector<Landmark> find() {
    for (std::size_t v = 0; v < at_.size(); ++v) add_corner(v);
    add_edges();
    for (std::size_t i = 0; i < found_.size(); ++i) found_[i].id = static_cast<int>(i);
    return std::move(found_);
  }

 private:
  const Vec3& point(int vertex) const { return world_.vertices[static_cast<std::size_t>(vertex)]; }
  const Vec3& normal(std::size_t s) const { return world_.surfaces[s].plane.normal; }

  void add(std::size_t surface, const Loop& loop) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const int a = loop[k], b = loop[(k + 1) % loop.size()];
      const std::pair<int, int> ends = std::minmax(a, b);
      sides_[ends].push_back({surface, a, b});
      at_[static_cast<std::size_t>(a)].insert(surface);
      for (int v : {a, b}) edges_at_[static_cast<std::size_t>(v)].insert(ends);
    }
  }

  // What is to the left of a side, in the surface.
  Vec3 inwards(const Side& side) const {
    return normal(side.surface).cross(point(side.b) - point(side.a)).normalized();
  }

  // Whether two surfaces are parallel but for less than the least angle.
  bool are_parallel(std::size_t a, std::size_t b) const {
    return normal(a).cross(normal(b)).norm() < std::sin(options_.min_angle);
  }

  // What the pairs of surfaces along an edge are to each other.
  void add_relief(const std::vector<Side>& sides, bool& concave, bool& convex) const {
    for (const Side& a : sides)
      for (const Side& b : sides)
        if (!are_parallel(a.surface, b.surface))
          (normal(a.surface).dot(inwards(b)) > 0 ? concave : convex) = true;
  }

  static Relief relief_of(bool concave, bool convex) {
    return concave == convex ? Relief::mixed : concave ? Relief::concave : Relief::convex;
  }

  std::vector<int> ids_of(const std::set<std::size_t>& surfaces) const {
    std::vector<int> ids;
    for (std::size_t s : surfaces) ids.push_back(world_.surfaces[s].id);
    std::sort(ids.begin(), ids.end());
    return ids;
  }

  // The largest volume that three of the normals span.
  double spanned(const std::set<std::size_t>& surfaces) const {
    double most = 0;
    for (std::size_t a : surfaces)
      for (std::size_t b : surfaces)
        for (std::size_t c : surfaces)
          if (a < b && b < c)
            most = std::max(most, std::abs(normal(a).cross(normal(b)).dot(normal(c))));
    return most;
  }

  std::set<std::size_t> measured(const std::set<std::size_t>& surfaces) const {
    std::set<std::size_t> result;
    for (std::size_t s : surfaces)
      if (world_.surfaces[s].support.points > 0) result.insert(s);
    return result;
  }

  void add_corner(std::size_t v) {
    const std::set<std::size_t>& surfaces = at_[v];
    const double least = std::sin(options_.min_angle);
    if (spanned(surfaces) < least) return;
    Landmark corner{.foot = world_.vertices[v], .top = world_.vertices[v]};
    corner.surfaces = ids_of(surfaces);
    bool concave = false, convex = false;
    for (const auto& ends : edges_at_[v]) add_relief(sides_.at(ends), concave, convex);
    corner.relief = relief_of(concave, convex);
    const std::set<std::size_t> known = measured(surfaces);
    if (spanned(known) >= least) {
      Mat3 information = Mat3::Zero();
      for (std::size_t s : known)
        information += normal(s) * normal(s).transpose() / variances_[s].at(corner.foot);
      corner.covariance = information.inverse();
    }
    found_.push_back(std::move(corner));
  }

  bool is_wall(std::size_t s) const {
    return std::abs(normal(s).dot(world_.frame.up)) < std::sin(options_.max_tilt);
  }

  // Pieces of upright edges between the same walls, from the lower vertex to the upper one.
  struct Piece {
    int low, high;
    bool concave, convex;
  };

  void add_edges() {
    std::map<std::set<std::size_t>, std::vector<Piece>> pieces;
    const Vec3& up = world_.frame.up;
    for (const auto& [ends, sides] : sides_) {
      const Vec3 way = point(ends.second) - point(ends.first);
      const double rise = up.dot(way);
      if (std::abs(rise) < way.norm() * std::cos(options_.max_tilt)) continue;
      std::set<std::size_t> walls;
      std::vector<Side> of_walls;
      for (const Side& side : sides)
        if (is_wall(side.surface)) walls.insert(side.surface), of_walls.push_back(side);
      bool meet = false, concave = false, convex = false;
      for (std::size_t a : walls)
        for (std::size_t b : walls) meet |= !are_parallel(a, b);
      if (!meet) continue;
      add_relief(of_walls, concave, convex);
      pieces[walls].push_back(rise > 0 ? Piece{ends.first, ends.second, concave, convex}
                                       : Piece{ends.second, ends.first, concave, convex});
    }
    for (auto& [walls, list] : pieces) join(walls, list);
  }

  // Joins the pieces that follow on each other.
  void join(const std::set<std::size_t>& walls, std::vector<Piece>& pieces) {
    const Vec3& up = world_.frame.up;
    std::stable_sort(pieces.begin(), pieces.end(), [&](const Piece& a, const Piece& b) {
      return up.dot(point(a.low)) < up.dot(point(b.low));
    });
    std::vector<Piece> joined;
    for (const Piece& p : pieces) {
      const auto below = std::find_if(joined.begin(), joined.end(),
                                      [&](const Piece& j) { return j.high == p.low; });
      if (below == joined.end())
        joined.push_back(p);
      else
        *below = {below->low, p.high, below->concave || p.concave, below->convex || p.convex};
    }
    for (const Piece& p : joined)
      if (up.dot(point(p.high) - point(p.low)) >= options_.min_height) add_edge(walls, p);
  }

  void add_edge(const std::set<std::size_t>& walls, const Piece& piece) {
    Landmark edge{.kind = LandmarkKind::edge,
                  .relief = relief_of(piece.concave, piece.convex),
                  .foot = point(piece.low),
                  .top = point(piece.high),
                  .surfaces = ids_of(walls)};
    const Vec3 middle = (edge.foot + edge.top) / 2;
    const PlaneFrame level = frame_of({world_.frame.up, 0});
    Mat2 information = Mat2::Zero();
    std::set<std::size_t> known = measured(walls);
    for (std::size_t s : known) {
      const Vec2 n = Vec2(level.u.dot(normal(s)), level.v.dot(normal(s))).normalized();
      information += n * n.transpose() / variances_[s].at(middle);
    }
    bool meet = false;
    for (std::size_t a : known)
      for (std::size_t b : known) meet |= !are_parallel(a, b);
    if (meet) {
      Eigen::Matrix<double, 3, 2> axes;
      axes << level.u, level.v;
      edge.covariance = axes * information.inverse() * axes.transpose();
    }
    found_.push_back(std::move(edge));
  }

  const World& world_;
  const LandmarkOptions& options_;
  std::vector<PlaneVariance> variances_;                    // of the surfaces
  std::vector<std::set<std::size_t>> at_;                   // the surfaces of each vertex
  std::vector<std::set<std::pair<int, int>>> edges_at_;     // and its edges
  std::map<std::pair<int, int>, std::vector<Side>> sides_;  // of each edge
  std::vector<Landmark> found_;
};

}  // namespace

std::vector<Landmark> find_landmarks(const World& world, const LandmarkOptions& options) {
  return LandmarkFinder(world, options).find();
}

const Landmark* nearest_landmark(const std::vector<Landmark>& landmarks, const Vec3& point,
                                 double max_distance) {
  const Landmark* nearest = nullptr;
  for (const Landmark& l : landmarks) {
    const Vec3 way = l.top - l.foot;
    const double length2 = way.squaredNorm();
    const double t = length2 > 0 ? std::clamp(way.dot(point - l.foot) / length2, 0.0, 1.0) : 0;
    const double distance = (l.foot + t * way - point).norm();
    if (nearest ? distance < max_distance : distance <= max_distance)
      nearest = &l, max_distance = distance;
  }
  return nearest;
}

const char* name_of(LandmarkKind kind) { return kind == LandmarkKind::corner ? "corner" : "edge"; }

const char* name_of(Relief relief) {
  static constexpr const char* names[] = {"concave", "convex", "mixed"};
  return names[static_cast<int>(relief)];
}

}  // namespace scanworld
