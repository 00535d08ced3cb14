// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "../error.h"
#include "validate.h"
#include "world_json.h"

namespace scanworld {

namespace {

using Json = nlohmann::json;

// A value in a file, with the path to it, so that errors can name the place.
class Node {
 public:
  Node(const Json& json, std::string path) : json_(json), path_(std::move(path)) {}

  [[noreturn]] void fail(const std::string& what) const {
    throw Error(Cause::bad_input, path_ + ": " + what);
  }

  // An object with no other keys than these; those that start with '?' may be missing.
  void expect_keys(std::initializer_list<const char*> keys) const {
    if (!json_.is_object()) fail("should be an object");
    std::set<std::string> known;
    for (const char* key : keys) {
      const bool optional = key[0] == '?';
      known.insert(key + optional);
      if (!optional && !json_.contains(key)) fail(fmt::format("has no '{}'", key));
    }
    for (const auto& item : json_.items())
      if (!known.count(item.key()))
        fail(fmt::format("has an unknown key '{}'", item.key().substr(0, 60)));
  }

  bool has(const char* key) const { return json_.contains(key); }
  Node at(const char* key) const { return {json_.at(key), path_ + "." + key}; }
  Node item(std::size_t i) const { return {json_.at(i), fmt::format("{}[{}]", path_, i)}; }
  const Json& json() const { return json_; }

  std::size_t size() const {
    if (!json_.is_array()) fail("should be a list");
    return json_.size();
  }

  double number() const {
    if (!json_.is_number()) fail("should be a number");
    return json_.get<double>();
  }
  int integer() const {
    const auto value = json_.is_number_integer() ? json_.get<double>() : -1e300;
    if (value < -2147483648.0 || value > 2147483647.0) fail("should be a whole number of 32 bits");
    return json_.get<int>();
  }
  std::size_t count() const {
    if (!json_.is_number_unsigned()) fail("should be a whole number, 0 or more");
    return json_.get<std::size_t>();
  }
  std::string text() const {
    if (!json_.is_string()) fail("should be a text");
    return json_.get<std::string>();
  }
  bool boolean() const {
    if (!json_.is_boolean()) fail("should be true or false");
    return json_.get<bool>();
  }
  Vec3 vector() const {
    if (size() != 3) fail("should be a list of 3 numbers");
    return {item(0).number(), item(1).number(), item(2).number()};
  }

  Eigen::Quaterniond rotation() const {
    if (size() != 4) fail("should be a list of 4 numbers, x y z w");
    return {item(3).number(), item(0).number(), item(1).number(), item(2).number()};
  }

  template <typename Read>
  auto list(Read read) const {
    std::vector<decltype(read(*this))> items;
    for (std::size_t i = 0; i < size(); ++i) items.push_back(read(item(i)));
    return items;
  }
  Loop integers() const {
    return list([](const Node& n) { return n.integer(); });
  }
  std::vector<Vec3> vectors() const {
    return list([](const Node& n) { return n.vector(); });
  }

  template <typename Enum>
  Enum one_of(std::initializer_list<Enum> values) const {
    std::string names;
    for (Enum value : values) {
      if (text() == name_of(value)) return value;
      names += (names.empty() ? "" : ", ") + std::string(name_of(value));
    }
    fail(fmt::format("'{}' is none of {}", text().substr(0, 60), names));
  }

