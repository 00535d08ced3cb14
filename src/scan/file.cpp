// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>

#include "../error.h"

namespace scanworld {

namespace {

[[noreturn]] void fail(const std::string& name, const std::string& what) {
  throw Error(Cause::bad_input, name + ": " + what);
}

class FileStream : public ByteStream {
 public:
  explicit FileStream(const std::filesystem::path& path) : file_(path) {}
  std::size_t read(char* to, std::size_t count) override {
    const std::size_t n = file_.read_some(at_, to, count);
    at_ += n;
    return n;
  }
  std::uint64_t at_most_left() const override { return file_.size() - std::min(at_, file_.size()); }

 private:
  InputFile file_;
  std::uint64_t at_ = 0;
};

class GzipStream : public ByteStream {
 public:
  explicit GzipStream(const std::filesystem::path& path)
      : name_(path.string()), file_(gzopen(path.c_str(), "rb")) {
    if (!file_) fail(name_, "cannot be opened as gzip");
    gzbuffer(file_, 1u << 18);
  }
  ~GzipStream() override { gzclose(file_); }
  std::size_t read(char* to, std::size_t count) override {
    const int n = gzread(file_, to, static_cast<unsigned>(std::min<std::size_t>(count, 1u << 30)));
    // A file that is cut off is told only by the error state, after what could be read of it.
    int code = Z_OK;
    const char* message = gzerror(file_, &code);
    if (n < 0 || (n == 0 && code != Z_OK))
      fail(name_, fmt::format("damaged gzip data: {}",
                              code == Z_BUF_ERROR ? "the file ends too early" : message));
    return static_cast<std::size_t>(n);
  }
  bool gzipped() const override { return true; }

 private:
  std::string name_;
  gzFile file_;
};

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) : path_(path) {
  fd_ = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (fd_ < 0) fail(name(), std::strerror(errno));
  struct stat info {};
  const bool known = ::fstat(fd_, &info) == 0;
  if (!known || !S_ISREG(info.st_mode)) {
    ::close(fd_);
    fail(name(),
         known && S_ISDIR(info.st_mode) ? "is a folder, not a file" : "is not a regular file");
  }
  size_ = static_cast<std::uint64_t>(info.st_size);
}

InputFile::~InputFile() { ::close(fd_); }

std::size_t InputFile::read_some(std::uint64_t offset, void* to, std::size_t count) const {
  std::size_t done = 0;
  while (done < count) {
    const ssize_t n = ::pread(fd_, static_cast<char*>(to) + done, count - done,
                              static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0)
      fail(name(), fmt::format("reading at byte {}: {}", offset + done, std::strerror(errno)));
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

void InputFile::read(std::uint64_t offset, void* to, std::size_t count) const {
  const std::size_t n = read_some(offset, to, count);
  if (n < count)
    fail(name(), fmt::format("ends at byte {}, {} bytes too early", offset + n, count - n));
}

std::unique_ptr<ByteStream> open_stream(const std::filesystem::path& path) {
  unsigned char magic[2] = {};
  const bool gzip =
      InputFile(path).read_some(0, magic, 2) == 2 && magic[0] == 0x1f && magic[1] == 0x8b;
  if (gzip) return std::make_unique<GzipStream>(path);
  return std::make_unique<FileStream>(path);
}

}  // namespace scanworld
