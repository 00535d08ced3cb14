// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The stages of the default method one after the other, and what holds after each of them.
#pragma once

#include <functional>

#include "rival/rival.h"
#include "scenes.h"

namespace scanworld::test {

// A cloud and what the stages up to "Fitting sides" make of it.
struct Stages {
  PointCloud cloud;
  rival::RivalOptions options;
  rival::Scale scale;
  rival::Grid grid;
  rival::Neighbors neighbors;
  std::vector<rival::LocalPlane> local;

  rival::Clustering grow() const;
  rival::Clustering settle() const;   // after growth
  rival::Clustering confirm() const;  // after all stages that make clusters
};

// `part`: whether thin walls are parted.
Stages run_stages(PointCloud cloud, const rival::RivalOptions& options = {}, bool part = true);

// Options for a cloud whose noise and spacing are known [m].
rival::RivalOptions known_scale(double noise, double spacing);

// Clusters of the sites as `label_of` tells by their positions, all of them awake.
rival::Clustering label_sites(const rival::Grid& grid,
                              const std::function<std::int32_t(const Vec3&)>& label_of);

// Labels name clusters that exist, and clusters hold what their sites add up to.
void check_clustering(const rival::Grid& grid, const rival::Clustering& clustering);

// How many sites are in each cluster.
std::vector<std::size_t> site_counts(const rival::Clustering& clustering);

}  // namespace scanworld::test
