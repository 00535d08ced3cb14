// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Writes OBJ and, beside it under the same name, MTL: an object for each surface and obstacle, a
// material for each colour. Metres, +Z up, which the format cannot say but in a comment.
void write_obj(const std::filesystem::path& path, const World& world, const ExportOptions& options);

// A mesh as one object, without material.
std::string obj_text(const std::string& name, const Mesh& mesh);

}  // namespace scanworld
