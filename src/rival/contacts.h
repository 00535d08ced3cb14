// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <tuple>

#include "cluster.h"
#include "neighbors.h"

namespace scanworld::rival {

// The sites of a cluster that have some of another one around them.
struct Contact {
  std::int32_t a, b;
  Moments moments;  // of a's sites

  bool operator<(const Contact& o) const { return std::tie(a, b) < std::tie(o.a, o.b); }
};

// All contacts, by a and b.
std::vector<Contact> find_contacts(const Grid& grid, const Neighbors& neighbors,
                                   const Clustering& clustering);

}  // namespace scanworld::rival
