// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "evidence.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "../parallel.h"

namespace scanworld::space {

namespace {

constexpr int kMostPlaces = 4000;     // that a facet is looked at
constexpr double kMostExtended = 10;  // the highest weight of what is extended
constexpr double kGrowth = 3;         // of that weight, for each size of what has points
constexpr double kAboutLevel = 0.7;   // cosine of a normal to up
constexpr double kGrain = 1e-6;       // [m2] rays are summed in whole ones: in any order the same

std::uint64_t key_of(int from, int to) {
  return static_cast<std::uint64_t>(static_cast<std::uint32_t>(from)) << 32 |
         static_cast<std::uint32_t>(to);
}

// What a plane with points says at places of it.
struct Speaker {
  const Cover* cover;
  bool is_flipped;
};

// How far a place is from a plane's points, 1 at a metre; beyond, against their extent.
double extension_at(const Cover& cover, const Vec2& p) {
  const auto at = cover.supported.find(p);
  if (at && cover.distance[*at] >= Cover::kBlocked) return kMostExtended;
  const Vec2 low = cover.supported.low, high = cover.supported.high();
  const double distance = at ? static_cast<double>(cover.distance[*at])
                             : cover.reach + (p - p.cwiseMax(low).cwiseMin(high)).norm();
  const double size = std::max(std::sqrt(cover.area), 0.1);
  // At 1 m as far as 1, or sooner where what has points is small; then three times as fast.
  const double near = std::min(1.0, size);
  return std::min(distance < near ? distance / near : 1 + kGrowth * (distance - near) / size,
                  kMostExtended);
}

// The convex polygon of a facet in a frame.
std::vector<Vec2> flatten(const CellComplex& cells, const CellFacet& facet,
                          const PlaneFrame& frame) {
  std::vector<Vec2> polygon;
  for (const int v : facet.vertices) polygon.push_back(frame.to_plane(cells.vertex(v)));
  return polygon;
}

// Where a row at this height crosses a convex polygon.
std::optional<std::pair<double, double>> row_of(const std::vector<Vec2>& polygon, double y) {
  double low = 1e300, high = -1e300;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if ((a.y() > y) == (b.y() > y)) continue;
    const double x = a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y());
    low = std::min(low, x), high = std::max(high, x);
  }
  if (low > high) return std::nullopt;
  return std::pair{low, high};
}

// Calls visit(place) for places of a convex polygon, on the raster with this corner and step.
template <typename Visit>
void visit_places(const std::vector<Vec2>& polygon, const Vec2& corner, double step,
                  const Visit& visit) {
  double low = 1e300, high = -1e300;
  for (const Vec2& p : polygon) low = std::min(low, p.y()), high = std::max(high, p.y());
  for (double row = std::ceil((low - corner.y()) / step - 0.5);; ++row) {
    const double y = corner.y() + (row + 0.5) * step;
    if (y > high) break;
    const auto range = row_of(polygon, y);
    if (!range) continue;
    for (double column = std::ceil((range->first - corner.x()) / step - 0.5);; ++column) {
      const double x = corner.x() + (column + 0.5) * step;
      if (x > range->second) break;
      visit(Vec2(x, y));
    }
  }
}

