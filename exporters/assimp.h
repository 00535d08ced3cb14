// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

#include "world/world.h"

namespace scanworld {

// Writes a format that assimp writes well; `format` is its name there ("collada"). Metres; +Z up
// where the format can say so.
void write_with_assimp(const std::filesystem::path& path, const World& world,
                       const std::string& format);

// Reads a mesh of any format that assimp knows, in the file's own axes, equal vertices joined.
// Throws bad_input naming the file.
Mesh read_mesh(const std::filesystem::path& path);

}  // namespace scanworld
