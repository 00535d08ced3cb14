// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <map>
#include <mutex>

#include "../error.h"
#include "../parallel.h"

namespace scanworld {

namespace {

// Calls visit(part, rows) for each part, in parallel.
void for_each_part(const RowSource& source,
                   const std::function<void(std::size_t, const Rows&)>& visit) {
  parallel_for(source.parts(), [&](std::size_t part) {
    thread_local Rows scratch;
    visit(part, source.load(part, scratch));
  });
}

// The median of the coordinates on each axis, as the lower edge of its bin of 512 m. Found in two
// rounds of histograms over +-2^30 m (what is farther out is on no planet of ours, and left out).
// An order statistic: the order of the rows does not matter, and a few outliers hardly do.
Vec3 coarse_median(const RowSource& source) {
  constexpr int kBins = 2048;
  constexpr double kReach = 1 << 30;
  Vec3 low = Vec3::Constant(-kReach);
  std::array<std::size_t, 3> below{};  // rows below `low`
  for (double width = 2 * kReach / kBins; width >= 512; width /= kBins) {
    std::array<std::array<std::size_t, kBins>, 3> counts{};
    std::size_t usable = 0;
    std::mutex mutex;
    for_each_part(source, [&](std::size_t, const Rows& rows) {
      std::vector<std::array<int, 3>> bins;
      std::size_t usable_here = 0;
      for (const Vec3& p : rows.points) {
        if (!(p.array().abs() < kReach).all()) continue;
        ++usable_here;
        const Vec3 bin = ((p - low) / width).array().floor();
        bins.push_back(
            {static_cast<int>(bin.x()), static_cast<int>(bin.y()), static_cast<int>(bin.z())});
      }
      const std::lock_guard lock(mutex);  // whole numbers: the order of the parts does not matter
      usable += usable_here;
      for (const auto& bin : bins)
        for (std::size_t k = 0; k < 3; ++k)
          if (bin[k] >= 0 && bin[k] < kBins) ++counts[k][static_cast<std::size_t>(bin[k])];
    });
    for (std::size_t k = 0; k < 3; ++k) {
      std::size_t bin = 0;
      for (; bin + 1 < kBins && below[k] + counts[k][bin] <= usable / 2; ++bin)
        below[k] += counts[k][bin];
      low[static_cast<int>(k)] += static_cast<double>(bin) * width;
    }
  }
  return low;
}

// The rows of several sources, one after the other.
RowSource chain(const std::vector<RowSource>& sources) {
  RowSource all{.first = {0}, .normals = true, .colors = true};
  std::vector<std::pair<const RowSource*, std::size_t>> parts;
  for (const RowSource& source : sources) {
    all.name += (all.name.empty() ? "" : ", ") + source.name;
    all.normals &= source.normals;
    all.colors &= source.colors;
    const std::size_t before = all.rows();
    for (std::size_t part = 0; part < source.parts(); ++part) {
      parts.emplace_back(&source, part);
      all.first.push_back(before + source.first[part + 1]);
    }
  }
  // Attributes come with the rows only.
  const bool all_floats = !all.normals && !all.colors &&
                          std::all_of(sources.begin(), sources.end(),
                                      [](const RowSource& s) { return !!s.load_floats; });
  if (sources.size() == 1 && all_floats) all.take_floats = sources[0].take_floats;
  if (all_floats)
    all.load_floats = [parts](std::size_t i, Vec3f* to) {
      parts[i].first->load_floats(parts[i].second, to);
    };
  all.load = [parts](std::size_t i, Rows& scratch) -> const Rows& {
    return parts[i].first->load(parts[i].second, scratch);
  };
  return all;
}

}  // namespace

void Rows::clear() {
  points.clear();
  near_points.clear();
  normals.clear();
  colors.clear();
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
}

void Rows::resize(std::size_t rows) {
  const auto cut = [&](auto& values) {
    if (values.size() > rows) values.resize(rows);
  };
  cut(points), cut(near_points), cut(normals), cut(colors);
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

PointCloud assemble_cloud(const std::vector<RowSource>& sources) {
  const RowSource source = chain(sources);
  PointCloud cloud;
  if (!source.take_floats) cloud.points.resize(source.rows());
  if (source.normals) cloud.normals.resize(source.rows());
  if (source.colors) cloud.colors.resize(source.rows());

  std::vector<std::vector<std::size_t>> skipped(source.parts());
  std::vector<float> reach(source.parts());  // how far from zero the part's finite coordinates go
  const auto look_at = [&](std::size_t part) {
    skipped[part].clear();
    Vec3f far = Vec3f::Zero();
    for (std::size_t i = source.first[part]; i < source.first[part + 1]; ++i) {
      const Vec3f& p = cloud.points[i];
      if (p.x() * 0 + p.y() * 0 + p.z() * 0 == 0)
        far = far.cwiseMax(p.cwiseAbs());  // 0 times infinity is not 0
      else
        skipped[part].push_back(i);
    }
    reach[part] = far.maxCoeff();
  };
  const auto fill = [&] {
    for_each_part(source, [&](std::size_t part, const Rows& rows) {
      const std::size_t first = source.first[part];
      for (std::size_t i = 0; i < rows.points.size(); ++i)
        cloud.points[first + i] = (rows.points[i] - cloud.origin).cast<float>();
      if (source.normals)
        std::copy(rows.normals.begin(), rows.normals.end(), cloud.normals.data() + first);
      if (source.colors)
        std::copy(rows.colors.begin(), rows.colors.end(), cloud.colors.data() + first);
      look_at(part);
    });
  };
  if (source.take_floats) {
    cloud.points = source.take_floats();
    parallel_for(source.parts(), look_at);
  } else if (source.load_floats) {
    parallel_for(source.parts(), [&](std::size_t part) {
      source.load_floats(part, cloud.points.data() + source.first[part]);
      look_at(part);
    });
  } else {
    fill();
  }
  if (std::any_of(reach.begin(), reach.end(),
                  [](float far) { return far > static_cast<float>(kNearOrigin); })) {
    const Vec3 median = coarse_median(source);
    for (int k = 0; k < 3; ++k) cloud.origin[k] = std::abs(median[k]) > kNearOrigin ? median[k] : 0;
    if (!cloud.origin.isZero()) fill();
  }
  for (const auto& s : skipped) cloud.skipped.insert(cloud.skipped.end(), s.begin(), s.end());
  for (const RowSource& each : sources)
    for (const Vec3& viewpoint : each.viewpoints)
      cloud.viewpoints.push_back(viewpoint - cloud.origin);
  if (cloud.skipped.size() == source.rows())
    throw Error(Cause::bad_input, source.rows() == 0
                                      ? fmt::format("{}: holds no points", source.name)
                                      : fmt::format("{}: none of its {} points is finite",
                                                    source.name, source.rows()));

  const auto close_gaps = [&](auto& values) {
    if (values.empty()) return;
    auto to = values.begin();
    std::size_t next = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (next < cloud.skipped.size() && cloud.skipped[next] == i)
        ++next;
      else
        *to++ = values[i];
    }
    values.erase(to, values.end());
  };
  if (!cloud.skipped.empty())
    close_gaps(cloud.points), close_gaps(cloud.normals), close_gaps(cloud.colors);
  return cloud;
}

RowSource rows_in_memory(const std::string& name, Rows all) {
  constexpr std::size_t kPartRows = 1 << 15;
  RowSource source{
      .name = name, .first = {0}, .normals = !all.normals.empty(), .colors = !all.colors.empty()};
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
  source.load = [held, first = source.first](std::size_t part, Rows& scratch) -> const Rows& {
    const auto copy = [&](const auto& from, auto& to) {
      if (!from.empty())
        to.assign(from.begin() + static_cast<std::ptrdiff_t>(first[part]),
                  from.begin() + static_cast<std::ptrdiff_t>(first[part + 1]));
    };
    scratch.clear();
    copy(held->points, scratch.points);
    copy(held->near_points, scratch.near_points);
    copy(held->normals, scratch.normals);
    copy(held->colors, scratch.colors);
    scratch.widen();
    return scratch;
  };
  return source;
}

}  // namespace scanworld
