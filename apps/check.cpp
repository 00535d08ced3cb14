// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli.h"
#include "error.h"
#include "world/validate.h"
#include "world/world_json.h"

namespace scanworld::cli {

namespace {

void run(const std::filesystem::path& path, bool json) {
  const World world = read_world(path);
  const std::vector<std::string> reasons = validate(world);
  if (json) {
    print_json({{"world", path.string()}, {"valid", reasons.empty()}, {"reasons", reasons}});
  } else if (reasons.empty()) {
    fmt::print("{}: valid, {} surfaces\n", path.string(), world.surfaces.size());
  } else {
    for (const std::string& reason : reasons) fmt::print("{}\n", reason);
  }
  if (!reasons.empty())
    throw Error(Cause::check_failed,
                fmt::format("{}: not valid, {} reasons", path.string(), reasons.size()));
}

}  // namespace

void add_check(CLI::App& app) {
  struct Request {
    std::filesystem::path world;
    bool json = false;
  };
  auto request = std::make_shared<Request>();
  CLI::App* verb =
      app.add_subcommand("check", "Tell whether a world is valid, and if not why (exit code 5)");
  verb->add_option("world", request->world, "A world.json or its folder")
      ->required()
      ->type_name("WORLD");
  verb->add_flag("--json", request->json, "As JSON");
  verb->footer("Example:\n  scanworld check office");
  verb->callback([request] { run(request->world, request->json); });
}

}  // namespace scanworld::cli
