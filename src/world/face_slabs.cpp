// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "face_slabs.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../parallel.h"
#include "../polygon.h"
#include "convex_parts.h"

namespace scanworld {

namespace {

constexpr double kSquare = 0.985;     // cosine: two faces at a right angle, within 10 degrees
constexpr double kClosed = 0.7;       // of a face's outline that must have neighbours
constexpr double kMinBeside = 0.02;   // [m] lower sides tell nothing
constexpr double kSameFace = 0.9999;  // cosine between a face and the slab's that covers it
// Of boxes and prisms instead of a prism. Robots at 60 Hz sink into prisms, not into boxes, and
// they drive into walls.
constexpr std::size_t kMostForPrism = 4, kMostForWall = 32;
constexpr double kRecess = 0.002;  // [m] it may be so far inside

// How far the neighbour at a convex corner goes on backwards [m].
double extent_behind(const Face& face, const Face& neighbour) {
  double deepest = 0;
  for (const Vec2& p : neighbour.rings[0])
    deepest = std::max(deepest, -face.surface->plane.signed_distance(neighbour.frame.to_space(p)));
  return deepest;
}

double depth_of(const std::vector<Face>& faces, const std::vector<std::vector<FaceEdge>>& edges,
                std::size_t i, const SlabOptions& options) {
  const Face& face = faces[i];
  if (face.surface->thickness) return *face.surface->thickness;
  double beside = std::numeric_limits<double>::max(), closed = 0, length = 0;
  for (const auto& ring : edges)
    for (const FaceEdge& edge : ring) {
      length += (edge.b - edge.a).norm();
      bool meets = edge.before.has_value();
      if (edge.beside) {
        const double extent = extent_behind(face, faces[*edge.beside]);
        const Vec2 out = edge.out();
        const bool square = faces[*edge.beside].normal().dot(face.frame.u * out.x() +
                                                             face.frame.v * out.y()) > kSquare;
        if (square && extent > kMinBeside) beside = std::min(beside, extent), meets = true;
      }
      if (meets) closed += (edge.b - edge.a).norm();
    }
  const bool is_known =
      beside <= options.max_beside || (beside <= options.max_depth && closed > kClosed * length);
  if (face.surface->kind == Kind::other) return is_known ? beside : options.other_depth;
  return is_known ? std::max(beside, options.depth) : options.depth;
}

// How far a slab may go beyond an edge [m].
double growth_of(const FaceEdge& edge, const FaceDepths& depths, const SlabOptions& options) {
  if (edge.before) return std::min(depths.depth[*edge.before], options.depth);
  return edge.flat ? options.overlap : 0;
}

// One face, while its slabs are made.
class Cover {
 public:
  Cover(const std::vector<Face>& faces, const FaceDepths& depths, std::size_t i,
        const SlabOptions& options)
      : face_(faces[i]), index_(i), edges_(depths.edges[i]), options_(options) {
    for (const auto& ring : edges_) {
      growth_.emplace_back();
      for (const FaceEdge& edge : ring) growth_.back().push_back(growth_of(edge, depths, options));
    }
    depth_ = depths.depth[i];
  }

  std::vector<Slab> run(const Slabs& made) {
    find_done(made);
    std::vector<Slab> boxes = make_boxes();
    std::vector<geos::Rings> covered = done_;
    for (const Slab& box : boxes) covered.push_back(rings_of(box.bounds));
    std::vector<Slab> rest = make_prisms(covered);
    if (rest.empty()) return boxes;
    std::vector<Slab> prisms = make_prisms(done_);
    const std::size_t most = face_.surface->kind == Kind::wall ? kMostForWall : kMostForPrism;
    if (most * prisms.size() < boxes.size() + rest.size()) return prisms;
    boxes.insert(boxes.end(), rest.begin(), rest.end());
    return boxes;
  }

 private:
  // The sides of slabs that lie in this face and look its way.
  void find_done(const Slabs& made) {
    const Plane& plane = face_.surface->plane;
    for (std::size_t k = 0; k < made.slabs.size(); ++k) {
      if (!grown(face_.box, kRecess).intersects(made.boxes[k])) continue;
      for (const auto& side : made.slabs[k].outline()) {
        const Vec3 normal = (side[1] - side[0]).cross(side[2] - side[0]).normalized();
        if (normal.dot(plane.normal) < kSameFace) continue;
        const bool lies_in = std::all_of(side.begin(), side.end(), [&](const Vec3& p) {
          const double d = plane.signed_distance(p);
          return d <= options_.tolerance * 1.01 && d >= -kRecess;
        });
        if (!lies_in) continue;
        std::vector<Vec2> ring;
        for (const Vec3& p : side) ring.push_back(face_.frame.to_plane(p));
        done_.push_back({ring});
      }
    }
  }

