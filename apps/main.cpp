// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <exception>
#include <new>

#include "cli.h"
#include "error.h"
#include "version.h"

namespace {

constexpr const char* kFooter =
    R"(Exit codes: 0 done, 1 failure, 2 usage, 3 bad input, 4 nothing found, 5 world failed its check.
'scanworld VERB --help' tells more about a verb, with an example.)";

int fail(int code, const std::string& message) {
  fmt::print(stderr, "scanworld: error: {}\n", message);
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace scanworld;
  CLI::App app(
      "scanworld turns a 3D scan of a real place into a light, exact world to simulate in.",
      "scanworld");
  app.set_version_flag("--version", std::string("scanworld ") + version());
  app.footer(kFooter);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);
  cli::add_build(app);
  cli::add_info(app);
  cli::add_export(app);
  cli::add_scan(app);
  cli::add_check(app);
  try {
    app.parse(argc, argv);
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    return fail(static_cast<int>(Cause::usage), std::string(e.what()) + " (see --help)");
  } catch (const Error& e) {
    return fail(static_cast<int>(e.cause), e.what());
  } catch (const std::bad_alloc&) {
    return fail(static_cast<int>(Cause::failure), "out of memory");
  } catch (const std::exception& e) {
    return fail(static_cast<int>(Cause::failure), e.what());
  }
}
