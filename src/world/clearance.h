// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "faces.h"
#include "slab.h"

namespace scanworld {

struct ClearanceOptions {
  double tolerance = 0.001;  // [m] a slab sticks out into free space by no more
  double poke = 0.01;  // [m] a surface that ends no deeper in a slab is not beyond it, but at it
  double least_depth = 0.01;  // [m] two faces of a thing that are nearer can't be told from noise
};

// Knows where free space begins behind any face.
class Clearance {
 public:
  Clearance(const std::vector<Face>& faces, const ClearanceOptions& options = {});

  // Takes a slab back from free space: where the front of another surface is in it, one of its
  // sides is moved inwards as far as there is slack, else it gets less deep. Surfaces that face the
  // same way as the slab's don't count: what is between is behind one, and before the other nothing
  // was seen.
  void fit(Slab& slab) const;

  // Whether fit() would leave the slab as it is.
  bool fits(const Slab& slab) const;

 private:
  struct Found {
    double depth, deepest;
    std::vector<double> cut;  // of each side, until nothing would be left
  };
  std::optional<Found> find(const Slab& slab, std::size_t face) const;

  const std::vector<Face>& faces_;
  const ClearanceOptions options_;
  std::vector<std::vector<std::array<Vec3, 3>>> triangles_;  // of each face
};

}  // namespace scanworld
