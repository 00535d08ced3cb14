// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/label_cells.h"

#include "support/cells.h"
#include "support/space.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

space::Label label_at(const space::LabelledSpace& space, const Vec3& place) {
  return space.labels[static_cast<std::size_t>(space.arrangement.cells.cell_at(place))];
}

// What all labels cost, as the fields of LabelOptions say.
double energy_of(const space::CellComplex& cells, const space::Evidence& evidence,
                 const std::vector<space::Label>& labels, const space::LabelOptions& o) {
  const auto is_free = [&](int c) {
    return labels[static_cast<std::size_t>(c)] == space::Label::free;
  };
  double sum = 0;
  for (std::size_t c = 0; c < labels.size(); ++c) {
    const space::CellEvidence& e = evidence.cells[c];
    if (labels[c] != space::Label::free)
      sum += o.front * e.front + e.start + (e.has_viewpoint ? 1e4 : 0);
    else
      sum += (1 - e.seen()) * o.volume * e.volume;
    if (labels[c] != space::Label::solid) sum += o.back * e.back;
  }
  for (std::size_t f = 0; f < evidence.facets.size(); ++f) {
    const space::CellFacet& facet = cells.facets()[f];
    const auto [a, b] = facet.cells;
    if (a < 0 || b < 0) {
      const auto c = static_cast<std::size_t>(std::max(a, b));
      if (labels[c] == space::Label::free)
        sum += evidence.facets[f].area *
               std::max(o.border_crossed, o.border * (1 - evidence.cells[c].seen()));
    } else if (is_free(a) != is_free(b)) {
      const std::size_t side = is_free(a) ? 0 : 1;
      sum += space::price_of(facet, evidence.facets[f], side,
                             labels[static_cast<std::size_t>(facet.cells[1 - side])], o);
    }
  }
  for (const space::Passage& p : evidence.passages)
    if (is_free(p.from) && !is_free(p.to)) sum += p.weight;
  return sum;
}

// Points, rays and holes by chance.
space::Evidence random_evidence(Random& random, const space::CellComplex& cells) {
  space::Evidence evidence = bare_evidence(cells);
  const auto chance = [&] { return random.uniform() < 0.3; };
  for (std::size_t f = 0; f < evidence.facets.size(); ++f) {
    space::FacetEvidence& e = evidence.facets[f];
    const space::CellFacet& facet = cells.facets()[f];
    if (facet.cells[0] < 0 || facet.cells[1] < 0) continue;
    e.is_bare = chance();
    if (e.is_bare) continue;
    const std::size_t side = random.whole(0, 1) == 0 ? 0 : 1;
    e.supported[side] = chance() ? random.uniform(0, 0.7) * e.area : 0;
    e.empty = chance() ? random.uniform(0, 0.3) * e.area : 0;
    e.extended = random.uniform(0, 2) * (e.area - e.supported[side] - e.empty);
    for (const std::size_t s : {0, 1}) {
      space::CellEvidence& cell = evidence.cells[static_cast<std::size_t>(facet.cells[s])];
      cell.front += e.supported[s], cell.back += e.supported[1 - s];
    }
    if (chance()) {
      const double weight = random.uniform(0, 1);
      evidence.passages.push_back({facet.cells[0], facet.cells[1], weight});
      for (const int c : facet.cells) evidence.cells[static_cast<std::size_t>(c)].crossed += weight;
    }
  }
  for (space::CellEvidence& c : evidence.cells) {
    c.around = 10;
    c.start = chance() ? random.uniform(0, 1) : 0;
  }
  evidence.cells[static_cast<std::size_t>(random.whole(0, int(cells.cells().size()) - 1))]
      .has_viewpoint = true;
  return evidence;
}

space::CellComplex small_complex(Random& random, int planes) {
  space::CellComplex cells(kCellBox);
  for (int k = 0; k < planes; ++k)
    split_all(cells, plane_through(random_place(random, kCellBox), random.direction()));
  return cells;
}

}  // namespace

TEST_CASE("a room that was scanned from inside is free, what is behind its walls solid") {
  LabelledScan without;  // viewpoints
  for (const RoomSide& side : room_sides()) without.add(side.corner, side.a, side.b);
  for (const LabelledScan& scan : {seen_from(room_sides(), {kScanner}), without}) {
    const space::LabelledSpace space = run_space(scan).label();
    const Box3 room(Vec3::Zero(), kRoomSize);
    Random random(6);
    for (int k = 0; k < 500; ++k)
      CHECK(label_at(space, random_place(random, grown(room, -0.02))) == space::Label::free);
    for (int k = 0; k < 500; ++k) {
      // Just behind a wall.
      Vec3 place = random_place(random, room);
      const int axis = random.whole(0, 2);
      place[axis] = random.whole(0, 1) == 0 ? -0.05 : kRoomSize[axis] + 0.05;
      CHECK(label_at(space, place) == space::Label::solid);
    }
    for (std::size_t c = 0; c < space.labels.size(); ++c) {
      if (space.labels[c] == space::Label::free) continue;
      bool is_beside = false;
      for (const int f : space.arrangement.cells.cells()[c].facets)
        for (const int other : space.arrangement.cells.facets()[static_cast<std::size_t>(f)].cells)
          is_beside |=
              other >= 0 && space.labels[static_cast<std::size_t>(other)] == space::Label::free;
      // Deep behind nothing is known.
      CHECK((space.labels[c] == space::Label::solid) == is_beside);
    }
  }
}

