// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// From planes to polygons that meet: where each plane has points, where planes meet, where they end
// on their own, and the outline that fits best to all of it. docs/surfaces.md tells how.
#pragma once

#include "../options.h"
#include "choose_cells.h"
#include "facets.h"
#include "facing.h"
#include "free_edges.h"
#include "gaps.h"
#include "reveals.h"
#include "seams.h"
#include "shared_edges.h"
#include "weld.h"

namespace scanworld::surface {

struct SurfaceOptions {
  PatchOptions patch;
  FacetOptions facets;
  FacingOptions facing;
  SeamOptions seams;
  GapOptions gaps;
  FreeEdgeOptions free_edges;
  SharedEdgeOptions shared_edges;
  ChoiceOptions choice;
  RevealOptions reveals;
  WeldOptions weld;
  double min_area = 0.02;  // [m2] smaller pieces are left out, but a plane's largest at a quarter
};

OptionList list_options(SurfaceOptions& options);

// The lines that may cut each patch: its seams, the longest first.
std::vector<std::vector<CutLine>> lines_of(const std::vector<Patch>& patches,
                                           const std::vector<Seam>& seams,
                                           const SeamOptions& options = {});

// The free edges of all patches.
std::vector<FreeEdge> find_free_edges(const PointCloud& cloud, const Members& members,
                                      const std::vector<Patch>& patches,
                                      const std::vector<std::vector<CutLine>>& lines,
                                      const FreeEdgeOptions& options = {});

// The polygons of all patches.
Pieces outline_patches(const std::vector<Patch>& patches, std::vector<std::vector<CutLine>> lines,
                       const std::vector<SharedEdge>& edges, const SurfaceOptions& options = {});

}  // namespace scanworld::surface
