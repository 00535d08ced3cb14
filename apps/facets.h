// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// How finely what is round is cut in the files that `build` and `export` write.
#pragma once

#include <string>

#include "cli.h"

namespace scanworld::cli {

// Adds --sagitta to a verb.
void add_sagitta(CLI::App& verb, std::string& text);

// In metres (length_from); 0 for no text.
double sagitta_from(const std::string& text);

// The world with new facets, and warnings about those that stay; as it is for a sagitta of 0.
World cut_anew(World world, double sagitta, const Console& console);

}  // namespace scanworld::cli
