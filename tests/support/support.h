// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What tests share: places for files, errors that are expected, random numbers, and the command as
// a user runs it.
#pragma once

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"
#include "types.h"

namespace scanworld::test {

constexpr double kDegree = M_PI / 180;
constexpr double kNoise = 0.005;  // [m] of a scan, where it does not matter

// A new folder that is removed with all it holds.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

// Writes a file and returns its path.
std::filesystem::path write_file(const std::filesystem::path& path, std::string_view bytes);
std::string read_file(const std::filesystem::path& path);

// A file of the project itself: in_project("data/office.ply").
std::filesystem::path in_project(std::string_view path);

// A real scan of ../shared/data, where that folder is present; where it is not, says that the test
// skips.
std::optional<std::filesystem::path> shared_scan(std::string_view name);

// The message of the Error that `action` throws, whose cause must be this one.
template <typename Action>
std::string error_of(Cause cause, Action action) {
  try {
    action();
  } catch (const Error& e) {
    CHECK(static_cast<int>(e.cause) == static_cast<int>(cause));
    return e.what();
  }
  FAIL_CHECK("no error was thrown");
  return "";
}

inline bool contains(std::string_view text, std::string_view part) {
  return text.find(part) != std::string_view::npos;
}

// Random numbers that are the same on every machine (SplitMix64).
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next();
  double uniform(double low = 0, double high = 1);
  double gauss();
  int whole(int low, int high);  // both included
  Vec3 direction();

 private:
  std::uint64_t state_;
};

template <typename T>
void shuffle(std::vector<T>& items, Random& random) {
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.next() % i]);
}

// What the command did.
struct Outcome {
  int code = -1;
  std::string out, err;
  double seconds = 0;
  long peak_kb = 0;
};

// Runs the command `scanworld` with these arguments.
Outcome run(const std::vector<std::string>& arguments);

// Runs any program and waits for its end.
Outcome run_program(const std::vector<std::string>& command);

}  // namespace scanworld::test
