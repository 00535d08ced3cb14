// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "geos.h"

#include <fmt/format.h>
#include <geos_c.h>

#include <algorithm>
#include <map>
#include <memory>

#include "../polygon.h"

namespace scanworld::geos {

namespace {

// One context a call: GEOS keeps its state there, so that calls from several threads do not meet.
struct Context {
  GEOSContextHandle_t handle = GEOS_init_r();
  ~Context() { GEOS_finish_r(handle); }
};

struct Free {
  GEOSContextHandle_t handle;
  void operator()(GEOSGeometry* g) const { GEOSGeom_destroy_r(handle, g); }
};
using Geometry = std::unique_ptr<GEOSGeometry, Free>;

GEOSGeometry* ring_of(GEOSContextHandle_t handle, const std::vector<Vec2>& ring) {
  std::vector<double> xy;
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    xy.push_back(ring[i % ring.size()].x());
    xy.push_back(ring[i % ring.size()].y());
  }
  return GEOSGeom_createLinearRing_r(
      handle, GEOSCoordSeq_copyFromBuffer_r(handle, xy.data(),
                                            static_cast<unsigned>(ring.size() + 1), 0, 0));
}

Geometry polygon_of(const Context& context, const Rings& rings) {
  std::vector<GEOSGeometry*> holes;
  for (std::size_t i = 1; i < rings.size(); ++i) holes.push_back(ring_of(context.handle, rings[i]));
  return {GEOSGeom_createPolygon_r(context.handle, ring_of(context.handle, rings[0]), holes.data(),
                                   static_cast<unsigned>(holes.size())),
          Free{context.handle}};
}

std::vector<Vec2> corners(const Context& context, const GEOSGeometry* geometry) {
  const GEOSCoordSequence* sequence = GEOSGeom_getCoordSeq_r(context.handle, geometry);
  unsigned size = 0;
  GEOSCoordSeq_getSize_r(context.handle, sequence, &size);
  std::vector<double> xy(2 * static_cast<std::size_t>(size));
  GEOSCoordSeq_copyToBuffer_r(context.handle, sequence, xy.data(), 0, 0);
  std::vector<Vec2> points;
  for (std::size_t i = 0; i < size; ++i) points.emplace_back(xy[2 * i], xy[2 * i + 1]);
  return points;
}

std::vector<Vec2> ring_of(const Context& context, const GEOSGeometry* geometry, bool ccw) {
  std::vector<Vec2> ring = corners(context, geometry);
  ring.pop_back();
  if ((doubled_area(ring) > 0) != ccw) std::reverse(ring.begin(), ring.end());
  return ring;
}

// The polygons among the parts of a geometry.
void collect(const Context& context, const GEOSGeometry* geometry, std::vector<Rings>& polygons) {
  if (!geometry || GEOSisEmpty_r(context.handle, geometry) == 1) return;
  const int type = GEOSGeomTypeId_r(context.handle, geometry);
  if (type == GEOS_POLYGON) {
    Rings rings = {ring_of(context, GEOSGetExteriorRing_r(context.handle, geometry), true)};
    const int holes = GEOSGetNumInteriorRings_r(context.handle, geometry);
    for (int i = 0; i < holes; ++i)
      rings.push_back(ring_of(context, GEOSGetInteriorRingN_r(context.handle, geometry, i), false));
    polygons.push_back(std::move(rings));
  } else if (type >= GEOS_MULTIPOINT) {
    for (int i = 0; i < GEOSGetNumGeometries_r(context.handle, geometry); ++i)
      collect(context, GEOSGetGeometryN_r(context.handle, geometry, i), polygons);
  }
}

Geometry union_of(const Context& context, const std::vector<Rings>& polygons) {
  std::vector<GEOSGeometry*> parts;
  for (const Rings& rings : polygons) parts.push_back(polygon_of(context, rings).release());
  const Geometry all(GEOSGeom_createCollection_r(context.handle, GEOS_GEOMETRYCOLLECTION,
                                                 parts.data(), static_cast<unsigned>(parts.size())),
                     Free{context.handle});
  return {GEOSUnaryUnion_r(context.handle, all.get()), Free{context.handle}};
}

// What is in some polygons and not in others; null where the library fails.
Geometry difference(const Context& context, const std::vector<Rings>& polygons,
                    const std::vector<Rings>& others) {
  const Geometry whole = union_of(context, polygons), without = union_of(context, others);
  return {whole && without ? GEOSDifference_r(context.handle, whole.get(), without.get()) : nullptr,
          Free{context.handle}};
}

// Moves the outline outwards by a distance [m], inwards where it is negative, with sharp corners.
Geometry offset(const Context& context, const Geometry& geometry, double distance) {
  return {GEOSBufferWithStyle_r(context.handle, geometry.get(), distance, 1, GEOSBUF_CAP_FLAT,
                                GEOSBUF_JOIN_MITRE, 10),
          Free{context.handle}};
}

using Triangles = std::vector<std::array<Vec2, 3>>;

// Those among the parts of a geometry.
Triangles triangles_of(const Context& context, const GEOSGeometry* geometry) {
  Triangles triangles;
  const int count = GEOSGetNumGeometries_r(context.handle, geometry);
  for (int i = 0; i < count; ++i) {
    const GEOSGeometry* triangle = GEOSGetGeometryN_r(context.handle, geometry, i);
    const std::vector<Vec2> p = corners(context, GEOSGetExteriorRing_r(context.handle, triangle));
    triangles.push_back({p[0], p[1], p[2]});
  }
  return triangles;
}

void turn_left(Triangles& triangles) {
  for (auto& t : triangles) {
    const Vec2 ab = t[1] - t[0], ac = t[2] - t[0];
    if (ab.x() * ac.y() - ab.y() * ac.x() <= 0) std::swap(t[1], t[2]);
  }
}

std::optional<Triangles> try_to_triangulate(const Rings& rings) {
  const Context context;
  const Geometry polygon = polygon_of(context, rings);
  if (!polygon) return std::nullopt;
  const Geometry result(GEOSConstrainedDelaunayTriangulation_r(context.handle, polygon.get()),
                        Free{context.handle});
  if (!result) return std::nullopt;
  return triangles_of(context, result.get());
}

}  // namespace

