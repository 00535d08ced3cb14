// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "open_sky.h"

#include <algorithm>

#include "../parallel.h"

namespace scanworld::surface {

namespace {

constexpr double kFar = 1e4;                                // [m] beyond it there is nothing
constexpr double kOff = 0.001;                              // [m] a ray's start, off its patch
constexpr std::array<double, 3> kBefore = {0.1, 0.5, 1.5};  // [m] a wall, where one looks up
constexpr int kRounds = 4;  // ground, the walls on it, the roof on them, and what stands there

// What a ray meets first.
struct Met {
  std::int32_t patch = -1;  // or nothing
  bool against = false;     // the patch's normal, as it was at first
  double distance = 0;      // [m]
};

// What is below and above a place before a side of a wall.
struct Column {
  std::size_t place = 0;
  Met below, above;
};

// What there is to know of a patch that only rays tell of.
struct Looks {
  bool is_level = false;
  std::array<std::vector<Column>, 2> columns;  // of a wall, to both sides
  std::vector<Met> below;                      // straight below the places on a level patch
  std::vector<Met> walls;                      // upright patches seen from below it
  std::size_t ways = 0;                        // along which they were looked for
  bool is_open = false;                        // most of it has nothing above
};

class SkyLooks {
 public:
  SkyLooks(const std::vector<Patch>& patches, const PatchRays& rays,
           const std::vector<Vec3>& directions, const Vec3& up, const SkyOptions& options)
      : patches_(patches), rays_(rays), directions_(directions), up_(up), options_(options) {}

  Looks look(const Patch& patch, const std::vector<Vec3>& places) const {
    Looks looks{.is_level = is_level(patch)};
    if (!looks.is_level) {
      for (std::size_t side : {0u, 1u}) looks.columns[side] = columns(patch, places, side);
      return looks;
    }
    std::size_t open = 0;
    for (const Vec3& place : places) open += !rays_.cast(place, up_, kFar, options_.layers);
    looks.is_open = 2 * open >= places.size();
    if (!looks.is_open) return looks;
    const double down = patch.plane.normal.dot(up_) > 0 ? -1 : 1;
    for (const Vec3& place : places) {
      looks.below.push_back(meet(place, -up_));
      for (const Vec3& d : directions_) {
        const Met met = meet(place, d.x() * patch.frame.u + d.y() * patch.frame.v +
                                        down * d.z() * patch.plane.normal);
        ++looks.ways;
        if (met.patch >= 0 && !is_level(patches_[static_cast<std::size_t>(met.patch)]))
          looks.walls.push_back(met);
      }
    }
    return looks;
  }

 private:
  bool is_level(const Patch& patch) const {
    return std::abs(patch.plane.normal.dot(up_)) > options_.level;
  }

  Met meet(const Vec3& from, const Vec3& way) const {
    const auto hit = rays_.cast(from, way, kFar, kOff);
    if (!hit) return {};
    return {static_cast<std::int32_t>(hit->patch), patches_[hit->patch].plane.normal.dot(way) < 0,
            hit->distance};
  }

  std::vector<Column> columns(const Patch& patch, const std::vector<Vec3>& places,
                              std::size_t side) const {
    const Vec3 out = side == 0 ? patch.plane.normal : Vec3(-patch.plane.normal);
    std::vector<Column> found;
    for (std::size_t k = 0; k < places.size(); ++k)
      for (double before : kBefore) {
        if (rays_.cast(places[k], out, before + kOff, kOff)) break;
        const Vec3 at = places[k] + before * out;
        found.push_back({k, meet(at, -up_), meet(at, up_)});
      }
    return found;
  }

  const std::vector<Patch>& patches_;
  const PatchRays& rays_;
  const std::vector<Vec3>& directions_;
  const Vec3& up_;
  const SkyOptions& options_;
};

// Judges what was seen by how the patches are turned so far.
class SkyJudge {
 public:
  SkyJudge(const std::vector<std::uint8_t>& turned, double horizon, const SkyOptions& options)
      : turned_(turned), horizon_(horizon), options_(options) {}

