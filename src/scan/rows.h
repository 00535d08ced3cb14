// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "../types.h"

namespace scanworld {

// What a column of a scan file holds. The packed colour is 0x00RRGGBB, as a number or as a float's
// bits.
enum class Role {
  none,
  x,
  y,
  z,
  nx,
  ny,
  nz,
  red,
  green,
  blue,
  packed_rgb,
  packed_rgb_float,
  scan_index
};

// The role that a column's name tells, in any case: x, normal_y, red, diffuse_red, rgb, scan_index
// ...; none for others.
Role role_of(std::string name);

// Keeps of the roles what can be used: the first of each kind, normals and colours only where all
// their parts are there. Throws bad_input, saying what `columns` are in file `name`, where x, y or
// z is missing.
std::vector<Role> usable_roles(std::vector<Role> roles, const std::string& name,
                               std::string_view columns);

// The colour packed as 0x00RRGGBB.
Color unpack_rgb(std::uint32_t rgb);

// Points with no coordinate larger than this are kept as they are, as floats: those resolve half a
// millimetre there.
inline constexpr double kNearOrigin = 8000;  // [m]

// Some rows of a scan as read, not finite ones included.
struct Rows {
  std::vector<Vec3> points;
  std::vector<Vec3f> near_points;  // in the place of `points` where all are near the origin
  std::vector<Vec3f> normals;      // empty, or one a row
  std::vector<Color> colors;       // empty, or one a row
  std::vector<double> scan_index;  // empty, or one a row

  std::size_t size() const { return std::max(points.size(), near_points.size()); }
  void clear();  // keeps the memory
  void widen();  // near points become points
  void append(const Rows& more);
  void resize(std::size_t rows);
};

// Rows to look at: those of a scan, or some of them.
struct RowsView {
  std::span<const Vec3> points;
  std::span<const Vec3f> normals;
  std::span<const Color> colors;
  std::span<const double> scan_index;
};

// The rows of a scan file in parts that can be had in any order, more than once, from several
// threads.
struct RowSource {
  std::string name;               // of the file, for messages
  std::vector<Vec3> viewpoints;   // scanner positions that the file tells
  std::uint64_t image_width = 0;  // where the rows are the pixels of an image, line by line; else 0
  std::vector<std::size_t>
      first;  // position of each part's first row; one more entry: the number of rows
  bool normals = false, colors = false, scan_index = false;
  // Returns the part's rows: in `scratch`, or where it holds them already.
  std::function<RowsView(std::size_t part, Rows& scratch)> load;
  // Where all coordinates are floats already: puts the part's points where they belong, without
  // attributes.
  std::function<void(std::size_t part, Vec3f* to)> load_floats;
  // Where they are in memory all together: gives them away.
  std::function<std::vector<Vec3f>()> take_floats;

  std::size_t parts() const { return first.size() - 1; }
  std::size_t rows() const { return first.back(); }
};

// A source of rows that are in memory.
RowSource rows_in_memory(const std::string& name, Rows rows);

}  // namespace scanworld
