// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "world.h"

namespace scanworld {

// The newest version of the format; a world without curves is written as version 1. Both are read.
inline constexpr int kWorldSchemaVersion = 2;

// The file that holds a world: world.json in a folder, else the path itself.
std::filesystem::path world_file(const std::filesystem::path& path);

// Reads a world from world.json, or from the world.json in a folder. Throws bad_input naming the
// file and the place in it: what is missing, of another type, unknown, or of another version.
// Nothing is left out silently.
World read_world(const std::filesystem::path& path);
// The same, for all who use a world rather than judge it: throws bad_input where it is not valid
// (validate.h), naming the first reason.
World read_valid_world(const std::filesystem::path& path);
World parse_world(const std::string& text, const std::string& name = "world");

// Writes a world so that reading it gives the same world, bit for bit.
void write_world(const std::filesystem::path& path, const World& world);
std::string world_text(const World& world);

// 16 hexadecimal digits that change with anything in the world but its provenance.
std::string world_hash(const World& world);

}  // namespace scanworld
