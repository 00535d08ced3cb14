// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "rows.h"

namespace scanworld {

// Makes one cloud of one or more files: leaves out rows that are not finite, and where coordinates
// are so large that float would lose them, moves the origin into the middle of the scan
// (component-wise median, in steps of 512 m). Throws bad_input where no row is finite. The origin
// does not depend on the order of the rows. Attributes that not all sources have are left out, and
// so are normals that for the most part were never set: zero or not finite.
//
// `poses`, in the coordinates of the files, take the place of the scanner positions that files
// tell; a point's scan_index then is the number of its own, from 0, and negative or not a number
// where that is unknown. Throws bad_input where there is no such pose. Without them each point of
// several files was seen from the position that its own file tells.
PointCloud assemble_cloud(const std::vector<RowSource>& sources,
                          const std::vector<Vec3>& poses = {});

}  // namespace scanworld
