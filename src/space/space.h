// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Space as free, solid or unknown: planes cut it into cells, points and lines of sight say what
// each cell is, and surfaces are where free meets solid. docs/space.md tells how.
#pragma once

#include "../options.h"
#include "depth_behind.h"
#include "interfaces.h"

namespace scanworld::space {

struct SpaceOptions {
  bool is_on = true;  // whether surfaces are found in labelled space; else plane by plane
  CoverOptions cover;
  RayOptions rays;
  PlanesOptions planes;
  ArrangeOptions arrange;
  LabelOptions labels;
  InterfaceOptions interfaces;
  Unknown unknown = Unknown::behind;  // what becomes of space that nobody saw
};

// What becomes of it by this name: solid, free or open; throws usage where there is none.
Unknown unknown_named(const std::string& name);
const char* name_of(Unknown unknown);

OptionList list_options(SpaceOptions& options);

// What the scan says of planes and of the space between them.
struct Outlook {
  std::vector<Cover> covers;  // by patch
  std::vector<Ray> rays;
  CellSet free;  // cells that rays cross, with edges of Sight::cell()
  Sight sight;
};

inline std::size_t count_of(const Outlook& outlook) { return outlook.rays.size(); }

// `patches`: with what their own points say; `rays`: of these; `spacing`: of the places around [m].
Outlook look_out(const std::vector<surface::Patch>& patches, const surface::PatchRays& rays,
                 const std::vector<surface::Seam>& seams, const surface::Surroundings& around,
                 double spacing, double noise, const SpaceOptions& options = {},
                 const Vec3& up = Vec3::UnitZ());

struct LabelledSpace {
  std::vector<SpacePlane> planes;
  Arrangement arrangement;
  Evidence evidence;
  std::vector<Label> labels;  // of the cells
};

inline std::size_t count_of(const LabelledSpace& space) { return space.labels.size(); }

// What each part of space is.
LabelledSpace label_space(const SpaceInput& in, const Outlook& outlook,
                          const std::vector<Vec3>& viewpoints, const SpaceOptions& options = {});

}  // namespace scanworld::space
