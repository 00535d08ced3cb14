// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "check_complex.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

namespace scanworld::space {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

int sign_of(Int128 v) { return (v > 0) - (v < 0); }

// The sign of a/b - c/d, with b and d above zero: by whole parts, then by those of the turned over
// rests, as the products may not fit.
int compare(Int128 a, Int128 b, Int128 c, Int128 d) {
  const auto floor_of = [](Int128 x, Int128 y) { return x / y - (x % y < 0); };
  const Int128 p = floor_of(a, b), q = floor_of(c, d);
  if (p != q) return sign_of(p - q);
  const Int128 rest_a = a - p * b, rest_c = c - q * d;
  if (rest_a == 0 || rest_c == 0) return sign_of(rest_a) - sign_of(rest_c);
  return compare(d, rest_c, b, rest_a);
}

// A line in whole numbers: the direction, and the moment about zero, without a common divisor. The
// same for all pairs of planes that meet in it.
using Line = std::array<Int128, 6>;

Line line_of(const ExactPlane& p, const ExactPlane& q) {
  const auto minor = [](std::int64_t a, std::int64_t b, std::int64_t c, std::int64_t d) {
    return Int128(a) * d - Int128(b) * c;
  };
  Line line = {minor(p.b, p.c, q.b, q.c), minor(p.c, p.a, q.c, q.a), minor(p.a, p.b, q.a, q.b),
               minor(p.a, p.d, q.a, q.d), minor(p.b, p.d, q.b, q.d), minor(p.c, p.d, q.c, q.d)};
  Int128 divisor = 0, first = 0;
  for (const Int128 v : line) {
    if (first == 0) first = v;
    for (Int128 b = v < 0 ? -v : v; b != 0;) std::swap(divisor %= b, b);
  }
  if (first < 0) divisor = -divisor;
  for (Int128& v : line) v /= divisor;
  return line;
}

std::int64_t determinant(const ExactPlane& p, const ExactPlane& q, const ExactPlane& r) {
  return p.a * (q.b * r.c - q.c * r.b) + p.b * (q.c * r.a - q.a * r.c) +
         p.c * (q.a * r.b - q.b * r.a);
}

class Checker {
 public:
  explicit Checker(const CellComplex& complex) : complex_(complex) {}

  std::vector<std::string> run() {
    for (std::size_t f = 0; f < complex_.facets().size(); ++f) check_facet(static_cast<int>(f));
    for (std::size_t c = 0; c < complex_.cells().size(); ++c) check_cell(static_cast<int>(c));
    check_vertices();
    check_links();
    check_volume();
    return std::move(faults_);
  }

 private:
  template <typename... Args>
  void report(fmt::format_string<Args...> format, Args&&... args) {
    faults_.push_back(fmt::format(format, std::forward<Args>(args)...));
  }

  const ExactPlane& plane(int index) const { return complex_.exact_plane(index); }
  int side(int plane_index, int vertex) const {
    return side_of(plane(plane_index), complex_.exact_vertex(vertex));
  }

  void check_facet(int index) {
    const CellFacet& facet = complex_.facets()[at(index)];
    const std::size_t count = facet.vertices.size();
    if (count < 3 || facet.edge_planes.size() != count) {
      report("facet {}: {} corners, {} edges", index, count, facet.edge_planes.size());
      return;
    }
    std::vector<int> inside(count);  // of each edge's plane, the side that the facet is on
    for (std::size_t i = 0; i < count; ++i) {
      if (side(facet.plane, facet.vertices[i]) != 0)
        report("facet {}: corner {} is not in its plane", index, i);
      const std::size_t next = (i + 1) % count;
      for (std::size_t k = 0; k < count; ++k) {
        const int s = side(facet.edge_planes[i], facet.vertices[k]);
        if (k == i || k == next) {
          if (s != 0) report("facet {}: an end of edge {} is not in its plane", index, i);
        } else if (s == 0 || s == -inside[i]) {
          report("facet {}: not strictly convex at edge {}", index, i);
        } else {
          inside[i] = s;
        }
      }
    }
    // From the edge before, an edge goes along normal x edge normal or against it, inwards.
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t last = (i + count - 1) % count;
      const std::int64_t way = determinant(plane(facet.plane), plane(facet.edge_planes[i]),
                                           plane(facet.edge_planes[last]));
      if (sign_of(way) != -inside[i] * inside[last])
        report("facet {}: not counter-clockwise at corner {}", index, i);
    }
  }

  // Which of two vertices on a line comes first.
  auto order_along(const Line& line) const {
    const int axis = line[0] != 0 ? 0 : line[1] != 0 ? 1 : 2;
    return [this, axis](int v, int w) {
      const ExactPoint &p = complex_.exact_vertex(v), &q = complex_.exact_vertex(w);
      const auto along = [axis](const ExactPoint& e) {
        return axis == 0 ? e.x : axis == 1 ? e.y : e.z;
      };
      return compare(along(p), p.w, along(q), q.w) < 0;
    };
  }

