// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "fuzz.h"
#include "world/triangulate.h"
#include "world/validate.h"
#include "world/world_json.h"

// Any text is read or refused; what is read is written and read the same; what is valid is
// triangulated.
void fuzz(const std::string& bytes) {
  const scanworld::World world = scanworld::parse_world(bytes);
  const std::string text = scanworld::world_text(world);
  if (scanworld::world_text(scanworld::parse_world(text)) != text) std::abort();
  if (!scanworld::validate(world).empty()) return;
  const scanworld::WorldMesh mesh = scanworld::triangulate(world);
  if (mesh.mesh.triangles.size() < world.surfaces.size()) std::abort();
}
