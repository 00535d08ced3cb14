// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "progress.h"
#include "text.h"
#include "world/world.h"

namespace scanworld::cli {

using Json = nlohmann::ordered_json;

// The verbs. Each adds its subcommand, which runs when the command line is parsed and may throw
// Error.
void add_build(CLI::App& app);
void add_info(CLI::App& app);
void add_export(CLI::App& app);
void add_scan(CLI::App& app);
void add_check(CLI::App& app);
void add_view(CLI::App& app);

// Parses a command line, runs what it asks for, and tells errors; returns the exit code. Adds
// --version.
int run_app(CLI::App& app, int argc, char** argv);

// What goes to stderr: the log, by how much of it is wanted, and the progress.
struct Console {
  bool quiet = false, verbose = false;
  std::string progress = "auto";  // auto, bar, json or none

  // Adds -q, -v and --progress to a verb.
  void add_to(CLI::App& verb);
  void warn(const std::string& text) const;
  void note(const std::string& text) const;  // with -v only
  // Draws a bar on a terminal or prints JSON lines, and throws where the user asked to stop.
  Progress make_progress() const;
  // Takes the bar away.
  void finish_progress() const;

 private:
  bool draws_bar() const;
};

// What a file is, by its extension and, of PLY, by its content; a folder is a world.
enum class FileKind { scan, mesh, world };
FileKind kind_of(const std::filesystem::path& file);

// What an option says, "5mm", "1cm", "0.01m" or "0.01", in metres; throws usage for other text.
double length_from(const std::string& option, const std::string& text);

std::string text_of(const Vec3& v);

Json json_of(const Vec3& v);

// A count of each kind: {"floor": 1, ...}
Json kind_counts(const World& world);

// Prints JSON to stdout.
void print_json(const Json& json);

}  // namespace scanworld::cli
