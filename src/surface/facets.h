// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "../curve.h"

namespace scanworld::surface {

struct FacetOptions {
  double sagitta = 0.01;   // [m] from a chord of a facet to the curve that it stands for, at most
  double min_turn = 0.19;  // [rad] between neighbouring facets: planes at less do not meet
};

// The flat faces that stand for a curve: as many to each side, those next to each other meeting
// in the middle of their edge.
class Facets {
 public:
  Facets(const Curve& curve, const FacetOptions& options = {});

  const std::vector<Plane>& planes() const { return planes_; }
  // The facet that a point near the curve belongs to.
  std::size_t of(const Vec3& p) const;

 private:
  void cut_cone(const FacetOptions& options);

  Curve curve_;
  struct Band {
    std::size_t first = 0;  // facet
    int facets = 1;         // by angle about the axis
  };
  std::vector<Band> bands_;    // one, or of a sphere by height
  double low_ = 0, high_ = 0;  // [rad] of a sphere's part, over its middle
  std::vector<Plane> planes_;
};

}  // namespace scanworld::surface