std::optional<Flaw> find_flaw(const Rings& rings) {
  const Context context;
  const Geometry polygon = polygon_of(context, rings);
  if (!polygon) return Flaw{"it is no ring", std::nullopt};
  char* reason = nullptr;
  GEOSGeometry* location = nullptr;
  const char valid = GEOSisValidDetail_r(context.handle, polygon.get(), 0, &reason, &location);
  const Geometry at(location, Free{context.handle});
  Flaw flaw{reason ? reason : "unknown reason", std::nullopt};
  if (reason) GEOSFree_r(context.handle, reason);
  if (valid == 1) return std::nullopt;
  if (at) flaw.at = corners(context, at.get())[0];
  return flaw;
}

std::optional<std::string> why_invalid(const Rings& rings) {
  const auto flaw = find_flaw(rings);
  if (!flaw) return std::nullopt;
  if (!flaw->at) return flaw->reason;
  return fmt::format("{} at ({:.3f}, {:.3f}) of its plane", flaw->reason, flaw->at->x(),
                     flaw->at->y());
}

std::vector<Rings> make_valid(const Rings& rings) {
  const Context context;
  // Each ring for itself: together, what of a hole lies outside would be filled.
  std::vector<Rings> outer, holes, result;
  for (std::size_t r = 0; r < rings.size(); ++r)
    if (const Geometry polygon = polygon_of(context, {rings[r]})) {
      const Geometry valid(GEOSMakeValid_r(context.handle, polygon.get()), Free{context.handle});
      collect(context, valid.get(), r == 0 ? outer : holes);
    }
  collect(context, difference(context, outer, holes).get(), result);
  // So thin ones come of rounding.
  std::erase_if(result, [](const Rings& part) { return doubled_area(part[0]) <= 0; });
  return result;
}

