// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "support.h"

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <sstream>

namespace scanworld::test {

namespace fs = std::filesystem;

TempFolder::TempFolder() {
  std::string name = (fs::temp_directory_path() / "scanworld-test-XXXXXX").string();
  REQUIRE(mkdtemp(name.data()) != nullptr);
  path_ = name;
}

TempFolder::~TempFolder() {
  std::error_code ignored;
  for (auto& entry : fs::recursive_directory_iterator(path_, ignored))
    fs::permissions(entry.path(), fs::perms::owner_all, fs::perm_options::add, ignored);
  fs::remove_all(path_, ignored);
}

fs::path write_file(const fs::path& path, std::string_view bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  REQUIRE(file.good());
  return path;
}

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

fs::path in_project(std::string_view path) { return fs::path(SCANWORLD_SOURCE_DIR) / path; }

std::optional<fs::path> shared_scan(std::string_view name) {
  const fs::path path = in_project("../shared/data") / name;
  if (fs::exists(path)) return path;
  MESSAGE("skipped: there is no " << path.lexically_normal().string());
  return std::nullopt;
}

std::uint64_t Random::next() {
  std::uint64_t x = state_ += 0x9e3779b97f4a7c15;
  x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
  x = (x ^ x >> 27) * 0x94d049bb133111eb;
  return x ^ x >> 31;
}

double Random::uniform(double low, double high) {
  return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53;
}

double Random::gauss() {
  return std::sqrt(-2 * std::log(1 - uniform())) * std::cos(2 * M_PI * uniform());
}

int Random::whole(int low, int high) {
  return low + static_cast<int>(next() % static_cast<std::uint64_t>(high - low + 1));
}

Vec3 Random::direction() {
  const double x = gauss(), y = gauss(), z = gauss();
  return Vec3(x, y, z).normalized();
}

Outcome run(const std::vector<std::string>& arguments) {
  std::vector<std::string> command = {SCANWORLD_COMMAND};
  command.insert(command.end(), arguments.begin(), arguments.end());
  return run_program(command);
}

Outcome run_program(const std::vector<std::string>& command) {
  const TempFolder folder;
  const fs::path out = folder / "out", err = folder / "err";
  const auto start = std::chrono::steady_clock::now();
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const int out_file = open(out.c_str(), O_CREAT | O_WRONLY, 0600),
              err_file = open(err.c_str(), O_CREAT | O_WRONLY, 0600);
    dup2(out_file, STDOUT_FILENO);
    dup2(err_file, STDERR_FILENO);
    std::vector<char*> words;
    for (const std::string& word : command) words.push_back(const_cast<char*>(word.c_str()));
    words.push_back(nullptr);
    execvp(words[0], words.data());
    _exit(127);
  }
  int status = 0;
  rusage usage{};
  wait4(child, &status, 0, &usage);
  Outcome outcome;
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  outcome.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  outcome.peak_kb = usage.ru_maxrss;
  outcome.out = read_file(out);
  outcome.err = read_file(err);
  return outcome;
}

}  // namespace scanworld::test
