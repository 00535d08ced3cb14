// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <vector>

#include "exporters/bodies.h"

namespace scanworld::sim {

// What does not move in a .bullet file.
struct BulletFile {
  std::vector<ExportBody> solids;  // none where a body is a triangle mesh
  Mesh seen;  // the mesh named "rays" (exporters/bullet.h), else the triangles of all bodies
  double seconds = 0;  // that reading took
};

// Reads a .bullet file of either precision. Boxes, cylinders, hulls, triangle meshes and compounds
// of them are known; throws bad_input naming another shape, or where the file is damaged: as
// Bullet's own reader crashes on many a damaged file, it is tried in a process of its own first.
BulletFile read_bullet(const std::filesystem::path& path);

}  // namespace scanworld::sim
