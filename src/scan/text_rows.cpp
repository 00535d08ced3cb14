// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "text_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include "../error.h"
#include "../parallel.h"

namespace scanworld {

namespace {

constexpr std::size_t kBlock = 1 << 16;  // [bytes] worked on at a time by one thread
constexpr std::size_t kBlocksAtOnce = 16;

// What a character is in a line of numbers, by table: that is one load where comparing takes
// several steps.
enum CharKind : std::uint8_t { kOther, kBlank, kSeparator, kDigit };

constexpr std::array<CharKind, 256> char_kinds() {
  std::array<CharKind, 256> kinds{};
  for (char c : {' ', '\t', '\r'}) kinds[static_cast<unsigned char>(c)] = kBlank;
  for (char c : {',', ';', '|'}) kinds[static_cast<unsigned char>(c)] = kSeparator;
  for (char c = '0'; c <= '9'; ++c) kinds[static_cast<unsigned char>(c)] = kDigit;
  return kinds;
}
constexpr std::array<CharKind, 256> kCharKinds = char_kinds();

CharKind kind_of(char c) { return kCharKinds[static_cast<unsigned char>(c)]; }
bool is_blank(char c) { return kind_of(c) == kBlank; }
bool is_separator(char c) { return kind_of(c) == kSeparator; }
bool is_digit(char c) { return kind_of(c) == kDigit; }

const char* skip_blanks(const char* at) {
  while (is_blank(*at)) ++at;
  return at;
}

// The end of the word at `at`; a line's end stops it.
const char* word_end(const char* at) {
  while (!is_blank(*at) && !is_separator(*at) && *at != '\n') ++at;
  return at;
}

// Reads a number of any form; returns the first character after it, or null.
[[gnu::noinline]] const char* parse_any_number(const char* from, const char* end, double& value) {
  const char* start = *from == '+' ? from + 1 : from;
  const auto [after, error] = std::from_chars(start, end, value);
  if (after == start || (start != from && *start == '-')) return nullptr;
  if (error == std::errc::result_out_of_range)  // too large to be finite, or too small to matter
    value = std::string_view(start, after).find("e-") == std::string_view::npos ? HUGE_VAL : 0;
  return after;
}

// Reads the number that starts at `from`; returns the first character after it, or null where there
// is none or something else follows at once. Correctly rounded; '+', nan and inf are understood.
const char* parse_number(const char* from, const char* end, double& value) {
  // Most numbers in scans have few digits and no exponent. Then both the digits and the power of
  // ten are exact in double, so that one division rounds correctly (Clinger, "How to read floating
  // point numbers accurately", 1990). Eight digits at once by arithmetic on words were tried:
  // slower, as most numbers are short.
  static constexpr double kPowers[] = {1e0, 1e1, 1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                       1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15};
  const bool negative = *from == '-';
  const char* at = from + (negative | (*from == '+'));  // no branch: signs cannot be foreseen
  const char* const digits = at;
  std::uint64_t mantissa = 0;
  for (; is_digit(*at); ++at) mantissa = mantissa * 10 + static_cast<unsigned>(*at - '0');
  std::ptrdiff_t length = at - digits, places = 0;
  if (*at == '.') {
    const char* const fraction = ++at;
    for (; is_digit(*at); ++at) mantissa = mantissa * 10 + static_cast<unsigned>(*at - '0');
    places = at - fraction;
    length += places;
  }
  if (length == 0 || length > 15 || (*at | 0x20) == 'e') {
    if (!(at = parse_any_number(from, end, value))) return nullptr;
  } else {
    const double magnitude =
        static_cast<double>(static_cast<std::int64_t>(mantissa)) / kPowers[places];
    value = negative ? -magnitude : magnitude;
  }
  return is_blank(*at) || is_separator(*at) || *at == '\n' ? at : nullptr;
}

// Where something is wrong in a block of lines.
struct BadRow {
  std::uint64_t line = 0;  // within the block, from 0
  std::string what;
};

// What a block of lines holds.
struct Block {
  std::vector<char> text;
  std::size_t size = 0;  // of the text
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
      if (role == Role::scan_index) index_ = i, indices_ = true;
    }
  }

  void put(const double* values) {
    put_point(values[point_[0]], values[point_[1]], values[point_[2]]);
    if (normals_)
      rows_.normals.push_back(
          Vec3(values[normal_[0]], values[normal_[1]], values[normal_[2]]).cast<float>());
    if (colors_)
      rows_.colors.push_back(
          {channel(values[color_[0]]), channel(values[color_[1]]), channel(values[color_[2]])});
    if (is_packed_) rows_.colors.push_back(unpack_rgb(packed_bits(values[packed_])));
    if (indices_) rows_.scan_index.push_back(values[index_]);
  }

