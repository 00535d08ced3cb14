// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "faces.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "surface_rings.h"

namespace scanworld {

namespace {

constexpr double kSameDirection = 0.01;  // [rad] edges that are parallel or square to each other
constexpr double kMinCornerSine = 0.17;  // of the angle at a corner (10 degrees)
constexpr double kFlat = 0.9986;         // cosine between faces that go on flat (3 degrees)
constexpr double kFoot = 0.94;     // cosine between down and out of an edge below (20 degrees)
constexpr double kRight = 0.75;    // of the outline of a polygon whose corners are mostly right
constexpr double kFootWeight = 3;  // of an edge below, as robots come there

// The angle of an edge, modulo a quarter turn [rad].
double quarter_angle(const Vec2& way) {
  const double angle = std::fmod(std::atan2(way.y(), way.x()), M_PI / 2);
  return angle < 0 ? angle + M_PI / 2 : angle;
}

struct Way {
  double angle, length;
  bool is_foot;  // of an edge below
};

// The direction that most edges have or are square to, and the length of these: the mean of those
// around the best of them.
std::pair<double, double> most_common(const std::vector<Way>& ways, double foot_weight) {
  const auto weight = [&](const Way& way) { return (way.is_foot ? foot_weight : 1) * way.length; };
  double best = 0, most = 0;
  for (const Way& candidate : ways) {
    double length = 0, turn = 0;
    for (const Way& way : ways) {
      const double off = std::remainder(way.angle - candidate.angle, M_PI / 2);
      if (std::abs(off) < kSameDirection) length += weight(way), turn += weight(way) * off;
    }
    if (length > most) most = length, best = candidate.angle + turn / length;
  }
  return {best, most};
}

// The direction of most edges of a polygon; where that are few, those below count for more. `down`
// is zero where there is none in the plane.
double main_angle(const geos::Rings& rings, const Vec2& down) {
  std::vector<Way> ways;
  double around = 0;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vec2 way = ring[(i + 1) % ring.size()] - ring[i], out(way.y(), -way.x());
      ways.push_back({quarter_angle(way), way.norm(), out.dot(down) > kFoot * way.norm()});
      around += way.norm();
    }
  const auto [angle, length] = most_common(ways, 1);
  return length >= kRight * around ? angle : most_common(ways, kFootWeight).first;
}

std::vector<Vec2> turned(const std::vector<Vec2>& ring, double angle) {
  const Eigen::Rotation2Dd back(-angle);
  std::vector<Vec2> result;
  for (const Vec2& p : ring) result.push_back(back * p);
  return result;
}

// Where the three places along an edge that tell a contact are: all of it must be one.
constexpr double kPlaces[] = {0.1, 0.5, 0.9};

}  // namespace

bool Face::is_near(const Vec3& p, double distance) const {
  if (std::abs(surface->plane.signed_distance(p)) > distance) return false;
  const Vec2 q = frame.to_plane(p);
  return is_inside(rings, q) || std::any_of(rings.begin(), rings.end(), [&](const auto& ring) {
           return distance_to_ring(q, ring) <= distance;
         });
}

std::vector<Face> faces_of(const World& world) {
  std::vector<Face> faces(world.surfaces.size());
  parallel_for(faces.size(), [&](std::size_t i) {
    const Surface& s = world.surfaces[i];
    Face& face = faces[i];
    face.surface = &s;
    face.rings = rings_of(world, s);
    face.frame = rings_frame(world, s);
    for (int v : s.outer) face.box.extend(world.vertices[static_cast<std::size_t>(v)]);
    if (!geos::why_invalid(face.rings)) face.area = area(world, s);
    const Vec3& up = world.frame.up;
    const double angle = main_angle(
        face.rings, -Vec2(up.dot(face.frame.u), up.dot(face.frame.v)).stableNormalized());
    for (auto& ring : face.rings) ring = turned(ring, angle);
    const Vec3 u = std::cos(angle) * face.frame.u + std::sin(angle) * face.frame.v;
    face.frame = {face.frame.origin, u, s.plane.normal.cross(u)};
  });
  return faces;
}

geos::Rings seen_in(const PlaneFrame& frame, const Face& face) {
  geos::Rings rings;
  for (const auto& ring : face.rings) {
    rings.emplace_back();
    for (const Vec2& p : ring) rings.back().push_back(frame.to_plane(face.frame.to_space(p)));
  }
  return rings;
}

std::vector<std::vector<FaceEdge>> edges_of(const std::vector<Face>& faces, std::size_t i,
                                            double gap) {
  const Face& face = faces[i];
  std::vector<std::size_t> near;
  for (std::size_t k = 0; k < faces.size(); ++k)
    if (k != i && faces[k].area > 0 && grown(face.box, gap).intersects(faces[k].box))
      near.push_back(k);
  std::vector<std::vector<FaceEdge>> edges;
  for (const auto& ring : face.rings) {
    edges.emplace_back();
    for (std::size_t e = 0; e < ring.size(); ++e) {
      FaceEdge edge{ring[e], ring[(e + 1) % ring.size()]};
      const Vec2 out = edge.out();
      const Vec3 inwards = -(face.frame.u * out.x() + face.frame.v * out.y());
      double steepest = kMinCornerSine, squarest = kMinCornerSine;
      for (std::size_t k : near) {
        const Face& other = faces[k];
        if (!std::all_of(std::begin(kPlaces), std::end(kPlaces), [&](double t) {
              return other.is_near(face.frame.to_space(edge.a + t * (edge.b - edge.a)), gap);
            }))
          continue;
        const double sine = other.normal().dot(inwards);
        if (sine > steepest) steepest = sine, edge.before = k;
        if (-sine > squarest) squarest = -sine, edge.beside = k;
        edge.flat = edge.flat || other.normal().dot(face.normal()) > kFlat;
      }
      edges.back().push_back(edge);
    }
  }
  return edges;
}

}  // namespace scanworld
