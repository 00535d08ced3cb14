// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "merge.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "contacts.h"
#include "crossing.h"
#include "join.h"

namespace scanworld::rival {

namespace {

constexpr double kNever = 1e9;     // a price
constexpr double kLayers = 0.9;    // cosine between the normals of layers
constexpr double kMostOfIt = 0.5;  // share of a layer that touches the cluster it belongs to

// What speaks for joining two clusters: the lower the price, the more; 1 or more is too much.
struct Bid {
  double price;
  std::int32_t a, b;
  bool layer;

  bool operator<(const Bid& o) const { return std::tie(price, a, b) < std::tie(o.price, o.a, o.b); }
};

// For a smaller cluster that lies in the noise of a larger one, where both are: `there` are the
// sites of the larger that touch it, `here` its own that touch the larger.
double layer_price(const Cluster& larger, const Contact& there, const Cluster& smaller,
                   const Contact& here, const Scale& scale, const MergeOptions& options) {
  if (larger.moments.n < smaller.moments.n || here.moments.n < kMostOfIt * smaller.moments.n ||
      std::abs(larger.fit.plane.normal.dot(smaller.fit.plane.normal)) < kLayers)
    return kNever;
  return (there.moments + smaller.moments).mean_square(larger.fit.plane) /
         square_limit(larger, smaller, scale.flatness.bend_at(extent_of(larger.fit)), scale,
                      options.max_rms);
}

// Whether two clusters are on two levels where they meet: `here` are the sites of the one there,
// `there` those of the other. One that lies along the other with most of it is no step of it.
bool is_step(const Cluster& a, const Contact& here, const Cluster& b, const Contact& there,
             const MergeOptions& options) {
  if (here.moments.n > kMostOfIt * a.moments.n || there.moments.n > kMostOfIt * b.moments.n)
    return false;
  const Vec3 other = b.fit.plane.normal;
  const double side = a.fit.plane.normal.dot(other) < 0 ? -1 : 1;
  const Vec3 normal = (a.fit.plane.normal + side * other).normalized();
  const auto square_error = [&](const Moments& m) {
    return normal.dot(m.covariance() * normal) / m.n;
  };
  const double step = std::abs(normal.dot(here.moments.mean() - there.moments.mean()));
  const double error =
      std::sqrt(std::max(0.0, square_error(here.moments) + square_error(there.moments)));
  return step > std::max(options.min_step, options.step_errors * error);
}

double plane_price(const Cluster& a, const Cluster& b, const Scale& scale, Meeting meeting,
                   const MergeOptions& options) {
  return is_across(a.fit.plane, b.fit.plane) ? kNever
                                             : joint_price(a, b, scale, options.max_rms, meeting);
}

std::vector<Bid> find_bids(const Clustering& c, const std::vector<Contact>& contacts,
                           const Scale& scale, const MergeOptions& options) {
  const auto at = [&](std::int32_t k) -> const Cluster& {
    return c.clusters[static_cast<std::size_t>(k)];
  };
  std::vector<Bid> bids;
  const auto offer = [&](const Bid& bid) {
    if (bid.price < 1) bids.push_back(bid);
  };
  for (const Contact& k : contacts) {
    const auto back = std::lower_bound(contacts.begin(), contacts.end(), Contact{k.b, k.a, {}});
    const bool is_mutual = back != contacts.end() && back->a == k.b && back->b == k.a;
    if (k.a < k.b && !(is_mutual && is_step(at(k.a), k, at(k.b), *back, options)))
      offer({plane_price(at(k.a), at(k.b), scale, Meeting::smooth, options), k.a, k.b, false});
    if (!is_mutual) continue;
    offer({layer_price(at(k.b), *back, at(k.a), k, scale, options), k.b, k.a, true});
  }
  std::sort(bids.begin(), bids.end());
  return bids;
}

}  // namespace

Clustering merge_clusters(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                          Clustering c, const MergeOptions& options) {
  const std::vector<Bid> bids = find_bids(c, find_contacts(grid, neighbors, c), scale, options);
  Joiner joiner(std::move(c));
  for (const Bid& bid : bids) {
    const auto a = static_cast<std::size_t>(bid.a), b = static_cast<std::size_t>(bid.b);
    if (joiner.find(a) == joiner.find(b)) continue;
    // A plane in common must serve what the two have become since.
    if (bid.layer ||
        plane_price(joiner.whole(a), joiner.whole(b), scale, Meeting::smooth, options) < 1)
      joiner.join(a, b);
  }
  return joiner.finish(grid);
}

}  // namespace scanworld::rival
