// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace scanworld {

using OptionValue = std::variant<bool, std::int64_t, double, std::string>;

// The name, unit and meaning of a field of an options struct, so that a command line, a file or a
// report can get at it. The struct itself holds the default.
struct Option {
  std::string name;  // with the path to it: "thesis.filter.min_size"
  std::variant<bool*, int*, double*> field;
  std::string unit;  // "m", "rad", "delta" ...; empty for counts and shares
  std::string meaning;
  double min = 0, max = std::numeric_limits<double>::max();  // inclusive

  OptionValue value() const;
};
using OptionList = std::vector<Option>;

// Sets an option from text. Throws usage naming the option and the value where there is none of
// this name (and which ones are alike), or where the value is no number or out of range.
void set_option(const OptionList& options, const std::string& name, const std::string& value);

// The same from "name=value"; throws usage too where there is no '='.
void assign_option(const OptionList& options, const std::string& assignment);

std::string text_of(const OptionValue& value);

}  // namespace scanworld
