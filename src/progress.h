// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string_view>

namespace scanworld {

// Told, on the caller's thread, that `fraction` (0 to 1) of the whole is done and `stage` comes
// next. To cancel, throw from it: stages are pure, so nothing is left half-done.
using Progress = std::function<void(std::string_view stage, double fraction)>;

}  // namespace scanworld
