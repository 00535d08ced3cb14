// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "slits.h"

#include <map>
#include <tuple>

#include "../disjoint_sets.h"

namespace scanworld::space {

namespace {

constexpr int kRounds = 8;         // a facet may depend on the one beside it
constexpr double kMuchLess = 0.5;  // of the open edges; what closes no more is not worth a facet

class SlitCloser {
 public:
  SlitCloser(const CellComplex& cells, const FacetEdges& edges, const std::vector<int>& shown)
      : cells_(cells), edges_(edges) {
    for (const int f : shown) count(f, 1);
  }

  bool is_narrow(const std::vector<int>& sheet, double narrow) const {
    std::map<Edge, int> own;
    double area = 0, outline = 0;
    for (const int f : sheet) {
      area += cells_.area_of(cells_.facets()[static_cast<std::size_t>(f)]);
      edges_.visit(f, [&](int a, int b) { ++own[std::minmax(a, b)]; });
    }
    for (const auto& [edge, times] : own)
      if (times == 1) outline += length_of(edge);
    return 2 * area < narrow * outline;
  }

  // Whether a facet closes edges, which it does from now on where it does.
  bool shall_show(int facet, bool is_shown) {
    double open_with = 0, open_without = 0;  // [m]
    edges_.visit(facet, [&](int a, int b) {
      const Edge edge = std::minmax(a, b);
      const int others = count_[edge] - (is_shown ? 1 : 0);
      (others % 2 == 0 ? open_with : open_without) += length_of(edge);
    });
    const bool shall = open_with < kMuchLess * open_without;
    if (shall != is_shown) count(facet, shall ? 1 : -1);
    return shall;
  }

 private:
  double length_of(const Edge& edge) const {
    return (cells_.vertex(edge.second) - cells_.vertex(edge.first)).norm();
  }
  void count(int facet, int by) {
    edges_.visit(facet, [&](int a, int b) { count_[std::minmax(a, b)] += by; });
  }

  const CellComplex& cells_;
  const FacetEdges& edges_;
  std::map<Edge, int> count_;  // of shown facets at each edge
};

}  // namespace

std::vector<std::vector<int>> find_sheets(const CellComplex& cells,
                                          const std::vector<Label>& labels, const FacetEdges& edges,
                                          const std::vector<int>& facets) {
  DisjointSets sets(facets.size());
  std::map<std::tuple<int, std::size_t, int, int>, std::size_t> at_edge;
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const CellFacet& facet = cells.facets()[static_cast<std::size_t>(facets[i])];
    edges.visit(facets[i], [&](int a, int b) {
      const auto [found, is_new] = at_edge.try_emplace(
          {facet.plane, free_side_of(facet, labels), std::min(a, b), std::max(a, b)}, i);
      if (!is_new) sets.unite(found->second, i);
    });
  }
  std::vector<std::vector<int>> sheets;
  std::vector<int> sheet_of(facets.size(), -1);
  for (std::size_t i = 0; i < facets.size(); ++i) {
    int& sheet = sheet_of[sets.find(i)];
    if (sheet < 0) {
      sheet = static_cast<int>(sheets.size());
      sheets.emplace_back();
    }
    sheets[static_cast<std::size_t>(sheet)].push_back(facets[i]);
  }
  return sheets;
}

std::vector<int> close_slits(const CellComplex& cells, const std::vector<Label>& labels,
                             const FacetEdges& edges, const FacetsBetween& facets, double narrow) {
  SlitCloser closer(cells, edges, facets.surfaces);
  struct Strip {
    int facet;
    bool is_shown;
  };
  std::vector<Strip> strips;
  std::vector<int> shown;
  // An opening may have slits beside it; a surface's border is not to be gnawed at.
  for (const int f : facets.openings)
    if (closer.is_narrow({f}, narrow)) strips.push_back({f, false});
  for (const auto& sheet : find_sheets(cells, labels, edges, facets.surfaces))
    if (closer.is_narrow(sheet, narrow))
      for (const int f : sheet) strips.push_back({f, true});
    else
      shown.insert(shown.end(), sheet.begin(), sheet.end());
  bool has_changed = true;
  for (int round = 0; round < kRounds && has_changed; ++round) {
    has_changed = false;
    for (Strip& strip : strips) {
      const bool was_shown = strip.is_shown;
      strip.is_shown = closer.shall_show(strip.facet, was_shown);
      has_changed |= strip.is_shown != was_shown;
    }
  }
  for (const Strip& strip : strips)
    if (strip.is_shown) shown.push_back(strip.facet);
  std::sort(shown.begin(), shown.end());
  return shown;
}

}  // namespace scanworld::space
