// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

#include "export_options.h"
#include "world/world.h"

namespace scanworld {

// Bullet's own format, in single precision, which its builds of either precision read: a static
// body of its own for each solid, named, with friction; gravity; and, belonging to no body, a
// triangle mesh of all that is to be seen, named "rays", with its tree and its internal edges
// (btInternalEdgeUtility). Rays against that mesh are exact and fast; contacts are better left to
// the solids. Bullet does not store which groups collide, so it is for the reader to put it to use.
void write_bullet(const std::filesystem::path& path, const World& world,
                  const ExportOptions& options);

}  // namespace scanworld
