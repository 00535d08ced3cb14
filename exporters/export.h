// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "world/world.h"

namespace scanworld {

// A format that worlds are written in.
struct ExportFormat {
  std::string name;       // "stl"; also the extension
  std::string describes;  // in a few words
  void (*write)(const std::filesystem::path&, const World&);
};

const std::vector<ExportFormat>& export_formats();

// The format of this name, or of the file's extension where the name is empty. Throws usage naming
// those that exist.
const ExportFormat& export_format(const std::filesystem::path& path, const std::string& name = "");

// Writes a world in the format of the file's extension, or in `format`. The file appears whole or
// not at all.
void export_world(const World& world, const std::filesystem::path& path,
                  const std::string& format = "");

}  // namespace scanworld
