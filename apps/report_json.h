// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json.hpp>

#include "reconstruct.h"
#include "world/fidelity.h"

namespace scanworld::cli {

// The report of a world as `build` writes it: times and counts of the stages, the counts of the
// thesis' Tables 1 to 3, scale and noise, how true the world is to its scan, peak memory so far,
// warnings, and the world's hash.
nlohmann::ordered_json report_json(const ReconstructResult& result, const Fidelity& fidelity,
                                   const PointCloud& cloud);

}  // namespace scanworld::cli
