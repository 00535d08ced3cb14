// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

namespace scanworld::sim {

// Whether work comes to its end, be it with an error, in a process of its own, which nothing is
// heard of: readers of others crash on many a damaged file. Throws failure where there can be no
// other process.
bool comes_to_end(const std::function<void()>& work);

}  // namespace scanworld::sim