  // Whether a patch is to be turned.
  bool is_turned(const Patch& patch, const Looks& looks, const Outlook& outlook,
                 const Vec3& up) const {
    if (!looks.is_level) return is_wall_turned(looks, outlook);
    const bool as_rays_say = outlook.way[0] < outlook.way[1];
    if (!looks.is_open || is_ceiling(looks)) return as_rays_say;
    return patch.plane.normal.dot(up) < 0;
  }

 private:
  bool is_front(const Met& met) const {
    return met.patch >= 0 && met.against != (turned_[static_cast<std::size_t>(met.patch)] != 0);
  }

  // The shares of a wall's places that have free space before them on a side, and that have the sky
  // over it.
  struct Shares {
    double free = 0, open = 0;
  };
  Shares shares_of(const std::vector<Column>& columns, std::size_t places) const {
    Shares shares;
    std::vector<std::uint8_t> free(places), open(places);
    for (const Column& c : columns) {
      if (!is_front(c.below)) continue;
      if (c.above.patch < 0)
        free[c.place] = open[c.place] = 1;
      else if (is_front(c.above))
        free[c.place] = 1;
    }
    const auto share = [&](const std::vector<std::uint8_t>& of) {
      return static_cast<double>(std::count(of.begin(), of.end(), 1)) / static_cast<double>(places);
    };
    return {share(free), share(open)};
  }

  bool is_wall_turned(const Looks& looks, const Outlook& outlook) const {
    std::array<Shares, 2> shares;
    for (std::size_t side : {0u, 1u})
      shares[side] = shares_of(looks.columns[side], outlook.places.size());
    const double lead = shares[0].free - shares[1].free;
    if (std::abs(lead) >= options_.min_lead) return lead < 0;
    // The open sky is as good as anything far away.
    const auto way = [&](std::size_t side) {
      return outlook.way[side] + horizon_ * outlook.to_sky[side] * shares[side].open;
    };
    return way(0) < way(1);
  }

  bool is_ceiling(const Looks& looks) const {
    const auto floors = [&](auto&& is_so) {
      return std::count_if(looks.below.begin(), looks.below.end(),
                           [&](const Met& m) { return is_front(m) && is_so(m.distance); });
    };
    const auto most = static_cast<std::ptrdiff_t>((looks.below.size() + 1) / 2);
    if (floors([&](double d) { return d < options_.headroom; }) >= most) return false;
    if (floors([](double) { return true; }) >= most) return true;
    const auto inwards = std::count_if(looks.walls.begin(), looks.walls.end(),
                                       [&](const Met& m) { return is_front(m); });
    return 2 * static_cast<double>(inwards) > static_cast<double>(looks.walls.size()) &&
           static_cast<double>(inwards) >= options_.min_walled * static_cast<double>(looks.ways);
  }

  const std::vector<std::uint8_t>& turned_;
  const double horizon_;
  const SkyOptions& options_;
};

}  // namespace

std::vector<std::uint8_t> find_turned(const std::vector<Patch>& patches,
                                      const std::vector<Outlook>& outlooks, const PatchRays& rays,
                                      const std::vector<Vec3>& directions, const Vec3& up,
                                      double horizon, const SkyOptions& options) {
  const auto is_open_to_doubt = [&](std::size_t k) {
    return !outlooks[k].is_told && !outlooks[k].places.empty();
  };
  const SkyLooks scene(patches, rays, directions, up, options);
  std::vector<Looks> looks(patches.size());
  std::vector<std::uint8_t> turned(patches.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    if (!is_open_to_doubt(k)) return;
    looks[k] = scene.look(patches[k], outlooks[k].places);
    turned[k] = outlooks[k].way[0] < outlooks[k].way[1];
  });
  for (int round = 0; round < kRounds; ++round) {
    // All are judged by how the others were before, so that their order does not matter.
    std::vector<std::uint8_t> next = turned;
    const SkyJudge judge(turned, horizon, options);
    parallel_for(patches.size(), [&](std::size_t k) {
      if (is_open_to_doubt(k)) next[k] = judge.is_turned(patches[k], looks[k], outlooks[k], up);
    });
    if (next == turned) break;
    turned = std::move(next);
  }
  return turned;
}

}  // namespace scanworld::surface
