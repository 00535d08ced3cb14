// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rectangles.h"

#include <algorithm>
#include <cstdint>

#include "../polygon.h"

namespace scanworld {

namespace {

constexpr std::size_t kMaxLines = 150;    // of a grid in each direction
constexpr std::size_t kMaxWork = 400000;  // of choices, before a good cover has to do

// Values in order, those within a tolerance as the middle between them.
std::vector<double> merged(std::vector<double> values, double tolerance) {
  std::sort(values.begin(), values.end());
  std::vector<double> lines;
  for (std::size_t i = 0; i < values.size();) {
    std::size_t end = i;
    while (end < values.size() && values[end] - values[i] <= tolerance) ++end;
    lines.push_back((values[i] + values[end - 1]) / 2);
    i = end;
  }
  return lines;
}

// Whether a segment comes into a box (Liang and Barsky 1984).
bool crosses(const Rectangle& box, const Vec2& a, const Vec2& b) {
  double from = 0, to = 1;
  const Vec2 d = b - a;
  for (int k = 0; k < 2; ++k) {
    if (d[k] == 0) {
      if (a[k] <= box.min()[k] || a[k] >= box.max()[k]) return false;
      continue;
    }
    const double s = (box.min()[k] - a[k]) / d[k], t = (box.max()[k] - a[k]) / d[k];
    from = std::max(from, std::min(s, t)), to = std::min(to, std::max(s, t));
  }
  return from < to;
}

enum class GridPlace { outside, across, inside };

// Where a box is, its middle telling for one that no edge crosses.
GridPlace place_of(const Rectangle& box, const std::vector<geos::Rings>& polygons) {
  for (const geos::Rings& rings : polygons) {
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        if (crosses(box, ring[i], ring[(i + 1) % ring.size()])) return GridPlace::across;
    if (is_inside(rings, box.center())) return GridPlace::inside;
  }
  return GridPlace::outside;
}

// The plane cut into cells by the lines of all edges.
struct Grid {
  std::vector<double> x, y;         // lines
  std::vector<char> allowed, must;  // of cells, row by row

  std::size_t columns() const { return x.size() - 1; }
  std::size_t rows() const { return y.size() - 1; }
  std::size_t at(std::size_t column, std::size_t row) const { return row * columns() + column; }
};

Grid make_grid(const geos::Rings& needed, const std::vector<geos::Rings>& allowed,
               const std::vector<geos::Rings>& done, const RectangleOptions& options) {
  Grid grid;
  for (int k = 0; k < 2; ++k) {
    std::vector<double> values;
    const auto add = [&](const geos::Rings& rings) {
      for (const auto& ring : rings)
        for (const Vec2& p : ring) values.push_back(p[k]);
    };
    add(needed);
    for (const auto& rings : allowed) add(rings);
    for (const auto& rings : done) add(rings);
    (k == 0 ? grid.x : grid.y) = merged(std::move(values), options.tolerance);
  }
  if (grid.x.size() < 2 || grid.y.size() < 2 || std::max(grid.x.size(), grid.y.size()) > kMaxLines)
    return {};
  for (std::size_t r = 0; r < grid.rows(); ++r)
    for (std::size_t c = 0; c < grid.columns(); ++c) {
      Rectangle cell(Vec2(grid.x[c], grid.y[r]), Vec2(grid.x[c + 1], grid.y[r + 1]));
      const bool narrow = cell.sizes().minCoeff() < options.min_width;
      for (int k = 0; k < 2; ++k) {
        const double margin = std::min(options.tolerance, 0.45 * cell.sizes()[k]);
        cell.min()[k] += margin, cell.max()[k] -= margin;
      }
      const bool free = place_of(cell, allowed) == GridPlace::inside;
      grid.allowed.push_back(free);
      grid.must.push_back(free && !narrow && place_of(cell, {needed}) != GridPlace::outside &&
                          place_of(cell, done) != GridPlace::inside);
    }
  return grid;
}

// A rectangle of cells, and which of those that need cover it has.
struct Rect {
  std::size_t left, right, bottom, top;  // lines
  std::vector<std::uint64_t> has;
  double area;
};

// All rectangles of allowed cells that cannot grow and have something to cover.
std::vector<Rect> candidates_of(const Grid& grid, const std::vector<std::size_t>& must,
                                const std::vector<std::size_t>& index) {
  const std::size_t columns = grid.columns(), rows = grid.rows();
  std::vector<Rect> found;
  for (std::size_t bottom = 0; bottom < rows; ++bottom) {
    std::vector<char> open(columns, 1);
    for (std::size_t top = bottom + 1; top <= rows; ++top) {
      for (std::size_t c = 0; c < columns; ++c) open[c] &= grid.allowed[grid.at(c, top - 1)];
      for (std::size_t left = 0, right = 0; left < columns; left = right + 1) {
        for (right = left; right < columns && open[right]; ++right) {
        }
        if (right == left) continue;
        const auto row_is_free = [&](std::size_t row) {
          for (std::size_t c = left; c < right; ++c)
            if (!grid.allowed[grid.at(c, row)]) return false;
          return true;
        };
        if ((bottom > 0 && row_is_free(bottom - 1)) || (top < rows && row_is_free(top))) continue;
        Rect candidate{left, right, bottom, top, {}, 0};
        candidate.has.resize((must.size() + 63) / 64);
        candidate.area = (grid.x[right] - grid.x[left]) * (grid.y[top] - grid.y[bottom]);
        bool useful = false;
        for (std::size_t r = bottom; r < top; ++r)
          for (std::size_t c = left; c < right; ++c)
            if (grid.must[grid.at(c, r)]) {
              const std::size_t i = index[grid.at(c, r)];
              candidate.has[i / 64] |= std::uint64_t{1} << i % 64;
              useful = true;
            }
        if (useful) found.push_back(std::move(candidate));
      }
    }
  }
  return found;
}

// Chooses the fewest candidates that have everything (set cover): for the item that the fewest
// have, each of these is tried, deeper and deeper, as long as that takes no more than kMaxWork;
// else what the greedy choice finds.
class Choice {
 public:
  Choice(const std::vector<Rect>& candidates, const std::vector<double>& weight)
      : candidates_(candidates), weight_(weight), having_(weight.size()) {
    for (std::size_t k = 0; k < candidates.size(); ++k)
      for (std::size_t i = 0; i < weight.size(); ++i)
        if (has(k, i)) having_[i].push_back(k);
    // Large ones first: of covers that are as good, the one with the most overlap is found.
    for (auto& list : having_)
      std::stable_sort(list.begin(), list.end(), [&](std::size_t a, std::size_t b) {
        return candidates_[a].area > candidates_[b].area;
      });
  }

