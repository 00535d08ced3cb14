// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "exact.h"

#include <fmt/format.h>

#include <cmath>
#include <numeric>

#include "../error.h"

namespace scanworld::space {
namespace {

__extension__ typedef unsigned __int128 UInt128;

constexpr double kLargest = 1 << 20;  // of a normal's components
constexpr double kLargestOffset = 0x1p62;
constexpr double kFinestUnit = 1.0 / 1024;  // [m]
constexpr double kUnitsInRadius = 1 << 17;

struct Cross {
  std::int64_t x, y, z;
};

Cross cross(const ExactPlane& p, const ExactPlane& q) {
  return {p.b * q.c - p.c * q.b, p.c * q.a - p.a * q.c, p.a * q.b - p.b * q.a};
}

// b > 0.
std::int64_t common_divisor(Int128 a, std::int64_t b) {
  const auto size = static_cast<UInt128>(a < 0 ? -a : a);
  return std::gcd(static_cast<std::int64_t>(size % static_cast<UInt128>(b)), b);
}

}  // namespace

double unit_for(double radius) {
  double unit = kFinestUnit;
  while (unit * kUnitsInRadius < radius) unit *= 2;
  return unit;
}

ExactPlane exact_plane(const Plane& plane, double unit) {
  // With the largest component at the limit, a plane that was rounded before stays as it is.
  const Vec3 scaled = plane.normal * (kLargest / plane.normal.cwiseAbs().maxCoeff());
  const Vec3 normal = scaled.unaryExpr([](double v) { return std::round(v); });
  const double length = normal.norm(), offset = std::round(plane.offset / unit * length);
  if (!(std::abs(offset) <= kLargestOffset))
    throw Error(Cause::bad_input, fmt::format("a plane is {} m from the middle of the place, which "
                                              "is on no planet of ours",
                                              std::abs(plane.offset)));
  return {static_cast<std::int64_t>(normal.x()), static_cast<std::int64_t>(normal.y()),
          static_cast<std::int64_t>(normal.z()), static_cast<std::int64_t>(offset),
          Plane{normal / length, offset / length * unit}};
}

// Cramer's rule.
std::optional<ExactPoint> meet(const ExactPlane& p, const ExactPlane& q, const ExactPlane& r) {
  const Cross qr = cross(q, r), rp = cross(r, p), pq = cross(p, q);
  const std::int64_t w = p.a * qr.x + p.b * qr.y + p.c * qr.z;
  if (w == 0) return std::nullopt;
  const Int128 sign = w < 0 ? 1 : -1;  // of the numerators, so that w is positive
  const auto numerator = [&](std::int64_t of_qr, std::int64_t of_rp, std::int64_t of_pq) {
    return sign * (Int128(p.d) * of_qr + Int128(q.d) * of_rp + Int128(r.d) * of_pq);
  };
  ExactPoint out{numerator(qr.x, rp.x, pq.x), numerator(qr.y, rp.y, pq.y),
                 numerator(qr.z, rp.z, pq.z), w < 0 ? -w : w};
  std::int64_t divisor = common_divisor(out.x, out.w);
  if (divisor > 1) divisor = common_divisor(out.y, divisor);
  if (divisor > 1) divisor = common_divisor(out.z, divisor);
  if (divisor > 1) {
    out.x /= divisor;
    out.y /= divisor;
    out.z /= divisor;
    out.w /= divisor;
  }
  return out;
}

int side_of(const ExactPlane& plane, const ExactPoint& point) {
  const Int128 value =
      plane.a * point.x + plane.b * point.y + plane.c * point.z + Int128(plane.d) * point.w;
  return (value > 0) - (value < 0);
}

Vec3 place_of(const ExactPoint& point, double unit) {
  const auto w = static_cast<double>(point.w);
  return Vec3(static_cast<double>(point.x) / w, static_cast<double>(point.y) / w,
              static_cast<double>(point.z) / w) *
         unit;
}

}  // namespace scanworld::space