TEST_CASE("what is hidden under a table is free, with a table top over it") {
  const space::LabelledSpace space = run_space(seen_from(table_room_sides(), {kScanner})).label();
  for (double x = 2.1; x < 3.9; x += 0.2)
    CHECK(label_at(space, {x, 1.4, 0.2}) == space::Label::free);
  CHECK(label_at(space, {2.6, 1.4, kTableTop.center().z()}) == space::Label::solid);
  CHECK(label_at(space, {2.6, 1.4, 1}) == space::Label::free);
  CHECK(label_at(space, {1, 1.5, -0.05}) == space::Label::solid);  // under the scanner
}

TEST_CASE("nobody falls out of a room behind what hides its floor") {
  // A board that one sees over: of the floor between it and the wall behind it nothing is seen.
  const Vec3 room(6, 4, 2.5);
  for (const double height : {0.7, 1.1}) {
    std::vector<RoomSide> sides = box_sides(Vec3::Zero(), room, true);
    sides.push_back({{4.5, 0.5, 0}, {0, 3, 0}, {0, 0, height}});
    const space::LabelledSpace space = run_space(seen_from(sides, {{1, 2, 1.5}})).label();
    for (double x = 4.9; x < room.x(); x += 0.2) {
      if (height < 1)
        CHECK(label_at(space, {x, 2, 0.1}) == space::Label::free);
      else
        CHECK(label_at(space, {x, 2, 0.1}) != space::Label::unknown);
      CHECK(label_at(space, {x, 2, -0.05}) == space::Label::solid);
    }
  }
}

TEST_CASE("a single view stays open to where the camera is: no surface is there") {
  // A floor and two walls, seen from where there are no others.
  const Vec3 camera(3.5, 3.5, 1.5);
  const std::vector<RoomSide> sides = {{{0, 0, 0}, {2.5, 0, 0}, {0, 2.5, 0}},
                                       {{0, 0, 0}, {2.5, 0, 0}, {0, 0, 2.5}},
                                       {{0, 0, 0}, {0, 2.5, 0}, {0, 0, 2.5}}};
  const space::LabelledSpace space = run_space(seen_from(sides, {camera}, -90 * kDegree)).label();
  CHECK(label_at(space, camera) == space::Label::free);
  CHECK(label_at(space, {1.2, 1.2, 1.2}) == space::Label::free);
  for (const Vec3& behind : {Vec3(1.2, 1.2, -0.1), Vec3(1.2, -0.1, 1.2), Vec3(-0.1, 1.2, 1.2)})
    CHECK(label_at(space, behind) == space::Label::solid);
  int shown = 0;
  for (std::size_t f = 0; f < space.evidence.facets.size(); ++f) {
    const space::CellFacet& facet = space.arrangement.cells.facets()[f];
    if (facet.cells[0] < 0 || facet.cells[1] < 0) continue;
    const auto one = space.labels[static_cast<std::size_t>(facet.cells[0])],
               other = space.labels[static_cast<std::size_t>(facet.cells[1])];
    if (std::minmax({one, other}) != std::pair(space::Label::free, space::Label::solid)) continue;
    const Vec3 middle = space.arrangement.cells.middle_of(facet);
    CHECK(middle.minCoeff() < 0.01);  // in one of the three planes, or behind it
    ++shown;
  }
  CHECK(shown >= 3);
}

TEST_CASE("more rounds never cost more, and no labels by chance cost less than those found") {
  Random random(8);
  for (int turn = 0; turn < 40; ++turn) {
    const space::CellComplex cells = small_complex(random, 3);
    const space::Evidence evidence = random_evidence(random, cells);
    double before = 1e300;
    for (int rounds = 1; rounds <= 5; ++rounds) {
      const space::LabelOptions options{.rounds = rounds};
      const double energy =
          energy_of(cells, evidence, space::label_cells(cells, evidence, options), options);
      CHECK(energy <= before + 1e-3);
      before = energy;
    }
    // Of those that take as solid what the answer takes as solid, the cut is the best.
    const std::vector<space::Label> found = space::label_cells(cells, evidence, {.rounds = 20});
    before = energy_of(cells, evidence, found, {});
    for (int k = 0; k < 300; ++k) {
      std::vector<space::Label> other = found;
      for (space::Label& label : other)
        if (label != space::Label::free && random.uniform() < 0.2) label = space::Label::free;
      CHECK(energy_of(cells, evidence, other, {}) >= before - 1e-3);
      other = found;
      for (space::Label& label : other)
        if (label != space::Label::free && random.uniform() < 0.2)
          label = label == space::Label::solid ? space::Label::unknown : space::Label::solid;
      CHECK(energy_of(cells, evidence, other, {}) >= before - 1e-3);
    }
  }
}

