// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/trace_loops.h"

#include <set>

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

constexpr int kSize = 12;  // squares along each axis

Vec2 place(int v) { return {v % (kSize + 1), v / (kSize + 1)}; }

// The edges of unit squares, counter-clockwise.
std::vector<HalfEdge> edges_of(const std::vector<int>& squares) {
  std::vector<HalfEdge> edges;
  for (int s : squares) {
    const int v = s / kSize * (kSize + 1) + s % kSize;
    const std::array<int, 4> ring = {v, v + 1, v + kSize + 2, v + kSize + 1};
    for (std::size_t k = 0; k < 4; ++k) edges.push_back({ring[k], ring[(k + 1) % 4], s});
  }
  return edges;
}

double area_of(const std::vector<HalfEdge>& edges, const std::vector<std::size_t>& loop) {
  double sum = 0;
  for (std::size_t e : loop) {
    const Vec2 p = place(edges[e].from), q = place(edges[e].to);
    sum += p.x() * q.y() - p.y() * q.x();
  }
  return sum / 2;
}

}  // namespace

TEST_CASE("loops around squares enclose their area, and none touches itself") {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    Random random(seed);
    std::vector<int> squares;
    for (int s = 0; s < kSize * kSize; ++s)
      if (random.whole(1, 3) > 1) squares.push_back(s);
    const std::vector<HalfEdge> edges = edges_of(squares);
    double area = 0;
    for (const auto& loop : trace_loops(edges, place)) {
      std::set<int> seen;
      for (std::size_t k = 0; k < loop.size(); ++k) {
        CHECK(seen.insert(edges[loop[k]].from).second);
        CHECK(edges[loop[k]].to == edges[loop[(k + 1) % loop.size()]].from);
      }
      area += area_of(edges, loop);
    }
    CHECK(area == doctest::Approx(static_cast<double>(squares.size())));
  }
}

TEST_CASE("a hole that touches the outline in a point is a loop of its own") {
  // A ring of eight squares without the corner opposite to nothing: the hole is in the middle.
  std::vector<int> ring;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      if ((x != 1 || y != 1) && (x != 0 || y != 0)) ring.push_back(y * kSize + x);
  const std::vector<HalfEdge> edges = edges_of(ring);
  const auto loops = trace_loops(edges, place);
  REQUIRE(loops.size() == 2);
  const double a = area_of(edges, loops[0]), b = area_of(edges, loops[1]);
  CHECK(std::max(a, b) == 8);
  CHECK(std::min(a, b) == -1);
}

TEST_CASE("edges that are walked both ways leave nothing") {
  std::vector<HalfEdge> edges = edges_of({5, 6, 17});
  for (const HalfEdge& e : edges_of({5, 6, 17})) edges.push_back({e.to, e.from});
  CHECK(trace_loops(edges, place).empty());
}
