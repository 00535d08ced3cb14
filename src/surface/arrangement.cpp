// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "arrangement.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "../disjoint_sets.h"

namespace scanworld::surface {

namespace {

constexpr double kSame = 1e-4;      // [m] points nearer than this are one
constexpr double kMinChord = 0.01;  // [m] of a cell that a line's reach runs through

struct Line2 {
  Vec2 origin, direction;
  double t0 = 0;  // of the origin, as in Line3
  Interval reach;
  bool is_seam = false;

  double off(const Vec2& p) const {
    const Vec2 to = p - origin;
    return direction.x() * to.y() - direction.y() * to.x();
  }
  double t(const Vec2& p) const { return t0 + direction.dot(p - origin); }
};

struct Face {
  std::vector<int> vertices, lines;   // line k runs from vertex k to the next
  std::vector<std::uint32_t> raster;  // cells of the raster, by their middles
};

class Arranger {
 public:
  Arranger(const Patch& patch, const std::vector<CutLine>& lines) : patch_(patch) {
    for (const CutLine& l : lines) {
      const Vec2 direction(l.line.direction.dot(patch.frame.u),
                           l.line.direction.dot(patch.frame.v));
      lines_.push_back({patch.frame.to_plane(l.line.point), direction.normalized(),
                        l.line.direction.dot(l.line.point), l.reach, l.is_seam});
    }
    unclear_.resize(patch.hit.bits.size());
    start();
    for (std::size_t k = 0; k < lines.size(); ++k) cut(static_cast<int>(k));
  }

  Arrangement finish() {
    join_vertices();
    Arrangement result;
    result.vertices = vertices_;
    for (const Face& face : faces_) result.cells.push_back(make_cell(face));
    link(result);
    return result;
  }

 private:
  void start() {
    const Raster& raster = patch_.hit;
    const Vec2 low = raster.low, high = raster.high();
    const int n = static_cast<int>(lines_.size());
    const std::array<Vec2, 4> corners = {low, Vec2(high.x(), low.y()), high,
                                         Vec2(low.x(), high.y())};
    Face face;
    for (int k = 0; k < 4; ++k) {
      const Vec2 &from = corners[static_cast<std::size_t>(k)],
                 &to = corners[static_cast<std::size_t>((k + 1) % 4)];
      lines_.push_back({from, (to - from).normalized(), 0, {}});
      vertices_.push_back(from);
      face.vertices.push_back(k), face.lines.push_back(n + k);
    }
    face.raster.resize(raster.bits.size());
    for (std::size_t i = 0; i < face.raster.size(); ++i)
      face.raster[i] = static_cast<std::uint32_t>(i);
    faces_.push_back(std::move(face));
  }

  int vertex_on(int line, const Vec2& p, const Vec2& q, double off_p, double off_q, int cutter) {
    const auto key = std::minmax(line, cutter);
    const auto [found, is_new] = crossing_.try_emplace(key, static_cast<int>(vertices_.size()));
    if (is_new) vertices_.push_back(p + (q - p) * (off_p / (off_p - off_q)));
    return found->second;
  }

  void cut(int cutter) {
    const Line2 line = lines_[static_cast<std::size_t>(cutter)];
    const std::size_t count = faces_.size();
    for (std::size_t f = 0; f < count; ++f) {
      std::vector<double> off;
      bool before = false, behind = false;
      for (int v : faces_[f].vertices) {
        off.push_back(line.off(vertices_[static_cast<std::size_t>(v)]));
        before |= off.back() > kSame, behind |= off.back() < -kSame;
      }
      if (before && behind) split(f, cutter, line, off);
    }
  }

  const Vec2& at(int vertex) const { return vertices_[static_cast<std::size_t>(vertex)]; }

  // Where the line goes in and out of a face.
  Interval chord_of(const Face& face, const Line2& line, const std::vector<double>& off) const {
    Interval chord{1e9, -1e9};
    for (std::size_t k = 0; k < off.size(); ++k) {
      const std::size_t next = (k + 1) % off.size();
      const double a = off[k], b = off[next];
      const Vec2 &from = at(face.vertices[k]), &to = at(face.vertices[next]);
      const bool is_on = std::abs(a) <= kSame;
      if (!is_on && (std::abs(b) <= kSame || (a > 0) == (b > 0))) continue;
      const double t = line.t(is_on ? from : from + (to - from) * (a / (a - b)));
      chord = {std::min(chord.low, t), std::max(chord.high, t)};
    }
    return chord;
  }

