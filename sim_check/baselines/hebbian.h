// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "network.h"

namespace scanworld::sim {

// Extended competitive Hebbian learning: connects the two nodes nearest to a signal, with faces to
// neighbours that they share, in place of what connected these. If they were connected, and one
// that they share is in between, then they no longer are.
void learn_connection(Network& network, const std::vector<Vec3>& positions, int first, int second);

}  // namespace scanworld::sim
