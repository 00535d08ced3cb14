// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "xyz.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "../error.h"
#include "text_rows.h"

namespace scanworld {

namespace {

constexpr std::size_t kSampleRows = 200;  // looked at to tell what the columns hold

// The roles that a line of names gives, if it is one: it names x, y and z.
std::optional<std::vector<Role>> named_columns(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t#/%;"), line.size()));
  std::vector<Role> roles;
  for (std::string_view word : split_columns(line)) {
    while (!word.empty() && (word.front() == '"' || word.front() == '\'')) word.remove_prefix(1);
    while (!word.empty() && (word.back() == '"' || word.back() == '\'')) word.remove_suffix(1);
    roles.push_back(role_of(std::string(word)));
  }
  for (Role role : {Role::x, Role::y, Role::z})
    if (std::find(roles.begin(), roles.end(), role) == roles.end()) return std::nullopt;
  return roles;
}

std::optional<std::vector<double>> numbers(std::string_view line) {
  std::vector<double> values;
  for (std::string_view word : split_columns(line)) {
    const auto value = number_of(word);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  return values;
}

// What unnamed columns hold, judged by some rows of numbers.
std::vector<Role> guess_columns(const std::vector<std::vector<double>>& sample) {
  std::size_t columns = sample[0].size();
  for (const auto& row : sample) columns = std::min(columns, row.size());
  const auto all = [&](std::size_t first, auto test) {
    return first + 3 <= columns && std::all_of(sample.begin(), sample.end(), [&](const auto& row) {
             return test(row[first], row[first + 1], row[first + 2]);
           });
  };
  const auto is_color = [&](std::size_t first) {
    return all(first,
               [](auto... v) { return ((v >= 0 && v <= 255 && v == std::floor(v)) && ...); });
  };
  const auto is_normal = [&](std::size_t first) {
    return all(first, [](auto... v) { return std::abs(((v * v) + ...) - 1) < 0.02; });
  };

  std::vector<Role> roles = {Role::x, Role::y, Role::z};
  bool color = false, normal = false;
  for (std::size_t i = 3; i < columns;) {
    // Of four or more columns left, the first may be the intensity: the colour then starts one
    // later.
    const bool later = (columns - i) % 3 == 1 && (is_color(i + 1) || is_normal(i + 1));
    if (!later && !color && is_color(i)) {
      roles.insert(roles.end(), {Role::red, Role::green, Role::blue});
      color = true, i += 3;
    } else if (!later && !normal && is_normal(i)) {
      roles.insert(roles.end(), {Role::nx, Role::ny, Role::nz});
      normal = true, i += 3;
    } else {
      roles.push_back(Role::none);
      ++i;
    }
  }
  while (roles.back() == Role::none) roles.pop_back();
  return roles;
}

// Looks at the first lines and tells what the columns hold and how many lines come before the rows.
struct Start {
  std::vector<Role> columns;
  std::uint64_t header_lines = 0;
};

Start look_at_start(LineReader& lines) {
  std::optional<std::vector<Role>> names;
  std::vector<std::vector<double>> sample;
  std::uint64_t header_lines = 0;
  for (std::string line; sample.size() < kSampleRows && lines.next_line(line);) {
    if (sample.empty() && !names && (names = named_columns(line))) {
      header_lines = lines.line_number();
      continue;
    }
    if (is_comment(line)) continue;
    const auto row = numbers(line);
    if (!row) break;  // reading the rows will say what is wrong, if they get so far
    if (row->size() > 1) sample.push_back(*row);
  }
  if (names) {
    while (names->back() == Role::none) names->pop_back();
    return {usable_roles(*names, lines.name(), "the columns"), header_lines};
  }
  if (sample.empty()) return {{Role::x, Role::y, Role::z}, 0};
  return {guess_columns(sample), 0};
}

}  // namespace

RowSource open_xyz(const std::filesystem::path& path) {
  LineReader first_look(path);
  const Start start = look_at_start(first_look);
  LineReader lines(path);
  std::string line;
  while (lines.line_number() < start.header_lines) lines.next_line(line);
  return rows_in_memory(lines.name(),
                        read_text_rows(lines, {.columns = start.columns, .counts_between = true}));
}

}  // namespace scanworld
