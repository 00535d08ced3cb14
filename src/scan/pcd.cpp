// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "pcd.h"

#include <fmt/format.h>
#include <liblzf/lzf.h>

#include <cmath>
#include <sstream>

#include "../error.h"
#include "records.h"
#include "text_rows.h"

namespace scanworld {

namespace {

constexpr std::uint64_t kLongestRecord = 1 << 20;  // [bytes] longer ones are damage, not data

struct PcdField {
  std::string name;
  std::uint64_t size = 4, count = 1;
  char type = 'F';

  std::uint64_t bytes() const { return size * count; }
};

enum class PcdEncoding { ascii, binary, binary_compressed };

struct PcdHeader {
  std::vector<PcdField> fields;
  std::uint64_t width = 0, height = 1, points = 0;
  bool has_points = false;
  std::vector<double> viewpoint;  // position and quaternion w x y z; empty where the file has none
  PcdEncoding encoding = PcdEncoding::ascii;

  std::uint64_t record_size() const {
    std::uint64_t size = 0;
    for (const PcdField& f : fields) size += f.bytes();
    return size;
  }
};

// Reads a PCD header line by line, up to its DATA line; each error names the line.
class PcdHeaderReader {
 public:
  explicit PcdHeaderReader(LineReader& lines) : lines_(lines) {}

  PcdHeader read() {
    std::string line;
    while (lines_.next_line(line)) {
      if (lines_.line_number() > 1000) fail("the header has no end");
      if (line.empty() || line[0] == '#') continue;
      std::istringstream words(line);
      std::string key;
      words >> key;
      if (key == "DATA") return read_encoding(words), finish();
      read_entry(key, words);
    }
    fail("the file ends within its header");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(Cause::bad_input,
                fmt::format("{}:{}: {}", lines_.name(), lines_.line_number(), what));
  }

  void read_entry(const std::string& key, std::istream& words) {
    if (key == "VERSION") return;
    if (key == "FIELDS" || key == "COLUMNS") {
      for (std::string name; words >> name;) header_.fields.push_back({.name = name});
      if (header_.fields.size() > 4096) fail("has more than 4096 fields");
    } else if (key == "SIZE") {
      for (PcdField& f : header_.fields) f.size = read_count(words, 8);
    } else if (key == "COUNT") {
      for (PcdField& f : header_.fields) f.count = read_count(words, 1 << 16);
    } else if (key == "TYPE") {
      for (PcdField& f : header_.fields)
        if (!(words >> f.type)) fail("has fewer types than fields");
    } else if (key == "WIDTH") {
      header_.width = read_count(words, UINT64_MAX);
    } else if (key == "HEIGHT") {
      header_.height = read_count(words, UINT64_MAX);
    } else if (key == "POINTS") {
      header_.points = read_count(words, UINT64_MAX);
      header_.has_points = true;
    } else if (key == "VIEWPOINT") {
      header_.viewpoint.clear();
      for (double v = 0; words >> v;) header_.viewpoint.push_back(v);
      if (header_.viewpoint.size() != 7) fail("VIEWPOINT needs 7 numbers");
      for (std::size_t k = 0; k < 3; ++k)
        if (!(std::abs(header_.viewpoint[k]) < kFarthest))
          fail(fmt::format("the VIEWPOINT's {} is not within {:.0f} m of the origin",
                           header_.viewpoint[k], kFarthest));
    } else {
      fail(fmt::format("'{}' is no PCD header line", key.substr(0, 40)));
    }
  }

  std::uint64_t read_count(std::istream& words, std::uint64_t at_most) const {
    std::string word;
    words >> word;
    const double value = number_of(word).value_or(-1);
    if (!(value >= 0 && value == std::floor(value) && value <= static_cast<double>(at_most) &&
          value <= 1e18))
      fail(fmt::format("'{}' is no number from 0 to {}", word.substr(0, 40), at_most));
    return static_cast<std::uint64_t>(value);
  }

  void read_encoding(std::istream& words) {
    std::string name;
    words >> name;
    if (name == "ascii")
      header_.encoding = PcdEncoding::ascii;
    else if (name == "binary")
      header_.encoding = PcdEncoding::binary;
    else if (name == "binary_compressed")
      header_.encoding = PcdEncoding::binary_compressed;
    else
      fail(fmt::format("unknown PCD data format '{}'", name.substr(0, 40)));
  }

  PcdHeader finish() {
    if (header_.fields.empty()) fail("the header has no FIELDS");
    if (header_.record_size() == 0) fail("the fields have no bytes");
    if (header_.record_size() > kLongestRecord) fail("a point has too many bytes");
    if (!header_.has_points) {
      if (header_.height > 0 && header_.width > UINT64_MAX / header_.height)
        fail("WIDTH times HEIGHT is too large");
      header_.points = header_.width * header_.height;
    }
    return header_;
  }

