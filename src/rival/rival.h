// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The default method: clusters compete for voxels, whose moments stand for their points. Its stages
// are the headers of this folder; docs/method.md explains them. Their options are here together.
#pragma once

#include "../options.h"
#include "bridge.h"
#include "columns.h"
#include "curves.h"
#include "evidence.h"
#include "flatness.h"
#include "floors.h"
#include "growth.h"
#include "labels.h"
#include "layers.h"
#include "local.h"
#include "merge.h"
#include "neighbors.h"
#include "regularise.h"
#include "rivalry.h"
#include "rough.h"
#include "scale.h"
#include "sides.h"
#include "split.h"
#include "spread_floors.h"

namespace scanworld::rival {

struct RivalOptions {
  ScaleOptions scale;
  NeighborOptions neighbors;
  LocalOptions local;
  SidesOptions sides;
  GrowthOptions growth;
  RivalryOptions rivalry;
  MergeOptions merge;
  FlatnessOptions flatness;
  int birth_rounds = 1;  // in which clusters are grown from what no cluster explains
  int birth_reach = 8;   // [voxels] that the neighbourhoods of what is left may reach
  SplitOptions split;
  BridgeOptions bridge;
  LayerOptions layers;
  EvidenceOptions evidence;
  ColumnOptions columns;
  RoughOptions rough;
  FloorOptions floors;
  CurveOptions curves;
  RegulariseOptions regularise;
  LabelOptions labels;
};

// All of them by name, "rival.scale.noise" and so on.
OptionList list_options(RivalOptions& options);

// How flat the scan's surfaces are, by clusters that have just grown: their pieces are joined where
// they go on into each other.
Flatness find_flatness(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                       Clustering clustering, const RivalOptions& options = {});

// Lets clusters compete until they settle, then grows new ones from the sites that are in none and
// lets these compete too. The local planes of those sites become those of what is left.
Clustering settle(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                  std::vector<LocalPlane>& local, Clustering clustering,
                  const RivalOptions& options = {}, const Observer& observe = {});

// Makes each cluster one connected face: parts what other planes divide and bridges what is only
// hidden.
Clustering part(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                const std::vector<LocalPlane>& local, Clustering clustering,
                const RivalOptions& options = {}, const Observer& observe = {});

// Drops what is no plane, and lets the others compete for what is left.
Clustering confirm(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                   const std::vector<LocalPlane>& local, Clustering clustering,
                   const RivalOptions& options = {}, const Observer& observe = {});

// Looks again at what is left, each time more coarsely, for surfaces that are rougher than noise
// and bend explain: stone, brick, curtains, hedges, and what a depth camera sees from afar.
Clustering find_rough(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                      Clustering clustering, const RivalOptions& options = {},
                      const Observer& observe = {});

}  // namespace scanworld::rival
