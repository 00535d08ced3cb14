// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>
#include <vector>

#include "world/virtual_scan.h"

namespace scanworld::bench {

// How well the planes that were found are those that are there. All shares are from 0 to 1.
struct PlaneScore {
  std::size_t asked_for = 0;         // true planes
  std::size_t found = 0;             // planes, right or not
  double precision = 0, recall = 0;  // with a right one where the IoU is 0.5 or more
  double f1_50 = 0, f1_75 = 0;       // with a right one where the IoU is 0.5, 0.75 or more
  double mean_iou = 0;               // over true planes asked for, of the best IoU of each
};

// Scores planes by the points in them. `truth` and `found` name the plane of each point, -1 = none;
// the names of the two have nothing to do with each other. `counted` names the true planes asked
// for. IoU of two planes: points in both / points in either. Recall is the share of true planes
// asked for that a found one matches, precision that of found planes that match a true one. A found
// plane whose best match is a true one not asked for, with an IoU of 0.5 or more, is neither right
// nor wrong. One true plane asked for that has no points is missed.
PlaneScore score_planes(const std::vector<std::int32_t>& truth,
                        const std::vector<std::int32_t>& found,
                        const std::set<std::int32_t>& counted);

// The ids of the surfaces that were seen well enough to be asked for: those with 100 points or
// more, in 20 or more squares of 5 cm. Each surface is a plane of its own, though it lie in one
// plane with others. The noise of the scan changes nothing.
std::set<std::int32_t> planes_asked_for(const World& world, const VirtualScan& scan);

}  // namespace scanworld::bench
