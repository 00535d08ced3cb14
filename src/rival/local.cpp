// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "local.h"

#include <cmath>

#include "../parallel.h"

namespace scanworld::rival {

namespace {

// The least and the middle eigenvalue of a symmetric matrix without negative ones, and the
// eigenvector of the least.
struct SymmetricFit {
  float least = 0, middle = 0;
  Vec3f normal = Vec3f::UnitZ();
};

// The least root of the characteristic polynomial by Newton's method, which comes from 0 to it
// without passing it; the others by the quadratic that is left. Several times as fast as the
// trigonometric solution.
SymmetricFit fit_symmetric(float xx, float xy, float xz, float yy, float yz, float zz) {
  const float trace = xx + yy + zz;
  SymmetricFit f;
  if (!(trace > 0)) return f;
  const float minors = xx * yy - xy * xy + xx * zz - xz * xz + yy * zz - yz * yz;
  const float det = xx * (yy * zz - yz * yz) - xy * (xy * zz - yz * xz) + xz * (xy * yz - yy * xz);
  float root = 0;
  for (int k = 0; k < 16; ++k) {
    const float value = det - root * (minors - root * (trace - root));
    const float slope = minors - root * (2 * trace - 3 * root);
    if (!(slope > 0)) break;
    const float step = value / slope;
    root += step;
    if (step <= 1e-5f * root) break;
  }
  f.least = std::max(0.f, root);
  const float rest = trace - f.least;
  const float product = minors - f.least * rest;
  f.middle = 0.5f * (rest - std::sqrt(std::max(0.f, rest * rest - 4 * product)));
  // Two rows of the matrix less the root span the plane; the widest angle tells it best.
  const Vec3f a(xx - f.least, xy, xz), b(xy, yy - f.least, yz), c(xz, yz, zz - f.least);
  const Vec3f ab = a.cross(b), bc = b.cross(c), ca = c.cross(a);
  const float nab = ab.squaredNorm(), nbc = bc.squaredNorm(), nca = ca.squaredNorm();
  const Vec3f& best = nab >= nbc && nab >= nca ? ab : nbc >= nca ? bc : ca;
  const float norm = best.norm();
  if (norm > 0) f.normal = best / norm;
  return f;
}

LocalPlane fit_at(const Grid& grid, std::span<const std::uint32_t> around, std::size_t i,
                  const Scale& scale, const LocalOptions& options) {
  LocalPlane local;
  // Relative to the site, so that floats suffice.
  const Vec3f here = grid.sites[i].mean;
  float n = 0;
  Vec3f sum = Vec3f::Zero();
  float xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  for (std::uint32_t j : around) {
    const Site& s = grid.sites[j];
    const float w = static_cast<float>(s.points);
    const Vec3f m = s.mean - here;
    const auto& c = s.covariance;
    n += w, sum += w * m;
    xx += w * (c[0] + m.x() * m.x()), xy += w * (c[1] + m.x() * m.y());
    xz += w * (c[2] + m.x() * m.z()), yy += w * (c[3] + m.y() * m.y());
    yz += w * (c[4] + m.y() * m.z()), zz += w * (c[5] + m.z() * m.z());
  }
  if (n < 4) return local;
  sum /= n;
  const SymmetricFit f = fit_symmetric(xx / n - sum.x() * sum.x(), xy / n - sum.x() * sum.y(),
                                       xz / n - sum.x() * sum.z(), yy / n - sum.y() * sum.y(),
                                       yz / n - sum.y() * sum.z(), zz / n - sum.z() * sum.z());
  local.normal = f.normal;
  const float noise = static_cast<float>(scale.noise_at(grid.sites[i].position()));
  const float square = f.least * n / (n - 3);
  const float wide = f.middle;
  const float rms = std::sqrt(square);
  local.ratio = wide / std::max(f.least, std::numeric_limits<float>::min());
  if (rms <= static_cast<float>(options.max_noise) * noise &&
      wide > static_cast<float>(options.min_ratio) * f.least &&
      std::sqrt(wide) > static_cast<float>(options.min_extent) * noise)
    local.rank = rms * (1 + 2 / std::sqrt(n));
  return local;
}

}  // namespace

std::vector<LocalPlane> fit_locally(const Grid& grid, const Neighbors& neighbors,
                                    const Scale& scale, const LocalOptions& options,
                                    std::vector<LocalPlane> planes,
                                    const std::vector<std::uint8_t>& only) {
  planes.resize(grid.sites.size());
  parallel_for(part_count(planes.size(), kSitesPerPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, planes.size(), kSitesPerPart);
    for (std::size_t i = begin; i < end; ++i)
      if (const auto around = neighbors.of(i); !around.empty() && (only.empty() || only[i]))
        planes[i] = fit_at(grid, around, i, scale, options);
  });
  return planes;
}

}  // namespace scanworld::rival
