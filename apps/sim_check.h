// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <string>
#include <vector>

#include "sim_check/compare.h"

namespace scanworld::cli {

// What is measured and how, as a command line says.
struct MeasureRequest {
  sim::CompareOptions options;
  std::vector<std::size_t> robots;
  std::vector<std::string> kinds;
  std::string only;

  void add_to(CLI::App& app);
  // The options; throws usage where they are none.
  sim::CompareOptions resolved() const;
};

// Writes sim_check.json, .csv, .md and .svg.
void write_comparison(const std::filesystem::path& folder, const sim::Comparison& comparison);

// The command sim_check: what it does without a verb, and its verbs.
void add_compare(CLI::App& app);
void add_baseline(CLI::App& app);
void add_tessellate(CLI::App& app);
void add_table5(CLI::App& app);

}  // namespace scanworld::cli
