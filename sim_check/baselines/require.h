// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include "error.h"

namespace scanworld::sim {

// Throws where an option's value is not good.
inline void require(bool good, const char* option, double value) {
  if (!good) throw Error(Cause::usage, fmt::format("{} cannot be {}", option, value));
}

}  // namespace scanworld::sim
