// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "reconstruct.h"

namespace scanworld::cli {

// Sets options from a TOML file: [thesis.filter] min_size = 0.1. Throws bad_input where it is no
// TOML, usage where an option does not exist or has a value out of range, both naming file and
// line.
void apply_config(ReconstructOptions& options, const std::filesystem::path& file);

// Sets options from "key=value" texts. Throws usage.
void apply_assignments(ReconstructOptions& options, const std::vector<std::string>& assignments);

// All options as a table: name, default, unit and meaning.
std::string options_table();

}  // namespace scanworld::cli
