// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "viewer/report_page.h"

#include <nlohmann/json.hpp>

#include "support/scenes.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

using Json = nlohmann::ordered_json;

Json small_report() {
  return {{"points", {{"input", 1234567}, {"not_finite", 0}}},
          {"triangles", 100},
          {"complete_seconds", 1.25},
          {"method", "rival"},
          {"preset", "indoor"},
          {"noise", 0.0064},
          {"spacing", 0.03},
          {"warnings", {"the scan is <b>tilted</b>"}},
          {"fidelity",
           {{"faithful", false},
            {"verdict", "not faithful: leaks 3.00 %"},
            {"criteria",
             {{{"name", "median distance of the points"},
               {"unit", "m"},
               {"value", 0.0042},
               {"at_most", 0.009},
               {"met", true}},
              {{"name", "leaks"},
               {"unit", "%"},
               {"value", nullptr},
               {"at_most", 0.02},
               {"met", nullptr}}}}}},
          {"stages",
           {{{"name", "Reading"},
             {"seconds", 0.1},
             {"in", 1},
             {"out", 1234567},
             {"what", "files -> points"}},
            {{"name", "Rivalry"}, {"seconds", 0.4}, {"in", 9}, {"out", 7}, {"what", "a -> b"}}}}};
}

}  // namespace

TEST_CASE("the report tells what was found, how true it is, and where the time went") {
  const World world = read_world(in_project("worlds/office.json"));
  const std::string page = report_page_of(world, "office", small_report().dump());
  for (const char* part :
       {"1,234,567", "12,345", "1.25 s", "not faithful: leaks 3.00 %", "4.2 mm", "at most 9.0 mm",
        "not measured", "corridor", "0.950 m", "Rivalry", "width:100.0%", "width:25.0%",
        "data:image/png;base64,iVBOR", "data:image/svg+xml;base64,"})
    CHECK_MESSAGE(contains(page, part), part);
}

TEST_CASE("text in a report stands as text, and no script is in it") {
  World world = read_world(in_project("worlds/room.json"));
  world.rooms[0].name = world.provenance.program = "<img src=x onerror=alert(1)>";
  const std::string page =
      report_page_of(world, "</title><script>x</script>", small_report().dump());
  CHECK_FALSE(contains(page, "<script"));
  CHECK_FALSE(contains(page, "<img src=x"));
  CHECK_FALSE(contains(page, "<b>tilted"));
  CHECK(contains(page, "&lt;b&gt;tilted"));
}

TEST_CASE("what is no report is refused, naming what it lacks") {
  const World world = read_world(in_project("worlds/room.json"));
  const auto message = [&](const std::string& text) {
    return error_of(Cause::bad_input, [&] { report_page_of(world, "room", text); });
  };
  CHECK(contains(message("{"), "report.json"));
  Json report = small_report();
  report.erase("stages");
  CHECK(contains(message(report.dump()), "stages"));
}