  std::vector<std::size_t> run() {
    std::vector<std::size_t> best = greedy();
    std::vector<int> covered(weight_.size());
    for (std::size_t depth = 1; depth < best.size() && work_ < kMaxWork; ++depth) {
      chosen_.clear();
      if (search(depth, covered)) return chosen_;
    }
    return best;
  }

 private:
  bool has(std::size_t k, std::size_t item) const {
    return candidates_[k].has[item / 64] >> item % 64 & 1;
  }

  std::vector<std::size_t> greedy() const {
    std::vector<std::size_t> chosen;
    std::vector<char> covered(weight_.size());
    while (true) {
      std::size_t best = 0;
      double most = 0;
      for (std::size_t k = 0; k < candidates_.size(); ++k) {
        double gain = 0;
        for (std::size_t i = 0; i < weight_.size(); ++i)
          if (!covered[i] && has(k, i)) gain += weight_[i];
        if (gain > most) most = gain, best = k;
      }
      if (most == 0) return chosen;
      chosen.push_back(best);
      for (std::size_t i = 0; i < weight_.size(); ++i)
        covered[i] = static_cast<char>(covered[i] | has(best, i));
    }
  }

  bool search(std::size_t depth, std::vector<int>& covered) {
    if ((work_ += weight_.size()) > kMaxWork) return false;
    const std::size_t none = weight_.size();
    std::size_t hardest = none;
    for (std::size_t i = 0; i < weight_.size(); ++i)
      if (!covered[i] && (hardest == none || having_[i].size() < having_[hardest].size()))
        hardest = i;
    if (hardest == none) return true;
    if (depth == 0) return false;
    for (std::size_t k : having_[hardest]) {
      chosen_.push_back(k);
      for (std::size_t i = 0; i < weight_.size(); ++i) covered[i] += has(k, i);
      if (search(depth - 1, covered)) return true;
      for (std::size_t i = 0; i < weight_.size(); ++i) covered[i] -= has(k, i);
      chosen_.pop_back();
    }
    return false;
  }

  const std::vector<Rect>& candidates_;
  const std::vector<double>& weight_;
  std::vector<std::vector<std::size_t>> having_;  // of each item the candidates
  std::vector<std::size_t> chosen_;
  std::size_t work_ = 0;
};

}  // namespace

geos::Rings rings_of(const Rectangle& r) {
  return {{r.min(), {r.max().x(), r.min().y()}, r.max(), {r.min().x(), r.max().y()}}};
}

std::vector<Rectangle> cover_with_rectangles(const geos::Rings& needed,
                                             const std::vector<geos::Rings>& allowed,
                                             const std::vector<geos::Rings>& done,
                                             const RectangleOptions& options) {
  const Grid grid = make_grid(needed, allowed, done, options);
  std::vector<std::size_t> must, index(grid.must.size());
  std::vector<double> weight;
  for (std::size_t i = 0; i < grid.must.size(); ++i)
    if (grid.must[i]) {
      index[i] = must.size();
      must.push_back(i);
      const std::size_t c = i % grid.columns(), r = i / grid.columns();
      weight.push_back((grid.x[c + 1] - grid.x[c]) * (grid.y[r + 1] - grid.y[r]));
    }
  std::vector<Rectangle> rectangles;
  if (must.empty()) return rectangles;
  const std::vector<Rect> candidates = candidates_of(grid, must, index);
  for (std::size_t k : Choice(candidates, weight).run()) {
    const Rect& c = candidates[k];
    rectangles.emplace_back(Vec2(grid.x[c.left], grid.y[c.bottom]),
                            Vec2(grid.x[c.right], grid.y[c.top]));
  }
  return rectangles;
}

}  // namespace scanworld
