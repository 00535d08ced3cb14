// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <map>

#include "parallel.h"
#include "support/space.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

const SpaceStages& table_stages() {
  static const SpaceStages stages = run_space(seen_from(table_room_sides(), {kScanner}));
  return stages;
}

const space::LabelledSpace& table_space() {
  static const space::LabelledSpace space = table_stages().label();
  return space;
}

space::Evidence evidence_of(const std::vector<space::Ray>& rays) {
  return space::find_evidence(table_space().arrangement, table_space().planes,
                              table_stages().outlook.covers, rays);
}

// All numbers of what rays say.
std::vector<double> sums_of(const space::Evidence& evidence) {
  std::vector<double> sums;
  for (const space::CellEvidence& c : evidence.cells)
    sums.insert(sums.end(), {c.crossed, c.start, double(c.has_viewpoint), c.front, c.back});
  for (const space::FacetEvidence& f : evidence.facets)
    sums.insert(sums.end(), {f.area, f.supported[0], f.supported[1], f.empty, f.extended,
                             double(f.is_bare), double(f.is_back)});
  for (const space::Passage& p : evidence.passages)
    sums.insert(sums.end(), {double(p.from), double(p.to), p.weight});
  return sums;
}

}  // namespace

TEST_CASE("the supported area of all facets is that of the covers") {
  const space::LabelledSpace& space = table_space();
  std::map<int, double> supported, expected;
  for (std::size_t f = 0; f < space.evidence.facets.size(); ++f) {
    const space::FacetEvidence& e = space.evidence.facets[f];
    supported[space.arrangement.cells.facets()[f].plane] += e.supported[0] + e.supported[1];
  }
  for (std::size_t p = 0; p < space.arrangement.parts.size(); ++p)
    for (const auto& part : space.arrangement.parts[p]) {
      const space::SpacePlane& plane = space.planes[static_cast<std::size_t>(part.plane)];
      if (plane.kind == space::SpacePlane::Kind::surface)
        expected[static_cast<int>(p)] +=
            table_stages().outlook.covers[static_cast<std::size_t>(plane.patch)].area;
    }
  CHECK(expected.size() >= 7);  // the room's, and the table's top
  for (const auto& [plane, area] : expected)
    if (area > 0.5) CHECK(supported[plane] == doctest::Approx(area).epsilon(0.02));
  for (const auto& [plane, area] : supported)
    if (!expected.contains(plane)) CHECK(area == 0);
}

TEST_CASE("a facet is supported on the side that its points' plane looks to, empty or neither") {
  const space::LabelledSpace& space = table_space();
  for (std::size_t f = 0; f < space.evidence.facets.size(); ++f) {
    const space::FacetEvidence& e = space.evidence.facets[f];
    const space::CellFacet& facet = space.arrangement.cells.facets()[f];
    CHECK(e.area == doctest::Approx(space.arrangement.cells.area_of(facet)));
    CHECK(e.supported[0] + e.supported[1] + e.empty <= e.area * (1 + 1e-9));
    CHECK(e.extended >= 0);
    if (e.is_bare) CHECK(e.supported[0] + e.supported[1] + e.empty + e.extended == 0);
    const Plane& plane = space.arrangement.cells.plane(facet.plane);
    // All look to the scanner.
    const std::size_t side = plane.signed_distance(kScanner) > 0 ? 0 : 1;
    CHECK(e.supported[1 - side] == 0);
  }
}

TEST_CASE("cells sum what is supported around them") {
  const space::LabelledSpace& space = table_space();
  double front = 0, back = 0, supported = 0, volume = 0;
  for (const space::CellEvidence& c : space.evidence.cells)
    front += c.front, back += c.back, volume += c.volume;
  for (const space::FacetEvidence& f : space.evidence.facets)
    supported += f.supported[0] + f.supported[1];
  CHECK(front == doctest::Approx(supported));
  CHECK(back == doctest::Approx(supported));
  CHECK(volume ==
        doctest::Approx(grown(Box3(Vec3::Zero(), kRoomSize), space::ArrangeOptions{}.pad).volume())
            .epsilon(0.03));
}

