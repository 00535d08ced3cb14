// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space/interfaces.h"

#include <map>
#include <set>

#include "polygon.h"
#include "support/cells.h"
#include "support/space.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

using Place = std::array<double, 3>;

Place key_at(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

// Cells by where their middle is.
std::vector<space::Label> labels_by(const space::CellComplex& cells,
                                    const std::function<space::Label(const Vec3&)>& label_of) {
  std::vector<space::Label> labels;
  for (const space::Cell& cell : cells.cells()) {
    std::set<int> corners;
    for (const int f : cell.facets)
      for (const int v : cells.facets()[static_cast<std::size_t>(f)].vertices) corners.insert(v);
    Vec3 middle = Vec3::Zero();
    for (const int v : corners) middle += cells.vertex(v) / static_cast<double>(corners.size());
    labels.push_back(label_of(middle));
  }
  return labels;
}

space::Label free_if(bool is_free) { return is_free ? space::Label::free : space::Label::solid; }

// The box cut by planes square to the axes.
space::CellComplex grid_complex(const std::array<std::vector<double>, 3>& at) {
  space::CellComplex cells(kCellBox);
  for (int axis = 0; axis < 3; ++axis)
    for (const double x : at[static_cast<std::size_t>(axis)])
      split_all(cells, plane_through(x * Vec3::Unit(axis), Vec3::Unit(axis)));
  return cells;
}

std::vector<space::Interface> interfaces_of(const space::CellComplex& cells,
                                            const std::vector<space::Label>& labels,
                                            const space::InterfaceOptions& options = {}) {
  return space::find_interfaces(cells, bare_evidence(cells), labels, options);
}

Plane plane_of(const space::CellComplex& cells, const space::Interface& shown) {
  const Plane& plane = cells.plane(shown.plane);
  return shown.is_flipped ? plane.flipped() : plane;
}

// The area of a loop about a normal, less than 0 where it is clockwise.
double signed_area(const std::vector<Vec3>& loop, const Vec3& normal) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 2; i < loop.size(); ++i)
    sum += (loop[i - 1] - loop[0]).cross(loop[i] - loop[0]);
  return normal.dot(sum) / 2;
}

// Loops are planar, do not touch themselves or each other, and turn the right way. Corners may be
// moved [m].
void check_loops(const space::CellComplex& cells, const std::vector<space::Interface>& all,
                 double moved = 0) {
  for (const space::Interface& shown : all) {
    const Plane plane = plane_of(cells, shown);
    const PlaneFrame frame = frame_of(plane);
    std::set<Place> corners;
    std::size_t count = 0;
    double area = 0, outline = 0;
    std::vector<std::pair<Vec2, Vec2>> edges;
    for (std::size_t k = 0; k < shown.loops.size(); ++k) {
      const std::vector<Vec3>& loop = shown.loops[k];
      REQUIRE(loop.size() >= 3);
      CHECK((signed_area(loop, plane.normal) > 0) == (k == 0));
      area += signed_area(loop, plane.normal);
      count += loop.size();
      for (std::size_t i = 0; i < loop.size(); ++i) {
        corners.insert(key_at(loop[i]));
        CHECK(std::abs(plane.signed_distance(loop[i])) < 1e-5 + moved);
        edges.emplace_back(frame.to_plane(loop[i]), frame.to_plane(loop[(i + 1) % loop.size()]));
        outline += (edges.back().second - edges.back().first).norm();
      }
    }
    CHECK(corners.size() == count);
    CHECK(std::abs(area - shown.area) < 1e-4 * (1 + std::max(area, shown.area)) + moved * outline);
    const auto cross = [](const Vec2& a, const Vec2& b) { return a.x() * b.y() - a.y() * b.x(); };
    int crossings = 0;
    for (std::size_t i = 0; i < edges.size(); ++i)
      for (std::size_t k = i + 1; k < edges.size(); ++k) {
        const auto& [a, b] = edges[i];
        const auto& [c, d] = edges[k];
        crossings += cross(b - a, c - a) * cross(b - a, d - a) < -1e-12 &&
                     cross(d - c, a - c) * cross(d - c, b - c) < -1e-12;
      }
    CHECK(crossings == 0);
  }
}

