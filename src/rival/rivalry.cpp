// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rivalry.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "votes.h"

namespace scanworld::rival {

namespace {

// The label that explains a site at the lowest price. Notes whether it has others around it.
std::int32_t best_label(std::size_t i, std::span<const std::uint32_t> around, const Grid& grid,
                        const std::vector<LocalPlane>& local, Clustering& c, const Scale& scale,
                        const std::vector<double>& bends, float cos_angle,
                        const RivalryOptions& options, Votes& votes) {
  const std::int32_t own = c.label[i];
  const auto& entries = votes.count(around, c.label, own);
  c.border[i] = entries.size() > (own == kNone ? 0 : 1);
  if (entries.empty()) return kNone;
  const int total = static_cast<int>(around.size()) - 1;  // the site itself is among them
  const Site& s = grid.sites[i];
  const double noise = scale.variance_at(s.position());
  const double n = std::min<double>(s.points, options.weight);
  double best = n * options.no_plane + options.smoothness;
  std::int32_t label = kNone;
  for (const auto& e : entries) {
    const Plane& plane = c.plane(e.label);
    const double d = plane.signed_distance(s.position());
    const double ms =
        (d * d + s.variance(plane.normal)) / (noise + bends[static_cast<std::size_t>(e.label)]);
    double price = n * std::min(ms, 16.0);
    if (local[i].planar() && std::abs(local[i].normal.dot(plane.normal.cast<float>())) < cos_angle)
      price += n * options.wrong_normal;
    const int others = total - e.count + (e.label == own ? 1 : 0);
    price += options.smoothness * others / std::max(total, 1);
    if (price < best || (price == best && e.label < label)) best = price, label = e.label;
  }
  return label;
}

}  // namespace

Clustering compete(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                   const std::vector<LocalPlane>& local, Clustering c,
                   const RivalryOptions& options, const Observer& observe) {
  struct Change {
    std::uint32_t site;
    std::int32_t label;
  };
  const float cos_angle = static_cast<float>(std::cos(options.max_angle));
  const std::size_t parts = part_count(grid.sites.size(), kSitesPerPart);
  std::size_t most = 0;
  for (int sweep = 0; sweep < options.max_sweeps; ++sweep) {
    std::vector<std::vector<Change>> found(parts);
    const std::vector<double> bends = square_bends(c, scale);
    parallel_for(parts, [&](std::size_t part) {
      const auto [begin, end] = part_of(part, grid.sites.size(), kSitesPerPart);
      Votes votes;
      for (std::size_t i = begin; i < end; ++i) {
        if (!c.awake[i]) continue;
        c.awake[i] = 0;
        const std::int32_t label =
            best_label(i, neighbors.of(i), grid, local, c, scale, bends, cos_angle, options, votes);
        if (label != c.label[i]) found[part].push_back({static_cast<std::uint32_t>(i), label});
      }
    });
    std::vector<char> changed(c.clusters.size());
    const auto move = [&](std::int32_t l, const Moments& m, bool in) {
      if (l == kNone) return;
      Moments& sum = c.clusters[static_cast<std::size_t>(l)].moments;
      in ? sum += m : sum -= m;
      changed[static_cast<std::size_t>(l)] = 1;
    };
    std::size_t changes = 0;
    for (const auto& list : found)
      for (const Change& change : list) {
        const Moments m = grid.sites[change.site].moments();
        move(c.label[change.site], m, false);
        move(change.label, m, true);
        c.label[change.site] = change.label;
        for (std::uint32_t j : neighbors.of(change.site)) c.awake[j] = 1;
        ++changes;
      }
    for (std::size_t k = 0; k < changed.size(); ++k)
      if (changed[k] && c.clusters[k].moments.n > 3) c.clusters[k].fit = fit(c.clusters[k].moments);
    if (observe) observe("each voxel goes to the cluster that explains it best", c);
    most = std::max(most, changes);
    if (static_cast<double>(changes) <= options.stop_share * static_cast<double>(most)) break;
  }
  refit(grid, c);
  return c;
}

}  // namespace scanworld::rival
