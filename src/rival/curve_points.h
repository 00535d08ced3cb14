// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "curves.h"

namespace scanworld::rival {

// For each point of the cloud the curve that it lies on, or kNone.
std::vector<std::int32_t> label_curve_points(const PointCloud& cloud, const Grid& grid,
                                             const Scale& scale, const Curves& curves,
                                             const CurveOptions& options = {});

}  // namespace scanworld::rival
