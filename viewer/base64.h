// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace scanworld {

// Bytes as text (RFC 4648, with padding).
std::string base64(const void* bytes, std::size_t count);

// Numbers as base64 of their bytes, which are little-endian on all machines that are supported.
template <typename T>
std::string base64(const std::vector<T>& numbers) {
  return base64(numbers.data(), numbers.size() * sizeof(T));
}

}  // namespace scanworld
