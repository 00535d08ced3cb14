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

// Scans with their median within this are kept as they are: a float resolves half a millimetre there.
constexpr double kNearOrigin = 8000;  // [m]

// Calls visit(part, rows) for each part, in parallel.
void for_each_part(const RowSource& source,
                   const std::function<void(std::size_t, const Rows&)>& visit) {
  parallel_for(source.parts(), [&](std::size_t part) {
    thread_local Rows scratch;
    visit(part, source.load(part, scratch));
  });
}

// The median of the coordinates on each axis, as the lower edge of its bin of 512 m. Found in two rounds of
// histograms over +-2^30 m (what is farther out is on no planet of ours, and left out). An order statistic:
// the order of the rows does not matter, and a few outliers hardly do.
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
        if (!(p.cwiseAbs().maxCoeff() < kReach)) continue;
        ++usable_here;
        const Vec3 bin = ((p - low) / width).array().floor();
        bins.push_back({static_cast<int>(bin.x()), static_cast<int>(bin.y()), static_cast<int>(bin.z())});
      }
      const std::lock_guard lock(mutex);  // whole numbers: the order of the parts does not matter
      usable += usable_here;
      for (const auto& bin : bins)
        for (std::size_t k = 0; k < 3; ++k)
          if (bin[k] >= 0 && bin[k] < kBins) ++counts[k][static_cast<std::size_t>(bin[k])];
    });
    for (std::size_t k = 0; k < 3; ++k) {
      std::size_t bin = 0;
      for (; bin + 1 < kBins && below[k] + counts[k][bin] <= usable / 2; ++bin) below[k] += counts[k][bin];
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
  all.load = [parts](std::size_t i, Rows& scratch) -> const Rows& {
    return parts[i].first->load(parts[i].second, scratch);
  };
  return all;
}

}  // namespace

Role role_of(std::string name) {
  static const std::map<std::string, Role> roles = {
      {"x", Role::x},                     {"y", Role::y},
      {"z", Role::z},                     {"nx", Role::nx},
      {"ny", Role::ny},                   {"nz", Role::nz},
      {"normal_x", Role::nx},             {"normal_y", Role::ny},
      {"normal_z", Role::nz},             {"red", Role::red},
      {"green", Role::green},             {"blue", Role::blue},
      {"r", Role::red},                   {"g", Role::green},
      {"b", Role::blue},                  {"diffuse_red", Role::red},
      {"diffuse_green", Role::green},     {"diffuse_blue", Role::blue},
      {"rgb", Role::packed_rgb},          {"rgba", Role::packed_rgb},
  };
  std::transform(name.begin(), name.end(), name.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto found = roles.find(name);
  return found == roles.end() ? Role::none : found->second;
}

std::vector<Role> usable_roles(std::vector<Role> roles, const std::string& name,
                               std::string_view columns) {
  const auto has = [&](Role role) { return std::find(roles.begin(), roles.end(), role) != roles.end(); };
  const auto drop = [&](std::initializer_list<Role> group) {
    for (Role role : group) std::replace(roles.begin(), roles.end(), role, Role::none);
  };
  for (auto role = roles.begin(); role != roles.end(); ++role)
    if (std::find(roles.begin(), role, *role) != role) *role = Role::none;
  for (auto [role, letter] : {std::pair{Role::x, 'x'}, {Role::y, 'y'}, {Role::z, 'z'}})
    if (!has(role)) throw Error(Cause::bad_input, fmt::format("{}: {} have no '{}'", name, columns, letter));
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
  cloud.points.resize(source.rows());
  if (source.normals) cloud.normals.resize(source.rows());
  if (source.colors) cloud.colors.resize(source.rows());

  std::vector<std::vector<std::size_t>> skipped(source.parts());
  std::vector<double> reach(source.parts());  // how far from zero the part's finite coordinates go
  const auto fill = [&] {
    for_each_part(source, [&](std::size_t part, const Rows& rows) {
      skipped[part].clear();
      std::size_t at = source.first[part];
      for (std::size_t i = 0; i < rows.points.size(); ++i, ++at) {
        cloud.points[at] = (rows.points[i] - cloud.origin).cast<float>();
        if (source.normals) cloud.normals[at] = rows.normals[i];
        if (source.colors) cloud.colors[at] = rows.colors[i];
        if (cloud.points[at].allFinite())
          reach[part] = std::max(reach[part], rows.points[i].cwiseAbs().maxCoeff());
        else
          skipped[part].push_back(at);
      }
    });
  };
  fill();
  if (std::any_of(reach.begin(), reach.end(), [](double far) { return far > kNearOrigin; })) {
    const Vec3 median = coarse_median(source);
    for (int k = 0; k < 3; ++k) cloud.origin[k] = std::abs(median[k]) > kNearOrigin ? median[k] : 0;
    if (!cloud.origin.isZero()) fill();
  }
  for (const auto& s : skipped) cloud.skipped.insert(cloud.skipped.end(), s.begin(), s.end());
  for (const RowSource& each : sources)
    for (const Vec3& viewpoint : each.viewpoints) cloud.viewpoints.push_back(viewpoint - cloud.origin);
  if (cloud.skipped.size() == source.rows())
    throw Error(Cause::bad_input, source.rows() == 0
                                      ? fmt::format("{}: holds no points", source.name)
                                      : fmt::format("{}: none of its {} points is finite", source.name,
                                                    source.rows()));

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
  if (!cloud.skipped.empty()) close_gaps(cloud.points), close_gaps(cloud.normals), close_gaps(cloud.colors);
  return cloud;
}

RowSource rows_in_memory(const std::string& name, std::vector<Rows> parts) {
  RowSource source{.name = name, .first = {0}};
  for (const Rows& rows : parts) {
    source.first.push_back(source.first.back() + rows.points.size());
    source.normals |= !rows.normals.empty();
    source.colors |= !rows.colors.empty();
  }
  source.load = [held = std::make_shared<const std::vector<Rows>>(std::move(parts))](
                    std::size_t part, Rows&) -> const Rows& { return (*held)[part]; };
  return source;
}

}  // namespace scanworld
