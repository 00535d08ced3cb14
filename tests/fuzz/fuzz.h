// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What fuzz targets share. Each target is one file with a function `fuzz` that must return, or
// throw Error, for any bytes. With clang and the preset `fuzz` it is driven by libFuzzer; else it
// replays the files that it is given.
#pragma once

#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>
#include <string>

#include "error.h"

void fuzz(const std::string& bytes);

namespace scanworld::fuzzing {

// Bytes as a file that has a path but is on no disk.
class MemoryFile {
 public:
  explicit MemoryFile(const std::string& bytes) : fd_(memfd_create("fuzz", 0)) {
    if (write(fd_, bytes.data(), bytes.size()) != static_cast<ssize_t>(bytes.size())) std::abort();
  }
  ~MemoryFile() { close(fd_); }
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  std::filesystem::path path() const { return "/proc/self/fd/" + std::to_string(fd_); }

 private:
  int fd_;
};

inline void run(const std::string& bytes) {
  try {
    fuzz(bytes);
  } catch (const scanworld::Error&) {
    // What a reader says of bad input.
  }
}

}  // namespace scanworld::fuzzing

#ifdef SCANWORLD_FUZZ
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  scanworld::fuzzing::run(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
#else
int main(int argc, char** argv) {
  int files = 0;
  for (int i = 1; i < argc; ++i)
    for (const auto& entry : std::filesystem::recursive_directory_iterator(argv[i])) {
      if (!entry.is_regular_file()) continue;
      std::ifstream file(entry.path(), std::ios::binary);
      std::ostringstream bytes;
      bytes << file.rdbuf();
      scanworld::fuzzing::run(bytes.str());
      ++files;
    }
  std::cout << files << " files replayed\n";
  return files > 0 ? 0 : 1;
}
#endif
