// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The World: what a scan becomes, and all that exporters, checks and simulators see. docs/world.md
// describes the file that holds it, world.json.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "../curve.h"
#include "../options.h"
#include "../types.h"

namespace scanworld {

// A ring of vertices, by index into World::vertices; the last is joined to the first.
using Loop = std::vector<int>;

enum class Kind { floor, ceiling, wall, other };

// A planar polygon. Its plane's normal points to the free side, from where `outer` is
// counter-clockwise and the holes are clockwise.
struct Surface {
  int id = 0;  // stable between runs; not an index
  Kind kind = Kind::other;
  Source source = Source::measured;
  Plane plane;
  Loop outer;
  std::vector<Loop> holes;
  std::optional<double> thickness;  // [m] of what is behind it, where that is known
  Support support;
  std::optional<Color> color;
  std::optional<int> curve;                 // id of what it is a facet of
  std::vector<InferredPart> inferred = {};  // where a measured one was not
  bool ground = false;                      // a floor that is part of ground that no plane fits
  bool operator==(const Surface&) const = default;
};

enum class OpeningKind { door, window, passage };

enum class LeafHinge { left, right };
enum class LeafSide { front, back };

// A door's leaf that stands open, a surface of its own.
struct Leaf {
  int surface = 0;   // id
  double angle = 0;  // [rad] from closed
  // The side that it hangs on, for who stands before the opening's surface and looks at it.
  LeafHinge hinge = LeafHinge::left;
  LeafSide opens_to = LeafSide::front;  // where that surface looks, or the other side
  bool operator==(const Leaf&) const = default;
};

// Where one can see or go through a surface. Its loop lies in the surface's plane: around one of
// its holes, or along a notch in its outer loop.
struct Opening {
  int id = 0;
  OpeningKind kind = OpeningKind::passage;
  int surface = 0;  // id
  Loop loop;
  double width = 0, height = 0;  // [m] clear
  std::string evidence;          // how it is known, in words
  bool glass = false;            // a window with a pane in it
  std::optional<Leaf> leaf = {};
  bool operator==(const Opening&) const = default;
};

struct OrientedBox {
  Vec3 center = Vec3::Zero();
  Vec3 size = Vec3::Zero();  // [m] full edge lengths
  Eigen::Quaterniond rotation =
      Eigen::Quaterniond::Identity();  // from the box's axes to the world's
  bool operator==(const OrientedBox& o) const {
    return center == o.center && size == o.size && rotation.coeffs() == o.rotation.coeffs();
  }
};

struct ConvexHull {
  std::vector<Vec3> vertices;  // the hull is that of these points
  bool operator==(const ConvexHull&) const = default;
};

// Upright: its axis is World::frame.up.
struct Cylinder {
  Vec3 center = Vec3::Zero();
  double radius = 0, height = 0;  // [m]
  bool operator==(const Cylinder&) const = default;
};

// A convex polygon moved along a vector.
struct ConvexPrism {
  std::vector<Vec3> base;
  Vec3 extrusion = Vec3::Zero();
  bool operator==(const ConvexPrism&) const = default;
};

// Clutter that no surface explains.
struct Obstacle {
  int id = 0;
  std::variant<OrientedBox, ConvexHull, Cylinder> shape;
  std::optional<int> curve = {};  // id of what it is, where it is a column or a pipe
  bool operator==(const Obstacle&) const = default;
};

// A solid for a physics engine, derived from a surface.
struct Collider {
  int surface = 0;  // id
  std::variant<OrientedBox, ConvexPrism> shape;
  bool operator==(const Collider&) const = default;
};

// What is round: surfaces are its facets, or an obstacle is it.
struct CurvedPart {
  int id = 0;
  Curve curve;
  bool operator==(const CurvedPart&) const = default;
};

struct Room {
  int id = 0;
  std::string name;
  std::vector<int> surfaces;   // ids of those that bound it
  std::optional<double> area;  // [m2] of its floor
  std::optional<Vec3> center;  // a place on its floor, as near to the middle of it as can be
  // [m] from the floor to the ceiling, over half of it, and [m3] between them; nothing where less
  // than half of it has a ceiling.
  std::optional<double> height = {}, volume = {};
  bool operator==(const Room&) const = default;
};

// A way between two rooms.
struct Door {
  int opening = 0;             // id
  std::array<int, 2> rooms{};  // ids
  bool operator==(const Door&) const = default;
};

enum class WayKind { stairs, ramp };

// A flight of stairs or a ramp, along the middle of its width.
struct Way {
  int id = 0;
  WayKind kind = WayKind::stairs;
  Vec3 foot = Vec3::Zero();  // on the floor it begins on, where the first riser stands
  Vec3 top = Vec3::Zero();   // on the floor it ends on, at that one's edge
  double width = 0;          // [m]
  int steps = 0;             // risers; a ramp has none, and no riser and tread
  double riser = 0;          // [m] from one tread to the next
  double tread = 0;          // [m] the same in plan
  double slope = 0;          // [rad] of a ramp
  // The floors or landings, and the rooms, that it begins and ends on; nothing where not known.
  std::array<std::optional<int>, 2> floors{}, rooms{};  // ids
  bool operator==(const Way&) const = default;
};

// How the world lies in the coordinates of the scan file: those are rotation * p + origin for a
// point p of the world.
struct Frame {
  Vec3 origin = Vec3::Zero();  // [m] in the scan's axes
  Eigen::Quaterniond rotation =
      Eigen::Quaterniond::Identity();  // from the world's axes to the scan's
  Vec3 up = Vec3::UnitZ();             // against gravity, in the world's axes
  std::vector<std::string> assumed;    // what was assumed or done about the frame, in words

