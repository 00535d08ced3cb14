// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "surface/raster.h"

#include "support/support.h"

using namespace scanworld;
using namespace scanworld::test;
using namespace scanworld::surface;

namespace {

Raster random_raster(int width, int height, int one_of, std::uint64_t seed) {
  Raster raster{.cell = 0.1, .width = width, .height = height};
  Random random(seed);
  for (int i = 0; i < width * height; ++i) raster.bits.push_back(random.whole(1, one_of) == 1);
  return raster;
}

}  // namespace

TEST_CASE("a raster around a box holds it and its margin, at whole cells whatever the box") {
  Random random(8);
  for (int i = 0; i < 50; ++i) {
    const Vec2 low(random.uniform(-5, 5), random.uniform(-5, 5)),
        size(random.uniform(0, 3), random.uniform(0, 3));
    const Raster raster = raster_around({low, low + size}, 0.25, 0.1);
    CHECK((raster.low.array() <= low.array() - 0.25 + 1e-9).all());
    CHECK((raster.high().array() >= (low + size).array() + 0.25 - 1e-9).all());
    CHECK((raster.high() - raster.low - size).maxCoeff() < 0.7 + 1e-9);
    CHECK(raster.bits.size() == static_cast<std::size_t>(raster.width * raster.height));
    const Vec2 cells = raster.low / raster.cell;
    CHECK((cells.array() - cells.array().round()).abs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("growing sets the cells near one that is set and no others") {
  for (int reach : {0, 1, 3}) {
    const Raster raster = random_raster(23, 17, 40, 3), grown = grow(raster, reach);
    for (int y = 0; y < raster.height; ++y)
      for (int x = 0; x < raster.width; ++x) {
        bool near = false;
        for (int b = -reach; b <= reach; ++b)
          for (int a = -reach; a <= reach; ++a) near |= raster.is_set(x + a, y + b);
        CHECK(grown.is_set(x, y) == near);
      }
  }
}

TEST_CASE("closing fills narrow gaps, leaves wide ones, and does nothing twice") {
  Raster raster{.cell = 0.1, .width = 20, .height = 9, .bits = std::vector<std::uint8_t>(180)};
  for (int y = 2; y < 7; ++y)
    for (int x = 2; x < 18; ++x) raster.bits[raster.index(x, y)] = x != 6 && (x < 10 || x > 13);
  const Raster closed = close(raster, 1);
  CHECK(closed.is_set(6, 4));
  CHECK_FALSE(closed.is_set(11, 4));
  CHECK(close(closed, 1).bits == closed.bits);
  for (std::uint64_t seed : {1, 2, 3}) {
    const Raster any = random_raster(30, 30, 3, seed), filled = close(any, 2), grown = grow(any, 2);
    for (std::size_t i = 0; i < any.bits.size(); ++i) {
      CHECK(filled.bits[i] >= any.bits[i]);
      CHECK(filled.bits[i] <= grown.bits[i]);
    }
  }
}
