// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rays.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "../cell_walk.h"
#include "../mix.h"
#include "../parallel.h"

namespace scanworld::space {

namespace {

constexpr double kLargestShare = 25;  // of a site's area: what a sparse point may stand for
constexpr double kOffPatch = 0.01;    // [m] that a ray between patches leaves to both

// One place of each cube, of a plane if there is one.
std::vector<std::size_t> thin_out(const surface::Surroundings& around, const RayOptions& options) {
  using Key = std::tuple<std::uint64_t, bool, std::uint64_t, std::size_t>;
  std::vector<Key> keys;
  for (std::size_t i = 0; i < around.points.size(); ++i) {
    const Vec3f& p = around.points[i];
    if (!has_code(p.cast<double>(), options.site)) continue;
    keys.emplace_back(morton_of(cell_of(p.cast<double>(), options.site)), around.planes[i] < 0,
                      hash_of_place(p.x(), p.y(), p.z()), i);
  }
  parallel_sort(keys);
  std::vector<std::size_t> sites;
  for (std::size_t k = 0; k < keys.size(); ++k)
    if (k == 0 || std::get<0>(keys[k]) != std::get<0>(keys[k - 1]))
      sites.push_back(std::get<3>(keys[k]));
  return sites;
}

std::vector<Ray> rays_from_viewpoints(const surface::Surroundings& around,
                                      const std::vector<std::int32_t>& viewers,
                                      const std::vector<Cover>& covers, double noise,
                                      const RayOptions& options) {
  std::vector<std::size_t> sites = thin_out(around, options);
  std::erase_if(sites, [&](std::size_t i) { return viewers[i] < 0; });
  double area = options.site * options.site;
  if (sites.size() > options.most) {
    const double share = static_cast<double>(options.most) / static_cast<double>(sites.size());
    area /= share;
    const auto limit = static_cast<std::uint64_t>(share * 0x1p32);
    std::erase_if(sites, [&](std::size_t i) {
      const Vec3f& p = around.points[i];
      return mix(hash_of_place(p.x(), p.y(), p.z())) >> 32 >= limit;
    });
  }
  std::vector<Ray> rays;
  for (const std::size_t i : sites) {
    const Vec3 to = around.points[i].cast<double>(),
               from = around.viewpoints[static_cast<std::size_t>(viewers[i])];
    const double length = (to - from).norm();
    if (length < options.min_length) continue;
    Ray ray{.from = from, .own = around.planes[i], .from_viewpoint = true};
    double before = std::max(options.before, 4 * noise);
    ray.weight = options.loose * area;
    if (ray.own >= 0) {
      const Cover& cover = covers[static_cast<std::size_t>(ray.own)];
      const double cosine = std::abs(cover.plane.normal.dot(to - from)) / length;
      if (cosine < options.min_cosine) continue;
      before = std::min(length / 2, before / cosine);
      ray.weight =
          options.on_plane * std::clamp(cover.area_of_point(to), area, kLargestShare * area);
    }
    ray.to = from + (to - from) * (1 - std::min(1.0, before / length));
    rays.push_back(ray);
  }
  return rays;
}

// From places of a patch along its normal and four directions at 50 degrees to it, as far as a
// patch that faces it.
void look_from(std::size_t k, const std::vector<Cover>& covers, const surface::PatchRays& patches,
               const RayOptions& options, std::vector<Ray>& rays) {
  constexpr double kSlant = 0.77, kUpright = 0.64;
  constexpr double kShort = 0.1;  // [m] where nothing is met
  const Cover& cover = covers[k];
  if (cover.is_none()) return;
  const int stride = cover.area > 3 ? 4 : 2;
  const Vec3 &n = cover.plane.normal, &u = cover.frame.u, &v = cover.frame.v;
  const std::array<Vec3, 5> ways = {
      n, (kUpright * n + kSlant * u).normalized(), (kUpright * n - kSlant * u).normalized(),
      (kUpright * n + kSlant * v).normalized(), (kUpright * n - kSlant * v).normalized()};
  const double cell = stride * cover.supported.cell;
  for (int y = 0; y < cover.supported.height; y += stride)
    for (int x = 0; x < cover.supported.width; x += stride) {
      if (!cover.supported.is_set(x, y)) continue;
      const Vec3 from = cover.frame.to_space(cover.supported.middle(x, y)) + kOffPatch * n;
      for (const Vec3& way : ways) {
        const auto hit = patches.cast(from, way, options.far);
        const bool is_facing = hit && covers[hit->patch].plane.normal.dot(way) < 0;
        const double length = is_facing ? hit->distance - kOffPatch : kShort;
        if (length <= 0) continue;
        rays.push_back({.from = from,
                        .to = from + length * way,
                        .own = static_cast<int>(k),
                        .weight = options.mutual * cell * cell / static_cast<double>(ways.size())});
      }
    }
}

std::vector<Ray> rays_between_patches(const std::vector<Cover>& covers,
                                      const surface::PatchRays& patches,
                                      const RayOptions& options) {
  std::vector<std::vector<Ray>> from(covers.size());
  parallel_for(covers.size(),
               [&](std::size_t k) { look_from(k, covers, patches, options, from[k]); });
  std::vector<Ray> rays;
  for (const std::vector<Ray>& some : from) rays.insert(rays.end(), some.begin(), some.end());
  return rays;
}

}  // namespace

std::vector<Ray> find_rays(const surface::Surroundings& around,
                           const std::vector<std::int32_t>& viewers,
                           const std::vector<Cover>& covers, const surface::PatchRays& patches,
                           double noise, const RayOptions& options) {
  return around.viewpoints.empty() ? rays_between_patches(covers, patches, options)
                                   : rays_from_viewpoints(around, viewers, covers, noise, options);
}

CellSet crossed_by(const std::vector<Ray>& rays, double cell) {
  CellSet crossed;
  for (const Ray& ray : rays)
    if (has_code(ray.from, cell) && has_code(ray.to, cell))
      walk_cells(ray.from / cell, cell_of(ray.to, cell), [&](std::uint64_t code) {
        crossed.insert(code);
        return true;
      });
  return crossed;
}

}  // namespace scanworld::space
