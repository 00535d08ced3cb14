// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace scanworld {

// A regular file opened for reading. Throws bad_input where it is missing, a folder, or may not be
// read.
class InputFile {
 public:
  explicit InputFile(const std::filesystem::path& path);
  ~InputFile();
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  std::uint64_t size() const { return size_; }
  std::string name() const { return path_.string(); }

  // Reads up to `count` bytes at `offset`; less only at the end of the file. Safe from several
  // threads.
  std::size_t read_some(std::uint64_t offset, void* to, std::size_t count) const;
  // Reads exactly `count` bytes, or throws bad_input: the file got shorter since it was opened.
  void read(std::uint64_t offset, void* to, std::size_t count) const;

 private:
  std::filesystem::path path_;
  int fd_ = -1;
  std::uint64_t size_ = 0;
};

// The bytes of a file one after the other, gunzipped where it is a gzip file (told by its content).
class ByteStream {
 public:
  virtual ~ByteStream() = default;
  // Reads up to `count` bytes; 0 at the end. Throws bad_input where gzip data are damaged or cut
  // off.
  virtual std::size_t read(char* to, std::size_t count) = 0;
  // The bytes not read yet, or no bound where only reading can tell (gzip).
  virtual std::uint64_t at_most_left() const { return UINT64_MAX; }
  virtual bool gzipped() const { return false; }
};
std::unique_ptr<ByteStream> open_stream(const std::filesystem::path& path);

}  // namespace scanworld
