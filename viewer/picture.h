// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Pictures of worlds on machines without a display: by rays, the same bytes each time.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "camera.h"

namespace scanworld {

struct Image {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgb;  // row by row from the top, three bytes a pixel
};

struct PictureOptions {
  int width = 1600, height = 1000;  // pixels
  int samples = 3;                  // along each edge of a pixel
};

// A world as it is seen from its free sides, so that one looks through ceilings into rooms; each
// surface in a colour of its own with dark edges, obstacles grey, panes of glass blue. Throws usage
// for sizes out of 1 to 16384, and check_failed naming a surface that is no valid polygon.
Image draw(const World& world, const Camera& camera, const PictureOptions& options = {});

// A file of this image as PNG, by libpng.
std::string png_of(const Image& image);

}  // namespace scanworld
