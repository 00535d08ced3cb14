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

// Where a path leads, with no symlink on the way to it: "a/b/" and "a/b" are the same place. What
// is last in it stays as it is named, so that a symlink can be told from what it leads to.
std::filesystem::path place_of(const std::filesystem::path& path);

// Whether a path leads into a folder or to it, whatever names and symlinks it goes by; false where
// one of them does not exist.
bool is_within(const std::filesystem::path& folder, const std::filesystem::path& path);

// Throws usage where a file may not be written at `out`: something is there that is no plain file
// (a folder, a device, or a symlink, which is neither followed nor replaced), or it is one of the
// inputs that the run reads. Any other file of this name is replaced.
void check_output(const std::filesystem::path& out,
                  const std::vector<std::filesystem::path>& inputs = {});

// Whether a file has this text in its first MB, as a sign of who wrote it.
bool bears_mark(const std::filesystem::path& file, std::string_view mark);

// For a file whose name is not of the user's choice: throws usage where there is one that does not
// bear the mark of what is written there.
void check_replaces_own(const std::filesystem::path& out, std::string_view mark);

// A new folder beside a path, under a name that nobody uses, to prepare there what belongs at the
// path. Throws failure where there can be none. It goes at the end with all it holds, unless it was
// let go.
class ScratchFolder {
 public:
  explicit ScratchFolder(const std::filesystem::path& beside);
  ~ScratchFolder();
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  void let_go() { path_.clear(); }

 private:
  std::filesystem::path path_;
};

// A file that appears whole or not at all: it is written beside its place and moved there by
// commit(). Without commit() nothing is left. Throws as check_output() does, and failure naming the
// file where it cannot be written.
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

}  // namespace scanworld