  // The face, and where its slabs may go beyond it.
  std::vector<geos::Rings> allowed() const {
    std::vector<geos::Rings> parts = {face_.rings};
    for (std::size_t r = 0; r < edges_.size(); ++r)
      for (std::size_t e = 0; e < edges_[r].size(); ++e) {
        const double grow = growth_[r][e];
        if (grow <= 0) continue;
        const std::size_t n = edges_[r].size();
        const FaceEdge& edge = edges_[r][e];
        const Vec2 along = edge.along(), out = edge.out();
        const Vec2 a = edge.a - along * growth_[r][(e + n - 1) % n],
                   b = edge.b + along * growth_[r][(e + 1) % n];
        parts.push_back({{a, a + grow * out, b + grow * out, b}});
      }
    return parts.size() > 1 ? geos::unite(parts) : parts;
  }

  std::vector<Slab> make_boxes() const {
    std::vector<Slab> boxes;
    for (const Rectangle& r : cover_with_rectangles(
             face_.rings, allowed(), done_,
             {.tolerance = options_.tolerance, .min_width = options_.min_width})) {
      Slab slab = slab_of(index_, face_.frame, r, depth_);
      // What is beyond the face is there for its neighbours' sake alone.
      Rectangle within;
      for (const auto& ring : face_.rings) {
        std::vector<Vec2> part = ring;
        for (const Slab::Side& side : slab.sides) part = clipped(part, side.normal, side.offset);
        for (const Vec2& p : part) within.extend(p);
      }
      for (Slab::Side& side : slab.sides) {
        const Vec2 extreme = side.normal.sum() > 0 ? within.max() : within.min();
        side.slack = std::max(0.0, side.offset - side.normal.dot(extreme)) + options_.min_width;
      }
      boxes.push_back(std::move(slab));
    }
    return boxes;
  }

  // How far a side of a part may go beyond: where it is no edge of the face but a cut through it,
  // enough to overlap; nothing where it is an edge in part.
  Slab::Side side_of(const Vec2& a, const Vec2& b) const {
    const Vec2 along = (b - a).normalized(), out(along.y(), -along.x());
    const double length = (b - a).norm();
    double grow = 1e3, shared = 0;
    for (std::size_t r = 0; r < edges_.size(); ++r)
      for (std::size_t e = 0; e < edges_[r].size(); ++e) {
        const FaceEdge& edge = edges_[r][e];
        if (std::abs(out.dot(edge.a - a)) > options_.tolerance ||
            std::abs(out.dot(edge.b - a)) > options_.tolerance)
          continue;
        const double common =
            std::min(length, along.dot(edge.b - a)) - std::max(0.0, along.dot(edge.a - a));
        if (common <= options_.tolerance) continue;
        shared += common;
        grow = std::min(grow, growth_[r][e]);
      }
    Slab::Side side{out, out.dot(a), 0};
    if (shared > 0.9 * length) {
      side.offset += grow;
      side.slack = grow + options_.min_width;
    } else if (shared < 0.1 * length) {
      side.offset += options_.tolerance / 2;
    }
    return side;
  }

  // Convex prisms for what is not covered.
  std::vector<Slab> make_prisms(const std::vector<geos::Rings>& covered) const {
    std::vector<Slab> prisms;
    for (const geos::Rings& left : covered.empty()
                                       ? std::vector<geos::Rings>{face_.rings}
                                       : geos::subtract(face_.rings, covered, options_.min_width))
      for (const auto& part : convex_parts(left, options_.tolerance)) {
        Slab slab{.surface = index_, .frame = face_.frame, .depth = depth_};
        double most = 0;
        for (std::size_t k = 0; k < part.size(); ++k) {
          slab.bounds.extend(part[k]);
          slab.sides.push_back(side_of(part[k], part[(k + 1) % part.size()]));
          most = std::max(most, slab.sides.back().slack + options_.tolerance);
        }
        slab.bounds.min().array() -= most, slab.bounds.max().array() += most;
        prisms.push_back(std::move(slab));
      }
    return prisms;
  }

  const Face& face_;
  const std::size_t index_;
  const std::vector<std::vector<FaceEdge>>& edges_;
  const SlabOptions& options_;
  std::vector<std::vector<double>> growth_;  // of each edge
  std::vector<geos::Rings> done_;            // what needs no slab
  double depth_;
};

}  // namespace

FaceDepths find_depths(const std::vector<Face>& faces, const SlabOptions& options) {
  FaceDepths depths{std::vector<std::vector<std::vector<FaceEdge>>>(faces.size()),
                    std::vector<double>(faces.size())};
  parallel_for(faces.size(), [&](std::size_t i) {
    if (faces[i].area <= 0) return;
    depths.edges[i] = edges_of(faces, i, options.gap);
    depths.depth[i] = depth_of(faces, depths.edges[i], i, options);
  });
  return depths;
}

std::vector<Slab> slabs_of(const std::vector<Face>& faces, const FaceDepths& depths, std::size_t i,
                           const Slabs& made, const Clearance& clearance,
                           const SlabOptions& options) {
  std::vector<Slab> slabs;
  for (Slab& slab : Cover(faces, depths, i, options).run(made)) {
    clearance.fit(slab);
    if (!slab.corners().empty()) slabs.push_back(std::move(slab));
  }
  return slabs;
}

}  // namespace scanworld
