// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "text.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>

#include "../error.h"
#include "../parallel.h"

namespace scanworld {

namespace {

constexpr std::size_t kBlock = 1 << 20;       // [bytes] worked on at a time by one thread
constexpr std::size_t kBlocksAtOnce = 16;
constexpr std::size_t kLongestLine = 1 << 20;  // [bytes] longer ones are no rows of numbers

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
bool is_separator(char c) { return c == ',' || c == ';' || c == '|'; }

const char* skip_blanks(const char* at) {
  while (is_blank(*at)) ++at;
  return at;
}

// The end of the word at `at`; a line's end stops it.
const char* word_end(const char* at) {
  while (!is_blank(*at) && !is_separator(*at) && *at != '\n') ++at;
  return at;
}

// Where something is wrong in a block of lines.
struct BadRow {
  std::uint64_t line = 0;  // within the block, from 0
  std::string what;
};

// What a block of lines holds.
struct Block {
  std::string text;
  Rows rows;
  std::uint64_t lines = 0;
  std::uint64_t announced = 0;  // rows announced by lines with a count
  bool has_count = false;
  std::optional<BadRow> bad;
};

// Puts one row's values where they belong.
class RowWriter {
 public:
  RowWriter(const std::vector<Role>& columns, Rows& rows) : rows_(rows) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
      const Role role = columns[i];
      if (role >= Role::x && role <= Role::z) point_[at(role, Role::x)] = i;
      if (role >= Role::nx && role <= Role::nz) normal_[at(role, Role::nx)] = i, normals_ = true;
      if (role >= Role::red && role <= Role::blue) color_[at(role, Role::red)] = i, colors_ = true;
      if (role == Role::packed_rgb || role == Role::packed_rgb_float)
        packed_ = i, is_packed_ = true, packed_float_ = role == Role::packed_rgb_float;
    }
  }

  void put(const double* values) {
    rows_.points.emplace_back(values[point_[0]], values[point_[1]], values[point_[2]]);
    if (normals_)
      rows_.normals.push_back(
          Vec3(values[normal_[0]], values[normal_[1]], values[normal_[2]]).cast<float>());
    if (colors_)
      rows_.colors.push_back({channel(values[color_[0]]), channel(values[color_[1]]), channel(values[color_[2]])});
    if (is_packed_) rows_.colors.push_back(unpack_rgb(packed_bits(values[packed_])));
  }

 private:
  static std::size_t at(Role role, Role base) {
    return static_cast<std::size_t>(role) - static_cast<std::size_t>(base);
  }
  static std::uint8_t channel(double v) {
    return static_cast<std::uint8_t>(v >= 0 ? std::min(v + 0.5, 255.0) : 0);
  }
  std::uint32_t packed_bits(double v) const {
    if (packed_float_) return std::bit_cast<std::uint32_t>(static_cast<float>(v));
    return v >= 0 && v < 4294967296.0 ? static_cast<std::uint32_t>(v) : 0;
  }

  Rows& rows_;
  std::size_t point_[3] = {}, normal_[3] = {}, color_[3] = {}, packed_ = 0;
  bool normals_ = false, colors_ = false, is_packed_ = false, packed_float_ = false;
};

class BlockParser {
 public:
  BlockParser(const TextLayout& layout, Block& block)
      : layout_(layout), block_(block), writer_(layout.columns, block.rows), values_(layout.columns.size()) {}

  void parse() {
    const char* at = block_.text.data();
    const char* const end = at + block_.text.size();
    block_.rows.points.reserve(block_.text.size() / 24);
    while (at < end && !block_.bad) {
      at = parse_line(at, end);
      ++block_.lines;
    }
  }

 private:
  // Reads the line at `line` and returns the next one.
  const char* parse_line(const char* line, const char* end) {
    const char* at = skip_blanks(line);
    if (*at == '\n') return at + 1;
    const std::size_t columns = values_.size();
    std::size_t column = 0;
    while (true) {
      if (layout_.columns[column] == Role::none) {
        at = word_end(at);
      } else {
        const char* after = parse_number(at, end, values_[column]);
        if (!after) return not_a_number(line, at, column, end);
        at = after;
      }
      ++column;
      at = skip_blanks(at);
      if (is_separator(*at)) at = skip_blanks(at + 1);
      if (column == columns || *at == '\n') break;
    }
    if (column < columns) return too_few(line, column, end);
    writer_.put(values_.data());
    return *at == '\n' ? at + 1 : next_line(at, end);
  }

