// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "world/convex_parts.h"

#include "polygon.h"
#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;

namespace {

bool is_convex(const std::vector<Vec2>& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 a = ring[(i + 1) % ring.size()] - ring[i],
               b = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
    if (a.x() * b.y() - a.y() * b.x() <= 0) return false;
  }
  return true;
}

}  // namespace

TEST_CASE("convex polygons stay whole, also with corners on their edges") {
  const std::vector<Vec2> hexagon = {{1, 0}, {2, 0}, {3, 1}, {2, 2}, {1, 2}, {0, 1}};
  CHECK(convex_parts({hexagon}, 0.001).size() == 1);
  const geos::Rings split = {
      {{0, 0}, {1, 0}, {2, 0.0002}, {4, 0}, {4, 1}, {4, 3}, {2.5, 3}, {0, 3}}};
  const auto parts = convex_parts(split, 0.001);
  REQUIRE(parts.size() == 1);
  CHECK(parts[0].size() == 4);
}

TEST_CASE("parts are convex, few, and together the polygon") {
  Random random(9);
  for (int round = 0; round < 200; ++round) {
    geos::Rings star(1);
    const int corners = random.whole(4, 24);
    for (int i = 0; i < corners; ++i) {
      const double r = random.uniform(1, 3), angle = 2 * M_PI * i / corners;
      star[0].push_back({r * std::cos(angle), r * std::sin(angle)});
    }
    if (random.whole(0, 1)) star.push_back({{0.3, 0.2}, {0.1, -0.4}, {-0.3, 0.1}});
    if (geos::why_invalid(star)) continue;
    double whole = std::abs(doubled_area(star[0])), sum = 0;
    if (star.size() > 1) whole -= std::abs(doubled_area(star[1]));
    const auto parts = convex_parts(star, 0.001);
    for (const auto& part : parts) {
      CHECK(is_convex(part));
      sum += doubled_area(part);
    }
    CHECK(sum == doctest::Approx(whole).epsilon(0.01));
    std::size_t reflex = 0;
    for (std::size_t i = 0; i < star[0].size(); ++i) {
      const auto& ring = star[0];
      const Vec2 a = ring[(i + 1) % ring.size()] - ring[i],
                 b = ring[(i + 2) % ring.size()] - ring[(i + 1) % ring.size()];
      reflex += a.x() * b.y() - a.y() * b.x() < 0;
    }
    for (std::size_t h = 1; h < star.size(); ++h) reflex += star[h].size() + 1;
    // Hertel and Mehlhorn: no more than two cuts at each reflex corner.
    CHECK(parts.size() <= 2 * reflex + 1);
  }
}