FacetEvidence ask(const CellComplex& cells, const CellFacet& facet,
                  const std::vector<Speaker>& speakers) {
  FacetEvidence e{.area = cells.area_of(facet)};
  if (speakers.empty()) return e;
  e.is_bare = false;
  const Cover& first = *speakers[0].cover;
  const std::vector<Vec2> polygon = flatten(cells, facet, first.frame);
  const double step = std::max(first.supported.cell, std::sqrt(e.area / kMostPlaces));
  int count = 0;
  std::array<double, 2> supported{};
  double empty = 0, extended = 0;
  const auto look = [&](const Vec2& p) {
    ++count;
    // Of planes that do not go on so far none says whether points should be there.
    std::optional<double> least_empty;
    double least_extended = kMostExtended;
    bool is_met = false;
    for (const Speaker& s : speakers) {
      const Vec2 q = &s == &speakers[0] ? p : s.cover->frame.to_plane(first.frame.to_space(p));
      const auto at = s.cover->supported.find(q);
      if (at && s.cover->supported.bits[*at]) {
        supported[s.is_flipped] += 1, is_met = true;
        continue;
      }
      if (at && s.cover->distance[*at] <= s.cover->reach)
        least_empty = std::min(least_empty.value_or(1), static_cast<double>(s.cover->empty[*at]));
      least_extended = std::min(least_extended, extension_at(*s.cover, q));
    }
    if (is_met) return;
    empty += least_empty.value_or(0);
    extended += (1 - least_empty.value_or(0)) * least_extended;
  };
  visit_places(polygon, first.supported.low, step, look);
  if (count == 0) {
    Vec2 middle = Vec2::Zero();
    for (const Vec2& p : polygon) middle += p / static_cast<double>(polygon.size());
    look(middle);
  }
  const double each = e.area / count;
  e.supported = {supported[0] * each, supported[1] * each};
  e.empty = empty * each, e.extended = extended * each;
  return e;
}

// Whether the floor of a room goes on below a facet.
bool is_over_floor(const CellComplex& cells, const CellFacet& facet,
                   const std::vector<const Cover*>& floors) {
  constexpr double kLowest = 0.2, kHighest = 4;  // [m] below, the floor is near
  const Vec3 middle = cells.middle_of(facet);
  return std::any_of(floors.begin(), floors.end(), [&](const Cover* floor) {
    const double height = floor->plane.signed_distance(middle);
    const auto at = floor->supported.find(floor->frame.to_plane(middle));
    return height > kLowest && height < kHighest && at && floor->distance[*at] <= floor->reach;
  });
}

// Sums of rays, exact whatever their order.
struct RaySums {
  std::unordered_map<std::uint64_t, std::int64_t> passages;
  std::unordered_map<int, std::int64_t> crossed, start;
  std::vector<int> viewpoints;

  void add(const RaySums& more) {
    for (const auto& [key, w] : more.passages) passages[key] += w;
    for (const auto& [cell, w] : more.crossed) crossed[cell] += w;
    for (const auto& [cell, w] : more.start) start[cell] += w;
    viewpoints.insert(viewpoints.end(), more.viewpoints.begin(), more.viewpoints.end());
  }
};

void follow(const CellComplex& cells, const Ray& ray, int own, RaySums& sums) {
  const auto weight = static_cast<std::int64_t>(std::llround(ray.weight / kGrain));
  int last = -1;
  cells.walk(ray.from, ray.to, own, [&](int cell, double, double, int) {
    if (last >= 0)
      sums.passages[key_of(last, cell)] += weight;
    else if (ray.from_viewpoint)
      sums.viewpoints.push_back(cell);
    else
      sums.start[cell] += weight;
    sums.crossed[cell] += weight;
    last = cell;
    return true;
  });
}

RaySums follow_all(const CellComplex& cells, const std::vector<Ray>& rays,
                   const std::vector<int>& plane_of_patch) {
  constexpr std::size_t kPart = 1 << 13;
  std::vector<RaySums> sums(part_count(rays.size(), kPart));
  parallel_for(sums.size(), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, rays.size(), kPart);
    for (std::size_t i = begin; i < end; ++i)
      follow(cells, rays[i],
             rays[i].own < 0 ? -1 : plane_of_patch[static_cast<std::size_t>(rays[i].own)],
             sums[part]);
    std::sort(sums[part].viewpoints.begin(), sums[part].viewpoints.end());
    const auto same = std::unique(sums[part].viewpoints.begin(), sums[part].viewpoints.end());
    sums[part].viewpoints.erase(same, sums[part].viewpoints.end());
  });
  RaySums all;
  for (const RaySums& some : sums) all.add(some);
  return all;
}

}  // namespace

