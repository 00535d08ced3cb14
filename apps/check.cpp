// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>

#include "cli.h"
#include "error.h"
#include "fidelity.h"
#include "parallel.h"
#include "world/cracks.h"
#include "world/validate.h"
#include "world/world_json.h"

namespace scanworld::cli {

namespace {

constexpr const char* kCheckExample = R"(Examples:
  scanworld check office
  scanworld check office office.ply --poses poses.txt
The second measures the world against its scan: distances both ways, how much of the surfaces has
points and how many points no surface explains, and with scanner positions which rays the world
contradicts. docs/fidelity.md has the meaning and limit of each figure.)";

struct CheckRequest {
  std::filesystem::path world, poses;
  std::vector<std::filesystem::path> scans;
  int threads = 0;
  bool exact = false, json = false;
};

std::string summary(const std::vector<Crack>& cracks) {
  if (cracks.empty()) return "surfaces that meet share their vertices";
  return fmt::format("{} T-junctions and {} cracks where surfaces meet",
                     count_of(cracks, Crack::Kind::t_junction),
                     count_of(cracks, Crack::Kind::crack));
}

void run(const CheckRequest& request) {
  if (request.scans.empty() && !request.poses.empty())
    throw Error(Cause::usage, "--poses needs a SCAN that was made from there");
  const ThreadLimit threads(request.threads);
  const World world = read_world(request.world);
  const std::string name = request.world.string();
  const std::vector<std::string> reasons = validate(world);
  const bool is_valid = reasons.empty();
  const std::vector<Crack> cracks = is_valid ? find_cracks(world) : std::vector<Crack>{};
  std::optional<Fidelity> fidelity;
  if (is_valid && !request.scans.empty())
    fidelity = fidelity_of(world, read_scan_with_poses(request.scans, request.poses));
  if (request.json) {
    Json places = Json::array();
    for (const Crack& crack : cracks) places.push_back(text_of(crack));
    Json json = {{"world", name},
                 {"valid", is_valid},
                 {"reasons", reasons},
                 {"t_junctions", count_of(cracks, Crack::Kind::t_junction)},
                 {"cracks", count_of(cracks, Crack::Kind::crack)},
                 {"not_joined", places}};
    if (fidelity) json["fidelity"] = json_of(*fidelity);
    print_json(json);
  } else {
    for (const std::string& reason : reasons) fmt::print("{}\n", reason);
    for (const Crack& crack : cracks) fmt::print("{}\n", text_of(crack));
    if (is_valid)
      fmt::print("{}: valid, {} surfaces; {}\n", name, world.surfaces.size(), summary(cracks));
    if (fidelity) fmt::print("{}", text_of(*fidelity, world));
  }
  if (!is_valid)
    throw Error(Cause::check_failed,
                fmt::format("{}: not valid, {} reasons", name, reasons.size()));
  if (request.exact && !cracks.empty())
    throw Error(Cause::check_failed, fmt::format("{}: not exact, {}", name, summary(cracks)));
  if (fidelity && !fidelity->is_faithful())
    throw Error(Cause::check_failed, fmt::format("{}: {}", name, verdict_of(*fidelity)));
}

}  // namespace

void add_check(CLI::App& app) {
  auto request = std::make_shared<CheckRequest>();
  CLI::App* verb = app.add_subcommand(
      "check", "Tell whether a world is valid and, with its scan, faithful (if not, exit code 5)");
  verb->add_option("world", request->world, "A world.json or its folder")
      ->required()
      ->type_name("WORLD");
  verb->add_option("scans", request->scans, "The scan that it was made of, to measure it against")
      ->type_name("SCAN");
  verb->add_option("--poses", request->poses, kPosesHelp)->type_name("F");
  verb->add_option("--threads", request->threads, "Threads to use; 0 = all")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str();
  verb->add_flag("--exact", request->exact,
                 "Fail too where surfaces meet without sharing their vertices");
  verb->add_flag("--json", request->json, "As JSON");
  verb->footer(kCheckExample);
  verb->callback([request] { run(*request); });
}

}  // namespace scanworld::cli
