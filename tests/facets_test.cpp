// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/facets.h"

#include <set>

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

Curve curve(CurveType type, double radius, double sweep) {
  Curve c;
  c.shape = {type, {1, 2, 3}, Vec3::UnitY(), radius};
  c.low = type == CurveType::sphere ? 0 : -1, c.high = type == CurveType::sphere ? radius : 2;
  if (type == CurveType::cone) c.shape.radius = 0, c.shape.half_angle = std::atan(radius / 2);
  if (type == CurveType::cone) c.low = 0.1;
  c.start = Vec3::UnitZ(), c.sweep = sweep;
  return c;
}

// A point on the curve, at these shares of its extent and sweep.
Vec3 point_at(const Curve& c, double height, double angle) {
  const RoundShape& s = c.shape;
  const double h = c.low + height * (c.high - c.low), a = angle * c.sweep;
  const double out =
      s.type == CurveType::sphere ? std::sqrt(s.radius * s.radius - h * h) : s.radius_at(h);
  return s.point + h * s.axis + out * (std::cos(a) * c.start + std::sin(a) * s.axis.cross(c.start));
}

}  // namespace

TEST_CASE("no point of a curve is farther from its facet than the sagitta asks for") {
  Random random(1);
  for (CurveType type : {CurveType::cylinder, CurveType::sphere, CurveType::cone})
    for (double radius : {0.3, 2.0, 5.0})
      for (double sweep : {1.0, M_PI, 2 * M_PI}) {
        CAPTURE(radius);
        CAPTURE(sweep);
        const Curve c = curve(type, radius, sweep);
        const FacetOptions options{.sagitta = 0.02, .min_turn = 0.05};
        const Facets facets(c, options);
        std::set<std::size_t> used;
        for (int i = 0; i < 4000; ++i) {
          const Vec3 p = point_at(c, random.uniform(0, 0.99), random.uniform());
          const std::size_t f = facets.of(p);
          REQUIRE(f < facets.planes().size());
          used.insert(f);
          CHECK(std::abs(facets.planes()[f].signed_distance(p)) < 1.05 * options.sagitta);
        }
        CHECK(20 * used.size() > 19 * facets.planes().size());
      }
}

TEST_CASE(
    "facets look outwards and are turned against their neighbours by no less than asked for") {
  const Facets facets(curve(CurveType::cylinder, 5, M_PI), {.sagitta = 1e-3, .min_turn = 0.2});
  const auto& planes = facets.planes();
  REQUIRE(planes.size() > 3);
  for (std::size_t k = 0; k < planes.size(); ++k) {
    CHECK(planes[k].signed_distance({1, 2, 3}) < 0);
    if (k > 0)
      CHECK(std::acos(planes[k].normal.dot(planes[k - 1].normal)) ==
            doctest::Approx(M_PI / static_cast<double>(planes.size())));
  }
  CHECK(planes.size() == 15);
}
