// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "label_cells.h"

#include <algorithm>
#include <cmath>

#include "../disjoint_sets.h"
#include "../min_cut.h"

namespace scanworld::space {

namespace {

constexpr double kUnit = 1e5;     // of capacities, for each m2
constexpr double kCertain = 1e4;  // [m2] that a viewpoint's cell is free

std::int64_t capacity_of(double price) {
  return static_cast<std::int64_t>(std::llround(price * kUnit));
}

class Labeller {
 public:
  Labeller(const CellComplex& cells, const Evidence& evidence, const LabelOptions& options)
      : cells_(cells), evidence_(evidence), options_(options) {}

  std::vector<Label> label() {
    // What a cell is where it is not free.
    std::vector<Label> other(cells_.cells().size(), Label::solid), labels;
    for (int round = 0; round < options_.rounds; ++round) {
      std::vector<Label> found = cut(other);
      if (found == labels) break;
      labels = std::move(found);
      other = choose_other(labels);
    }
    for (std::size_t c = 0; c < labels.size(); ++c)
      if (labels[c] != Label::free) labels[c] = other[c];
    return labels;
  }

 private:
  // The least price where each cell may be free or else what `other` says.
  std::vector<Label> cut(const std::vector<Label>& other) const {
    const int source = static_cast<int>(other.size()), sink = source + 1;
    std::vector<FlowEdge<std::int64_t>> edges;
    std::vector<double> free(other.size()), taken(other.size());
    for (std::size_t c = 0; c < other.size(); ++c) {
      const CellEvidence& e = evidence_.cells[c];
      free[c] = e.front * options_.front + e.start + (e.has_viewpoint ? kCertain : 0);
      // What has points and is before what is unknown costs as much as before what is free.
      taken[c] = (other[c] == Label::solid ? e.back * options_.back : 0) +
                 (1 - e.seen()) * e.volume * options_.volume;
    }
    for (std::size_t f = 0; f < cells_.facets().size(); ++f) {
      const CellFacet& facet = cells_.facets()[f];
      const auto price = [&](std::size_t free_side) {
        const int c = facet.cells[1 - free_side];
        return capacity_of(price_of(facet, evidence_.facets[f], free_side,
                                    other[static_cast<std::size_t>(c)], options_));
      };
      if (facet.cells[0] >= 0 && facet.cells[1] >= 0) {
        edges.push_back({facet.cells[0], facet.cells[1], price(0), price(1)});
      } else {
        const auto c = static_cast<std::size_t>(std::max(facet.cells[0], facet.cells[1]));
        taken[c] += border_price(f, c);
      }
    }
    for (const Passage& p : evidence_.passages)
      edges.push_back({p.from, p.to, capacity_of(p.weight), 0});
    for (std::size_t c = 0; c < other.size(); ++c) {
      // What is common to both does not decide.
      const std::int64_t lead = capacity_of(free[c]) - capacity_of(taken[c]);
      if (lead > 0) edges.push_back({source, static_cast<int>(c), lead, 0});
      if (lead < 0) edges.push_back({static_cast<int>(c), sink, -lead, 0});
    }
    const std::vector<char> is_free = min_cut(other.size() + 2, source, sink, edges);
    std::vector<Label> labels = other;
    for (std::size_t c = 0; c < labels.size(); ++c)
      if (is_free[c]) labels[c] = Label::free;
    return labels;
  }

  // Of a free cell at the border of all.
  double border_price(std::size_t facet, std::size_t cell) const {
    const CellEvidence& e = evidence_.cells[cell];
    return evidence_.facets[facet].area *
           std::max(options_.border_crossed, options_.border * (1 - e.seen()));
  }

  // Whether each cell is solid or unknown where it is not free, as its free neighbours would have
  // it: what is cheaper, and of equal ones unknown.
  std::vector<Label> choose_other(const std::vector<Label>& labels) const {
    std::vector<double> solid(labels.size()), unknown(labels.size());
    for (std::size_t c = 0; c < labels.size(); ++c)
      unknown[c] = options_.back * evidence_.cells[c].back;
    for (std::size_t f = 0; f < cells_.facets().size(); ++f) {
      const CellFacet& facet = cells_.facets()[f];
      for (const std::size_t side : {0, 1}) {
        const int free = facet.cells[side], c = facet.cells[1 - side];
        if (free < 0 || c < 0 || labels[static_cast<std::size_t>(free)] != Label::free) continue;
        const auto i = static_cast<std::size_t>(c);
        solid[i] += price_of(facet, evidence_.facets[f], side, Label::solid, options_);
        unknown[i] += price_of(facet, evidence_.facets[f], side, Label::unknown, options_);
      }
    }
    std::vector<Label> other(labels.size());
    for (std::size_t c = 0; c < labels.size(); ++c)
      other[c] = solid[c] < unknown[c] ? Label::solid : Label::unknown;
    return other;
  }

