// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "file.h"
#include "rows.h"

namespace scanworld {

enum class NumberType { i8, u8, i16, u16, i32, u32, i64, u64, f32, f64 };

std::size_t size_of(NumberType type);

// One value of each record: where its first byte lies, and the distance to the next record's.
struct Field {
  Role role;
  NumberType type;
  std::uint64_t offset;
  std::uint64_t stride;
};

// Binary records of a fixed layout, as PLY and PCD have them: `count` rows, fields in any order and
// place.
struct RecordLayout {
  std::vector<Field> fields;  // those with a role; x, y and z must be among them
  std::uint64_t count = 0;
  bool big_endian = false;
};

// Rows of records of `record_size` bytes that start at byte `begin` of the file; field offsets are
// within the record. The file must be long enough.
RowSource record_rows(std::shared_ptr<const InputFile> file, std::uint64_t begin,
                      std::uint64_t record_size, const RecordLayout& layout);

// Rows of values in memory; field offsets are within `bytes`.
RowSource record_rows(const std::string& name, std::vector<char> bytes, const RecordLayout& layout);

}  // namespace scanworld
