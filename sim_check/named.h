// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "error.h"

namespace scanworld::sim {

// The names of items that have one, with commas between.
template <typename T>
std::string names_of(const std::vector<T>& items) {
  std::string names;
  for (const T& item : items) names += (names.empty() ? "" : ", ") + item.name;
  return names;
}

// The item of a name. Throws usage naming those that there are.
template <typename T>
const T& find_named(const std::vector<T>& items, const std::string& name, const std::string& what) {
  const auto found = std::ranges::find(items, name, &T::name);
  if (found != items.end()) return *found;
  throw Error(Cause::usage, "no " + what + " '" + name + "'; there is " + names_of(items));
}

}  // namespace scanworld::sim
