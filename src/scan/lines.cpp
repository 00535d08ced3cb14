// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "lines.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <utility>

#include "../error.h"

namespace scanworld {

namespace {

constexpr std::size_t kReadAtOnce = 1 << 16;   // [bytes]
constexpr std::size_t kLongestLine = 1 << 20;  // [bytes] longer ones are no lines of a scan

}  // namespace

LineReader::LineReader(const std::filesystem::path& path)
    : name_(path.string()), stream_(open_stream(path)) {}

// Reads behind the first `have` bytes; how many are there then.
std::size_t LineReader::read_more(std::vector<char>& bytes, std::size_t have) {
  const std::size_t want = std::clamp<std::uint64_t>(stream_->at_most_left(), 1, kReadAtOnce);
  if (bytes.size() < have + want)
    bytes.resize(have + want);  // never less, so that it is cleared once only
  return have + stream_->read(bytes.data() + have, want);
}

bool LineReader::next_line(std::string& line) {
  std::size_t length = 0;
  while (true) {
    const char* const first = buffer_.data() + at_;
    const auto* newline =
        static_cast<const char*>(at_ < end_ ? std::memchr(first, '\n', end_ - at_) : nullptr);
    length = newline ? static_cast<std::size_t>(newline - first) : end_ - at_;
    if (newline) break;
    if (length > kLongestLine)
      throw Error(Cause::bad_input, fmt::format("{}:{}: the line is longer than {} bytes", name_,
                                                lines_ + 1, kLongestLine));
    buffer_.erase(buffer_.begin(),
                  buffer_.begin() + static_cast<std::ptrdiff_t>(std::exchange(at_, 0)));
    end_ = read_more(buffer_, length);
    if (end_ > length) continue;
    if (length == 0) return false;
    break;  // the last line has no end of its own
  }
  line.assign(buffer_.data() + at_, length);
  const std::size_t next = std::min(at_ + length + 1, end_);
  offset_ += next - at_;
  at_ = next;
  ++lines_;
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return true;
}

std::size_t LineReader::next_block(std::vector<char>& block, std::size_t target) {
  std::size_t size = end_ - at_, lines_end = 0;  // the whole lines end there
  if (block.size() < size) block.resize(size);
  std::copy(buffer_.begin() + static_cast<std::ptrdiff_t>(at_),
            buffer_.begin() + static_cast<std::ptrdiff_t>(end_), block.begin());
  at_ = end_ = 0;
  while (size < target || lines_end == 0) {
    if (size > kLongestLine + target)
      throw Error(Cause::bad_input, fmt::format("{}: has a line longer than {} bytes after line {}",
                                                name_, kLongestLine, lines_));
    const std::size_t before = std::exchange(size, read_more(block, size));
    if (size == before) {
      if (size > 0 && block[size - 1] != '\n') {  // the last line has no end of its own
        if (block.size() == size) block.push_back('\n');
        block[size++] = '\n';
        --offset_;
      }
      lines_end = size;
      break;
    }
    const void* newline = memrchr(block.data(), '\n', size);
    lines_end = newline
                    ? static_cast<std::size_t>(static_cast<const char*>(newline) - block.data()) + 1
                    : 0;
  }
  end_ = size - lines_end;
  if (buffer_.size() < end_) buffer_.resize(end_);
  std::copy(block.begin() + static_cast<std::ptrdiff_t>(lines_end),
            block.begin() + static_cast<std::ptrdiff_t>(size), buffer_.begin());
  offset_ += lines_end;
  return lines_end;
}

std::uint64_t LineReader::at_most_left() const {
  const std::uint64_t unread = stream_->at_most_left();
  return unread == UINT64_MAX ? unread : unread + end_ - at_;
}

}  // namespace scanworld
