// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "../surface/raster.h"

namespace scanworld::terrain {

// A place seen from above, and how high it is [m].
struct Spot {
  Vec2 at;
  double height;
};

struct HeightOptions {
  double cell = 0.1;       // [m] edge of a cell
  double per_spacing = 2;  // and at least so many times the spacing
  double max_cells = 4e6;  // in larger places cells are larger
  double tolerance =
      0.02;            // [m] ground is no farther off what the ground around it leads to expect
  double turn = 0.15;  // and this for each metre to the nearest ground that is known
  double reach = 1;    // [m] to where the nearest ground leads to expect something
};

// How high the ground is: one height for each cell of a level plane where it is known.
struct Heights {
  surface::Raster known;       // cells with ground
  std::vector<double> height;  // [m] of each cell

  // What the known cells around the middle of a cell lead to expect there: the height of a plane
  // fitted to those no more than `reach` cells away, the near ones most, and how far the nearest is
  // [cells]. Nothing where there are none.
  struct Expected {
    double height, distance;
    double spread;  // [m] between the highest and the lowest of those cells
  };
  std::optional<Expected> expected(int x, int y, int reach) const;

  // With each height as the plane fitted to the cells around has it that are no farther off than
  // `step` [m]: edges stay.
  Heights smoothed(int reach, double step) const;

 private:
  template <typename Takes>
  std::optional<Expected> fitted(int x, int y, int reach, const Takes& takes) const;
};

// The spots of a scan by the cells that they are in.
class SpotColumns {
 public:
  SpotColumns(const std::vector<Spot>& spots, const HeightOptions& options);

  // Cells, none known.
  const Heights& none() const { return none_; }
  bool is_empty(std::size_t cell) const { return first_[cell] == first_[cell + 1]; }
  // The mean height of the spots in a cell no farther than this from a height; nothing where there
  // are none.
  std::optional<double> near(std::size_t cell, double height, double distance) const;

 private:
  Heights none_;
  std::vector<std::uint32_t> first_;  // for each cell its first height; one more at the end
  std::vector<double> height_;        // ascending in each cell
};

// Ground goes on from where it is known to the spots around, as far as each is where the ground
// that is known by then leads to expect it: up slopes and over gaps, not onto things. Region
// growing with a local plane as the predictor.
Heights grow_ground(const SpotColumns& spots, Heights heights, const HeightOptions& options = {});

}  // namespace scanworld::terrain