Evidence find_evidence(const Arrangement& arrangement, const std::vector<SpacePlane>& planes,
                       const std::vector<Cover>& covers, const std::vector<Ray>& rays,
                       const Vec3& up) {
  const CellComplex& cells = arrangement.cells;
  std::vector<std::vector<Speaker>> speakers(arrangement.parts.size());
  std::vector<int> plane_of_patch(covers.size(), -1);
  std::vector<std::optional<std::size_t>> back_side(arrangement.parts.size());
  for (std::size_t plane = 0; plane < arrangement.parts.size(); ++plane)
    for (const Arrangement::Part& part : arrangement.parts[plane]) {
      const SpacePlane& p = planes[static_cast<std::size_t>(part.plane)];
      if (p.kind == SpacePlane::Kind::back) back_side[plane] = part.is_flipped ? 1 : 0;
      if (p.kind != SpacePlane::Kind::surface) continue;
      const auto patch = static_cast<std::size_t>(p.patch);
      speakers[plane].push_back({&covers[patch], part.is_flipped});
      plane_of_patch[patch] = static_cast<int>(plane);
    }
  std::vector<const Cover*> floors;
  for (const Cover& cover : covers)
    if (cover.is_room_floor) floors.push_back(&cover);
  Evidence evidence;
  evidence.facets.resize(cells.facets().size());
  parallel_for(evidence.facets.size(), [&](std::size_t f) {
    const CellFacet& facet = cells.facets()[f];
    const std::vector<Speaker>& own = speakers[static_cast<std::size_t>(facet.plane)];
    evidence.facets[f] = ask(cells, facet, own);
    const double rise = cells.plane(facet.plane).normal.dot(up);
    if (std::abs(rise) > kAboutLevel && is_over_floor(cells, facet, floors))
      evidence.facets[f].over_floor = rise > 0 ? 0 : 1;
    for (const Speaker& s : own)
      if (s.cover->plane.normal.dot(up) > kLevelCosine) evidence.facets[f].floor = s.is_flipped;
  });
  evidence.cells.resize(cells.cells().size());
  for (std::size_t f = 0; f < evidence.facets.size(); ++f)
    for (const std::size_t side : {0, 1}) {
      const int c = cells.facets()[f].cells[side];
      if (c < 0) continue;
      CellEvidence& cell = evidence.cells[static_cast<std::size_t>(c)];
      cell.front += evidence.facets[f].supported[side];
      cell.back += evidence.facets[f].supported[1 - side];
      cell.around += evidence.facets[f].area;
    }
  parallel_for(evidence.cells.size(), [&](std::size_t c) {
    evidence.cells[c].volume = cells.volume_of(static_cast<int>(c));
  });
  const RaySums sums = follow_all(cells, rays, plane_of_patch);
  for (const auto& [cell, w] : sums.crossed)
    evidence.cells[static_cast<std::size_t>(cell)].crossed = static_cast<double>(w) * kGrain;
  for (const auto& [cell, w] : sums.start)
    evidence.cells[static_cast<std::size_t>(cell)].start = static_cast<double>(w) * kGrain;
  for (const int cell : sums.viewpoints)
    evidence.cells[static_cast<std::size_t>(cell)].has_viewpoint = true;
  for (std::size_t f = 0; f < evidence.facets.size(); ++f) {
    const CellFacet& facet = cells.facets()[f];
    const auto side = back_side[static_cast<std::size_t>(facet.plane)];
    if (side && facet.cells[*side] >= 0)
      evidence.facets[f].is_back =
          evidence.cells[static_cast<std::size_t>(facet.cells[*side])].seen() >= 0.5;
  }
  for (const auto& [key, w] : sums.passages)
    evidence.passages.push_back({static_cast<int>(key >> 32), static_cast<int>(key & 0xffffffff),
                                 static_cast<double>(w) * kGrain});
  std::sort(evidence.passages.begin(), evidence.passages.end(),
            [](const Passage& a, const Passage& b) {
              return std::pair(a.from, a.to) < std::pair(b.from, b.to);
            });
  return evidence;
}

}  // namespace scanworld::space
