// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "facet_edges.h"

#include <array>
#include <cmath>
#include <map>
#include <set>

namespace scanworld::space {

namespace {

// Gives each vertex the corner that stands for it: of those nearer than `same` the first one.
std::vector<int> unite_vertices(const CellComplex& cells, const std::set<int>& vertices,
                                double same) {
  std::vector<int> corner(cells.vertex_count(), -1);
  std::map<std::array<std::int64_t, 3>, std::vector<int>> at;
  for (const int v : vertices) {
    corner[static_cast<std::size_t>(v)] = v;
    if (same <= 0) continue;
    const Vec3& p = cells.vertex(v);
    const auto here = [&](int k) { return static_cast<std::int64_t>(std::floor(p[k] / same)); };
    const std::int64_t i = here(0), j = here(1), k = here(2);
    const auto find_near = [&]() -> int {
      for (int x = -1; x <= 1; ++x)
        for (int y = -1; y <= 1; ++y)
          for (int z = -1; z <= 1; ++z) {
            const auto near = at.find({i + x, j + y, k + z});
            if (near == at.end()) continue;
            for (const int other : near->second)
              if ((cells.vertex(other) - p).norm() < same) return other;
          }
      return -1;
    };
    if (const int near = find_near(); near >= 0)
      corner[static_cast<std::size_t>(v)] = near;
    else
      at[{i, j, k}].push_back(v);
  }
  return corner;
}

}  // namespace

FacetEdges::FacetEdges(const CellComplex& cells, const std::vector<int>& facets, double same)
    : cells_(cells) {
  std::set<int> vertices;
  for (const int f : facets) {
    const CellFacet& own = cells.facets()[static_cast<std::size_t>(f)];
    vertices.insert(own.vertices.begin(), own.vertices.end());
    for (std::size_t i = 0; i < own.vertices.size(); ++i) {
      std::vector<int>& on = lines_[line_of(own.plane, own.edge_planes[i])];
      on.push_back(own.vertices[i]);
      on.push_back(own.vertices[(i + 1) % own.vertices.size()]);
    }
  }
  corner_ = unite_vertices(cells, vertices, same);
  for (auto& [key, on] : lines_) {
    const Vec3 way = cells.plane(static_cast<int>(key >> 32))
                         .normal.cross(cells.plane(static_cast<int>(key & 0xffffffff)).normal);
    std::sort(on.begin(), on.end());
    on.erase(std::unique(on.begin(), on.end()), on.end());
    std::stable_sort(on.begin(), on.end(), [&](int a, int b) {
      return way.dot(cells.vertex(a)) < way.dot(cells.vertex(b));
    });
  }
}

}  // namespace scanworld::space
