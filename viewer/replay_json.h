// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "replay.h"

namespace scanworld {

// A replay as replay.json (docs/page.md).
std::string replay_text(const Replay& replay);

}  // namespace scanworld
