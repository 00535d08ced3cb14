// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "lines.h"
#include "rows.h"

namespace scanworld {

// How rows of numbers are written.
struct TextLayout {
  std::vector<Role> columns;  // what each column holds; columns beyond these are not looked at
  std::uint64_t rows = UINT64_MAX;  // stop after so many
  bool counts_between = false;  // lines with one whole number announce how many rows follow (PTS)
};

// Reads rows, one a line, values separated by blanks, tabs, commas, semicolons or bars; empty lines
// and comments (# // % ;) are passed over. Lines are worked on in parallel. Throws bad_input naming
// file, line and word where a value is missing or is not a number.
Rows read_text_rows(LineReader& lines, const TextLayout& layout);

// The words of a line, split as the rows are; empty where two separators follow each other.
std::vector<std::string_view> split_columns(std::string_view line);

// True where a line holds nothing to read: it is empty or a comment.
bool is_comment(std::string_view line);

// The number that a word is, correctly rounded; '+', nan and inf are understood. Nothing where it
// is none.
std::optional<double> number_of(std::string_view word);

}  // namespace scanworld
