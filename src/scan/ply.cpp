// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "ply.h"

#include <fmt/format.h>

#include <charconv>
#include <limits>
#include <map>
#include <optional>
#include <sstream>

#include "../error.h"
#include "records.h"
#include "text_rows.h"

namespace scanworld {

namespace {

struct Property {
  std::string name;
  NumberType type = NumberType::f32;
  std::optional<NumberType> list_count;  // set where the property is a list
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;

  bool has_list() const {
    for (const Property& p : properties)
      if (p.list_count) return true;
    return false;
  }
  // Bytes of one binary record; for elements without lists.
  std::uint64_t record_size() const {
    std::uint64_t size = 0;
    for (const Property& p : properties) size += size_of(p.type);
    return size;
  }
};

enum class PlyEncoding { ascii, little_endian, big_endian };

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::ascii;
  std::vector<Element> elements;
};

// Reads a PLY header line by line; each error names the line.
class PlyHeaderReader {
 public:
  explicit PlyHeaderReader(LineReader& lines) : lines_(lines) {}

  PlyHeader read() {
    std::string line;
    if (!lines_.next_line(line) || line != "ply")
      fail("is not a PLY file: the first line is not 'ply'");
    bool has_format = false;
    while (lines_.next_line(line)) {
      std::istringstream words(line);
      std::string word;
      words >> word;
      if (word == "format")
        read_format(words), has_format = true;
      else if (word == "element")
        read_element(words);
      else if (word == "property")
        read_property(words);
      else if (word == "end_header")
        return has_format ? header_ : (fail("has no format line"), header_);
      else if (!word.empty() && word != "comment" && word != "obj_info")
        fail(fmt::format("'{}' is no PLY header line", word.substr(0, 40)));
      if (lines_.line_number() > 10000) fail("the header has no end");
    }
    fail("the file ends within its header");
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw Error(Cause::bad_input,
                fmt::format("{}:{}: {}", lines_.name(), lines_.line_number(), what));
  }

  void read_format(std::istream& words) {
    static const std::map<std::string, PlyEncoding> encodings = {
        {"ascii", PlyEncoding::ascii},
        {"binary_little_endian", PlyEncoding::little_endian},
        {"binary_big_endian", PlyEncoding::big_endian}};
    std::string name;
    words >> name;
    const auto found = encodings.find(name);
    if (found == encodings.end()) fail(fmt::format("unknown PLY format '{}'", name.substr(0, 40)));
    header_.encoding = found->second;
  }

  void read_element(std::istream& words) {
    Element element;
    std::string count;
    words >> element.name >> count;
    const auto [end, error] =
        std::from_chars(count.data(), count.data() + count.size(), element.count);
    if (count.empty() || error != std::errc() || end != count.data() + count.size())
      fail(fmt::format("'{}' is no number of elements", count.substr(0, 40)));
    header_.elements.push_back(element);
  }

  void read_property(std::istream& words) {
    if (header_.elements.empty()) fail("a property before the first element");
    Property property;
    std::string type;
    words >> type;
    if (type == "list") {
      std::string count_type;
      words >> count_type >> type;
      property.list_count = number_type(count_type);
    }
    property.type = number_type(type);
    if (!(words >> property.name)) fail("a property without a name");
    header_.elements.back().properties.push_back(property);
  }

  NumberType number_type(const std::string& name) const {
    static const std::map<std::string, NumberType> types = {
        {"char", NumberType::i8},    {"int8", NumberType::i8},     {"uchar", NumberType::u8},
        {"uint8", NumberType::u8},   {"short", NumberType::i16},   {"int16", NumberType::i16},
        {"ushort", NumberType::u16}, {"uint16", NumberType::u16},  {"int", NumberType::i32},
        {"int32", NumberType::i32},  {"uint", NumberType::u32},    {"uint32", NumberType::u32},
        {"float", NumberType::f32},  {"float32", NumberType::f32}, {"double", NumberType::f64},
        {"float64", NumberType::f64}};
    const auto found = types.find(name);
    if (found == types.end()) fail(fmt::format("unknown PLY type '{}'", name.substr(0, 40)));
    return found->second;
  }

