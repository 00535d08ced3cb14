// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "viewer/drawn_plan.h"

#include <tinyxml2.h>

#include <algorithm>
#include <map>

#include "support/scenes.h"
#include "world/level.h"
#include "world/ray_scene.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// What is written on a plan, as a reader of SVG finds it.
struct Written {
  std::vector<std::string> texts;
  struct Line {
    std::string kind;
    double length;  // [m]
  };
  std::vector<Line> lines;
  bool says(const std::string& text) const { return std::ranges::count(texts, text) > 0; }
};

Written read_svg(const std::string& svg) {
  tinyxml2::XMLDocument document;
  REQUIRE(document.Parse(svg.c_str()) == tinyxml2::XML_SUCCESS);
  Written written;
  for (auto* e = document.RootElement()->FirstChildElement(); e; e = e->NextSiblingElement()) {
    if (e->Name() == std::string("text")) written.texts.push_back(e->GetText());
    if (e->Name() == std::string("line"))
      written.lines.push_back(
          {e->Attribute("class"), std::hypot(e->DoubleAttribute("x2") - e->DoubleAttribute("x1"),
                                             e->DoubleAttribute("y2") - e->DoubleAttribute("y1")) /
                                      100});
  }
  return written;
}

std::string metres(double length) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3f", length);
  return text;
}

}  // namespace

TEST_CASE("the widths on the plan of an office are those of its rooms, to the millimetre") {
  const World world = read_world(in_project("worlds/office.json"));
  const Written plan = read_svg(svg_of(draw_plan(world), "office"));
  // As worlds/make_worlds.py has them.
  for (const char* width : {"5.400", "4.450", "4.100", "4.050", "9.600", "2.000", "4.200", "4.500",
                            "3.100", "4.000", "2.100"})
    CHECK_MESSAGE(plan.says(width), width);
  for (const Room& room : world.rooms) CHECK(plan.says(room.name));
  for (const Opening& o : world.openings) CHECK(plan.says(metres(o.width)));
}

TEST_CASE("each length that is written is that of its line, and lies between two faces") {
  for (const std::string name : {"office", "room", "stairs"}) {
    const World world = read_world(in_project("worlds/" + name + ".json"));
    const DrawnPlan plan = draw_plan(world);
    const Written written = read_svg(svg_of(plan, name));
    std::vector<double> drawn;
    for (const Written::Line& line : written.lines)
      if (line.kind == "dimension") drawn.push_back(line.length);
    for (const auto& dimensions : {plan.widths, plan.overall})
      for (const DrawnPlan::Dimension& d : dimensions) {
        CHECK(written.says(metres(d.length())));
        CHECK(
            std::ranges::any_of(drawn, [&](double x) { return std::abs(x - d.length()) < 1e-3; }));
      }
    for (const DrawnPlan::Dimension& d : plan.widths)
      for (const Vec2& end : {d.a, d.b}) {
        const bool is_on_face = std::ranges::any_of(world.surfaces, [&](const Surface& s) {
          return std::abs(s.plane.signed_distance({end.x(), end.y(), plan.cut})) < 1e-6 &&
                 std::abs(s.plane.normal.z()) < 0.1;
        });
        CHECK(is_on_face);
      }
  }
}

TEST_CASE("a plan is the same however the world is turned about its up, but for its own way") {
  const World world = read_world(in_project("worlds/office.json"));
  const auto lengths_of = [](const DrawnPlan& plan) {
    std::vector<double> lengths = {0};
    for (const DrawnPlan::Line& wall : plan.walls) lengths[0] += (wall.b - wall.a).norm();
    for (const DrawnPlan::Dimension& d : plan.overall) lengths.push_back(d.length());
    for (const DrawnPlan::Opening& o : plan.openings) lengths.push_back((o.b - o.a).norm());
    return lengths;
  };
  const std::vector<double> straight = lengths_of(draw_plan(world));
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.3, Vec3::UnitZ()));
  const DrawnPlan turned = draw_plan(moved(world, turn, {100, -40, 3}));
  CHECK((turned.along - Vec2(std::cos(0.3), std::sin(0.3))).norm() < 1e-3);
  const std::vector<double> other = lengths_of(turned);
  REQUIRE(other.size() == straight.size());
  for (std::size_t i = 0; i < other.size(); ++i)
    CHECK(other[i] == doctest::Approx(straight[i]).epsilon(0).scale(1).epsilon(1e-4));
}

TEST_CASE("doors and windows are where their loops are, and as wide") {
  const World world = read_world(in_project("worlds/office.json"));
  const DrawnPlan plan = draw_plan(world);
  REQUIRE(plan.openings.size() == world.openings.size());
  for (std::size_t i = 0; i < plan.openings.size(); ++i) {
    CHECK((plan.openings[i].b - plan.openings[i].a).norm() ==
          doctest::Approx(world.openings[i].width));
    CHECK(plan.openings[i].kind == world.openings[i].kind);
  }
}

TEST_CASE("each storey has a plan of its own; one that is not there is refused") {
  World world = read_world(in_project("worlds/room.json"));
  const World above = moved(world, Eigen::Quaterniond::Identity(), {0, 0, 4});
  const int vertices = static_cast<int>(world.vertices.size());
  world.vertices.insert(world.vertices.end(), above.vertices.begin(), above.vertices.end());
  for (Surface s : above.surfaces) {
    s.id += 1000;
    for (int& v : s.outer) v += vertices;
    for (Loop& hole : s.holes)
      for (int& v : hole) v += vertices;
    world.surfaces.push_back(s);
  }
  const DrawnPlan low = draw_plan(world, {.storey = 0}), high = draw_plan(world, {.storey = 1});
  CHECK(high.level == doctest::Approx(low.level + 4));
  CHECK(low.rooms.size() == world.rooms.size());
  CHECK(high.rooms.empty());
  CHECK(high.walls.size() == low.walls.size());
  CHECK(contains(error_of(Cause::usage, [&] { draw_plan(world, {.storey = 7}); }),
                 "--storey 7: the world has"));
}

TEST_CASE("names on a plan are text, whatever is in them; an empty world has a plan too") {
  World world = read_world(in_project("worlds/room.json"));
  const std::string name = "<script>&\"'";
  world.rooms[0].name = name;
  const std::string svg = svg_of(draw_plan(world), name);
  CHECK_FALSE(contains(svg, "<script"));
  CHECK(read_svg(svg).says(name));
  CHECK(read_svg(svg_of(draw_plan({}), "nothing")).lines.empty());
}
