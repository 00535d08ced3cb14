// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <utility>

#include "error.h"

namespace scanworld {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_at(const fs::path& path, std::string_view doing, const std::string& why) {
  throw Error(Cause::failure, fmt::format("{}: {}: {}", path.string(), doing, why));
}

// A name beside `path` that no other process uses.
fs::path beside(const fs::path& path, std::string_view what) {
  return path.parent_path() / fmt::format(".{}.{}-{}", path.filename().string(), what, ::getpid());
}

// "a/b/" and "a/b" are the same place; the path is made absolute so that a changed folder does not
// matter.
fs::path place(const fs::path& path) {
  fs::path whole = fs::absolute(path).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".gz" && path.stem().has_extension() ? lower_extension(path.stem())
                                                           : extension;
}

OutputFile::OutputFile(fs::path path) : path_(place(path)), part_(beside(path_, "part")) {
  std::error_code ignored;
  if (fs::is_directory(path_, ignored)) fail_at(path_, "writing", "is a folder");
  file_ = std::fopen(part_.c_str(), "wbe");
  if (!file_) fail("writing");
}

OutputFile::~OutputFile() {
  if (!file_) return;
  std::fclose(file_);
  ::unlink(part_.c_str());
}

void OutputFile::fail(const char* doing) const { fail_at(path_, doing, std::strerror(errno)); }

void OutputFile::write(const void* bytes, std::size_t count) {
  if (count > 0 && std::fwrite(bytes, 1, count, file_) != count) fail("writing");
}

void OutputFile::commit() {
  if (std::fflush(file_) != 0) fail("writing");
  const bool closed = std::fclose(std::exchange(file_, nullptr)) == 0;
  if (!closed || std::rename(part_.c_str(), path_.c_str()) != 0) {
    const int why = errno;
    ::unlink(part_.c_str());
    errno = why;
    fail("writing");
  }
}

void write_text(const std::filesystem::path& path, std::string_view text) {
  OutputFile file(path);
  file.write(text);
  file.commit();
}

OutputFolder::OutputFolder(fs::path path, std::string_view mark)
    : path_(place(path)), part_(beside(path_, "part")) {
  std::error_code error;
  const fs::file_status status = fs::status(path_, error);
  if (fs::exists(status)) {
    if (!fs::is_directory(status))
      fail_at(path_, "writing the folder", "there is a file of this name");
    const bool empty = fs::is_empty(path_, error);
    if (!empty && !fs::exists(path_ / mark, error))
      fail_at(path_, "writing the folder",
              fmt::format("it holds other files and no {}; not replaced", mark));
    if (::access(path_.c_str(), W_OK) != 0)
      fail_at(path_, "writing the folder", std::strerror(errno));
  }
  fs::create_directories(path_.parent_path(), error);
  if (error) fail_at(path_.parent_path(), "making the folder", error.message());
  fs::remove_all(part_, error);
  fs::create_directory(part_, error);
  if (error) fail_at(path_, "writing the folder", error.message());
}

OutputFolder::~OutputFolder() {
  std::error_code ignored;
  if (!part_.empty()) fs::remove_all(part_, ignored);
}

void OutputFolder::commit() {
  // Where there is an older folder, the two change places in one step; the older one is then
  // removed.
  std::error_code error;
  if (fs::exists(path_, error)) {
    if (::renameat2(AT_FDCWD, part_.c_str(), AT_FDCWD, path_.c_str(), RENAME_EXCHANGE) == 0) return;
    const fs::path old = beside(path_, "old");  // a file system that cannot exchange
    fs::rename(path_, old, error);
    if (error) fail_at(path_, "replacing the folder", error.message());
    fs::rename(part_, path_, error);
    if (error)
      fs::rename(old, path_);
    else
      fs::remove_all(old, error);
    return;
  }
  fs::rename(part_, path_, error);
  if (error) fail_at(path_, "writing the folder", error.message());
  part_.clear();
}

}  // namespace scanworld