 private:
  const Json& json_;
  std::string path_;
};

Frame read_frame(const Node& n) {
  n.expect_keys({"origin", "?rotation", "up", "unit", "assumed"});
  if (n.at("unit").text() != "m") n.at("unit").fail("the only unit is 'm'");
  Frame f{.origin = n.at("origin").vector(),
          .up = n.at("up").vector(),
          .assumed = n.at("assumed").list([](const Node& t) { return t.text(); })};
  if (n.has("rotation")) f.rotation = n.at("rotation").rotation();
  return f;
}

Color read_color(const Node& n) {
  if (n.size() != 3) n.fail("should be a list of 3 numbers");
  const auto channel = [&](std::size_t i) {
    if (n.item(i).count() > 255) n.item(i).fail("should be at most 255");
    return static_cast<std::uint8_t>(n.item(i).count());
  };
  return {channel(0), channel(1), channel(2)};
}

Support read_support(const Node& n) {
  n.expect_keys({"points", "rms", "coverage"});
  return {n.at("points").count(), n.at("rms").number(), n.at("coverage").number()};
}

InferredPart read_inferred(const Node& n) {
  n.expect_keys({"outer", "holes"});
  return {n.at("outer").vectors(),
          n.at("holes").list([](const Node& hole) { return hole.vectors(); })};
}

Surface read_surface(const Node& n) {
  n.expect_keys({"id", "kind", "source", "plane", "outer", "holes", "support", "?thickness",
                 "?color", "?curve", "?inferred", "?ground"});
  const Node plane = n.at("plane");
  plane.expect_keys({"normal", "offset"});
  Surface s;
  s.id = n.at("id").integer();
  s.kind = n.at("kind").one_of({Kind::floor, Kind::ceiling, Kind::wall, Kind::other});
  s.source = n.at("source").one_of({Source::measured, Source::inferred});
  s.plane = {plane.at("normal").vector(), plane.at("offset").number()};
  s.outer = n.at("outer").integers();
  s.holes = n.at("holes").list([](const Node& hole) { return hole.integers(); });
  s.support = read_support(n.at("support"));
  if (n.has("thickness")) s.thickness = n.at("thickness").number();
  if (n.has("color")) s.color = read_color(n.at("color"));
  if (n.has("curve")) s.curve = n.at("curve").integer();
  if (n.has("ground")) s.ground = n.at("ground").boolean();
  if (n.has("inferred")) s.inferred = n.at("inferred").list(read_inferred);
  return s;
}

Leaf read_leaf(const Node& n) {
  n.expect_keys({"surface", "angle", "hinge", "opens_to"});
  return {n.at("surface").integer(), n.at("angle").number(),
          n.at("hinge").one_of({LeafHinge::left, LeafHinge::right}),
          n.at("opens_to").one_of({LeafSide::front, LeafSide::back})};
}

Opening read_opening(const Node& n) {
  n.expect_keys(
      {"id", "kind", "surface", "loop", "width", "height", "evidence", "?glass", "?leaf"});
  return {
      .id = n.at("id").integer(),
      .kind = n.at("kind").one_of({OpeningKind::door, OpeningKind::window, OpeningKind::passage}),
      .surface = n.at("surface").integer(),
      .loop = n.at("loop").integers(),
      .width = n.at("width").number(),
      .height = n.at("height").number(),
      .evidence = n.at("evidence").text(),
      .glass = n.has("glass") && n.at("glass").boolean(),
      .leaf = n.has("leaf") ? std::optional(read_leaf(n.at("leaf"))) : std::nullopt};
}

OrientedBox read_box(const Node& n) {
  n.expect_keys({"center", "size", "rotation"});
  return {n.at("center").vector(), n.at("size").vector(), n.at("rotation").rotation()};
}
ConvexHull read_hull(const Node& n) {
  n.expect_keys({"vertices"});
  return {n.at("vertices").vectors()};
}
Cylinder read_cylinder(const Node& n) {
  n.expect_keys({"center", "radius", "height"});
  return {n.at("center").vector(), n.at("radius").number(), n.at("height").number()};
}
ConvexPrism read_prism(const Node& n) {
  n.expect_keys({"base", "extrusion"});
  return {n.at("base").vectors(), n.at("extrusion").vector()};
}

Obstacle read_obstacle(const Node& n) {
  n.expect_keys({"id", "?curve", "?box", "?hull", "?cylinder"});
  if (n.json().size() != 2 + n.json().count("curve"))
    n.fail("should have one of box, hull and cylinder");
  Obstacle o{.id = n.at("id").integer()};
  if (n.has("curve")) o.curve = n.at("curve").integer();
  if (n.has("box")) o.shape = read_box(n.at("box"));
  if (n.has("hull")) o.shape = read_hull(n.at("hull"));
  if (n.has("cylinder")) o.shape = read_cylinder(n.at("cylinder"));
  return o;
}

Collider read_collider(const Node& n) {
  n.expect_keys({"surface", "?box", "?prism"});
  if (n.json().size() != 2) n.fail("should have one of box and prism");
  Collider c{.surface = n.at("surface").integer()};
  if (n.has("box")) c.shape = read_box(n.at("box"));
  if (n.has("prism")) c.shape = read_prism(n.at("prism"));
  return c;
}

CurvedPart read_curve(const Node& n) {
  const CurveType type =
      n.at("type").one_of({CurveType::cylinder, CurveType::sphere, CurveType::cone});
  const bool is_cone = type == CurveType::cone;
  n.expect_keys({"id", "type", "point", "axis", is_cone ? "half_angle" : "radius", "extent",
                 "start", "sweep", "facing", "support"});
  const Node extent = n.at("extent");
  if (extent.size() != 2) extent.fail("should be a list of 2 numbers");
  const std::string facing = n.at("facing").text();
  if (facing != "in" && facing != "out") n.at("facing").fail("is neither 'in' nor 'out'");
  return {n.at("id").integer(),
          {{type, n.at("point").vector(), n.at("axis").vector(),
            is_cone ? 0 : n.at("radius").number(), is_cone ? n.at("half_angle").number() : 0},
           extent.item(0).number(),
           extent.item(1).number(),
           n.at("start").vector(),
           n.at("sweep").number(),
           facing == "in",
           read_support(n.at("support"))}};
}

Room read_room(const Node& n) {
  n.expect_keys({"id", "name", "surfaces", "?area", "?center", "?height", "?volume"});
  Room r{n.at("id").integer(), n.at("name").text(), n.at("surfaces").integers()};
  if (n.has("area")) r.area = n.at("area").number();
  if (n.has("center")) r.center = n.at("center").vector();
  if (n.has("height")) r.height = n.at("height").number();
  if (n.has("volume")) r.volume = n.at("volume").number();
  return r;
}

Door read_door(const Node& n) {
  n.expect_keys({"opening", "rooms"});
  const Node rooms = n.at("rooms");
  if (rooms.size() != 2) rooms.fail("should be a list of 2 rooms");
  return {n.at("opening").integer(), {rooms.item(0).integer(), rooms.item(1).integer()}};
}

// Two ids, of which each may be null.
std::array<std::optional<int>, 2> read_ends(const Node& n) {
  if (n.size() != 2) n.fail("should be a list of 2 ids");
  std::array<std::optional<int>, 2> ids;
  for (std::size_t i = 0; i < 2; ++i)
    if (!n.item(i).json().is_null()) ids[i] = n.item(i).integer();
  return ids;
}

Way read_way(const Node& n) {
  n.expect_keys({"id", "kind", "foot", "top", "width", "?steps", "?riser", "?tread", "?slope",
                 "floors", "rooms"});
  Way w{.id = n.at("id").integer(),
        .kind = n.at("kind").one_of({WayKind::stairs, WayKind::ramp}),
        .foot = n.at("foot").vector(),
        .top = n.at("top").vector(),
        .width = n.at("width").number(),
        .floors = read_ends(n.at("floors")),
        .rooms = read_ends(n.at("rooms"))};
  const bool is_stairs = w.kind == WayKind::stairs;
  for (const char* key : {"steps", "riser", "tread", "slope"})
    if (n.has(key) != (is_stairs == (key != std::string("slope"))))
      n.fail(fmt::format("a way of kind {} {} '{}'", name_of(w.kind),
                         n.has(key) ? "has no" : "needs", key));
  if (is_stairs)
    w.steps = n.at("steps").integer(), w.riser = n.at("riser").number(),
    w.tread = n.at("tread").number();
  else
    w.slope = n.at("slope").number();
  return w;
}

Provenance read_provenance(const Node& n) {
  n.expect_keys({"program", "inputs", "options"});
  Provenance p{.program = n.at("program").text()};
  p.inputs = n.at("inputs").list([](const Node& i) {
    i.expect_keys({"file", "points", "fingerprint"});
    return Provenance::Input{i.at("file").text(), i.at("points").count(),
                             i.at("fingerprint").text()};
  });
  const Node options = n.at("options");
  if (!options.json().is_object()) options.fail("should be an object");
  for (const auto& item : options.json().items()) {
    const Json& v = item.value();
    OptionValue& value = p.options[item.key()];
    if (v.is_boolean())
      value = v.get<bool>();
    else if (v.is_number_integer())
      value = v.get<std::int64_t>();
    else if (v.is_number())
      value = v.get<double>();
    else if (v.is_string())
      value = v.get<std::string>();
    else
      options.fail(fmt::format("'{}' should be a plain value", item.key().substr(0, 60)));
  }
  return p;
}

World read_document(const Node& n) {
  if (!n.json().is_object() || !n.has("schema"))
    n.fail("is not a scanworld world: it has no 'schema'");
  const Node schema = n.at("schema");
  schema.expect_keys({"name", "version"});
  if (schema.at("name").text() != "scanworld") schema.fail("the name is not 'scanworld'");
  const int version = schema.at("version").integer();
  if (version < 1 || version > kWorldSchemaVersion)
    schema.fail(
        fmt::format("version {} cannot be read, only 1 to {}", version, kWorldSchemaVersion));
  n.expect_keys({"schema", "frame", "vertices", "surfaces", "openings", "obstacles", "colliders",
                 "?curves", "rooms", "doors", "?ways", "provenance"});
  return {.frame = read_frame(n.at("frame")),
          .vertices = n.at("vertices").vectors(),
          .surfaces = n.at("surfaces").list(read_surface),
          .openings = n.at("openings").list(read_opening),
          .obstacles = n.at("obstacles").list(read_obstacle),
          .colliders = n.at("colliders").list(read_collider),
          .curves = n.has("curves") ? n.at("curves").list(read_curve) : std::vector<CurvedPart>{},
          .rooms = n.at("rooms").list(read_room),
          .doors = n.at("doors").list(read_door),
          .ways = n.has("ways") ? n.at("ways").list(read_way) : std::vector<Way>{},
          .provenance = read_provenance(n.at("provenance"))};
}

}  // namespace

World parse_world(const std::string& text, const std::string& name) {
  Json json;
  try {
    json = Json::parse(text);
  } catch (const Json::exception& e) {
    // "[json.exception.parse_error.101] parse error at line 1, column 2: ..." is what the library
    // says.
    const std::string what = e.what();
    const std::size_t start = what.find("] ");
    throw Error(Cause::bad_input,
                name + ": " + (start == std::string::npos ? what : what.substr(start + 2)));
  }
  return read_document(Node(json, name + ": world"));
}

std::filesystem::path world_file(const std::filesystem::path& path) {
  std::error_code ignored;
  return std::filesystem::is_directory(path, ignored) ? path / "world.json" : path;
}

World read_world(const std::filesystem::path& path) {
  std::error_code ignored;
  const std::filesystem::path file = world_file(path);
  std::ifstream in(file, std::ios::binary);
  if (!in || std::filesystem::is_directory(file, ignored))
    throw Error(Cause::bad_input, file.string() + ": cannot be opened");
  std::ostringstream text;
  text << in.rdbuf();
  return parse_world(text.str(), file.string());
}

World read_valid_world(const std::filesystem::path& path) {
  World world = read_world(path);
  if (const auto reasons = validate(world); !reasons.empty())
    throw Error(
        Cause::bad_input,
        fmt::format("{}: not valid: {}{}", world_file(path).string(), reasons[0],
                    reasons.size() > 1 ? fmt::format("; and {} more", reasons.size() - 1) : ""));
  return world;
}

}  // namespace scanworld
