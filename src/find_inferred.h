// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <vector>

#include "types.h"

namespace scanworld {

// What of a surface was not measured: behind furniture, under the scanner.
struct InferredOptions {
  double cell =
      0.05;  // [m] between the places that are asked for; parts narrower than two are none
};

// The parts of a surface where is_measured(place) is false.
std::vector<InferredPart> find_inferred(const FoundSurface& surface,
                                        const std::function<bool(const Vec3&)>& is_measured,
                                        const InferredOptions& options = {});

}  // namespace scanworld