  void split(std::size_t f, int cutter, const Line2& line, const std::vector<double>& off) {
    const std::size_t n = off.size();
    const Interval chord = chord_of(faces_[f], line, off);
    if (std::min(chord.high, line.reach.high) - std::max(chord.low, line.reach.low) < kMinChord)
      return;
    Face sides[2];  // before and behind the line
    const Face face = std::move(faces_[f]);
    const auto add = [&](Face& side, int vertex, int own_line) {
      side.vertices.push_back(vertex), side.lines.push_back(own_line);
    };
    for (std::size_t k = 0; k < n; ++k) {
      const double a = off[k], b = off[(k + 1) % n];
      const int v = face.vertices[k], own = face.lines[k];
      const auto side_of = [](double o) { return o > kSame ? 0 : o < -kSame ? 1 : 2; };
      const int sa = side_of(a), sb = side_of(b);
      if (sa == 2) {
        // On the line: where the edge goes to one side, the other one goes along the line.
        add(sides[0], v, sb == 0 ? own : cutter);
        add(sides[1], v, sb == 1 ? own : cutter);
        continue;
      }
      add(sides[sa], v, own);
      if (sb == 2 || sb == sa) continue;
      const int crossing = vertex_on(own, at(v), at(face.vertices[(k + 1) % n]), a, b, cutter);
      add(sides[sa], crossing, cutter);
      add(sides[sb], crossing, own);
    }
    for (std::uint32_t cell : face.raster) {
      const double side = line.off(patch_.middle[cell]);
      sides[side > 0 ? 0 : 1].raster.push_back(cell);
      // Noise, and points of what is met there, put some beyond the line.
      if (line.is_seam && std::abs(side) < patch_.hit.cell / 2 && patch_.evidence[cell] > 0)
        unclear_[cell] = 1;
    }
    faces_[f] = std::move(sides[0]);
    faces_.push_back(std::move(sides[1]));
  }

  // Vertices at one place on a line are made one.
  void join_vertices() {
    joined_ = DisjointSets(vertices_.size());
    on_line_.resize(lines_.size());
    for (const Face& face : faces_)
      for (std::size_t k = 0; k < face.vertices.size(); ++k) {
        auto& on = on_line_[static_cast<std::size_t>(face.lines[k])];
        for (int v : {face.vertices[k], face.vertices[(k + 1) % face.vertices.size()]})
          on.push_back({lines_[static_cast<std::size_t>(face.lines[k])].t(
                            vertices_[static_cast<std::size_t>(v)]),
                        v});
      }
    for (auto& on : on_line_) {
      std::sort(on.begin(), on.end());
      for (std::size_t k = 1; k < on.size(); ++k)
        if (on[k].first - on[k - 1].first < 2 * kSame)
          joined_.unite(static_cast<std::size_t>(on[k - 1].second),
                        static_cast<std::size_t>(on[k].second));
    }
  }
  int name(int v) { return static_cast<int>(joined_.find(static_cast<std::size_t>(v))); }

  Arrangement::Cell make_cell(const Face& face) {
    Arrangement::Cell cell;
    for (std::size_t k = 0; k < face.vertices.size(); ++k) {
      const int line = face.lines[k];
      const auto& on = on_line_[static_cast<std::size_t>(line)];
      const Line2& l = lines_[static_cast<std::size_t>(line)];
      const int start = face.vertices[k], end = face.vertices[(k + 1) % face.vertices.size()];
      const int from = name(start), to = name(end);
      const double t_from = l.t(at(start)), t_to = l.t(at(end));
      std::vector<int> chain = {from};
      const auto step = [&](const std::pair<double, int>& e) {
        const int v = name(e.second);
        if (v != chain.back() && v != to) chain.push_back(v);
      };
      const double low = std::min(t_from, t_to), high = std::max(t_from, t_to);
      const auto first = std::lower_bound(on.begin(), on.end(), std::pair{low, -1});
      const auto last = std::lower_bound(on.begin(), on.end(), std::pair{high, -1});
      if (t_from < t_to)
        for (auto e = first; e != last; ++e) step(*e);
      else
        for (auto e = last; e != first; --e) step(*std::prev(e));
      if (to != chain.back()) chain.push_back(to);
      for (std::size_t i = 1; i < chain.size(); ++i)
        cell.sides.push_back({chain[i - 1], chain[i], line});
    }
    const double area = patch_.hit.cell * patch_.hit.cell;
    for (std::uint32_t i : face.raster) {
      if (unclear_[i]) continue;
      const double says = area * static_cast<double>(patch_.evidence[i]);
      (says > 0 ? cell.covered : cell.empty) += std::abs(says);
    }
    return cell;
  }

  static void link(Arrangement& arrangement) {
    std::unordered_map<std::uint64_t, int> owner;  // of the directed side from -> to
    const auto key = [](int from, int to) {
      return static_cast<std::uint64_t>(from) << 32 | static_cast<std::uint32_t>(to);
    };
    for (std::size_t c = 0; c < arrangement.cells.size(); ++c)
      for (const auto& side : arrangement.cells[c].sides)
        owner[key(side.from, side.to)] = static_cast<int>(c);
    for (auto& cell : arrangement.cells)
      for (auto& side : cell.sides)
        if (const auto at = owner.find(key(side.to, side.from)); at != owner.end())
          side.across = at->second;
  }

  const Patch& patch_;
  std::vector<Line2> lines_;
  std::vector<Vec2> vertices_;
  std::vector<Face> faces_;
  std::vector<char> unclear_;  // cells with points, so near to a seam that they are on either side
  std::map<std::pair<int, int>, int> crossing_;  // by lines
  DisjointSets joined_{0};
  std::vector<std::vector<std::pair<double, int>>> on_line_;  // t and vertex, ascending
};

}  // namespace

Arrangement arrange(const Patch& patch, const std::vector<CutLine>& lines) {
  return Arranger(patch, lines).finish();
}

}  // namespace scanworld::surface
