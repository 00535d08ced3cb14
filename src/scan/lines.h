// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "file.h"

namespace scanworld {

// Lines of a text, gunzipped where needed, single ones for a header and blocks of whole ones for
// the rows.
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path& path);

  // The next line without its end; false at the end of the file.
  bool next_line(std::string& line);
  // About `target` bytes of whole lines at the start of `block`, which grows as needed; how many, 0
  // at the end of the file. Each line ends with '\n', the last too.
  std::size_t next_block(std::vector<char>& block, std::size_t target);
  // The number of lines that were had one by one, so of the line that next_line gave last.
  std::uint64_t line_number() const { return lines_; }
  // The bytes had so far.
  std::uint64_t offset() const { return offset_; }
  // No more bytes than this follow (of a gzip file that cannot be known).
  std::uint64_t at_most_left() const;

  const std::string& name() const { return name_; }
  bool gzipped() const { return stream_->gzipped(); }

 private:
  std::size_t read_more(std::vector<char>& bytes, std::size_t have);

  std::string name_;
  std::unique_ptr<ByteStream> stream_;
  std::vector<char> buffer_;  // of what was read, [at_, end_) is not given out yet
  std::size_t at_ = 0, end_ = 0;
  std::uint64_t lines_ = 0, offset_ = 0;
};

}  // namespace scanworld