  const CellComplex& cells_;
  const Evidence& evidence_;
  const LabelOptions& options_;
};

}  // namespace

double price_of(const CellFacet& facet, const FacetEvidence& e, std::size_t free_side, Label other,
                const LabelOptions& options) {
  if (facet.cells[0] < 0 || facet.cells[1] < 0) return 0;
  const double right = e.supported[free_side], wrong = e.supported[1 - free_side];
  const double rest = std::max(0.0, e.area - right - wrong - e.empty);
  const double each = e.is_bare ? options.bare_facet : 0;
  if (other == Label::unknown) {
    const auto side = static_cast<int>(free_side);
    const double open = side == e.floor        ? options.open_floor
                        : side == e.over_floor ? options.open_over_floor
                        : e.is_bare            ? options.open_bare
                                               : options.open;
    return each + wrong * options.reversed + rest * open;
  }
  return each + right * options.supported + wrong * options.reversed + e.empty * options.empty +
         (e.is_bare ? rest * (e.is_back ? options.of_plate : options.bare)
                    : rest * options.beside + e.extended * options.extended);
}

std::vector<Label> fill_slits(const CellComplex& cells, const Evidence& evidence,
                              std::vector<Label> labels, const LabelOptions& options) {
  std::vector<double> solid(labels.size());  // [m2] around each cell
  for (std::size_t f = 0; f < cells.facets().size(); ++f) {
    const CellFacet& facet = cells.facets()[f];
    for (const std::size_t side : {0, 1}) {
      const int own = facet.cells[side], other = facet.cells[1 - side];
      if (own >= 0 && other >= 0 && labels[static_cast<std::size_t>(other)] == Label::solid)
        solid[static_cast<std::size_t>(own)] += evidence.facets[f].area;
    }
  }
  for (std::size_t c = 0; c < labels.size(); ++c) {
    const CellEvidence& e = evidence.cells[c];
    if (labels[c] != Label::solid && 2 * e.volume < options.slit_width * e.around &&
        solid[c] > options.slit_solid * e.around)
      labels[c] = Label::solid;
  }
  return labels;
}

std::vector<Label> fill_pockets(const CellComplex& cells, const Evidence& evidence,
                                std::vector<Label> labels, const LabelOptions& options) {
  DisjointSets sets(labels.size());
  for (const CellFacet& facet : cells.facets()) {
    if (facet.cells[0] < 0 || facet.cells[1] < 0) continue;
    const auto a = static_cast<std::size_t>(facet.cells[0]),
               b = static_cast<std::size_t>(facet.cells[1]);
    if (labels[a] == Label::free && labels[b] == Label::free) sets.unite(a, b);
  }
  std::vector<double> volume(labels.size());
  std::vector<char> has_viewpoint(labels.size());
  for (std::size_t c = 0; c < labels.size(); ++c) {
    volume[sets.find(c)] += evidence.cells[c].volume;
    has_viewpoint[sets.find(c)] |= evidence.cells[c].has_viewpoint;
  }
  for (std::size_t c = 0; c < labels.size(); ++c)
    if (labels[c] == Label::free && !has_viewpoint[sets.find(c)] &&
        volume[sets.find(c)] < options.min_volume)
      labels[c] = Label::solid;
  return labels;
}

std::vector<Label> label_cells(const CellComplex& cells, const Evidence& evidence,
                               const LabelOptions& options) {
  return Labeller(cells, evidence, options).label();
}

std::vector<Label> labels_of_surfaces(std::vector<Label> labels, Unknown unknown) {
  if (unknown == Unknown::solid)
    std::replace(labels.begin(), labels.end(), Label::unknown, Label::solid);
  if (unknown == Unknown::free)
    std::replace(labels.begin(), labels.end(), Label::unknown, Label::free);
  return labels;
}

std::vector<Label> labels_behind(std::vector<Label> labels, Unknown unknown) {
  if (unknown == Unknown::free || unknown == Unknown::open)
    std::replace(labels.begin(), labels.end(), Label::unknown, Label::free);
  return labels;
}

}  // namespace scanworld::space
