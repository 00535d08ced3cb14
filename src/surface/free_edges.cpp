// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "free_edges.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "../polygon.h"
#include "../quantile.h"
#include "raster_outlines.h"

namespace scanworld::surface {

namespace {

constexpr double kPi = 3.14159265358979323846;

struct EdgePiece {
  Vec2 from, to, outward;  // unit vector
  double offset = 0;       // outward . x on it
  bool is_square = false;  // parallel or square to a seam

  double length() const { return (to - from).norm(); }
};

class EdgeFinder {
 public:
  EdgeFinder(const Patch& patch, const std::vector<CutLine>& lines, const FreeEdgeOptions& options)
      : patch_(patch), options_(options) {
    for (const CutLine& l : lines) {
      const Vec2 direction(l.line.direction.dot(patch.frame.u),
                           l.line.direction.dot(patch.frame.v));
      angles_.push_back(std::atan2(direction.y(), direction.x()));
      lines_.push_back({patch.frame.to_plane(l.line.at(0)), direction, l.seen});
    }
  }

  std::vector<EdgePiece> find() {
    for (const std::vector<Vec2>& loop : trace_raster(patch_.covered)) add_loop(loop);
    return std::move(pieces_);
  }

 private:
  struct Line {
    Vec2 origin, direction;
    std::vector<Interval> seen;
  };

  bool is_explained(const Vec2& p) const {
    const double reach = options_.near_seam * patch_.covered.cell;
    return std::any_of(lines_.begin(), lines_.end(), [&](const Line& line) {
      const Vec2 to = p - line.origin;
      if (std::abs(line.direction.x() * to.y() - line.direction.y() * to.x()) > reach) return false;
      const double t = line.direction.dot(to);
      return std::any_of(line.seen.begin(), line.seen.end(), [&](const Interval& i) {
        return t > i.low - reach && t < i.high + reach;
      });
    });
  }

  void add_loop(const std::vector<Vec2>& loop) {
    const std::size_t n = loop.size();
    std::vector<char> explained(n);
    for (std::size_t i = 0; i < n; ++i) explained[i] = is_explained(loop[i]);
    const auto first = std::find(explained.begin(), explained.end(), 1) - explained.begin();
    std::vector<Vec2> run;
    if (static_cast<std::size_t>(first) == n) return add_run(around(loop));
    for (std::size_t k = 0; k <= n; ++k) {
      const std::size_t i = (static_cast<std::size_t>(first) + k) % n;
      if (!explained[i]) {
        run.push_back(loop[i]);
      } else {
        if (run.size() > 1) add_run(run);
        run.clear();
      }
    }
  }

  void add_run(const std::vector<Vec2>& run) {
    const std::vector<std::size_t> ends =
        straight_ends(run, options_.tolerance * patch_.covered.cell);
    std::vector<EdgePiece> pieces;
    for (std::size_t k = 1; k < ends.size(); ++k)
      pieces.push_back(piece_of({run.begin() + static_cast<std::ptrdiff_t>(ends[k - 1]),
                                 run.begin() + static_cast<std::ptrdiff_t>(ends[k]) + 1}));
    pieces = with_corners(std::move(pieces), run.front() == run.back());
    for (const EdgePiece& p : pieces)
      if (p.length() >= options_.min_length) pieces_.push_back(p);
  }

  bool is_straight(const EdgePiece& p) const {
    return p.is_square && p.length() >= options_.min_length;
  }

  // Where the outline cuts the corner of an opening between two square pieces, these go on to it
  // instead: between the points of a sparse scan it looks cut off.
  std::vector<EdgePiece> with_corners(std::vector<EdgePiece> pieces, bool is_closed) const {
    const std::size_t n = pieces.size();
    std::vector<char> drop(n);
    for (std::size_t a = 0; a < n; ++a) {
      if (!is_straight(pieces[a])) continue;
      std::size_t b = a + 1;
      while (b < a + n && !is_straight(pieces[b % n])) ++b;
      if (b >= a + n || (b >= n && !is_closed)) continue;
      EdgePiece &before = pieces[a], &after = pieces[b % n];
      if ((after.from - before.to).norm() > options_.max_chamfer ||
          before.outward.x() * after.outward.y() - before.outward.y() * after.outward.x() > -0.99)
        continue;
      Eigen::Matrix2d normals;
      normals << before.outward.transpose(), after.outward.transpose();
      const Vec2 corner = normals.inverse() * Vec2(before.offset, after.offset);
      if ((corner - before.to).norm() > options_.max_chamfer ||
          (corner - after.from).norm() > options_.max_chamfer)
        continue;
      for (std::size_t k = a + 1; k < b; ++k) {
        drop[k % n] = 1;
        if (pieces[k % n].length() >= options_.min_length) before.to = after.from = corner;
      }
    }
    std::vector<EdgePiece> kept;
    for (std::size_t k = 0; k < n; ++k)
      if (!drop[k]) kept.push_back(pieces[k]);
    return kept;
  }

  EdgePiece piece_of(const std::vector<Vec2>& points) const {
    Vec2 mean = Vec2::Zero();
    for (const Vec2& p : points) mean += p;
    mean /= static_cast<double>(points.size());
    const double angle = principal_angle(points);
    const std::optional<double> snapped = snap(angle);
    const double turned = snapped.value_or(angle);
    Vec2 along(std::cos(turned), std::sin(turned));
    if (along.dot(points.back() - points.front()) < 0) along = -along;
    // The patch lies to the left.
    const Vec2 outward(along.y(), -along.x());
    const auto on_line = [&](const Vec2& p) -> Vec2 { return p + outward * outward.dot(mean - p); };
    return {on_line(points.front()), on_line(points.back()), outward, outward.dot(mean),
            snapped.has_value()};
  }

