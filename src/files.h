// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace scanworld {

// The extension of a file name in lower case, with its dot: ".ply"; that before it where it is
// ".gz".
std::string lower_extension(const std::filesystem::path& path);

// A file that appears whole or not at all: it is written beside its place and moved there by
// commit(). Without commit() nothing is left. Throws failure naming the file where it cannot be
// written.
class OutputFile {
 public:
  explicit OutputFile(std::filesystem::path path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(const void* bytes, std::size_t count);
  void write(std::string_view text) { write(text.data(), text.size()); }
  template <typename T>
  void write_values(const std::vector<T>& values) {
    write(values.data(), values.size() * sizeof(T));
  }
  void commit();

 private:
  [[noreturn]] void fail(const char* doing) const;

  std::filesystem::path path_, part_;
  std::FILE* file_ = nullptr;
};

// Writes a whole file of text or bytes, as OutputFile does.
void write_text(const std::filesystem::path& path, std::string_view text);

// A folder that appears whole or not at all. It takes the place of an older folder only where that
// one holds nothing or a file named `mark`, so that no folder is lost by a slip of the keyboard.
class OutputFolder {
 public:
  // Throws failure where the place is taken by something else or cannot be written to.
  OutputFolder(std::filesystem::path path, std::string_view mark);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  // Where to write the files until commit().
  const std::filesystem::path& path() const { return part_; }
  void commit();

 private:
  std::filesystem::path path_, part_;
};

}  // namespace scanworld
