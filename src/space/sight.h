// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../cell_set.h"
#include "../surface/patch_rays.h"
#include "../surface/surroundings.h"

namespace scanworld::space {

inline constexpr double kLevelCosine = 0.9;  // of a floor's normal to up, at least

struct SightOptions {
  double cell = 0.1;         // [m] edge of the cells that points hide others with, at least ...
  double sites = 2;          // ... so many times the distance of the sites
  double blind = 0.3;        // [m] around a viewpoint, where nothing hides
  double min_cosine = 0.15;  // of a line of sight to a normal; what is seen more aslant is unsure
  int viewers = 3;           // that are asked about a place, the nearest ones
  double look_ahead = 0.7;   // [m] where no viewpoint is known: what stands so near hides, ...
  double look_below = 3;     // [m] ... and a floor is none only if there is something so near below
};

// Who can see what: the cells that hold points, and where each viewpoint looked. A direction was
// looked in where returns came from above and below, left and right of it.
class Sight {
 public:
  // `viewers`: for each place around the viewpoint that it was seen from, or -1.
  Sight(const surface::Surroundings& around, const std::vector<std::int32_t>& viewers,
        double spacing, const SightOptions& options = {}, const Vec3& up = Vec3::UnitZ());

  // Whether a surface at a place with this normal would have been seen: it lies in a viewpoint's
  // field of view and nothing stands between.
  bool is_exposed(const Vec3& place, const Vec3& normal) const;

  bool is_occupied(const Vec3& place) const;
  double cell() const { return cell_; }
  const Vec3& up() const { return up_; }

 private:
  static constexpr int kAzimuths = 180, kElevations = 90;
  using Directions = std::vector<std::uint8_t>;

  static std::size_t direction_of(const Vec3& way);
  static Directions field_of_view(const Directions& returns);
  bool has_below(const Vec3& place) const;
  bool is_hidden(const Vec3& place, const Vec3& normal, const Vec3& to) const;

  std::vector<Vec3> viewpoints_;
  SightOptions options_;
  Vec3 up_;
  double cell_;
  CellSet occupied_;
  std::vector<Directions> seen_;  // by viewpoint
};

}  // namespace scanworld::space
