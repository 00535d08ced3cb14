// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "ray_scene.h"

namespace scanworld {

struct DoubledOptions {
  double reach = 0.1;    // [m] between layers, and of points from their surface
  double square = 0.15;  // [m] edge of the squares of a surface that are looked at; larger where
                         // points are few, so that as many are in each
  double square_points = 16;       // that a square should hold on the mean
  std::size_t min_points = 10;     // in a square that tells
  double min_share = 0.3;          // of them in each layer; joints between bricks are a quarter
  double min_apart = 0.015;        // [m] between layers
  double min_apart_per_rms = 4.5;  // 3.5 where points are everywhere, 2.7 of one layer's noise
  double max_beside = 0.2;  // [square] between the middles of layers; more is one beside the other
  double min_spread = 0.6;  // of a layer across the square against the other's
  double max_turn = 0.1;    // [rad] between surfaces that may be layers of one
};

// The share of the surfaces' area in which their points lie in two layers, that are seen from one
// side and through each other: a wall was scanned twice, and the passes do not agree. What is not
// dense enough to tell does not count; nothing where all is not. `nearest` is that of each point.
std::optional<double> measure_doubled(const World& world, const std::vector<Vec3>& points,
                                      const std::vector<std::optional<Nearest>>& nearest,
                                      const DoubledOptions& options = {});

}  // namespace scanworld