// Every edge is used as often one way as the other.
void check_closed(const std::vector<space::Interface>& all, bool is_simple) {
  std::map<std::pair<Place, Place>, int> uses;
  for (const space::Interface& shown : all)
    for (const auto& loop : shown.loops)
      for (std::size_t i = 0; i < loop.size(); ++i)
        ++uses[{key_at(loop[i]), key_at(loop[(i + 1) % loop.size()])}];
  CHECK_FALSE(uses.empty());
  std::size_t open = 0;
  for (const auto& [edge, count] : uses) {
    const auto back = uses.find({edge.second, edge.first});
    open += back == uses.end() || back->second != count;
    if (is_simple) CHECK(count == 1);
  }
  CHECK(open == 0);
}

double area_of_all(const std::vector<space::Interface>& all) {
  double sum = 0;
  for (const space::Interface& shown : all) sum += shown.area;
  return sum;
}

}  // namespace

TEST_CASE("a free cell among solid ones has a closed surface that looks inside") {
  const space::CellComplex cells = grid_complex({{{-1, 2}, {0, 2.5}, {-0.5, 1}}});
  const Box3 room(Vec3(-1, 0, -0.5), Vec3(2, 2.5, 1));
  const auto shown = interfaces_of(
      cells, labels_by(cells, [&](const Vec3& p) { return free_if(room.contains(p)); }));
  REQUIRE(shown.size() == 6);
  check_loops(cells, shown);
  check_closed(shown, true);
  const Vec3 size = room.sizes();
  CHECK(area_of_all(shown) ==
        doctest::Approx(2 * (size.x() * size.y() + size.y() * size.z() + size.z() * size.x())));
  for (const space::Interface& i : shown) {
    CHECK(plane_of(cells, i).signed_distance(room.center()) > 0);
    CHECK(i.loops.size() == 1);
    CHECK(i.loops[0].size() == 4);
    CHECK(i.supported == 0);
  }
}

TEST_CASE("facets of one plane are one surface, its corners where others meet it alone") {
  // Planes through the room that part free from free.
  const space::CellComplex cells = grid_complex({{{-1, 0, 1, 2}, {0, 1, 2.5}, {-0.5, 0.2, 1}}});
  const Box3 room(Vec3(-1, 0, -0.5), Vec3(2, 2.5, 1));
  const auto shown = interfaces_of(
      cells, labels_by(cells, [&](const Vec3& p) { return free_if(room.contains(p)); }));
  REQUIRE(shown.size() == 6);
  check_closed(shown, true);
  for (const space::Interface& i : shown) {
    CHECK(i.facets.size() >= 4);
    CHECK(i.loops[0].size() == 4);
  }
}

TEST_CASE("a hole in a wall is a loop of it, and the border of all is never shown") {
  const space::CellComplex cells = grid_complex({{{1}, {0, 2}, {0, 1}}});
  const Box3 hole(Vec3(-3, 0, 0), Vec3(1, 2, 1));
  const auto shown = interfaces_of(cells, labels_by(cells, [&](const Vec3& p) {
                                     return free_if(p.x() > 1 || hole.contains(p));
                                   }));
  REQUIRE(shown.size() == 5);  // the wall, and the sides of the hole
  check_loops(cells, shown);
  for (const space::Interface& i : shown) {
    const bool is_wall = std::abs(cells.plane(i.plane).normal.x()) > 0.5;
    CHECK(i.loops.size() == (is_wall ? 2 : 1));
    CHECK(i.area == doctest::Approx(is_wall                                           ? 6 * 3 - 2
                                    : std::abs(cells.plane(i.plane).normal.y()) > 0.5 ? 4
                                                                                      : 8));
  }
}

TEST_CASE("sheets that touch in corners alone are apart") {
  const space::CellComplex cells = grid_complex({{{1}, {0, 2}, {0, 1}}});
  const auto is_wall = [](const Vec3& p) {
    const int column = p.y() < 0 ? 0 : p.y() < 2 ? 1 : 2, row = p.z() < 0 ? 0 : p.z() < 1 ? 1 : 2;
    return (column + row) % 2 == 0;
  };
  const auto all = interfaces_of(
      cells, labels_by(cells, [&](const Vec3& p) { return free_if(p.x() > 1 || !is_wall(p)); }));
  check_loops(cells, all);
  int sheets = 0;
  for (const space::Interface& i : all) sheets += std::abs(cells.plane(i.plane).normal.x()) > 0.5;
  CHECK(sheets == 5);
}

