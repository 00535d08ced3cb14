// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "cluster.h"

namespace scanworld::rival {

// The clusters around a site, and how many sites each has there.
class Votes {
 public:
  struct Entry {
    std::int32_t label;
    int count;
  };

  // The site's own cluster comes first, where it has one.
  const std::vector<Entry>& count(std::span<const std::uint32_t> around,
                                  const std::vector<std::int32_t>& labels, std::int32_t own) {
    // Mostly all are in its own or in none, so others are sorted out without a branch.
    if (others_.size() < around.size()) others_.resize(around.size());
    int own_count = 0;
    std::size_t others = 0;
    for (std::uint32_t j : around) {
      const std::int32_t l = labels[j];
      own_count += l == own;
      others_[others] = l;
      others += l != own && l != kNone;
    }
    entries_.clear();
    if (own != kNone) entries_.push_back({own, own_count});
    for (std::size_t k = 0; k < others; ++k) {
      const auto at = std::find_if(entries_.begin(), entries_.end(),
                                   [&](const Entry& e) { return e.label == others_[k]; });
      if (at != entries_.end())
        ++at->count;
      else
        entries_.push_back({others_[k], 1});
    }
    return entries_;
  }

 private:
  std::vector<std::int32_t> others_;
  std::vector<Entry> entries_;
};

}  // namespace scanworld::rival
