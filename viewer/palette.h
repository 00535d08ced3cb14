// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>

#include "types.h"

namespace scanworld {

// A colour of its own for each surface, by its id: hues a golden angle apart, as the page has them
// (viewer/page/src/palette.ts).
inline Color color_of_id(int id) {
  const double hue = std::fmod(0.381966 * id + 0.08, 1.0);
  const double lightness = 0.66 + 0.06 * (id % 3 - 1);
  const double chroma = 0.5 * std::min(lightness, 1 - lightness);
  // From hue, saturation and lightness to red, green and blue.
  const auto channel = [&](double n) {
    const double k = std::fmod(n + 12 * hue, 12.0);
    const double share = lightness - chroma * std::max(-1.0, std::min({k - 3, 9 - k, 1.0}));
    return static_cast<std::uint8_t>(std::lround(255 * share));
  };
  return {channel(0), channel(8), channel(4)};
}

}  // namespace scanworld