TEST_CASE("a viewpoint's cell is free, whatever else is said of it") {
  Random random(9);
  for (int turn = 0; turn < 40; ++turn) {
    const space::CellComplex cells = small_complex(random, 4);
    const space::Evidence evidence = random_evidence(random, cells);
    const std::vector<space::Label> labels = space::label_cells(cells, evidence);
    for (std::size_t c = 0; c < labels.size(); ++c)
      if (evidence.cells[c].has_viewpoint) CHECK(labels[c] == space::Label::free);
  }
}

TEST_CASE("without any evidence nothing is free and nothing solid") {
  Random random(10);
  const space::CellComplex cells = small_complex(random, 4);
  for (const space::Label label : space::label_cells(cells, bare_evidence(cells)))
    CHECK(label == space::Label::unknown);
}

TEST_CASE("a surface is cheapest where it was seen from its free side, dearest where it is empty") {
  space::CellFacet facet;
  facet.cells = {0, 1};
  const auto price = [&](const space::FacetEvidence& e, std::size_t side, space::Label other) {
    return space::price_of(facet, e, side, other);
  };
  const auto solid = space::Label::solid, unknown = space::Label::unknown;
  const space::FacetEvidence seen{.area = 1, .supported = {1, 0}, .is_bare = false},
      empty{.area = 1, .empty = 1, .is_bare = false},
      near{.area = 1, .extended = 0.1, .is_bare = false},
      far{.area = 1, .extended = 1, .is_bare = false}, bare{.area = 1},
      plate{.area = 1, .is_back = true};
  CHECK(price(seen, 0, solid) < price(near, 0, solid));
  CHECK(price(near, 0, solid) < price(far, 0, solid));
  CHECK(price(far, 0, solid) < price(bare, 0, solid));
  CHECK(price(bare, 0, solid) < price(seen, 1, solid));
  CHECK(price(seen, 1, solid) < price(empty, 0, solid));
  CHECK(price(plate, 0, solid) < price(bare, 0, solid));
  CHECK(price(bare, 0, unknown) < price(bare, 0, solid));  // an open side is, in the open ...
  CHECK(price(near, 0, unknown) > price(near, 0, solid));  // ... a surface where a plane goes on
  CHECK(price(empty, 0, unknown) == 0);
  // A floor goes on, with what is free over it; under it that is no floor.
  const space::FacetEvidence floor{.area = 1, .extended = 0.5, .is_bare = false, .floor = 0};
  CHECK(price(floor, 0, unknown) > price(near, 0, unknown));
  CHECK(price(floor, 1, unknown) == price(near, 1, unknown));
  // Nobody may fall out of a room.
  const space::FacetEvidence above{.area = 1, .over_floor = 0};
  CHECK(price(above, 0, unknown) > price(bare, 0, unknown));
  CHECK(price(above, 1, unknown) == price(bare, 1, unknown));
  facet.cells = {-1, 1};
  CHECK(price(bare, 1, solid) == 0);
}

TEST_CASE("a slit in what is solid is solid, wider gaps and narrow cells of an opening are not") {
  // A box of 2 m with a layer between two others.
  for (const double height : {0.005, 0.02})
    for (const space::Label above : {space::Label::solid, space::Label::free})
      for (const space::Label layer : {space::Label::free, space::Label::unknown}) {
        space::CellComplex cells(Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
        for (const double top : {0.0, height})
          cells.split(cells.cell_at({0, 0, 0.999}), cells.add_plane({Vec3::UnitZ(), -top}).plane);
        std::vector<space::Label> labels(cells.cells().size(), space::Label::solid);
        const auto slit = static_cast<std::size_t>(cells.cell_at({0, 0, height / 2}));
        labels[slit] = layer;
        labels[static_cast<std::size_t>(cells.cell_at({0, 0, 0.5}))] = above;
        auto expected = labels;
        if (height < 0.01 && above == space::Label::solid) expected[slit] = space::Label::solid;
        CHECK(space::fill_slits(cells, bare_evidence(cells), labels) == expected);
      }
}

TEST_CASE("a free pocket too small to be in is solid, if no viewpoint is in it") {
  // A box of 2 m, of which a layer is free between what is not.
  for (const double height : {0.005, 0.5})
    for (const bool has_viewpoint : {false, true}) {
      space::CellComplex cells(Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)));
      for (const double top : {0.0, height})
        cells.split(cells.cell_at({0, 0, 0.999}), cells.add_plane({Vec3::UnitZ(), -top}).plane);
      space::Evidence evidence = bare_evidence(cells);
      const auto pocket = static_cast<std::size_t>(cells.cell_at({0, 0, height / 2}));
      evidence.cells[pocket].has_viewpoint = has_viewpoint;
      std::vector<space::Label> labels(cells.cells().size(), space::Label::unknown);
      labels[pocket] = space::Label::free;
      const bool is_kept = has_viewpoint || height > 0.1;
      const auto filled = space::fill_pockets(cells, evidence, labels);
      CHECK(filled[pocket] == (is_kept ? space::Label::free : space::Label::solid));
      for (std::size_t c = 0; c < labels.size(); ++c)
        if (c != pocket) CHECK(filled[c] == space::Label::unknown);
    }
}