  void check_cell(int index) {
    std::set<int> corners;
    for (const int f : complex_.cells()[at(index)].facets) {
      const CellFacet& facet = complex_.facets()[at(f)];
      corners.insert(facet.vertices.begin(), facet.vertices.end());
    }
    struct Edge {
      int from, to;
    };
    std::map<Line, std::vector<Edge>> edges;  // as seen from outside
    for (const int f : complex_.cells()[at(index)].facets) {
      const CellFacet& facet = complex_.facets()[at(f)];
      const bool is_behind = facet.cells[1] == index;
      for (const int v : corners)
        if (const int s = side(facet.plane, v); is_behind ? s > 0 : s < 0)
          report("cell {}: not convex at facet {}", index, f);
      for (std::size_t i = 0; i < facet.vertices.size(); ++i) {
        Edge edge{facet.vertices[i], facet.vertices[(i + 1) % facet.vertices.size()]};
        if (!is_behind) std::swap(edge.from, edge.to);
        edges[line_of(plane(facet.plane), plane(facet.edge_planes[i]))].push_back(edge);
      }
    }
    std::size_t pieces = 0;
    for (const auto& [line, those] : edges) {
      const auto before = order_along(line);
      std::vector<int> stops;
      for (const Edge& e : those) stops.insert(stops.end(), {e.from, e.to});
      std::sort(stops.begin(), stops.end(), before);
      stops.erase(std::unique(stops.begin(), stops.end()), stops.end());
      for (std::size_t i = 1; i < stops.size(); ++i) {
        const auto covers = [&](int a, int b) {
          return !before(stops[i - 1], a) && !before(b, stops[i]);
        };
        const auto ahead =
            std::count_if(those.begin(), those.end(), [&](Edge e) { return covers(e.from, e.to); });
        const auto back =
            std::count_if(those.begin(), those.end(), [&](Edge e) { return covers(e.to, e.from); });
        if (ahead != back || ahead > 1)
          report("cell {}: {} edges one way, {} the other from vertex {} to {}", index, ahead, back,
                 stops[i - 1], stops[i]);
        pieces += ahead > 0;
      }
    }
    if (corners.size() + complex_.cells()[at(index)].facets.size() != pieces + 2)
      report("cell {}: {} corners, {} edges, {} facets", index, corners.size(), pieces,
             complex_.cells()[at(index)].facets.size());
  }

  // There is one vertex a place.
  void check_vertices() {
    std::set<std::array<Int128, 4>> seen;
    for (std::size_t v = 0; v < complex_.vertex_count(); ++v) {
      const ExactPoint& p = complex_.exact_vertex(static_cast<int>(v));
      if (!seen.insert({p.x, p.y, p.z, p.w}).second) report("vertex {} is where another is", v);
    }
  }

  // Facets and cells, cells and leaves know each other.
  void check_links() {
    std::size_t known = 0, sides = 0;
    for (std::size_t c = 0; c < complex_.cells().size(); ++c)
      for (const int f : complex_.cells()[c].facets) {
        const auto& cells = complex_.facets()[at(f)].cells;
        if ((cells[0] == static_cast<int>(c)) == (cells[1] == static_cast<int>(c)))
          report("cell {}: facet {} is not at its side", c, f);
        ++known;
      }
    for (const CellFacet& facet : complex_.facets())
      sides += (facet.cells[0] >= 0) + (facet.cells[1] >= 0);
    if (known != sides) report("cells know {} facets, facets {} cells", known, sides);
    std::vector<int> leaves(complex_.cells().size());
    for (const CellNode& node : complex_.nodes())
      if (node.plane < 0) ++leaves[at(node.cell)];
    for (std::size_t c = 0; c < leaves.size(); ++c)
      if (leaves[c] != 1) report("cell {}: {} leaves", c, leaves[c]);
  }

  void check_volume() {
    double sum = 0;
    for (std::size_t c = 0; c < complex_.cells().size(); ++c)
      sum += complex_.volume_of(static_cast<int>(c));
    Vec3 size;
    for (int axis = 0; axis < 3; ++axis)
      size[axis] = -plane(2 * axis).plane.offset - plane(2 * axis + 1).plane.offset;
    if (!(std::abs(sum - size.prod()) <= 1e-9 * size.prod()))
      report("the cells have {} m3, the box {}", sum, size.prod());
  }

  const CellComplex& complex_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<std::string> check_complex(const CellComplex& complex) {
  return Checker(complex).run();
}

}  // namespace scanworld::space
