// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace scanworld {

// "1.2.3"
const char* version();

}  // namespace scanworld
