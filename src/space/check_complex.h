// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "cells.h"

namespace scanworld::space {

// What is wrong with a complex, in whole numbers but for the volumes: every facet is planar,
// strictly convex and counter-clockwise, no two vertices are one place, every cell is convex and
// closed (each piece of a line between corners has as many edges one way as the other, one each),
// satisfies Euler's formula and has its leaf in the tree, and the volumes add up to the box's.
// Empty where all is right.
std::vector<std::string> check_complex(const CellComplex& complex);

}  // namespace scanworld::space
