// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "merge.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "contacts.h"

namespace scanworld::rival {

Clustering merge_clusters(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                          Clustering c, const MergeOptions& options) {
  const std::vector<Contact> contacts = find_contacts(grid, neighbors, c);
  const auto limit = [&](const Cluster& p, const Cluster& q) {
    return std::pow(
        options.max_rms * std::max(scale.noise_at(p.fit.centroid), scale.noise_at(q.fit.centroid)),
        2);
  };
  std::vector<std::int32_t> to(c.clusters.size());
  for (std::size_t k = 0; k < to.size(); ++k) to[k] = static_cast<std::int32_t>(k);
  const auto find = [&](std::int32_t k) {
    while (to[static_cast<std::size_t>(k)] != k) k = to[static_cast<std::size_t>(k)];
    return k;
  };
  const auto at = [&](std::int32_t k) -> Cluster& {
    return c.clusters[static_cast<std::size_t>(k)];
  };
  // The larger of the two parts' mean squares about the plane in common, over the limit.
  const auto price_of = [&](std::int32_t a, std::int32_t b) {
    const Cluster &p = at(a), &q = at(b);
    if (std::abs(p.fit.plane.normal.dot(q.fit.plane.normal)) < 0.7) return 1e9;
    const MomentFit joint = fit(p.moments + q.moments);
    return std::max(p.moments.mean_square(joint.plane), q.moments.mean_square(joint.plane)) /
           limit(p, q);
  };
  // Layers: b lies in a's noise, where both are.
  const auto layer_price = [&](const Contact& b_at_a, const Contact& a_at_b) {
    const Cluster &p = at(a_at_b.a), &q = at(b_at_a.a);
    if (p.moments.n < q.moments.n || b_at_a.moments.n < 0.5 * q.moments.n ||
        std::abs(p.fit.plane.normal.dot(q.fit.plane.normal)) < 0.9)
      return 1e9;
    return (a_at_b.moments + q.moments).mean_square(p.fit.plane) / limit(p, q);
  };
  struct Bid {
    double price;
    std::int32_t a, b;
    bool layer;
  };
  std::vector<Bid> bids;
  for (const Contact& k : contacts) {
    if (k.a < k.b)
      if (const double price = price_of(k.a, k.b); price < 1)
        bids.push_back({price, k.a, k.b, false});
    const auto back = std::lower_bound(contacts.begin(), contacts.end(), Contact{k.b, k.a, {}});
    if (back == contacts.end() || back->a != k.b || back->b != k.a) continue;
    if (const double price = layer_price(k, *back); price < 1)
      bids.push_back({price, k.b, k.a, true});
  }
  std::sort(bids.begin(), bids.end(), [](const Bid& x, const Bid& y) {
    return std::tie(x.price, x.a, x.b) < std::tie(y.price, y.a, y.b);
  });
  for (const Bid& bid : bids) {
    std::int32_t a = find(bid.a), b = find(bid.b);
    if (a == b || (!bid.layer && price_of(a, b) >= 1)) continue;
    if (a > b) std::swap(a, b);
    at(a).moments += at(b).moments;
    at(a).fit = fit(at(a).moments);
    to[static_cast<std::size_t>(b)] = a;
  }
  for (std::size_t i = 0; i < c.label.size(); ++i)
    if (c.label[i] != kNone && to[static_cast<std::size_t>(c.label[i])] != c.label[i])
      c.label[i] = find(c.label[i]), c.awake[i] = 1;
  refit(grid, c);
  return c;
}

}  // namespace scanworld::rival
