// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "report_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "base64.h"
#include "drawn_plan.h"
#include "error.h"
#include "picture.h"
#include "text.h"
#include "world/fidelity.h"

namespace scanworld {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kWidth = 900, kHeight = 600;  // [pixels] of the picture

constexpr const char* kHead = R"(<meta charset="utf-8">
<meta name="viewport" content="width=device-width">
<style>
:root { color-scheme: light dark; --line: #8886; --bar: #4a7fb5; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 2rem auto; padding: 0 1rem; }
h1 { margin-bottom: 0; } h2 { margin-top: 2rem; font-size: 1.2rem; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; padding: .2rem .8rem .2rem 0; border-bottom: 1px solid var(--line); }
td.number, th.number { text-align: right; font-variant-numeric: tabular-nums; }
img { max-width: 100%; border: 1px solid var(--line); border-radius: 4px; background: #fff; }
.bar { background: var(--bar); height: .8rem; border-radius: 2px; min-width: 1px; }
.chart td { border: none; padding-top: 0; padding-bottom: 0; } .chart td:nth-child(2) { width: 40%; } .chart td { white-space: nowrap; }
.good { color: #2a8f5c; } .bad { color: #d0453b; font-weight: 600; }
.numbers { display: flex; flex-wrap: wrap; gap: 1.5rem; margin: 1rem 0; }
.numbers b { display: block; font-size: 1.6rem; font-variant-numeric: tabular-nums; }
</style>
)";

// A row of a table; cells after the first are numbers.
std::string row(const std::vector<std::string>& cells, const char* tag = "td") {
  std::string text = "<tr>";
  for (std::size_t k = 0; k < cells.size(); ++k)
    text += fmt::format("<{0}{1}>{2}</{0}>", tag, k > 0 ? " class=\"number\"" : "", cells[k]);
  return text + "</tr>\n";
}

std::string number_tile(const std::string& value, const std::string& what) {
  return fmt::format("<div><b>{}</b>{}</div>\n", value, what);
}

// What the scan was, and what the world is.
std::string numbers(const World& world, const Json& report) {
  const auto points = report.at("points").at("input").get<std::size_t>();
  const auto triangles = report.at("triangles").get<std::size_t>();
  return "<div class=\"numbers\">\n" + number_tile(grouped(points), "points before") +
         number_tile(grouped(world.surfaces.size()), "surfaces after") +
         number_tile(grouped(triangles), "triangles") +
         number_tile(grouped(world.colliders.size() + world.obstacles.size()),
                     "solids to collide with") +
         number_tile(triangles > 0 ? grouped(points / triangles) : "-", "points for a triangle") +
         number_tile(fmt::format("{:.2f} s", report.at("complete_seconds").get<double>()),
                     "from files to files") +
         "</div>\n";
}

std::string pictures(const World& world, const std::string& title) {
  const auto image = [](const char* type, const std::string& bytes, const char* what) {
    return fmt::format("<p><img src=\"data:image/{};base64,{}\" alt=\"{}\"></p>\n", type,
                       base64(bytes.data(), bytes.size()), what);
  };
  const Camera camera = camera_from_corner(world, static_cast<double>(kWidth) / kHeight);
  return image("png",
               png_of(draw(world, camera, {.width = kWidth, .height = kHeight, .samples = 2})),
               "The world from a corner") +
         image("svg+xml", svg_of(draw_plan(world), title), "The floor plan");
}

std::string surfaces_table(const World& world) {
  std::string text = "<table>\n" + row({"kind", "surfaces", "area", "measured"}, "th");
  for (Kind kind : {Kind::floor, Kind::ceiling, Kind::wall, Kind::other}) {
    std::size_t count = 0;
    double whole = 0, measured = 0;
    for (const Surface& s : world.surfaces) {
      if (s.kind != kind) continue;
      const double a = area(world, s);
      ++count, whole += a;
      if (s.source == Source::measured) measured += a;
    }
    text += row({name_of(kind), grouped(count), fmt::format("{:.2f} m²", whole),
                 whole > 0 ? fmt::format("{:.0f} %", 100 * measured / whole) : "-"});
  }
  return text + "</table>\n";
}

std::string openings_table(const World& world) {
  if (world.openings.empty()) return "<p>No doors, windows or passages.</p>\n";
  std::string text = "<table>\n" + row({"opening", "width", "height", "in surface"}, "th");
  for (const Opening& o : world.openings)
    text += row({fmt::format("{}{} {}", name_of(o.kind), o.glass ? " with a pane" : "", o.id),
                 fmt::format("{:.3f} m", o.width), fmt::format("{:.3f} m", o.height),
                 fmt::to_string(o.surface)});
  return text + "</table>\n";
}

std::string rooms_table(const World& world) {
  if (world.rooms.empty()) return "<p>No rooms.</p>\n";
  std::string text = "<table>\n" + row({"room", "floor", "doors"}, "th");
  for (const Room& room : world.rooms) {
    const auto doors = std::count_if(world.doors.begin(), world.doors.end(), [&](const Door& d) {
      return d.rooms[0] == room.id || d.rooms[1] == room.id;
    });
    text += row({markup_text(room.name), room.area ? fmt::format("{:.2f} m²", *room.area) : "-",
                 fmt::to_string(doors)});
  }
  return text + "</table>\n";
}

std::string ways_table(const World& world) {
  if (world.ways.empty()) return "";
  std::string text = "<table>\n" + row({"way", "width", "rise", "steps", "riser, tread"}, "th");
  for (const Way& w : world.ways) {
    const bool is_stairs = w.kind == WayKind::stairs;
    text += row({fmt::format("{} {}", name_of(w.kind), w.id), fmt::format("{:.2f} m", w.width),
                 fmt::format("{:.2f} m", world.frame.up.dot(w.top - w.foot)),
                 is_stairs ? fmt::to_string(w.steps) : "-",
                 is_stairs ? fmt::format("{:.3f} m, {:.3f} m", w.riser, w.tread)
                           : fmt::format("slope {:.1f}°", w.slope * 180 / M_PI)});
  }
  return text + "</table>\n";
}

std::string value_text(const Json& value, const std::string& unit) {
  return value.is_null() ? "not measured" : figure_text(value.get<double>(), unit);
}

std::string fidelity_section(const Json& fidelity) {
  const bool is_faithful = fidelity.at("faithful").get<bool>();
  std::string text =
      fmt::format("<p class=\"{}\">The world is {}.</p>\n<table>\n", is_faithful ? "good" : "bad",
                  markup_text(fidelity.at("verdict").get<std::string>())) +
      row({"criterion", "found", "limit", "met"}, "th");
  for (const Json& c : fidelity.at("criteria")) {
    const bool is_minimum = c.contains("at_least");
    const auto unit = c.at("unit").get<std::string>();
    text += row({markup_text(c.at("name").get<std::string>()), value_text(c.at("value"), unit),
                 (is_minimum ? "at least " : "at most ") +
                     value_text(c.at(is_minimum ? "at_least" : "at_most"), unit),
                 c.at("met").is_null()     ? "-"
                 : c.at("met").get<bool>() ? "<span class=\"good\">yes</span>"
                                           : "<span class=\"bad\">no</span>"});
  }
  return text + "</table>\n";
}

// Times as bars, with what each stage took and gave.
std::string stages_chart(const Json& stages) {
  double longest = 1e-9;
  for (const Json& s : stages) longest = std::max(longest, s.at("seconds").get<double>());
  std::string text = "<table class=\"chart\">\n";
  for (const Json& s : stages) {
    const double seconds = s.at("seconds").get<double>();
    text += fmt::format(
        "<tr><td>{}</td><td><div class=\"bar\" style=\"width:{:.1f}%\"></div></td>"
        "<td class=\"number\">{:.0f} ms</td><td>{} &rarr; {} ({})</td></tr>\n",
        markup_text(s.at("name").get<std::string>()), 100 * seconds / longest, 1e3 * seconds,
        grouped(s.at("in").get<std::size_t>()), grouped(s.at("out").get<std::size_t>()),
        markup_text(s.at("what").get<std::string>()));
  }
  return text + "</table>\n";
}

std::string warnings_list(const Json& warnings) {
  if (warnings.empty()) return "<p>None.</p>\n";
  std::string text = "<ul>\n";
  for (const Json& w : warnings) text += "<li>" + markup_text(w.get<std::string>()) + "</li>\n";
  return text + "</ul>\n";
}

std::string sources(const World& world, const Json& report) {
  std::string text = fmt::format("<p>Made by {}", markup_text(world.provenance.program));
  for (const auto& input : world.provenance.inputs)
    text += fmt::format(" of {} ({} points, fingerprint {})", markup_text(input.file),
                        grouped(input.points), markup_text(input.fingerprint));
  return text + fmt::format("; method {}, preset {}, noise {:.1f} mm, spacing {:.1f} mm.</p>\n",
                            markup_text(report.at("method").get<std::string>()),
                            markup_text(report.at("preset").get<std::string>()),
                            1e3 * report.at("noise").get<double>(),
                            1e3 * report.at("spacing").get<double>());
}

}  // namespace

std::string report_page_of(const World& world, const std::string& title,
                           const std::string& report_json) {
  const auto section = [](const char* name, const std::string& body) {
    return fmt::format("<h2>{}</h2>\n{}", name, body);
  };
  try {
    const Json report = Json::parse(report_json);
    return "<!doctype html>\n<html lang=\"en\">\n<head>\n<title>" + markup_text(title) +
           "</title>\n" + kHead + "</head>\n<body>\n<h1>" + markup_text(title) + "</h1>\n" +
           sources(world, report) + numbers(world, report) + pictures(world, title) +
           section("Warnings", warnings_list(report.at("warnings"))) +
           section("How true it is to the scan", fidelity_section(report.at("fidelity"))) +
           section("Surfaces", surfaces_table(world)) +
           section("Rooms", rooms_table(world) + ways_table(world)) +
           section("Openings", openings_table(world)) +
           section("Where the time went", stages_chart(report.at("stages"))) + "</body>\n</html>\n";
  } catch (const Json::exception& e) {
    throw Error(Cause::bad_input, std::string("report.json: ") + e.what());
  }
}

}  // namespace scanworld
