// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "version.h"

namespace scanworld {

const char* version() { return SCANWORLD_VERSION; }  // defined by CMakeLists.txt

}  // namespace scanworld
