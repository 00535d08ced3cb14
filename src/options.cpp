// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "options.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <numeric>

#include "error.h"

namespace scanworld {

namespace {

// The number of letters to change to turn one word into the other (Levenshtein, 1966).
std::size_t edit_distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t changed = diagonal + (a[i - 1] != b[j - 1]);
      diagonal = row[j];
      row[j] = std::min({row[j] + 1, row[j - 1] + 1, changed});
    }
  }
  return row[b.size()];
}

[[noreturn]] void fail(const std::string& text) { throw Error(Cause::usage, text); }

template <typename T>
T parse(const std::string& name, const std::string& text, const char* kind) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (text.empty() || error != std::errc() || end != text.data() + text.size())
    fail(fmt::format("option {}: '{}' is not {}", name, text, kind));
  return value;
}

}  // namespace

OptionValue Option::value() const {
  if (const auto* b = std::get_if<bool*>(&field)) return **b;
  if (const auto* i = std::get_if<int*>(&field)) return std::int64_t{**i};
  return **std::get_if<double*>(&field);
}

void set_option(const OptionList& options, const std::string& name, const std::string& text) {
  const auto option =
      std::find_if(options.begin(), options.end(), [&](const Option& o) { return o.name == name; });
  if (option == options.end()) {
    const auto like =
        std::min_element(options.begin(), options.end(), [&](const Option& a, const Option& b) {
          return edit_distance(a.name, name) < edit_distance(b.name, name);
        });
    fail(
        fmt::format("there is no option '{}'{}", name,
                    like == options.end() ? "" : fmt::format("; the nearest is '{}'", like->name)));
  }
  if (const auto* b = std::get_if<bool*>(&option->field)) {
    if (text != "true" && text != "false")
      fail(fmt::format("option {}: '{}' is not true or false", name, text));
    **b = text == "true";
    return;
  }
  const bool whole = std::holds_alternative<int*>(option->field);
  const double value =
      whole ? parse<int>(name, text, "a whole number") : parse<double>(name, text, "a number");
  if (!(value >= option->min && value <= option->max))
    fail(fmt::format("option {}: {} is not from {} to {}", name, text, option->min,
                     option->max == std::numeric_limits<double>::max()
                         ? "any size"
                         : fmt::to_string(option->max)));
  if (whole)
    **std::get_if<int*>(&option->field) = static_cast<int>(value);
  else
    **std::get_if<double*>(&option->field) = value;
}

void assign_option(const OptionList& options, const std::string& assignment) {
  const std::size_t at = assignment.find('=');
  if (at == std::string::npos)
    throw Error(Cause::usage, fmt::format("--set {}: should be key=value", assignment));
  set_option(options, assignment.substr(0, at), assignment.substr(at + 1));
}

std::string text_of(const OptionValue& value) {
  return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

}  // namespace scanworld
