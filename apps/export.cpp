// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "exporters/export.h"

#include <fmt/format.h>

#include <memory>

#include "cli.h"
#include "world/world_json.h"

namespace scanworld::cli {

void add_export(CLI::App& app) {
  struct ExportRequest {
    std::filesystem::path world, out;
    std::string format;
  };
  auto request = std::make_shared<ExportRequest>();
  CLI::App* verb = app.add_subcommand("export", "Write a world in another format");
  verb->add_option("world", request->world, "A world.json or its folder")
      ->required()
      ->type_name("WORLD");
  verb->add_option("-o,--out", request->out, "File to write")->required()->type_name("OUT");
  verb->add_option("--format", request->format, "Format, where the extension does not tell it");
  std::string formats = "Formats:\n";
  for (const ExportFormat& f : export_formats())
    formats += fmt::format("  {:<5} {}\n", f.name, f.describes);
  verb->footer(formats + "\nExample:\n  scanworld export office -o office.glb");
  verb->callback([request] {
    const ExportFormat& format = export_format(request->out, request->format);
    format.write(request->out, read_world(request->world));
  });
}

}  // namespace scanworld::cli