std::optional<Triangles> triangulate(const Rings& rings) {
  std::optional<Triangles> triangles = try_to_triangulate(rings);
  // The library joins holes to the outline along an axis, and fails on some polygons with many
  // of them: turned, they go.
  for (double angle = 0.5; !triangles && angle < 3; angle += 0.7) {
    const Eigen::Rotation2Dd turn(angle);
    std::map<std::pair<double, double>, Vec2> original;
    Rings turned = rings;
    for (auto& ring : turned)
      for (Vec2& p : ring) {
        const Vec2 q = turn * p;
        original.try_emplace({q.x(), q.y()}, p);
        p = q;
      }
    triangles = try_to_triangulate(turned);
    if (!triangles) continue;
    for (auto& triangle : *triangles)
      for (Vec2& p : triangle) p = original.at({p.x(), p.y()});
  }
  if (!triangles) return std::nullopt;
  turn_left(*triangles);
  return triangles;
}

Overlap overlap_of(const Rings& a, const Rings& b) {
  const Context context;
  const Geometry p = polygon_of(context, a), q = polygon_of(context, b);
  const Geometry common(GEOSIntersection_r(context.handle, p.get(), q.get()), Free{context.handle});
  Overlap overlap;
  if (!common || GEOSArea_r(context.handle, common.get(), &overlap.area) != 1 || overlap.area <= 0)
    return {};
  const Geometry point(GEOSPointOnSurface_r(context.handle, common.get()), Free{context.handle});
  if (!point) return {};
  overlap.inside = corners(context, point.get())[0];
  return overlap;
}

std::vector<Rings> unite(const std::vector<Rings>& polygons) {
  const Context context;
  std::vector<Rings> result;
  collect(context, union_of(context, polygons).get(), result);
  return result;
}

std::vector<Rings> subtract(const Rings& polygon, const std::vector<Rings>& others,
                            double min_width) {
  const Context context;
  const Geometry left = difference(context, {polygon}, others);
  std::vector<Rings> result;
  if (!left) return result;
  if (min_width == 0) {
    collect(context, left.get(), result);
    return result;
  }
  const Geometry core = offset(context, left, -min_width / 2);
  if (core) collect(context, offset(context, core, min_width / 2).get(), result);
  return result;
}

std::vector<std::vector<Rings>> intersect(const std::vector<Rings>& polygons,
                                          const std::vector<Rings>& others) {
  const Context context;
  std::vector<Geometry> all;
  for (const Rings& rings : others)
    if (Geometry other = polygon_of(context, rings)) all.push_back(std::move(other));
  std::vector<std::vector<Rings>> parts;
  for (const Rings& rings : polygons) {
    parts.emplace_back();
    const Geometry own = polygon_of(context, rings);
    if (!own) continue;
    for (const Geometry& other : all) {
      const Geometry common(GEOSIntersection_r(context.handle, own.get(), other.get()),
                            Free{context.handle});
      collect(context, common.get(), parts.back());
    }
  }
  return parts;
}

Triangles delaunay(const std::vector<Vec2>& places) {
  const Context context;
  std::vector<double> xy;
  for (const Vec2& p : places) xy.insert(xy.end(), {p.x(), p.y()});
  GEOSCoordSequence* sequence = GEOSCoordSeq_copyFromBuffer_r(
      context.handle, xy.data(), static_cast<unsigned>(places.size()), 0, 0);
  const Geometry line(GEOSGeom_createLineString_r(context.handle, sequence), Free{context.handle});
  if (!line) return {};
  const Geometry result(GEOSDelaunayTriangulation_r(context.handle, line.get(), 0, 0),
                        Free{context.handle});
  if (!result) return {};
  Triangles triangles = triangles_of(context, result.get());
  turn_left(triangles);
  return triangles;
}

}  // namespace scanworld::geos