 private:
  // Most scans are near the origin all through, and then need half the memory. A point that is near
  // is a float, also among others that are not, so that it does not matter which lines are worked
  // on together.
  void put_point(double x, double y, double z) {
    const bool far = std::max({std::abs(x), std::abs(y), std::abs(z)}) > kNearOrigin;
    if (!far && rows_.points.empty()) {
      rows_.near_points.emplace_back(static_cast<float>(x), static_cast<float>(y),
                                     static_cast<float>(z));
      return;
    }
    rows_.widen();
    if (far)
      rows_.points.emplace_back(x, y, z);
    else
      rows_.points.push_back(
          Vec3f(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z))
              .cast<double>());
  }
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
  std::size_t point_[3] = {}, normal_[3] = {}, color_[3] = {}, packed_ = 0, index_ = 0;
  bool normals_ = false, colors_ = false, is_packed_ = false, packed_float_ = false,
       indices_ = false;
};

class BlockParser {
 public:
  BlockParser(const TextLayout& layout, Block& block)
      : layout_(layout),
        block_(block),
        writer_(layout.columns, block.rows),
        values_(layout.columns.size()) {}

  void parse() {
    block_.rows.clear();
    block_.lines = block_.announced = 0;
    block_.has_count = false;
    block_.bad.reset();
    const char* at = block_.text.data();
    const char* const end = at + block_.size;
    block_.rows.near_points.reserve(block_.size / 24);
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
    if (layout_.counts_between && have == 1 && count >= 0 && count == std::floor(count) &&
        count < 1e18) {
      block_.announced += static_cast<std::uint64_t>(count);
      block_.has_count = true;
    } else {
      block_.bad = {block_.lines,
                    fmt::format("has {} values, {} are needed", have, values_.size())};
    }
    return next;
  }

  const TextLayout& layout_;
  Block& block_;
  RowWriter writer_;
  std::vector<double> values_;
};

// About how many rows there will be, judged by the first block, so that memory is had once.
std::size_t expected_rows(const LineReader& lines, const Block& first, std::size_t blocks) {
  const std::uint64_t left = lines.at_most_left();
  if (left == UINT64_MAX || first.size == 0) return 0;
  const double rows_a_byte =
      static_cast<double>(first.rows.size()) / static_cast<double>(first.size);
  return static_cast<std::size_t>(1.02 * rows_a_byte * static_cast<double>(left + blocks * kBlock));
}

}  // namespace

Rows read_text_rows(LineReader& lines, const TextLayout& layout) {
  Rows rows;
  std::vector<Block> blocks(kBlocksAtOnce);
  std::uint64_t line = lines.line_number(), announced = 0;
  bool has_count = false;
  while (rows.size() < layout.rows) {
    std::size_t count = 0;
    while (count < blocks.size() &&
           (blocks[count].size = lines.next_block(blocks[count].text, kBlock)) > 0)
      ++count;
    if (count == 0) break;
    parallel_for(count, [&](std::size_t i) { BlockParser(layout, blocks[i]).parse(); });
    if (rows.size() == 0) {
      const std::size_t expected = expected_rows(lines, blocks[0], count);
      if (blocks[0].rows.points.empty())
        rows.near_points.reserve(expected);
      else
        rows.points.reserve(expected);
    }
    for (std::size_t i = 0; i < count && rows.size() < layout.rows; ++i) {
      const Block& block = blocks[i];
      const bool enough =
          rows.size() + block.rows.size() >= layout.rows;  // what follows is not ours
      if (block.bad && !enough)
        throw Error(Cause::bad_input, fmt::format("{}:{}: {}", lines.name(),
                                                  line + block.bad->line + 1, block.bad->what));
      rows.append(block.rows);
      line += block.lines;
      announced += block.announced;
      has_count |= block.has_count;
    }
  }
  const std::uint64_t promised = layout.rows != UINT64_MAX ? layout.rows
                                 : has_count               ? announced
                                                           : 0;
  if (rows.size() < promised)
    throw Error(Cause::bad_input, fmt::format("{}: promises {} points, but ends after {} (line {})",
                                              lines.name(), promised, rows.size(), line));
  if (layout.rows != UINT64_MAX) rows.resize(layout.rows);
  return rows;
}

std::vector<std::string_view> split_columns(std::string_view line) {
  std::vector<std::string_view> words;
  std::string text(line);
  text += '\n';
  const char* at = skip_blanks(text.data());
  while (*at != '\n') {
    const char* end = word_end(at);
    words.push_back(line.substr(static_cast<std::size_t>(at - text.data()),
                                static_cast<std::size_t>(end - at)));
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

std::optional<double> number_of(std::string_view word) {
  double value = 0;
  const char* const end = word.data() + word.size();
  return !word.empty() && parse_any_number(word.data(), end, value) == end ? std::optional(value)
                                                                           : std::nullopt;
}

}  // namespace scanworld
