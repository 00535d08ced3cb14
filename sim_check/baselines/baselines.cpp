// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "baselines.h"

#include "../named.h"
#include "gng.h"
#include "growing_grid.h"
#include "gsrm.h"

namespace scanworld::sim {

const std::vector<Baseline>& baselines() {
  static const std::vector<Baseline> all = {
      {"gg", "Growing Grid (Fritzke 1995): a sheet",
       [](const PointCloud& cloud, const BaselineOptions& o, const Progress& progress) {
         return growing_grid(cloud, {.nodes = o.nodes, .seed = o.seed}, progress);
       }},
      {"gsrm", "growing self-reconstruction maps (do Rego and others 2010)",
       [](const PointCloud& cloud, const BaselineOptions& o, const Progress& progress) {
         return gsrm(cloud, {.gas = {.max_nodes = o.nodes, .seed = o.seed}}, progress);
       }},
      {"gng", "growing neural gas (Fritzke 1995), its cliques as triangles",
       [](const PointCloud& cloud, const BaselineOptions& o, const Progress& progress) {
         return gng_with_cliques(cloud, {.gas = {.max_nodes = o.nodes, .seed = o.seed}}, progress);
       }},
  };
  return all;
}

const Baseline& baseline_named(const std::string& name) {
  return find_named(baselines(), name, "baseline");
}

}  // namespace scanworld::sim
