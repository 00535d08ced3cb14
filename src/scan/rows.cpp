// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <memory>

#include "../error.h"
#include "../parallel.h"

namespace scanworld {

void Rows::clear() {
  points.clear();
  near_points.clear();
  normals.clear();
  colors.clear();
  scan_index.clear();
}

void Rows::widen() {
  for (const Vec3f& p : near_points) points.push_back(p.cast<double>());
  near_points = {};
}

void Rows::append(const Rows& more) {
  if (more.points.empty() && points.empty()) {
    near_points.insert(near_points.end(), more.near_points.begin(), more.near_points.end());
  } else {
    widen();
    points.insert(points.end(), more.points.begin(), more.points.end());
    for (const Vec3f& p : more.near_points) points.push_back(p.cast<double>());
  }
  normals.insert(normals.end(), more.normals.begin(), more.normals.end());
  colors.insert(colors.end(), more.colors.begin(), more.colors.end());
  scan_index.insert(scan_index.end(), more.scan_index.begin(), more.scan_index.end());
}

void Rows::resize(std::size_t rows) {
  const auto cut = [&](auto& values) {
    if (values.size() > rows) values.resize(rows);
  };
  cut(points), cut(near_points), cut(normals), cut(colors), cut(scan_index);
}

Role role_of(std::string name) {
  static const std::map<std::string, Role> roles = {
      {"x", Role::x},
      {"y", Role::y},
      {"z", Role::z},
      {"nx", Role::nx},
      {"ny", Role::ny},
      {"nz", Role::nz},
      {"normal_x", Role::nx},
      {"normal_y", Role::ny},
      {"normal_z", Role::nz},
      {"red", Role::red},
      {"green", Role::green},
      {"blue", Role::blue},
      {"r", Role::red},
      {"g", Role::green},
      {"b", Role::blue},
      {"diffuse_red", Role::red},
      {"diffuse_green", Role::green},
      {"diffuse_blue", Role::blue},
      {"rgb", Role::packed_rgb},
      {"rgba", Role::packed_rgb},
      {"scan_index", Role::scan_index},
  };
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = roles.find(name);
  return found == roles.end() ? Role::none : found->second;
}

std::vector<Role> usable_roles(std::vector<Role> roles, const std::string& name,
                               std::string_view columns) {
  const auto has = [&](Role role) {
    return std::find(roles.begin(), roles.end(), role) != roles.end();
  };
  const auto drop = [&](std::initializer_list<Role> group) {
    for (Role role : group) std::replace(roles.begin(), roles.end(), role, Role::none);
  };
  for (auto role = roles.begin(); role != roles.end(); ++role)
    if (std::find(roles.begin(), role, *role) != role) *role = Role::none;
  for (auto [role, letter] : {std::pair{Role::x, 'x'}, {Role::y, 'y'}, {Role::z, 'z'}})
    if (!has(role))
      throw Error(Cause::bad_input, fmt::format("{}: {} have no '{}'", name, columns, letter));
  if (!has(Role::nx) || !has(Role::ny) || !has(Role::nz)) drop({Role::nx, Role::ny, Role::nz});
  const bool channels = has(Role::red) && has(Role::green) && has(Role::blue);
  if (!channels) drop({Role::red, Role::green, Role::blue});
  if (channels) drop({Role::packed_rgb, Role::packed_rgb_float});
  return roles;
}

Color unpack_rgb(std::uint32_t rgb) {
  const auto byte = [&](int shift) { return static_cast<std::uint8_t>(rgb >> shift & 255); };
  return {byte(16), byte(8), byte(0)};
}

RowSource rows_in_memory(const std::string& name, Rows all) {
  constexpr std::size_t kPartRows = 1 << 15;
  RowSource source{.name = name,
                   .first = {0},
                   .normals = !all.normals.empty(),
                   .colors = !all.colors.empty(),
                   .scan_index = !all.scan_index.empty()};
  for (std::size_t i = 0; i < part_count(all.size(), kPartRows); ++i)
    source.first.push_back(part_of(i, all.size(), kPartRows).end);
  const auto held = std::make_shared<Rows>(std::move(all));
  if (held->points.empty()) {
    source.load_floats = [held, first = source.first](std::size_t part, Vec3f* to) {
      std::copy(held->near_points.data() + first[part], held->near_points.data() + first[part + 1],
                to);
    };
    source.take_floats = [held] { return std::move(held->near_points); };
  }
  source.load = [held, first = source.first](std::size_t part, Rows& scratch) -> RowsView {
    const auto slice = [&](const auto& values) {
      return std::span(values).subspan(values.empty() ? 0 : first[part],
                                       values.empty() ? 0 : first[part + 1] - first[part]);
    };
    RowsView view{slice(held->points), slice(held->normals), slice(held->colors),
                  slice(held->scan_index)};
    if (held->points.empty()) {
      scratch.points.clear();
      for (const Vec3f& p : slice(held->near_points)) scratch.points.push_back(p.cast<double>());
      view.points = scratch.points;
    }
    return view;
  };
  return source;
}

}  // namespace scanworld
