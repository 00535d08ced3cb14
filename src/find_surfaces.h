// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "cut_curves.h"
#include "record.h"
#include "surface/surroundings.h"

namespace scanworld {

// What surfaces are made of.
struct PlanesInScan {
  const PointCloud& cloud;
  const std::vector<Plane>& planes;
  const CutCurves& round;
  double voxel;                                        // [m]
  std::function<surface::Surroundings()> find_around;  // the voxels' points; asked for once
};

struct SurfacesInScan {
  std::vector<FoundSurface> surfaces;
  surface::Surroundings around;
};

inline std::size_t count_of(const SurfacesInScan& found) { return found.surfaces.size(); }

// From planes to polygons that meet, plane by plane (docs/surfaces.md) or, where it is asked for,
// in labelled space (docs/space.md). A plane's points are labelled with its largest piece.
SurfacesInScan find_surfaces(const PlanesInScan& in, const ReconstructOptions& options,
                             StageLog& log, ReconstructResult& result, Recorder& recorder);

// Labels that are called otherwise; -1 stays.
inline std::vector<std::int32_t> labels_by(const std::vector<std::int32_t>& new_label,
                                           std::vector<std::int32_t> labels) {
  for (std::int32_t& l : labels)
    if (l >= 0) l = new_label[static_cast<std::size_t>(l)];
  return labels;
}

}  // namespace scanworld