TEST_CASE("a sheet that touches itself in a corner is parted there") {
  const space::CellComplex cells = grid_complex({{{1}, {0, 1, 2}, {-0.5, 0, 0.5}}});
  // A ring of fields that lacks one of its corners, where it touches itself.
  const auto is_wall = [](const Vec3& p) {
    const int column = p.y() < 0   ? 0
                       : p.y() < 1 ? 1
                       : p.y() < 2 ? 2
                                   : 3,
              row = p.z() < -0.5  ? 0
                    : p.z() < 0   ? 1
                    : p.z() < 0.5 ? 2
                                  : 3;
    if (column > 2 || row > 2) return false;
    return !(column == 1 && row == 1) && !(column == 0 && row == 2);
  };
  const auto all = interfaces_of(
      cells, labels_by(cells, [&](const Vec3& p) { return free_if(p.x() > 1 || !is_wall(p)); }));
  check_loops(cells, all);
  int sheets = 0;
  for (const space::Interface& i : all) sheets += std::abs(cells.plane(i.plane).normal.x()) > 0.5;
  CHECK(sheets == 2);
}

TEST_CASE("surfaces of cells labelled by chance are closed, simple and planar") {
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    Random random(seed);
    space::CellComplex cells(kCellBox);
    if (seed % 2 == 0) {
      cells = random_complex(seed, kCellBox, 80);
    } else {
      cells = grid_complex({{{-1, 0, 1, 3}, {-1, 0, 1, 2.5}, {-0.5, 0, 1}}});
    }
    std::vector<space::Label> labels;
    for (const space::Cell& cell : cells.cells()) {
      const bool is_border = std::any_of(cell.facets.begin(), cell.facets.end(), [&](int f) {
        return cells.facets()[static_cast<std::size_t>(f)].plane < space::CellComplex::kBoxPlanes;
      });
      labels.push_back(free_if(!is_border && random.uniform() < 0.5));
    }
    const auto shown = interfaces_of(cells, labels, {.same = 0, .min_area = 0});
    CHECK(shown.size() > 5);
    check_closed(shown, false);
    check_loops(cells, interfaces_of(cells, labels, {.same = 2e-6}));
    check_loops(cells, interfaces_of(cells, labels), space::InterfaceOptions{}.same);
    double expected = 0;
    for (const space::CellFacet& f : cells.facets())
      if (f.cells[0] >= 0 && f.cells[1] >= 0 &&
          labels[static_cast<std::size_t>(f.cells[0])] !=
              labels[static_cast<std::size_t>(f.cells[1])])
        expected += cells.area_of(f);
    CHECK(area_of_all(shown) == doctest::Approx(expected));
  }
}

TEST_CASE(
    "only what is between free and solid is shown, and not where it is more than half empty") {
  const space::CellComplex cells = grid_complex({{{1}, {}, {}}});
  space::Evidence evidence = bare_evidence(cells);
  const auto count = [&](space::Label left, space::Label right) {
    const auto labels = labels_by(cells, [&](const Vec3& p) { return p.x() < 1 ? left : right; });
    return space::find_interfaces(cells, evidence, labels).size();
  };
  for (const auto left : {space::Label::free, space::Label::solid, space::Label::unknown})
    for (const auto right : {space::Label::free, space::Label::solid, space::Label::unknown})
      CHECK(count(left, right) ==
            (std::minmax({left, right}) == std::pair(space::Label::free, space::Label::solid)));
  for (const double share : {0.4, 0.6}) {
    for (space::FacetEvidence& e : evidence.facets) e.empty = share * e.area;
    CHECK(count(space::Label::free, space::Label::solid) == (share < 0.5));
  }
}

TEST_CASE("a surface says how much of it was seen from its free side") {
  const space::CellComplex cells = grid_complex({{{1}, {}, {}}});
  space::Evidence evidence = bare_evidence(cells);
  for (space::FacetEvidence& e : evidence.facets) e.supported = {3, 1};
  for (const bool is_right : {true, false}) {
    const auto shown = space::find_interfaces(cells, evidence, labels_by(cells, [&](const Vec3& p) {
                                                return free_if((p.x() > 1) == is_right);
                                              }));
    REQUIRE(shown.size() == 1);
    CHECK(plane_of(cells, shown[0]).normal.x() == doctest::Approx(is_right ? 1 : -1));
    CHECK(shown[0].supported == (is_right ? 3 : 1));
    check_loops(cells, shown);
  }
}
