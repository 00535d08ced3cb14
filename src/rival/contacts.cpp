// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "contacts.h"

#include <algorithm>

#include "../parallel.h"

namespace scanworld::rival {

std::vector<Contact> find_contacts(const Grid& grid, const Neighbors& neighbors,
                                   const Clustering& c) {
  constexpr std::size_t kPart = 1 << 12;
  const std::size_t parts = part_count(grid.sites.size(), kPart);
  std::vector<std::vector<Contact>> found(parts);
  parallel_for(parts, [&](std::size_t part) {
    const auto [begin, end] = part_of(part, grid.sites.size(), kPart);
    std::vector<Contact>& list = found[part];
    std::vector<std::int32_t> others;
    for (std::size_t i = begin; i < end; ++i) {
      const std::int32_t a = c.label[i];
      if (a == kNone || !c.may_border(i)) continue;
      others.clear();
      for (std::uint32_t j : neighbors.of(i)) {
        const std::int32_t b = c.label[j];
        if (b != a && b != kNone) add_new(others, b);
      }
      for (std::int32_t b : others) {
        auto at = std::find_if(list.begin(), list.end(),
                               [&](const Contact& k) { return k.a == a && k.b == b; });
        if (at == list.end()) at = list.insert(list.end(), {a, b, {}});
        at->moments += grid.sites[i].moments();
      }
    }
  });
  std::vector<Contact> all;
  for (const auto& list : found) all.insert(all.end(), list.begin(), list.end());
  std::stable_sort(all.begin(), all.end());
  std::size_t last = 0;
  for (std::size_t k = 1; k < all.size(); ++k) {
    if (all[last] < all[k])
      all[++last] = all[k];
    else
      all[last].moments += all[k].moments;
  }
  if (!all.empty()) all.resize(last + 1);
  return all;
}

}  // namespace scanworld::rival
