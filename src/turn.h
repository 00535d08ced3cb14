// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "types.h"

namespace scanworld {

// The least rotation that turns one direction into another. Eigen's own, which takes seconds to
// compile, compiled once.
Eigen::Quaterniond turn_between(const Vec3& from, const Vec3& to);

}  // namespace scanworld
