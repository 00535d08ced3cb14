// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

namespace scanworld::cli {

// The command sim_check: what it does without a verb, and its verbs.
void add_compare(CLI::App& app);

}  // namespace scanworld::cli
