// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "settings.h"

#include <fmt/format.h>
#include <toml++/toml.h>

#include "error.h"

namespace scanworld::cli {

namespace {

std::string text_of(const toml::node& node) {
  if (const auto b = node.value<bool>(); b && node.is_boolean()) return *b ? "true" : "false";
  if (const auto i = node.value<std::int64_t>(); i && node.is_integer()) return fmt::to_string(*i);
  if (const auto d = node.value<double>(); d && node.is_floating_point()) return fmt::to_string(*d);
  if (const auto s = node.value<std::string>()) return *s;
  return "(a list)";
}

void apply_table(const OptionList& options, const toml::table& table, const std::string& prefix,
                 const std::string& file) {
  for (const auto& [key, node] : table) {
    const std::string name = prefix + std::string(key.str());
    if (const toml::table* inner = node.as_table()) {
      apply_table(options, *inner, name + ".", file);
      continue;
    }
    try {
      set_option(options, name, text_of(node));
    } catch (const Error& e) {
      throw Error(e.cause, fmt::format("{}:{}: {}", file, node.source().begin.line, e.what()));
    }
  }
}

}  // namespace

void apply_config(ReconstructOptions& options, const std::filesystem::path& file) {
  try {
    const toml::table table = toml::parse_file(file.string());
    apply_table(list_options(options), table, "", file.string());
  } catch (const toml::parse_error& e) {
    throw Error(Cause::bad_input,
                fmt::format("{}:{}: {}", file.string(), e.source().begin.line, e.description()));
  }
}

void apply_assignments(ReconstructOptions& options, const std::vector<std::string>& assignments) {
  const OptionList list = list_options(options);
  for (const std::string& assignment : assignments) assign_option(list, assignment);
}

std::string options_table() {
  ReconstructOptions defaults;
  std::string table =
      fmt::format("{:<42} {:>8} {:<6} {}\n", "option", "default", "unit", "meaning");
  for (const Option& option : list_options(defaults))
    table += fmt::format("{:<42} {:>8} {:<6} {}\n", option.name, scanworld::text_of(option.value()),
                         option.unit, option.meaning);
  return table;
}

}  // namespace scanworld::cli