  static const char* next_line(const char* at, const char* end) {
    return static_cast<const char*>(std::memchr(at, '\n', static_cast<std::size_t>(end - at))) + 1;
  }

  const char* not_a_number(const char* line, const char* at, std::size_t column, const char* end) {
    const char* next = next_line(at, end);
    if (is_comment({line, static_cast<std::size_t>(next - line) - 1})) return next;
    const std::string_view word(at, static_cast<std::size_t>(word_end(at) - at));
    block_.bad = {block_.lines, word.empty() ? fmt::format("value {} is empty", column + 1)
                                             : fmt::format("'{}' (value {}) is not a number",
                                                           word.substr(0, 40), column + 1)};
    return next;
  }

  const char* too_few(const char* line, std::size_t have, const char* end) {
    const char* next = next_line(line, end);
    const double count = values_[0];
    if (layout_.counts_between && have == 1 && count >= 0 && count == std::floor(count) && count < 1e18) {
      block_.announced += static_cast<std::uint64_t>(count);
      block_.has_count = true;
    } else {
      block_.bad = {block_.lines, fmt::format("has {} values, {} are needed", have, values_.size())};
    }
    return next;
  }

  const TextLayout& layout_;
  Block& block_;
  RowWriter writer_;
  std::vector<double> values_;
};

void keep_first_rows(Rows& rows, std::size_t count) {
  rows.points.resize(count);
  if (!rows.normals.empty()) rows.normals.resize(count);
  if (!rows.colors.empty()) rows.colors.resize(count);
}

}  // namespace

LineReader::LineReader(const std::filesystem::path& path)
    : name_(path.string()), stream_(open_stream(path)) {}

bool LineReader::refill() {
  buffer_.erase(0, at_);
  at_ = 0;
  const std::size_t have = buffer_.size();
  buffer_.resize(have + std::min<std::uint64_t>(kBlock, std::max<std::uint64_t>(stream_->at_most_left(), 1)));
  const std::size_t n = stream_->read(buffer_.data() + have, buffer_.size() - have);
  buffer_.resize(have + n);
  return n > 0;
}

bool LineReader::next_line(std::string& line) {
  std::size_t end = 0;
  while ((end = buffer_.find('\n', at_)) == std::string::npos) {
    if (buffer_.size() - at_ > kLongestLine)
      throw Error(Cause::bad_input, fmt::format("{}:{}: the line is longer than {} bytes", name_,
                                                lines_ + 1, kLongestLine));
    if (refill()) continue;
    if (at_ == buffer_.size()) return false;
    end = buffer_.size();
    break;
  }
  line.assign(buffer_, at_, end - at_);
  const std::size_t next = std::min(end + 1, buffer_.size());
  offset_ += next - at_;
  at_ = next;
  ++lines_;
  if (!line.empty() && line.back() == '\r') line.pop_back();
  return true;
}

bool LineReader::next_block(std::string& block, std::size_t target) {
  while (buffer_.size() - at_ < target && refill()) {
  }
  std::size_t end = buffer_.rfind('\n');
  while ((end == std::string::npos || end < at_) && buffer_.size() - at_ <= kLongestLine && refill())
    end = buffer_.rfind('\n');
  if (at_ == buffer_.size()) return false;
  if (end == std::string::npos || end < at_) {
    if (buffer_.size() - at_ > kLongestLine)
      throw Error(Cause::bad_input, fmt::format("{}: has a line longer than {} bytes after line {}", name_,
                                                kLongestLine, lines_));
    end = buffer_.size() - 1;  // the last line has no end of its own
  }
  block.assign(buffer_, at_, end + 1 - at_);
  offset_ += block.size();
  at_ = end + 1;
  if (block.back() != '\n') block += '\n';
  return true;
}

std::uint64_t LineReader::at_most_left() const {
  const std::uint64_t unread = stream_->at_most_left();
  return unread == UINT64_MAX ? unread : unread + buffer_.size() - at_;
}

