// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "raster.h"

namespace scanworld::surface {

// The points of each plane.
struct Members {
  std::vector<std::uint32_t> points;  // indices into the cloud, plane by plane
  std::vector<std::size_t> first;     // for each plane its first; one more at the end

  std::span<const std::uint32_t> of(std::size_t plane) const {
    return {points.data() + first[plane], first[plane + 1] - first[plane]};
  }
};

// `labels`: for each point of the cloud its plane or -1.
Members group_points(const std::vector<std::int32_t>& labels, std::size_t planes);

// What a scan holds, thinned: for looking around. In no order that the points' order changes.
struct Surroundings {
  std::vector<Vec3f> points;
  std::vector<std::int32_t> planes;        // of each point, or -1
  std::vector<Eigen::AlignedBox3f> boxes;  // of each kRun points

  static constexpr std::size_t kRun = 256;
};

Surroundings surroundings_of(std::vector<Vec3f> points, std::vector<std::int32_t> planes);

struct PatchOptions {
  double margin = 0.25;           // [m] around the points
  double shadow_depth = 0.7;      // [m] what stands no farther before a patch hides it ...
  double shadow_cosine = 0.5;     // ... unless it is a plane at a larger angle to it
  double hidden_evidence = 0.02;  // of cells without points that something hides
  double ground_price = 0.12;  // of cells of a floor without points, where nothing is below; 1 for
                               // others
  double level = 0.9;       // cosine off upright of patches that one stands on; they have no holes
                            // but where something is below
  double depth_below = 3;   // [m] how far
  double facing_depth = 4;  // [m] so far the place is looked at to tell a patch's free side
};

// A plane and where its points are. Its normal points to the free side: that of the nearest
// viewpoint; where none is known, that to which most normals point; where there are none either,
// the side on which more of the place lies before the points.
struct Patch {
  Plane plane;
  PlaneFrame frame;
  Raster hit;                // cells with points; empty where there are none
  Raster covered;            // those and the gaps of one or two cells between them
  Box3 box;                  // of the points
  std::vector<Vec2> middle;  // of each cell of `hit`; of its points where it has some
  // What each cell says for the surface, more than 0 where it is hit: the area, in cells, that its
  // points stand for where they are sparse. Where it is not hit, down to -1 as points were to be
  // expected.
  std::vector<float> evidence;
};

inline std::size_t count_of(const std::vector<Patch>& patches) { return patches.size(); }

std::vector<Patch> find_patches(const PointCloud& cloud, const Members& members,
                                const std::vector<Plane>& planes, double cell,
                                const Surroundings& surroundings, const Vec3& up,
                                const PatchOptions& options = {});

}  // namespace scanworld::surface
