// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "gaps.h"

#include <algorithm>

#include "../parallel.h"

namespace scanworld::surface {

namespace {

// What a patch covers, and the seams from end to end: also where neither patch has points.
Raster rim_of(const Patch& patch, const std::vector<CutLine>& lines) {
  Raster rim = patch.covered;
  for (const CutLine& line : lines)
    for (double t = line.seen.front().low; t <= line.seen.back().high; t += rim.cell / 2)
      set(rim, patch.frame.to_plane(line.line.at(t)));
  return rim;
}

// The mean of what the cells around each one say, two to all sides: in a sparse scan cells without
// points lie between others.
std::vector<float> mean_around(const Raster& raster, const std::vector<float>& evidence) {
  constexpr int kReach = 2;
  const auto row = static_cast<std::size_t>(raster.width) + 1;
  std::vector<double> sums(row * (static_cast<std::size_t>(raster.height) + 1));
  const auto at = [&](int x, int y) -> double& {
    return sums[static_cast<std::size_t>(y) * row + static_cast<std::size_t>(x)];
  };
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x)
      at(x + 1, y + 1) = evidence[raster.index(x, y)] + at(x, y + 1) + at(x + 1, y) - at(x, y);
  std::vector<float> means(evidence.size());
  for (int y = 0; y < raster.height; ++y)
    for (int x = 0; x < raster.width; ++x) {
      const int x0 = std::max(0, x - kReach), x1 = std::min(raster.width, x + kReach + 1),
                y0 = std::max(0, y - kReach), y1 = std::min(raster.height, y + kReach + 1);
      means[raster.index(x, y)] = static_cast<float>(
          (at(x1, y1) - at(x0, y1) - at(x1, y0) + at(x0, y0)) / ((x1 - x0) * (y1 - y0)));
    }
  return means;
}

// What a patch's cells say, which of them something hides, and which are in an opening.
struct Weighed {
  std::vector<float> evidence;
  Raster hidden, open;
};

class GapWeigher {
 public:
  GapWeigher(const std::vector<Patch>& patches, const Surroundings& around, const Vec3& up,
             const GapOptions& options)
      : patches_(patches), around_(around), up_(up), options_(options) {}

  Weighed weigh(const Patch& patch, const std::vector<CutLine>& lines) const {
    const Raster enclosed = enclosed_by(rim_of(patch, lines));
    const Raster through = seen_through(patch, around_, options_.through);
    const Raster ground = find_ground(patch);
    Raster hidden = find_hidden(patch, enclosed), open = empty_like(patch.hit);
    std::vector<float> evidence = patch.evidence;
    for (std::size_t i = 0; i < evidence.size(); ++i) {
      if (patch.hit.bits[i]) continue;
      if (through.bits[i])
        evidence[i] = -1, hidden.bits[i] = 0;
      else if (hidden.bits[i])
        evidence[i] = static_cast<float>(options_.hidden_evidence);
      else if (ground.bits[i] && enclosed.bits[i])
        evidence[i] *= static_cast<float>(options_.ground_price);
    }
    const std::vector<float> around = mean_around(patch.hit, evidence);
    for (std::size_t i = 0; i < evidence.size(); ++i)
      open.bits[i] = !patch.hit.bits[i] && enclosed.bits[i] && !hidden.bits[i] &&
                     around[i] < options_.open_evidence;
    return {std::move(evidence), std::move(hidden), std::move(open)};
  }

  // The evidence of a patch's cells, once that of all patches is known: what is hidden before one
  // face of a wall is an opening if it is one in the other face.
  std::vector<float> agree(std::size_t k, const std::vector<Weighed>& weighed) const {
    const Patch& patch = patches_[k];
    std::vector<float> evidence = weighed[k].evidence;
    for (std::size_t other = 0; other < patches_.size(); ++other) {
      if (!are_faces(patch, patches_[other])) continue;
      const Weighed& its = weighed[other];
      for (int y = 0; y < patch.hit.height; ++y)
        for (int x = 0; x < patch.hit.width; ++x) {
          const std::size_t i = patch.hit.index(x, y);
          if (patch.hit.bits[i] || !weighed[k].hidden.bits[i]) continue;
          const Vec2 p =
              patches_[other].frame.to_plane(patch.frame.to_space(patch.hit.middle(x, y)));
          const std::optional<std::size_t> at = its.open.find(p);
          if (at && its.open.bits[*at]) evidence[i] = std::min(evidence[i], its.evidence[*at]);
        }
    }
    return evidence;
  }

