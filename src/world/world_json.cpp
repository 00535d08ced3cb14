// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "../files.h"

namespace scanworld {

namespace {

using Json = nlohmann::ordered_json;

Json to_json(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json to_json(const std::vector<Vec3>& points) {
  Json list = Json::array();
  for (const Vec3& p : points) list.push_back(to_json(p));
  return list;
}

Json to_json(const Eigen::Quaterniond& rotation) {
  const Eigen::Vector4d q = rotation.coeffs();
  return {q[0], q[1], q[2], q[3]};
}

Json to_json(const Frame& f) {
  Json j = {{"origin", to_json(f.origin)}};
  const bool is_turned = f.rotation.coeffs() != Eigen::Quaterniond::Identity().coeffs();
  if (is_turned) j["rotation"] = to_json(f.rotation);
  j.update({{"up", to_json(f.up)}, {"unit", "m"}, {"assumed", f.assumed}});
  return j;
}

Json to_json(const Support& s) {
  return {{"points", s.points}, {"rms", s.rms}, {"coverage", s.coverage}};
}

Json to_json(const Surface& s) {
  Json j = {{"id", s.id},
            {"kind", name_of(s.kind)},
            {"source", name_of(s.source)},
            {"plane", {{"normal", to_json(s.plane.normal)}, {"offset", s.plane.offset}}},
            {"outer", s.outer},
            {"holes", s.holes},
            {"support", to_json(s.support)}};
  if (s.thickness) j["thickness"] = *s.thickness;
  if (s.color) j["color"] = {s.color->r, s.color->g, s.color->b};
  if (s.curve) j["curve"] = *s.curve;
  if (s.ground) j["ground"] = true;
  for (const InferredPart& part : s.inferred) {
    Json holes = Json::array();
    for (const auto& hole : part.holes) holes.push_back(to_json(hole));
    j["inferred"].push_back({{"outer", to_json(part.outer)}, {"holes", holes}});
  }
  return j;
}

Json to_json(const Opening& o) {
  Json j = {
      {"id", o.id},       {"kind", name_of(o.kind)}, {"surface", o.surface},  {"loop", o.loop},
      {"width", o.width}, {"height", o.height},      {"evidence", o.evidence}};
  if (o.glass) j["glass"] = true;
  if (o.leaf)
    j["leaf"] = {{"surface", o.leaf->surface},
                 {"angle", o.leaf->angle},
                 {"hinge", name_of(o.leaf->hinge)},
                 {"opens_to", name_of(o.leaf->opens_to)}};
  return j;
}

Json shape_json(const OrientedBox& b) {
  return {{"box",
           {{"center", to_json(b.center)},
            {"size", to_json(b.size)},
            {"rotation", to_json(b.rotation)}}}};
}
Json shape_json(const ConvexHull& h) { return {{"hull", {{"vertices", to_json(h.vertices)}}}}; }
Json shape_json(const Cylinder& c) {
  return {
      {"cylinder", {{"center", to_json(c.center)}, {"radius", c.radius}, {"height", c.height}}}};
}
Json shape_json(const ConvexPrism& p) {
  return {{"prism", {{"base", to_json(p.base)}, {"extrusion", to_json(p.extrusion)}}}};
}

template <typename Shape>
Json with_shape(Json j, const Shape& shape) {
  j.update(std::visit([](const auto& s) { return shape_json(s); }, shape));
  return j;
}

Json to_json(const Obstacle& o) {
  Json j = {{"id", o.id}};
  if (o.curve) j["curve"] = *o.curve;
  return with_shape(std::move(j), o.shape);
}
Json to_json(const Collider& c) { return with_shape({{"surface", c.surface}}, c.shape); }
Json to_json(const CurvedPart& c) {
  const Curve& curve = c.curve;
  const bool is_cone = curve.shape.type == CurveType::cone;
  return {
      {"id", c.id},
      {"type", name_of(curve.shape.type)},
      {"point", to_json(curve.shape.point)},
      {"axis", to_json(curve.shape.axis)},
      {is_cone ? "half_angle" : "radius", is_cone ? curve.shape.half_angle : curve.shape.radius},
      {"extent", {curve.low, curve.high}},
      {"start", to_json(curve.start)},
      {"sweep", curve.sweep},
      {"facing", curve.hollow ? "in" : "out"},
      {"support", to_json(curve.support)}};
}
Json to_json(const Room& r) {
  Json j = {{"id", r.id}, {"name", r.name}, {"surfaces", r.surfaces}};
  if (r.area) j["area"] = *r.area;
  if (r.center) j["center"] = to_json(*r.center);
  if (r.height) j["height"] = *r.height;
  if (r.volume) j["volume"] = *r.volume;
  return j;
}
Json to_json(const Door& d) { return {{"opening", d.opening}, {"rooms", d.rooms}}; }

Json to_json(const std::optional<int>& id) { return id ? Json(*id) : Json(nullptr); }

Json to_json(const Way& w) {
  const auto pair = [](const auto& ids) { return Json::array({to_json(ids[0]), to_json(ids[1])}); };
  Json j = {{"id", w.id},
            {"kind", name_of(w.kind)},
            {"foot", to_json(w.foot)},
            {"top", to_json(w.top)},
            {"width", w.width}};
  if (w.kind == WayKind::stairs)
    j.update({{"steps", w.steps}, {"riser", w.riser}, {"tread", w.tread}});
  else
    j["slope"] = w.slope;
  j.update({{"floors", pair(w.floors)}, {"rooms", pair(w.rooms)}});
  return j;
}

Json to_json(const Provenance& p) {
  Json inputs = Json::array(), options = Json::object();
  for (const auto& i : p.inputs)
    inputs.push_back({{"file", i.file}, {"points", i.points}, {"fingerprint", i.fingerprint}});
  for (const auto& [key, value] : p.options)
    std::visit([&, &name = key](const auto& v) { options[name] = v; }, value);
  return {{"program", p.program}, {"inputs", inputs}, {"options", options}};
}

template <typename T>
Json list_of(const std::vector<T>& items) {
  Json list = Json::array();
  for (const T& item : items) list.push_back(to_json(item));
  return list;
}

Json to_json(const World& w) {
  // Who knows version 1 alone can read what has nothing round, inferred in part or uneven in it, no
  // stairs, no leaf and no height of a room.
  const bool is_plain = w.curves.empty() && w.ways.empty() &&
                        std::none_of(w.rooms.begin(), w.rooms.end(),
                                     [](const Room& r) { return r.height || r.volume; }) &&
                        std::none_of(w.openings.begin(), w.openings.end(),
                                     [](const Opening& o) { return o.leaf.has_value(); }) &&
                        std::none_of(w.surfaces.begin(), w.surfaces.end(), [](const Surface& s) {
                          return !s.inferred.empty() || s.ground;
                        });
  const int version = is_plain ? 1 : kWorldSchemaVersion;
  Json j = {{"schema", {{"name", "scanworld"}, {"version", version}}},
            {"frame", to_json(w.frame)},
            {"vertices", to_json(w.vertices)},
            {"surfaces", list_of(w.surfaces)},
            {"openings", list_of(w.openings)},
            {"obstacles", list_of(w.obstacles)},
            {"colliders", list_of(w.colliders)}};
  if (!w.curves.empty()) j["curves"] = list_of(w.curves);
  j.update({{"rooms", list_of(w.rooms)}, {"doors", list_of(w.doors)}});
  if (!w.ways.empty()) j["ways"] = list_of(w.ways);
  j["provenance"] = to_json(w.provenance);
  return j;
}

// Text with one item a line where it holds objects or lists of lists, and lists of plain values on
// one line.
void print(const Json& j, int indent, std::string& out) {
  const bool nested = j.is_object() || (j.is_array() && !j.empty() && j.begin()->is_structured());
  if (!nested || j.empty()) {
    if (!j.is_array()) {
      out += j.dump();
      return;
    }
    out += '[';
    for (std::size_t i = 0; i < j.size(); ++i) {
      if (i > 0) out += ", ";
      out += j[i].dump();
    }
    out += ']';
    return;
  }
  const std::string line = "\n" + std::string(static_cast<std::size_t>(indent) + 1, ' ');
  out += j.is_object() ? '{' : '[';
  bool first = true;
  for (const auto& item : j.items()) {
    if (!first) out += ',';
    first = false;
    out += line;
    if (j.is_object()) out += Json(item.key()).dump() + ": ";
    print(item.value(), indent + 1, out);
  }
  out += line.substr(0, line.size() - 1);
  out += j.is_object() ? '}' : ']';
}

}  // namespace

std::string world_text(const World& world) {
  std::string text;
  print(to_json(world), 0, text);
  return text + "\n";
}

void write_world(const std::filesystem::path& path, const World& world) {
  write_text(path, world_text(world));
}

std::string world_hash(const World& world) {
  World bare = world;
  bare.provenance = {};
  std::uint64_t hash = 0xcbf29ce484222325;  // FNV-1a
  for (unsigned char c : world_text(bare)) hash = (hash ^ c) * 0x100000001b3;
  return fmt::format("{:016x}", hash);
}

}  // namespace scanworld
