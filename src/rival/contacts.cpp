// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "contacts.h"

#include <algorithm>
#include <unordered_map>

#include "../parallel.h"
#include "votes.h"

namespace scanworld::rival {

std::vector<Contact> find_contacts(const Grid& grid, const Neighbors& neighbors,
                                   const Clustering& c) {
  const std::size_t parts = part_count(grid.sites.size(), kSitesPerPart);
  std::vector<std::vector<Contact>> found(parts);
  parallel_for(parts, [&](std::size_t part) {
    const auto [begin, end] = part_of(part, grid.sites.size(), kSitesPerPart);
    std::vector<Contact>& list = found[part];
    Votes votes;
    std::unordered_map<std::uint64_t, std::size_t> index;  // in the list, by a << 32 | b
    for (std::size_t i = begin; i < end; ++i) {
      const std::int32_t a = c.label[i];
      if (a == kNone || !c.may_border(i)) continue;
      for (const auto& [b, count] : votes.count(neighbors.of(i), c.label, a)) {
        if (b == a) continue;
        const auto key = static_cast<std::uint64_t>(a) << 32 | static_cast<std::uint32_t>(b);
        const auto [at, is_new] = index.try_emplace(key, list.size());
        if (is_new) list.push_back({a, b, {}});
        list[at->second].moments += grid.sites[i].moments();
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
