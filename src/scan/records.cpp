// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "records.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "../parallel.h"

namespace scanworld {

namespace {

// Rows worked on at a time: their bytes and values stay in the cache.
constexpr std::size_t kPartRows = 1 << 14;

template <typename T>
T load(const char* from, bool swap) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, sizeof(T));
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

// Calls put(row, value) for rows [0, count) of one field.
template <typename T, typename Put>
void each_value(const char* first, std::uint64_t stride, std::size_t count, bool swap, Put put) {
  for (std::size_t i = 0; i < count; ++i) put(i, load<T>(first + i * stride, swap));
}

template <typename Put>
void each_value(const Field& field, const char* first, std::size_t count, bool swap, Put put) {
  switch (field.type) {
    case NumberType::i8:
      return each_value<std::int8_t>(first, field.stride, count, swap, put);
    case NumberType::u8:
      return each_value<std::uint8_t>(first, field.stride, count, swap, put);
    case NumberType::i16:
      return each_value<std::int16_t>(first, field.stride, count, swap, put);
    case NumberType::u16:
      return each_value<std::uint16_t>(first, field.stride, count, swap, put);
    case NumberType::i32:
      return each_value<std::int32_t>(first, field.stride, count, swap, put);
    case NumberType::u32:
      return each_value<std::uint32_t>(first, field.stride, count, swap, put);
    case NumberType::i64:
      return each_value<std::int64_t>(first, field.stride, count, swap, put);
    case NumberType::u64:
      return each_value<std::uint64_t>(first, field.stride, count, swap, put);
    case NumberType::f32:
      return each_value<float>(first, field.stride, count, swap, put);
    case NumberType::f64:
      return each_value<double>(first, field.stride, count, swap, put);
  }
}

// A colour channel as 0 to 255, from 8 or 16 bits or from a share of 1.
std::uint8_t channel(double value, NumberType type) {
  if (type == NumberType::f32 || type == NumberType::f64) value *= 255;
  if (type == NumberType::u16) value /= 257;
  return static_cast<std::uint8_t>(value >= 0 ? std::min(value + 0.5, 255.0) : 0);
}

void decode(const Field& field, const char* first, std::size_t count, bool swap, Rows& rows) {
  const auto axis = [&](Role base) {
    return static_cast<int>(field.role) - static_cast<int>(base);
  };
  switch (field.role) {
    case Role::none:
      return;
    case Role::x:
    case Role::y:
    case Role::z: {
      const int k = axis(Role::x);
      return each_value(field, first, count, swap,
                        [&](std::size_t i, auto v) { rows.points[i][k] = static_cast<double>(v); });
    }
    case Role::nx:
    case Role::ny:
    case Role::nz: {
      const int k = axis(Role::nx);
      return each_value(field, first, count, swap,
                        [&](std::size_t i, auto v) { rows.normals[i][k] = static_cast<float>(v); });
    }
    case Role::red:
    case Role::green:
    case Role::blue: {
      std::uint8_t Color::*const part =
          std::array{&Color::r, &Color::g, &Color::b}[static_cast<std::size_t>(axis(Role::red))];
      return each_value(field, first, count, swap, [&](std::size_t i, auto v) {
        rows.colors[i].*part = channel(static_cast<double>(v), field.type);
      });
    }
    case Role::packed_rgb:
    case Role::packed_rgb_float:
      return each_value<std::uint32_t>(
          first, field.stride, count, swap,
          [&](std::size_t i, std::uint32_t v) { rows.colors[i] = unpack_rgb(v); });
    case Role::scan_index:
      return each_value(field, first, count, swap, [&](std::size_t i, auto v) {
        rows.scan_index[i] = static_cast<double>(v);
      });
  }
}

// True where the records begin with x, y and z as floats in this machine's byte order.
bool has_plain_floats(const RecordLayout& layout) {
  const auto is_float = [&](Role role, std::uint64_t offset) {
    return std::any_of(layout.fields.begin(), layout.fields.end(), [&](const Field& f) {
      return f.role == role && f.type == NumberType::f32 && f.offset == offset;
    });
  };
  return layout.big_endian == (std::endian::native == std::endian::big) && is_float(Role::x, 0) &&
         is_float(Role::y, 4) && is_float(Role::z, 8);
}

// Sets up all of a source but how bytes are had: `bytes(part, field)` is the first byte of a field
// in a part.
template <typename Bytes>
RowSource make_source(const std::string& name, const RecordLayout& layout, Bytes bytes) {
  RowSource source{.name = name, .first = {0}};
  for (std::size_t i = 0; i < part_count(layout.count, kPartRows); ++i)
    source.first.push_back(part_of(i, layout.count, kPartRows).end);
  for (const Field& field : layout.fields) {
    source.normals |= field.role == Role::nx;
    source.colors |= field.role == Role::red || field.role == Role::packed_rgb ||
                     field.role == Role::packed_rgb_float;
    source.scan_index |= field.role == Role::scan_index;
  }
  const bool swap = layout.big_endian != (std::endian::native == std::endian::big);
  source.load = [layout, bytes, swap, normals = source.normals, colors = source.colors,
                 indices = source.scan_index](std::size_t i, Rows& rows) -> RowsView {
    const Part part = part_of(i, layout.count, kPartRows);
    const std::size_t count = part.end - part.begin;
    rows.points.resize(count);
    rows.normals.assign(normals ? count : 0, Vec3f::Zero());
    rows.colors.resize(colors ? count : 0);
    rows.scan_index.resize(indices ? count : 0);
    const auto first_byte = bytes(part);
    for (const Field& field : layout.fields) decode(field, first_byte(field), count, swap, rows);
    return {rows.points, rows.normals, rows.colors, rows.scan_index};
  };
  return source;
}

}  // namespace

std::size_t size_of(NumberType type) {
  static constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 8, 8, 4, 8};
  return sizes[static_cast<int>(type)];
}

RowSource record_rows(std::shared_ptr<const InputFile> file, std::uint64_t begin,
                      std::uint64_t record_size, const RecordLayout& layout) {
  const auto bytes_of = [file, begin, record_size](Part part, char* to) {
    file->read(begin + part.begin * record_size, to, (part.end - part.begin) * record_size);
  };
  RowSource source = make_source(file->name(), layout, [bytes_of, record_size](Part part) {
    thread_local std::vector<char> buffer;
    buffer.resize((part.end - part.begin) * record_size);
    bytes_of(part, buffer.data());
    return [](const Field& field) { return buffer.data() + field.offset; };
  });
  // The most common file of all holds nothing but floats: they go straight to their place.
  if (record_size == sizeof(Vec3f) && has_plain_floats(layout))
    source.load_floats = [bytes_of, count = layout.count](std::size_t i, Vec3f* to) {
      bytes_of(part_of(i, count, kPartRows), reinterpret_cast<char*>(to));
    };
  return source;
}

RowSource record_rows(const std::string& name, std::vector<char> bytes,
                      const RecordLayout& layout) {
  const auto held = std::make_shared<const std::vector<char>>(std::move(bytes));
  return make_source(name, layout, [held](Part part) {
    return [first = held->data(), part](const Field& field) {
      return first + field.offset + part.begin * field.stride;
    };
  });
}

}  // namespace scanworld
