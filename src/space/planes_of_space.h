// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../surface/seams.h"
#include "../surface/shared_edges.h"
#include "cover.h"

namespace scanworld::space {

struct PlanesOptions {
  double min_area = 0.01;     // [m2] of points on a plane that cuts space
  double same_plane = 0.012;  // [m] surfaces that look the same way are in one plane if they are no
                              // farther apart, or twice the noise, ...
  double same_angle = 0.07;   // [rad] ... and tilted by no more ...
  double same_reach = 0.6;    // [m] ... and so near to each other; ...
  double same_far = 0.005;    // [m] others only if they are no farther apart
  double seam_reach = 0.15;   // [m] a plane goes on to both sides of where another one ends on it
  double edge_depth = 0.25;   // [m] the plane of an edge cuts to both sides of the face
  double edge_reach = 0.04;   // [m] ... and so far beyond the edge's ends
  double same_edge = 0.012;   // [m] ends of faces no farther from the plane of a longer one are its
  double on_plane = 0.025;    // [m] and those no farther from a surface are where that goes on
  double min_emptiness = 0.15;  // mean beyond an edge that is one; else the points just end there
  double step_depth = 0.25;     // [m] between two planes of one wall that a step parts, at most ...
  double min_step = 0.02;       // [m] ... and at least, and twice the noise
  double min_behind = 0.12;     // share of a plate that lines of sight pass behind
  double thin = 0.04;       // [m] the thickness of a plate that was seen from one side alone ...
  double thin_wall = 0.08;  // [m] ... where it is large and upright
};

// A plane that may cut space, and where it does.
struct SpacePlane {
  enum class Kind { surface, step, edge, back };

  Plane plane;  // the normal of a surface or a back looks to the free side. Surfaces that are
                // nearly in one plane have that of the largest
  Kind kind = Kind::surface;
  int patch = -1;                          // whose plane or back it is
  double size = 0;                         // [m2], or of a step or an edge its length [m]
  bool is_late = false;                    // it comes after the steps that part it from others
  std::vector<std::vector<Vec3>> regions;  // convex polygons: it cuts the cells that they touch
};

struct SpaceInput {
  const std::vector<surface::Patch>& patches;
  const std::vector<Cover>& covers;
  const std::vector<surface::Seam>& seams;
  const std::vector<surface::SharedEdge>& edges;
  Vec3 up = Vec3::UnitZ();
  double noise = 0;  // [m]
};

// Those of the patches, each as far as it may go on; the steps between two that go on a wall beside
// each other; the edges where a face ends though more could be seen. `free`: what lines of sight
// crossed; plates that they pass behind get a back. In the order in which they cut.
std::vector<SpacePlane> planes_of_space(const SpaceInput& in, const Sight& sight,
                                        const CellSet& free, const PlanesOptions& options = {});

}  // namespace scanworld::space