  Vec3 to_scan(const Vec3& p) const { return rotation * p + origin; }
  Vec3 to_world(const Vec3& p) const { return rotation.conjugate() * (p - origin); }
  bool operator==(const Frame& o) const {
    return origin == o.origin && rotation.coeffs() == o.rotation.coeffs() && up == o.up &&
           assumed == o.assumed;
  }
};

// Where a world comes from.
struct Provenance {
  struct Input {
    std::string file;  // name without folder
    std::size_t points = 0;
    std::string fingerprint;  // of the set of points: the same in any order
    bool operator==(const Input&) const = default;
  };
  std::string program;  // and version
  std::vector<Input> inputs;
  std::map<std::string, OptionValue> options;  // as they were used
  bool operator==(const Provenance&) const = default;
};

struct World {
  Frame frame;
  std::vector<Vec3> vertices;
  std::vector<Surface> surfaces;
  std::vector<Opening> openings;
  std::vector<Obstacle> obstacles;
  std::vector<Collider> colliders;
  std::vector<CurvedPart> curves;
  std::vector<Room> rooms;
  std::vector<Door> doors;
  std::vector<Way> ways;
  Provenance provenance;
  bool operator==(const World&) const = default;
};

const char* name_of(Kind kind);
const char* name_of(Source source);
const char* name_of(OpeningKind kind);
const char* name_of(WayKind kind);
const char* name_of(LeafHinge hinge);
const char* name_of(LeafSide side);
const char* name_of(CurveType type);

// Of any triangulation without further vertices.
std::size_t triangle_count(const World& world);

inline std::size_t count_of(const World& world) { return world.surfaces.size(); }

// The surface with an id; null where there is none.
const Surface* find_surface(const World& world, int id);

// An id that no surface has, nor any with a larger one.
int next_id(const World& world);

// The area of a surface [m2], and the middle of it.
double area(const World& world, const Surface& surface);
Vec3 centroid(const World& world, const Surface& surface);

// The box around all vertices and obstacles; empty for an empty world.
Box3 bounds(const World& world);

}  // namespace scanworld