 private:
  // Whether two patches look away from each other, as far apart as the faces of a wall are.
  bool are_faces(const Patch& a, const Patch& b) const {
    if (a.hit.bits.empty() || b.hit.bits.empty() ||
        a.plane.normal.dot(b.plane.normal) > -std::cos(options_.max_tilt) ||
        !grown(a.box, options_.max_thickness).intersects(b.box))
      return false;
    const double apart = -a.plane.signed_distance(b.box.center());
    return apart > 0 && apart < options_.max_thickness;
  }

  // Whether what belongs to a plane, or to none, hides what is behind it.
  bool may_hide(std::int32_t plane, const Plane& patch) const {
    return plane < 0 ||
           std::abs(patches_[static_cast<std::size_t>(plane)].plane.normal.dot(patch.normal)) >
               options_.shadow_cosine;
  }

  // The cells that something stands before.
  Raster find_shadow(const Patch& patch) const {
    Raster shadow = empty_like(patch.hit);
    look_around(patch, around_, options_.shadow_depth,
                [&](double distance, const Vec2& p, std::int32_t plane) {
                  if (distance > 2 * shadow.cell && may_hide(plane, patch.plane)) set(shadow, p);
                });
    return shadow;
  }

  // Cells in a shadow, and all cells of gaps that are in a shadow for the most part: it falls
  // aslant.
  Raster find_hidden(const Patch& patch, const Raster& enclosed) const {
    const Raster shadow = find_shadow(patch);
    Raster hidden = shadow, left = enclosed;
    for (std::size_t i = 0; i < left.bits.size(); ++i) left.bits[i] &= !patch.covered.bits[i];
    for (int y = 0; y < left.height; ++y)
      for (int x = 0; x < left.width; ++x) {
        if (!left.is_set(x, y)) continue;
        const std::vector<std::size_t> gap = take_gap(left, x, y);
        const auto shaded =
            std::count_if(gap.begin(), gap.end(), [&](std::size_t i) { return shadow.bits[i]; });
        if (static_cast<double>(shaded) >= options_.hidden_share * static_cast<double>(gap.size()))
          for (std::size_t i : gap) hidden.bits[i] = 1;
      }
    return hidden;
  }

  // The cells of what one stands on that have nothing below; none of other patches.
  Raster find_ground(const Patch& patch) const {
    Raster ground = empty_like(patch.hit);
    if (patch.plane.normal.dot(up_) < options_.level) return ground;
    Raster below = ground;
    look_around(patch, around_, options_.depth_below,
                [&](double distance, const Vec2& p, std::int32_t) {
                  if (distance < -2 * below.cell) set(below, p);
                });
    below = close(below, 2);
    for (std::size_t i = 0; i < ground.bits.size(); ++i) ground.bits[i] = !below.bits[i];
    return ground;
  }

  // Clears the set cells that hang together with one by their sides, and returns them.
  static std::vector<std::size_t> take_gap(Raster& left, int x, int y) {
    std::vector<std::size_t> gap;
    std::vector<std::array<int, 2>> open = {{x, y}};
    left.bits[left.index(x, y)] = 0;
    while (!open.empty()) {
      const auto [cx, cy] = open.back();
      open.pop_back();
      gap.push_back(left.index(cx, cy));
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}})
        if (left.is_set(cx + dx, cy + dy)) {
          left.bits[left.index(cx + dx, cy + dy)] = 0;
          open.push_back({cx + dx, cy + dy});
        }
    }
    return gap;
  }

  const std::vector<Patch>& patches_;
  const Surroundings& around_;
  const Vec3& up_;
  const GapOptions& options_;
};

}  // namespace

std::vector<Patch> weigh_gaps(std::vector<Patch> patches,
                              const std::vector<std::vector<CutLine>>& lines,
                              const Surroundings& around, const Vec3& up,
                              const GapOptions& options) {
  const GapWeigher weigher(patches, around, up, options);
  std::vector<Weighed> weighed(patches.size());
  parallel_for(patches.size(), [&](std::size_t k) {
    if (!patches[k].hit.bits.empty()) weighed[k] = weigher.weigh(patches[k], lines[k]);
  });
  std::vector<std::vector<float>> evidence(patches.size());
  parallel_for(patches.size(), [&](std::size_t k) { evidence[k] = weigher.agree(k, weighed); });
  for (std::size_t k = 0; k < patches.size(); ++k) patches[k].evidence = std::move(evidence[k]);
  return patches;
}

}  // namespace scanworld::surface
