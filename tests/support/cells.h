// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Cell complexes to test with, and what must hold of every one.
#pragma once

#include <vector>

#include "space/cells.h"
#include "support.h"

namespace scanworld::test {

inline const Box3 kCellBox(Vec3(-3, -2, -1), Vec3(5, 4, 2));

// Splits all cells that there are by a plane. How many it cut.
int split_all(space::CellComplex& complex, const Plane& plane);

// Nothing is wrong with a complex.
void check(const space::CellComplex& complex);

Vec3 random_place(Random& random, const Box3& box);

// The corners of a rectangle round a place, turned about the normal by chance; `size` is half of
// its longer side.
std::vector<Vec3> random_rectangle(Random& random, const Vec3& middle, const Vec3& normal,
                                   double size);

double area_of(const std::vector<Vec3>& polygon);

// Cut as a place is: by every plane the cells that its patch is in. Some planes are level or
// upright, some are on a grid, so that many meet in one line or point.
space::CellComplex random_complex(std::uint64_t seed, const Box3& box, int planes);

}  // namespace scanworld::test
