// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A limit for the time that a contact test takes in a world.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "reconstruct.h"
#include "sim_check/budget.h"

namespace scanworld::cli {

// "5us", "0.1ms" or "1e-5s" in seconds; throws usage for other text.
double seconds_from(const std::string& text);

// Simplifies a world until it meets the budget; where it can't, leaves it as it is and warns.
// Points of surfaces that went have no label any more.
sim::Budget keep_budget(ReconstructResult& result, double limit);

nlohmann::ordered_json json_of(const sim::Budget& budget);

}  // namespace scanworld::cli
