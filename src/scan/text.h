// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "file.h"
#include "rows.h"

namespace scanworld {

// Lines of a text, gunzipped where needed, single ones for a header and blocks of whole ones for the rows.
class LineReader {
 public:
  explicit LineReader(const std::filesystem::path& path);

  // The next line without its end; false at the end of the file.
  bool next_line(std::string& line);
  // About `target` bytes of whole lines; false at the end of the file. Each line ends with '\n', the last too.
  bool next_block(std::string& block, std::size_t target);
  // The number of lines that were had one by one, so of the line that next_line gave last.
  std::uint64_t line_number() const { return lines_; }
  // The bytes had so far.
  std::uint64_t offset() const { return offset_; }
  // No more bytes than this follow (of a gzip file that cannot be known).
  std::uint64_t at_most_left() const;

  const std::string& name() const { return name_; }
  bool gzipped() const { return stream_->gzipped(); }

 private:
  bool refill();

  std::string name_;
  std::unique_ptr<ByteStream> stream_;
  std::string buffer_;  // read, not given out yet from `at_` on
  std::size_t at_ = 0;
  std::uint64_t lines_ = 0, offset_ = 0;
};

// How rows of numbers are written.
struct TextLayout {
  std::vector<Role> columns;       // what each column holds; columns beyond these are not looked at
  std::uint64_t rows = UINT64_MAX; // stop after so many
  bool counts_between = false;     // lines with one whole number announce how many rows follow (PTS)
};

// Reads rows, one a line, values separated by blanks, tabs, commas, semicolons or bars; empty lines and
// comments (# // % ;) are passed over. Lines are worked on in parallel.
// Throws bad_input naming file, line and word where a value is missing or is not a number.
std::vector<Rows> read_text_rows(LineReader& lines, const TextLayout& layout);

// The words of a line, split as the rows are; empty where two separators follow each other.
std::vector<std::string_view> split_columns(std::string_view line);

// True where a line holds nothing to read: it is empty or a comment.
bool is_comment(std::string_view line);

// Reads a number from `from`, where a word starts; returns the first character after it, or null where there
// is none. Correctly rounded; '+', nan and inf are understood. A byte that is not part of a number must follow.
const char* parse_number(const char* from, const char* end, double& value);

}  // namespace scanworld