  LineReader& lines_;
  PlyHeader header_;
};

std::vector<Role> vertex_roles(const Element& vertex, const std::string& name) {
  std::vector<Role> roles;
  for (const Property& p : vertex.properties) {
    if (p.list_count)
      throw Error(Cause::bad_input,
                  fmt::format("{}: vertex property '{}' is a list; points with lists "
                              "are not supported",
                              name, p.name));
    roles.push_back(role_of(p.name));
  }
  return usable_roles(std::move(roles), name, "the vertices");
}

[[noreturn]] void fail_truncated(const std::string& name, const Element& element,
                                 std::uint64_t have) {
  throw Error(Cause::bad_input,
              fmt::format("{}: promises {} of element '{}', but has room for {} at most", name,
                          element.count, element.name, have));
}

RowSource open_ascii(LineReader& lines, const PlyHeader& header, std::size_t vertex_at) {
  std::string line;
  for (std::size_t e = 0; e < vertex_at; ++e)
    for (std::uint64_t i = 0; i < header.elements[e].count; ++i)
      if (!lines.next_line(line)) fail_truncated(lines.name(), header.elements[e], i);
  const Element& vertex = header.elements[vertex_at];
  // Each value takes a digit and a separator (the file's last separator may be missing).
  const std::uint64_t at_most = (lines.at_most_left() / 2 + 1) / vertex.properties.size();
  if (vertex.count > at_most) fail_truncated(lines.name(), vertex, at_most);
  const TextLayout layout{.columns = vertex_roles(vertex, lines.name()), .rows = vertex.count};
  return rows_in_memory(lines.name(), read_text_rows(lines, layout));
}

// The first byte after `element`, whose first is at `begin`.
std::uint64_t skip_binary(const InputFile& file, const Element& element, std::uint64_t begin,
                          bool big_endian) {
  if (!element.has_list()) {
    const std::uint64_t size = element.record_size(), left = file.size() - begin;
    if (size > 0 && element.count > left / size) fail_truncated(file.name(), element, left / size);
    return begin + element.count * size;
  }
  std::uint64_t at = begin;
  for (std::uint64_t i = 0; i < element.count; ++i) {
    for (const Property& p : element.properties) {
      std::uint64_t items = 1;
      if (p.list_count) {
        const std::size_t size = size_of(*p.list_count);
        if (at + size > file.size() || size > 4) fail_truncated(file.name(), element, i);
        unsigned char bytes[4] = {};
        file.read(at, bytes, size);
        items = 0;
        for (std::size_t b = 0; b < size; ++b)
          items = items << 8 | bytes[big_endian ? b : size - 1 - b];
        at += size;
      }
      at += items * size_of(p.type);
    }
    if (at > file.size()) fail_truncated(file.name(), element, i);
  }
  return at;
}

RowSource open_binary(const LineReader& lines, const PlyHeader& header, std::size_t vertex_at) {
  if (lines.gzipped())
    throw Error(
        Cause::bad_input,
        lines.name() + ": binary PLY in gzip is not supported; unpack it with gunzip first");
  const auto file = std::make_shared<const InputFile>(lines.name());
  const bool big_endian = header.encoding == PlyEncoding::big_endian;
  std::uint64_t begin = lines.offset();
  for (std::size_t e = 0; e < vertex_at; ++e)
    begin = skip_binary(*file, header.elements[e], begin, big_endian);

  const Element& vertex = header.elements[vertex_at];
  const std::vector<Role> roles = vertex_roles(vertex, lines.name());
  skip_binary(*file, vertex, begin,
              big_endian);  // throws where the file is too short for all vertices
  RecordLayout layout{.count = vertex.count, .big_endian = big_endian};
  std::uint64_t offset = 0;
  for (std::size_t i = 0; i < roles.size(); ++i) {
    const NumberType type = vertex.properties[i].type;
    const bool packed = roles[i] == Role::packed_rgb;
    if (roles[i] != Role::none && (!packed || size_of(type) == 4))
      layout.fields.push_back({roles[i], type, offset, vertex.record_size()});
    offset += size_of(type);
  }
  return record_rows(file, begin, vertex.record_size(), layout);
}

std::size_t find_vertex(const PlyHeader& header, const std::string& name) {
  for (std::size_t i = 0; i < header.elements.size(); ++i)
    if (header.elements[i].name == "vertex" && !header.elements[i].properties.empty()) return i;
  throw Error(Cause::bad_input, name + ": the header has no element 'vertex' with properties");
}

}  // namespace

RowSource open_ply(const std::filesystem::path& path) {
  LineReader lines(path);
  const PlyHeader header = PlyHeaderReader(lines).read();
  const std::size_t vertex = find_vertex(header, lines.name());
  if (header.encoding == PlyEncoding::ascii) return open_ascii(lines, header, vertex);
  return open_binary(lines, header, vertex);
}

bool is_ply_mesh(const std::filesystem::path& path) {
  LineReader lines(path);
  for (const Element& element : PlyHeaderReader(lines).read().elements)
    if (element.name == "face" && element.count > 0) return true;
  return false;
}

}  // namespace scanworld
