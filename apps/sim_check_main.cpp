// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cli.h"
#include "sim_check.h"

int main(int argc, char** argv) {
  using namespace scanworld;
  CLI::App app(
      "sim_check tells how much faster a world is to simulate in than a mesh of the same place, "
      "and "
      "whether robots can trust it.",
      "sim_check");
  cli::add_compare(app);
  cli::add_baseline(app);
  cli::add_tessellate(app);
  cli::add_table5(app);
  return cli::run_app(app, argc, argv);
}