TEST_CASE("the sums of rays hang neither on threads nor on the rays' order") {
  std::vector<space::Ray> rays = table_stages().outlook.rays;
  // So many that they are summed in several parts.
  const std::vector<space::Ray> once = rays;
  for (int k = 0; k < 3; ++k) rays.insert(rays.end(), once.begin(), once.end());
  const std::vector<double> sums = sums_of(evidence_of(rays));
  Random random(5);
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    shuffle(rays, random);
    CHECK(sums_of(evidence_of(rays)) == sums);
  }
  rays.pop_back();
  CHECK(sums_of(evidence_of(rays)) != sums);
}

TEST_CASE("what crosses a cell has come from a cell, or begins there") {
  std::vector<space::Ray> rays = table_stages().outlook.rays;
  for (space::Ray& ray : rays) ray.from_viewpoint = false;
  const space::Evidence evidence = evidence_of(rays);
  std::vector<double> coming(evidence.cells.size());
  for (std::size_t i = 0; i < evidence.passages.size(); ++i) {
    const space::Passage& p = evidence.passages[i];
    CHECK(p.from != p.to);
    CHECK(p.weight > 0);
    if (i > 0) {
      const space::Passage& before = evidence.passages[i - 1];
      CHECK(std::pair(before.from, before.to) < std::pair(p.from, p.to));
    }
    coming[static_cast<std::size_t>(p.to)] += p.weight;
  }
  double start = 0, weight = 0;
  for (std::size_t c = 0; c < coming.size(); ++c) {
    const space::CellEvidence& e = evidence.cells[c];
    CHECK_FALSE(e.has_viewpoint);
    CHECK(e.crossed == doctest::Approx(coming[c] + e.start));
    start += e.start;
  }
  for (const space::Ray& ray : rays) weight += ray.weight;
  CHECK(start == doctest::Approx(weight));
}

TEST_CASE("the scanner's cell is known, and rays pass no plane that they end at") {
  const space::LabelledSpace& space = table_space();
  const int home = space.arrangement.cells.cell_at(kScanner);
  for (std::size_t c = 0; c < space.evidence.cells.size(); ++c)
    CHECK(space.evidence.cells[c].has_viewpoint == (static_cast<int>(c) == home));
  for (std::size_t c = 0; c < space.evidence.cells.size(); ++c) {
    // No cell behind a wall is crossed: their corners are all outside of the room.
    bool is_outside = true;
    for (const int f : space.arrangement.cells.cells()[c].facets)
      for (const int v : space.arrangement.cells.facets()[static_cast<std::size_t>(f)].vertices)
        is_outside = is_outside && !grown(Box3(Vec3::Zero(), kRoomSize), -0.05)
                                        .contains(space.arrangement.cells.vertex(v));
    Vec3 middle = Vec3::Zero();
    int corners = 0;
    for (const int f : space.arrangement.cells.cells()[c].facets)
      for (const int v : space.arrangement.cells.facets()[static_cast<std::size_t>(f)].vertices)
        middle += space.arrangement.cells.vertex(v), ++corners;
    if (is_outside && !Box3(Vec3::Zero(), kRoomSize).contains(middle / corners))
      CHECK(space.evidence.cells[c].crossed == 0);
  }
}

TEST_CASE("a facet is a plate's back only where many rays go behind it") {
  const space::LabelledSpace& space = table_space();
  int backs = 0;
  for (std::size_t f = 0; f < space.evidence.facets.size(); ++f) {
    if (!space.evidence.facets[f].is_back) continue;
    ++backs;
    const space::CellFacet& facet = space.arrangement.cells.facets()[f];
    bool is_of_back = false, is_seen = false;
    for (const auto& part : space.arrangement.parts[static_cast<std::size_t>(facet.plane)]) {
      if (space.planes[static_cast<std::size_t>(part.plane)].kind != space::SpacePlane::Kind::back)
        continue;
      is_of_back = true;
      const int behind = facet.cells[part.is_flipped ? 1 : 0];
      is_seen |= space.evidence.cells[static_cast<std::size_t>(behind)].seen() >= 0.5;
    }
    CHECK(is_of_back);
    CHECK(is_seen);
  }
  CHECK(backs > 0);
  for (const space::FacetEvidence& f : evidence_of({}).facets) CHECK_FALSE(f.is_back);
}
