// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// A format that worlds are written in.
struct ExportFormat {
  std::string name;       // "stl"
  std::string extension;  // without dot; mostly the name
  std::string describes;  // in a few words
  std::string loading;    // how to load it, {0} standing for the file
  void (*write)(const std::filesystem::path&, const World&, const ExportOptions&);
  bool any_up = false;  // whether it can be written with Y up as well
  // From a scan as it is, without a world; null where the format has no such form.
  void (*write_scan)(const std::filesystem::path&, const PointCloud&,
                     const ExportOptions&) = nullptr;
};

const std::vector<ExportFormat>& export_formats();

// The format of this name, or of the file's extension where the name is empty. Throws usage naming
// those that exist.
const ExportFormat& export_format(const std::filesystem::path& path, const std::string& name = "");

// The world as it is to be written: moved, turned and coloured as asked, with colliders and rooms,
// which are made where it has none, and without the parts that are to be left out. Throws usage
// where nothing is left, and where it is over the budget, saying what and by how much.
World prepare_export(World world, const ExportOptions& options);

// Prepares a world and writes it in the format of the file's extension, or in `format`. Every file
// appears whole or not at all. Throws usage where an option does not go with the format.
void export_world(const World& world, const std::filesystem::path& path,
                  const ExportOptions& options = {}, const std::string& format = "");

// The same of those that need no world. Throws usage naming them where the format does.
const ExportFormat& scan_export_format(const std::filesystem::path& path,
                                       const std::string& name = "");

// Writes a scan in a format that needs no world, in the scan's coordinates as stored. Throws usage
// where an option asks for other ones.
void export_scan(const PointCloud& scan, const std::filesystem::path& path,
                 const ExportOptions& options = {}, const std::string& format = "");

// A format that a world could not be written in.
struct LeftOut {
  std::string format, why;
};

// The file that is in each folder of all formats: a README that says how to load each.
inline constexpr const char* kFormatsMark = "README.md";

// Writes the world in every format into a folder that is there, and the README. What a format
// refuses is left out and told.
std::vector<LeftOut> write_formats(const std::filesystem::path& folder, const World& world,
                                   const ExportOptions& options = {});

// The same as a folder of its own, which appears whole or not at all.
std::vector<LeftOut> export_all(const World& world, const std::filesystem::path& folder,
                                const ExportOptions& options = {});

}  // namespace scanworld