  LineReader& lines_;
  PcdHeader header_;
};

NumberType number_type(const PcdField& field, const std::string& name) {
  const std::string code = field.type + std::to_string(field.size);
  static const std::pair<const char*, NumberType> types[] = {
      {"I1", NumberType::i8},  {"U1", NumberType::u8},  {"I2", NumberType::i16},
      {"U2", NumberType::u16}, {"I4", NumberType::i32}, {"U4", NumberType::u32},
      {"I8", NumberType::i64}, {"U8", NumberType::u64}, {"F4", NumberType::f32},
      {"F8", NumberType::f64}};
  for (const auto& [known, type] : types)
    if (code == known) return type;
  throw Error(Cause::bad_input,
              fmt::format("{}: field '{}' has the unknown type {}", name, field.name, code));
}

std::vector<Role> field_roles(const PcdHeader& header, const std::string& name) {
  std::vector<Role> roles;
  for (const PcdField& f : header.fields) {
    Role role = f.count == 1 ? role_of(f.name) : Role::none;
    if (role == Role::packed_rgb) {
      if (f.size != 4)
        role = Role::none;
      else if (f.type == 'F')
        role = Role::packed_rgb_float;
    }
    roles.push_back(role);
  }
  return usable_roles(std::move(roles), name, "the fields");
}

// The fields of records that lie one after the other (stride = record), or of whole columns (stride
// = value).
RecordLayout binary_layout(const PcdHeader& header, const std::string& name, bool columns) {
  const std::vector<Role> roles = field_roles(header, name);
  RecordLayout layout{.count = header.points};
  std::uint64_t offset = 0;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const PcdField& f = header.fields[i];
    if (roles[i] != Role::none)
      layout.fields.push_back({roles[i], number_type(f, name),
                               offset * (columns ? header.points : 1),
                               columns ? f.bytes() : header.record_size()});
    offset += f.bytes();
  }
  return layout;
}

void check_length(const std::string& name, std::uint64_t points, std::uint64_t room) {
  if (points > room)
    throw Error(Cause::bad_input, fmt::format("{}: promises {} points, but has room for {} at most",
                                              name, points, room));
}

RowSource open_ascii(LineReader& lines, const PcdHeader& header) {
  const std::vector<Role> roles = field_roles(header, lines.name());
  TextLayout layout{.rows = header.points};
  for (std::size_t i = 0; i < roles.size(); ++i) {
    layout.columns.push_back(roles[i]);
    layout.columns.insert(layout.columns.end(),
                          header.fields[i].count > 1 ? header.fields[i].count - 1 : 0, Role::none);
  }
  check_length(lines.name(), header.points, (lines.at_most_left() / 2 + 1) / layout.columns.size());
  return rows_in_memory(lines.name(), read_text_rows(lines, layout));
}

RowSource open_binary(const LineReader& lines, const PcdHeader& header) {
  const auto file = std::make_shared<const InputFile>(lines.name());
  check_length(file->name(), header.points, (file->size() - lines.offset()) / header.record_size());
  return record_rows(file, lines.offset(), header.record_size(),
                     binary_layout(header, file->name(), false));
}

RowSource open_compressed(const LineReader& lines, const PcdHeader& header) {
  const InputFile file(lines.name());
  const auto fail = [&](const std::string& what) {
    throw Error(Cause::bad_input, file.name() + ": " + what);
  };
  std::uint32_t sizes[2] = {};  // compressed, uncompressed
  if (file.size() < lines.offset() + sizeof(sizes)) fail("ends before its compressed data");
  file.read(lines.offset(), sizes, sizeof(sizes));
  const std::uint64_t begin = lines.offset() + sizeof(sizes);
  if (sizes[0] > file.size() - begin)
    fail(fmt::format("promises {} bytes of compressed data, but has {}", sizes[0],
                     file.size() - begin));
  check_length(file.name(), header.points, sizes[1] / header.record_size());
  // LZF makes at most 264 bytes of 3: what claims more is damaged, and must not cost us the memory.
  if (sizes[1] / 88 > std::uint64_t{sizes[0]} + 1)
    fail(fmt::format("{} bytes cannot hold {} bytes compressed", sizes[0], sizes[1]));
  std::vector<char> packed(sizes[0]), bytes(sizes[1]);
  file.read(begin, packed.data(), packed.size());
  if (header.points > 0 &&
      lzf_decompress(packed.data(), sizes[0], bytes.data(), sizes[1]) != sizes[1])
    fail(fmt::format("the compressed data at byte {} are damaged", begin));
  return record_rows(file.name(), std::move(bytes), binary_layout(header, file.name(), true));
}

}  // namespace

RowSource open_pcd(const std::filesystem::path& path) {
  LineReader lines(path);
  const PcdHeader header = PcdHeaderReader(lines).read();
  if (lines.gzipped() && header.encoding != PcdEncoding::ascii)
    throw Error(
        Cause::bad_input,
        lines.name() + ": binary PCD in gzip is not supported; unpack it with gunzip first");
  RowSource rows = header.encoding == PcdEncoding::ascii    ? open_ascii(lines, header)
                   : header.encoding == PcdEncoding::binary ? open_binary(lines, header)
                                                            : open_compressed(lines, header);
  const bool organised =
      header.height > 1 && header.width > 1 && header.points / header.height == header.width;
  if (organised) rows.image_width = header.width;
  if (header.viewpoint.size() == 7) {
    const std::vector<double>& v = header.viewpoint;
    const bool is_default = v == std::vector<double>{0, 0, 0, 1, 0, 0, 0};
    const Vec3 position(v[0], v[1], v[2]);
    if (organised || !is_default) rows.viewpoints.push_back(position);
  }
  return rows;
}

}  // namespace scanworld
