// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "files.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>

#include "error.h"

namespace scanworld {

namespace fs = std::filesystem;

namespace {

[[noreturn]] void fail_at(const fs::path& path, std::string_view doing, const std::string& why) {
  throw Error(Cause::failure, fmt::format("{}: {}: {}", path.string(), doing, why));
}

// Tries names beside `path` until `make` could make something new under one; it returns whether it
// did, with errno set where not.
template <typename Make>
fs::path make_beside(const fs::path& path, const Make& make) {
  for (int i = 0;; ++i) {
    const fs::path name =
        path.parent_path() / fmt::format(".{}.part-{}-{}", path.filename().string(), ::getpid(), i);
    if (make(name)) return name;
    if (errno != EEXIST) fail_at(path, "writing", std::strerror(errno));
  }
}

}  // namespace

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".gz" && path.stem().has_extension() ? lower_extension(path.stem())
                                                           : extension;
}

fs::path place_of(const fs::path& path) {
  std::error_code error;
  fs::path whole = fs::absolute(path);
  while (whole.has_parent_path() && whole != whole.root_path() &&
         (!whole.has_filename() || whole.filename() == "."))
    whole = whole.parent_path();
  const bool is_named = whole.has_filename() && whole.filename() != "..";
  const fs::path real = fs::weakly_canonical(is_named ? whole.parent_path() : whole, error);
  if (error) return whole.lexically_normal();
  return is_named ? real / whole.filename() : real;
}

bool is_within(const fs::path& folder, const fs::path& path) {
  std::error_code error;
  fs::path at = fs::canonical(path, error);
  while (!error && !fs::equivalent(folder, at, error)) {
    if (at == at.root_path()) return false;
    at = at.parent_path();
  }
  return !error;
}

void check_output(const fs::path& out, const std::vector<fs::path>& inputs) {
  const auto refuse = [&](const std::string& why) {
    throw Error(Cause::usage, fmt::format("{}: not written: {}", out.string(), why));
  };
  std::error_code error;
  const fs::path path = place_of(out);
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::exists(status)) return;
  if (fs::is_symlink(status))
    refuse(fmt::format("is a symlink to {}; name the file itself",
                       fs::read_symlink(path, error).string()));
  if (fs::is_directory(status)) refuse("is a folder");
  if (!fs::is_regular_file(status)) refuse("is no plain file");
  for (const fs::path& input : inputs)
    if (!input.empty() && fs::equivalent(path, input, error))
      refuse("is the input " + input.string());
}

bool bears_mark(const fs::path& file, std::string_view mark) {
  std::ifstream in(file, std::ios::binary);
  std::string head(1 << 20, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  return head.find(mark) != std::string::npos;
}

void check_replaces_own(const fs::path& out, std::string_view mark) {
  std::error_code ignored;
  if (fs::is_regular_file(out, ignored) && !bears_mark(out, mark))
    throw Error(Cause::usage, fmt::format("{}: not written: there is a file of this name that "
                                          "scanworld did not write",
                                          out.string()));
}

ScratchFolder::ScratchFolder(const fs::path& beside)
    : path_(make_beside(place_of(beside),
                        [](const fs::path& name) { return ::mkdir(name.c_str(), 0777) == 0; })) {}

ScratchFolder::~ScratchFolder() {
  std::error_code ignored;
  if (!path_.empty()) fs::remove_all(path_, ignored);
}

OutputFile::OutputFile(fs::path path) : path_(place_of(path)) {
  check_output(path);
  int file = -1;
  part_ = make_beside(path_, [&](const fs::path& name) {
    file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    return file >= 0;
  });
  file_ = ::fdopen(file, "wb");
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

}  // namespace scanworld
