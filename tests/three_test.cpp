// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// GLB and USD as three.js reads them.
#include <sstream>

#include "exporters/export.h"
#include "exporters/parts.h"
#include "support/engines.h"
#include "support/scenes.h"
#include "world/solids.h"
#include "world/world_json.h"

using namespace scanworld;
using namespace scanworld::test;

TEST_CASE(
    "three.js finds every surface, obstacle and solid in GLB and USD, by name, size and place") {
  if (!has_node_packages()) return;
  for (const std::string name : {"room", "office", "stairs"}) {
    const World world = prepare_export(read_world(in_project("worlds/" + name + ".json")), {});
    for (const std::string extension : {"glb", "usda"}) {
      const TempFolder folder;
      const auto file = folder / ("world." + extension);
      export_world(world, file);
      const Outcome outcome =
          run_program({"node", node_script("read_with_three.mjs").string(), file.string()});
      CHECK_MESSAGE(outcome.code == 0, outcome.err);
      std::istringstream lines(outcome.out);
      // What is next, its points turned to Y up; rounded things are cut into faces anew.
      const auto check_next = [&](const std::string& part, const std::vector<Vec3>& points,
                                  double tolerance) -> std::vector<double> {
        std::string line;
        REQUIRE(std::getline(lines, line));
        const std::size_t blank = line.find(' ');
        CHECK(line.substr(0, blank).starts_with(part));
        const std::vector<double> n = numbers_in(line.substr(blank));
        REQUIRE(n.size() == 8);
        Box3 box;
        for (const Vec3& v : points) box.extend(Vec3(v.x(), v.z(), -v.y()));
        CHECK((Vec3(n[2], n[3], n[4]) - box.min()).norm() < tolerance);
        CHECK((Vec3(n[5], n[6], n[7]) - box.max()).norm() < tolerance);
        return n;
      };
      for (const ExportPart& part : export_parts(world)) {
        const auto n = check_next(part.name, part.mesh.vertices, 1e-4);
        CHECK(n[0] == static_cast<double>(part.mesh.triangles.size()));
        CHECK(n[1] == doctest::Approx(area_of(part.mesh)).scale(0).epsilon(1e-4));
      }
      if (extension == "glb") continue;
      for (const ExportBody& body : export_bodies(world, {})) {
        const auto* cylinder = std::get_if<CylinderShape>(&body.shape);
        check_next(body.name, mesh_of(body).vertices, cylinder ? 0.05 * cylinder->radius : 1e-4);
      }
    }
  }
}