  // The nearest of the seams' angles and those square to them, if one is near.
  std::optional<double> snap(double angle) const {
    std::optional<double> best;
    double least = options_.snap_angle;
    for (double a : angles_) {
      const double turn = std::remainder(angle - a, kPi / 2);
      if (std::abs(turn) < least) least = std::abs(turn), best = angle - turn;
    }
    return best;
  }

  const Patch& patch_;
  const FreeEdgeOptions& options_;
  std::vector<Line> lines_;
  std::vector<double> angles_;
  std::vector<EdgePiece> pieces_;
};

// The pieces near each square of 8 x 8 cells.
class NearPieces {
 public:
  NearPieces(const Raster& raster, const std::vector<EdgePiece>& pieces, double reach)
      : low_(raster.low),
        square_(8 * raster.cell),
        width_(raster.width / 8 + 1),
        height_(raster.height / 8 + 1),
        lists_(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_)) {
    const double around = reach + square_;  // more than half a square's diagonal
    for (std::size_t k = 0; k < pieces.size(); ++k) {
      const EdgePiece& p = pieces[k];
      const Vec2 low = ((p.from.cwiseMin(p.to).array() - reach).matrix() - low_) / square_,
                 high = ((p.from.cwiseMax(p.to).array() + reach).matrix() - low_) / square_;
      for (int y = std::max(0, static_cast<int>(low.y()));
           y <= std::min(height_ - 1, static_cast<int>(high.y())); ++y)
        for (int x = std::max(0, static_cast<int>(low.x()));
             x <= std::min(width_ - 1, static_cast<int>(high.x())); ++x) {
          const Vec2 middle = low_ + square_ * Vec2(x + 0.5, y + 0.5);
          if (std::abs(p.outward.dot(middle) - p.offset) < around)
            lists_[index(x, y)].push_back(static_cast<std::uint32_t>(k));
        }
    }
  }

  const std::vector<std::uint32_t>& at(const Vec2& p) const {
    const Vec2 q = (p - low_) / square_;
    return lists_[index(static_cast<int>(q.x()), static_cast<int>(q.y()))];
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }

  Vec2 low_;
  double square_;
  int width_, height_;
  std::vector<std::vector<std::uint32_t>> lists_;
};

// Moves pieces to where the points end: along each the outermost points of bins two cells wide; the
// median of their places is as far from the edge as points of this density leave it (the first of a
// Poisson process).
void refine(const PointCloud& cloud, std::span<const std::uint32_t> members, const Patch& patch,
            std::vector<EdgePiece>& pieces) {
  const double reach = 2.5 * patch.covered.cell, width = 2 * patch.covered.cell;
  struct Bins {
    std::vector<double> farthest;
    std::size_t points = 0;
  };
  std::vector<Bins> bins;
  for (const EdgePiece& p : pieces)
    bins.push_back(
        {std::vector<double>(
             std::max<std::size_t>(1, static_cast<std::size_t>((p.to - p.from).norm() / width)),
             -1e9),
         0});
  const NearPieces near(patch.covered, pieces, reach);
  for (std::uint32_t i : members) {
    const Vec2 q = patch.frame.to_plane(cloud.points[i].cast<double>());
    for (std::uint32_t k : near.at(q)) {
      const EdgePiece& p = pieces[k];
      const double off = p.outward.dot(q) - p.offset;
      if (std::abs(off) > reach) continue;
      const double length = (p.to - p.from).norm(), t = (p.to - p.from).dot(q - p.from) / length;
      if (t < 0 || t >= length) continue;
      const auto bin =
          static_cast<std::size_t>(t / length * static_cast<double>(bins[k].farthest.size()));
      double& farthest = bins[k].farthest[std::min(bin, bins[k].farthest.size() - 1)];
      farthest = std::max(farthest, off);
      ++bins[k].points;
    }
  }
  for (std::size_t k = 0; k < pieces.size(); ++k) {
    std::vector<double>& farthest = bins[k].farthest;
    const double middle = median(farthest);
    if (middle < -reach) continue;
    EdgePiece& p = pieces[k];
    const double length = (p.to - p.from).norm();
    const double density = static_cast<double>(bins[k].points) / (length * (middle + reach));
    const double bin = length / static_cast<double>(farthest.size());
    const double shift = std::min(middle + std::log(2.0) / (density * bin), reach);
    p.offset += shift, p.from += shift * p.outward, p.to += shift * p.outward;
  }
}

}  // namespace

std::vector<FreeEdge> find_free_edges(const PointCloud& cloud,
                                      std::span<const std::uint32_t> members, const Patch& patch,
                                      const std::vector<CutLine>& lines,
                                      const FreeEdgeOptions& options) {
  std::vector<EdgePiece> pieces = EdgeFinder(patch, lines, options).find();
  refine(cloud, members, patch, pieces);
  std::vector<FreeEdge> edges;
  for (const EdgePiece& p : pieces) {
    const Vec3 outward = p.outward.x() * patch.frame.u + p.outward.y() * patch.frame.v;
    const Vec3 from = patch.frame.to_space(p.from);
    edges.push_back({.from = from,
                     .to = patch.frame.to_space(p.to),
                     .plane = plane_through(from, outward.normalized())});
  }
  return edges;
}

}  // namespace scanworld::surface
