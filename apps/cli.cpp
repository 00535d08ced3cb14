// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "cli.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "error.h"
#include "files.h"
#include "scan/ply.h"
#include "version.h"

namespace scanworld::cli {

namespace {

volatile std::sig_atomic_t stop_asked = 0;

void ask_to_stop(int signal) {
  stop_asked = 1;
  std::signal(signal, SIG_DFL);  // the second time it ends at once
}

// The program's name, in front of what it says.
std::string program = "scanworld";

int fail(int code, const std::string& message) {
  fmt::print(stderr, "{}: error: {}\n", program, message);
  return code;
}

}  // namespace

int run_app(CLI::App& app, int argc, char** argv) try {
  program = app.get_name();
  app.set_version_flag("--version", std::string("scanworld ") + version());
  app.failure_message(CLI::FailureMessage::simple);
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

void Console::add_to(CLI::App& verb) {
  verb.add_flag("-q,--quiet", quiet, "No warnings, no progress");
  verb.add_flag("-v,--verbose", verbose, "Say more on stderr");
  verb.add_option("--progress", progress,
                  "Progress on stderr: auto (a bar on a terminal), bar, json or none")
      ->check(CLI::IsMember({"auto", "bar", "json", "none"}))
      ->capture_default_str();
}

void Console::warn(const std::string& text) const {
  if (!quiet) fmt::print(stderr, "{}: warning: {}\n", program, text);
}

void Console::note(const std::string& text) const {
  if (verbose && !quiet) fmt::print(stderr, "{}: {}\n", program, text);
}

bool Console::draws_bar() const {
  return progress == "bar" || (progress == "auto" && !quiet && isatty(STDERR_FILENO));
}

Progress Console::make_progress() const {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  return [bar = draws_bar(), json = progress == "json"](std::string_view stage, double fraction) {
    if (stop_asked) throw Error(Cause::failure, "stopped on request; nothing was written");
    if (bar) {
      constexpr int kWidth = 30;
      const int done = static_cast<int>(fraction * kWidth);
      fmt::print(stderr, "\r[{:#<{}}{:.<{}}] {:3.0f} % {:<28}", "", done, "", kWidth - done,
                 100 * fraction, stage);
      std::fflush(stderr);
    }
    if (json) fmt::print(stderr, "{}\n", Json{{"stage", stage}, {"fraction", fraction}}.dump());
  };
}

void Console::finish_progress() const {
  if (draws_bar()) fmt::print(stderr, "\r{:70}\r", "");
}

FileKind kind_of(const std::filesystem::path& file) {
  std::error_code ignored;
  const std::string extension = lower_extension(file);
  if (extension == ".json" || std::filesystem::is_directory(file, ignored)) return FileKind::world;
  static const std::vector<std::string> meshes = {".obj", ".stl", ".glb", ".gltf",
                                                  ".dae", ".off", ".3ds", ".fbx"};
  if (std::find(meshes.begin(), meshes.end(), extension) != meshes.end()) return FileKind::mesh;
  if (extension == ".ply" && is_ply_mesh(file)) return FileKind::mesh;
  return FileKind::scan;
}

double length_from(const std::string& option, const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  const std::string unit = end;
  const double factor = unit == "mm"                  ? 1e-3
                        : unit == "cm"                ? 1e-2
                        : unit == "m" || unit.empty() ? 1
                                                      : 0;
  const double metres = number * factor;
  if (end == text.c_str() || !(metres >= 1e-5 && metres <= 10))
    throw Error(Cause::usage,
                option + ": '" + text + "' is no length from 0.01 mm to 10 m; write 5mm or 1cm");
  return metres;
}

std::string text_of(const Vec3& v) {
  return fmt::format("{:.3f} {:.3f} {:.3f}", v.x(), v.y(), v.z());
}

Json json_of(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

Json kind_counts(const World& world) {
  Json counts;
  for (Kind kind : {Kind::floor, Kind::ceiling, Kind::wall, Kind::other}) counts[name_of(kind)] = 0;
  for (const Surface& s : world.surfaces)
    counts[name_of(s.kind)] = counts[name_of(s.kind)].get<int>() + 1;
  return counts;
}

void print_json(const Json& json) { fmt::print("{}\n", json.dump(2)); }

}  // namespace scanworld::cli
