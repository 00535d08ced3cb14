// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/slits.h"

#include "space/interfaces.h"
#include "support/cells.h"
#include "support/space.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

// A solid with a step: its top is at height 0 where x < 1, and `step` higher beyond.
struct Step {
  space::CellComplex cells{kCellBox};
  std::vector<space::Label> labels;
  space::Evidence evidence;

  explicit Step(double step) {
    for (const Plane& plane : {plane_through(Vec3::Zero(), Vec3::UnitZ()),
                               plane_through(Vec3(0, 0, step), Vec3::UnitZ()),
                               plane_through(Vec3::UnitX(), Vec3::UnitX())})
      split_all(cells, plane);
    for (std::size_t c = 0; c < cells.cells().size(); ++c) labels.push_back(space::Label::solid);
    for (const double x : {0.0, 2.0})
      for (const double z : {step / 2, step + 0.5})
        if (z > (x < 1 ? 0 : step))
          labels[static_cast<std::size_t>(cells.cell_at({x, 0, z}))] = space::Label::free;
    evidence = bare_evidence(cells);
  }

  // Points should be, and are not, on the facets whose middle is within a box.
  void open(const Box3& box) {
    for (std::size_t f = 0; f < cells.facets().size(); ++f) {
      Vec3 middle = Vec3::Zero();
      const auto& vertices = cells.facets()[f].vertices;
      for (const int v : vertices) middle += cells.vertex(v) / static_cast<double>(vertices.size());
      if (box.contains(middle)) evidence.facets[f].empty = evidence.facets[f].area;
    }
  }
  std::size_t shown() const { return space::find_interfaces(cells, evidence, labels).size(); }
};

const Box3 kRiser(Vec3(0.99, -9, -0.5), Vec3(1.01, 9, 0.5));
const Box3 kUpperTop(Vec3(1.5, -9, 1e-4), Vec3(9, 9, 0.5));

}  // namespace

TEST_CASE("a step that nobody saw is an opening where it is high, else it is closed") {
  for (const double step : {0.003, 0.02}) {
    Step solid(step);
    CHECK(solid.shown() == 3);
    solid.open(kRiser);
    CHECK(solid.shown() == (step < 0.005 ? 3 : 2));
  }
}

TEST_CASE("a step beside an opening is no surface where it is low") {
  for (const double step : {0.003, 0.02}) {
    Step solid(step);
    solid.open(kUpperTop);
    CHECK(solid.shown() == (step < 0.005 ? 1 : 2));
  }
}

TEST_CASE("sheets are facets of one plane that share edges") {
  const Step solid(0.02);
  std::vector<int> all;
  for (std::size_t f = 0; f < solid.cells.facets().size(); ++f) {
    const auto& [before, behind] = solid.cells.facets()[f].cells;
    if (before >= 0 && behind >= 0 &&
        solid.labels[static_cast<std::size_t>(before)] !=
            solid.labels[static_cast<std::size_t>(behind)])
      all.push_back(static_cast<int>(f));
  }
  const space::FacetEdges edges(solid.cells, all, 0);
  const auto sheets = space::find_sheets(solid.cells, solid.labels, edges, all);
  REQUIRE(sheets.size() == 3);
  for (const auto& sheet : sheets)
    for (const int f : sheet)
      CHECK(solid.cells.facets()[static_cast<std::size_t>(f)].plane ==
            solid.cells.facets()[static_cast<std::size_t>(sheet[0])].plane);
}
