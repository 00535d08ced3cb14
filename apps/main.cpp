// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cli.h"

namespace {

constexpr const char* kFooter =
    R"(Exit codes: 0 done, 1 failure, 2 usage, 3 bad input, 4 nothing found, 5 world failed its check.
'scanworld VERB --help' tells more about a verb, with an example.)";

}  // namespace

int main(int argc, char** argv) {
  using namespace scanworld;
  CLI::App app(
      "scanworld turns a 3D scan of a real place into a light, exact world to simulate in.",
      "scanworld");
  app.footer(kFooter);
  app.require_subcommand(1);
  cli::add_build(app);
  cli::add_info(app);
  cli::add_export(app);
  cli::add_scan(app);
  cli::add_check(app);
  cli::add_view(app);
  return cli::run_app(app, argc, argv);
}
