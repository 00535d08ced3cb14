// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>

namespace scanworld {

// What went wrong, in the classes that a caller tells apart. The values are the exit codes of
// `scanworld`.
enum class Cause {
  failure = 1,        // the machine: no space, no permission to write, out of memory
  usage = 2,          // an option that does not exist or has a value out of range
  bad_input = 3,      // a file that is missing, unreadable or not what it says it is
  nothing_found = 4,  // a readable scan with nothing in it that could be made into a world
  check_failed = 5,   // a world that breaks a promise
};

// The one exception of the library. The message names the file, the element and the value.
struct Error : std::runtime_error {
  Error(Cause why, const std::string& message) : std::runtime_error(message), cause(why) {}
  Cause cause;
};

}  // namespace scanworld