std::vector<Rows> read_text_rows(LineReader& lines, const TextLayout& layout) {
  std::vector<Rows> parts;
  std::uint64_t line = lines.line_number(), rows = 0, announced = 0;
  bool has_count = false;
  std::vector<Block> blocks(kBlocksAtOnce);
  while (rows < layout.rows) {
    std::size_t count = 0;
    while (count < blocks.size() && lines.next_block(blocks[count].text, kBlock)) ++count;
    if (count == 0) break;
    parallel_for(count, [&](std::size_t i) {
      blocks[i] = {.text = std::move(blocks[i].text)};
      BlockParser(layout, blocks[i]).parse();
    });
    for (std::size_t i = 0; i < count && rows < layout.rows; ++i) {
      Block& block = blocks[i];
      const bool enough = rows + block.rows.points.size() >= layout.rows;  // what follows is not ours
      if (block.bad && !enough)
        throw Error(Cause::bad_input,
                    fmt::format("{}:{}: {}", lines.name(), line + block.bad->line + 1, block.bad->what));
      if (enough) keep_first_rows(block.rows, static_cast<std::size_t>(layout.rows - rows));
      rows += block.rows.points.size();
      line += block.lines;
      announced += block.announced;
      has_count |= block.has_count;
      if (!block.rows.points.empty()) parts.push_back(std::move(block.rows));
    }
  }
  if (layout.rows != UINT64_MAX && rows < layout.rows)
    throw Error(Cause::bad_input, fmt::format("{}: promises {} points, but ends after {} (line {})",
                                              lines.name(), layout.rows, rows, line));
  if (has_count && rows < announced)
    throw Error(Cause::bad_input, fmt::format("{}: promises {} points, but ends after {} (line {})",
                                              lines.name(), announced, rows, line));
  return parts;
}

std::vector<std::string_view> split_columns(std::string_view line) {
  std::vector<std::string_view> words;
  std::string text(line);
  text += '\n';
  const char* at = skip_blanks(text.data());
  while (*at != '\n') {
    const char* end = word_end(at);
    words.push_back(line.substr(static_cast<std::size_t>(at - text.data()), static_cast<std::size_t>(end - at)));
    at = skip_blanks(end);
    if (is_separator(*at)) at = skip_blanks(at + 1);
  }
  return words;
}

bool is_comment(std::string_view line) {
  const std::size_t at = line.find_first_not_of(" \t\r");
  if (at == std::string_view::npos) return true;
  const std::string_view text = line.substr(at);
  return text[0] == '#' || text[0] == '%' || text[0] == ';' || text.starts_with("//");
}

const char* parse_number(const char* from, const char* end, double& value) {
  // Most numbers in scans have few digits and no exponent. Then both the digits and the power of ten are exact
  // in double, so that one division rounds correctly (Clinger, "How to read floating point numbers
  // accurately", 1990).
  static constexpr double kPowers[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,  1e8,  1e9,  1e10, 1e11,
                                       1e12, 1e13, 1e14, 1e15, 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
  const char* at = from;
  const bool negative = *at == '-';
  if (negative || *at == '+') ++at;
  const char* const digits = at;
  std::uint64_t mantissa = 0;
  unsigned digit = 0;
  for (; (digit = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10; ++at) mantissa = mantissa * 10 + digit;
  std::ptrdiff_t places = 0, length = at - digits;
  if (*at == '.') {
    const char* const fraction = ++at;
    for (; (digit = static_cast<unsigned char>(*at) - unsigned{'0'}) < 10; ++at) mantissa = mantissa * 10 + digit;
    places = at - fraction;
    length += places;
  }
  if (length == 0 || length > 15 || *at == 'e' || *at == 'E') {
    const char* start = *from == '+' ? from + 1 : from;
    const auto [after, error] = std::from_chars(start, end, value);
    if (after == start || (start != from && *start == '-')) return nullptr;
    if (error == std::errc::result_out_of_range)  // too large to be finite, or too small to matter
      value = std::string_view(start, after).find("e-") == std::string_view::npos ? HUGE_VAL : 0;
    at = after;
  } else {
    value = static_cast<double>(mantissa) / kPowers[places];
    if (negative) value = -value;
  }
  return is_blank(*at) || is_separator(*at) || *at == '\n' ? at : nullptr;
}

}  // namespace scanworld
