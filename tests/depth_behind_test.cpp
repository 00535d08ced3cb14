// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/depth_behind.h"

#include "support/space.h"

using namespace scanworld;
using namespace scanworld::test;
using space::Label;

namespace {

// A box of 2 m, of which the layers between heights 0 and each of these have their labels.
struct LabelledLayers {
  space::CellComplex cells;
  std::vector<Label> labels;
};

LabelledLayers layers_up_to(const std::vector<std::pair<double, Label>>& tops) {
  LabelledLayers result{space::CellComplex(Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1))), {}};
  for (const auto& [top, label] : tops) {
    const int plane = result.cells.add_plane({Vec3::UnitZ(), -top}).plane;
    const int cell = result.cells.cell_at({0, 0, 0.999});
    result.cells.split(cell, plane);
  }
  result.labels.assign(result.cells.cells().size(), Label::free);
  double low = -1;
  for (const auto& [top, label] : tops) {
    const int cell = result.cells.cell_at({0, 0, (low + top) / 2});
    result.labels[static_cast<std::size_t>(cell)] = label;
    low = top;
  }
  return result;
}

std::vector<space::Interface> shown_in(const LabelledLayers& in) {
  return space::find_interfaces(in.cells, bare_evidence(in.cells), in.labels);
}

}  // namespace

TEST_CASE("behind a plate it is as deep as the plate is thick") {
  for (const double thickness : {0.02, 0.1, 0.3}) {
    const LabelledLayers in = layers_up_to({{0, Label::free}, {thickness, Label::solid}});
    const auto found = shown_in(in);
    REQUIRE(found.size() == 2);
    for (const space::Interface& face : found)
      CHECK(space::depth_behind(in.cells, in.labels, face) == doctest::Approx(thickness));
  }
}

TEST_CASE("what is unknown behind what is solid counts as deep, up to the limit") {
  const LabelledLayers in = layers_up_to({{0, Label::unknown}, {0.1, Label::solid}});
  const auto found = shown_in(in);
  REQUIRE(found.size() == 1);
  CHECK(space::depth_behind(in.cells, in.labels, found[0]) == 0.5);
  CHECK(space::depth_behind(in.cells, in.labels, found[0], {.max_depth = 0.2}) == 0.2);
}
