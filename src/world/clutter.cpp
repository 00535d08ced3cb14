// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "clutter.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "../disjoint_sets.h"
#include "../parallel.h"
#include "../polygon.h"
#include "../quantile.h"
#include "surface_rings.h"

namespace scanworld {

namespace {

constexpr double kReach = 1 << 19;  // [cells] points farther from the origin are not looked at

// A point by its cube: a cell's number, 20 bits an axis, then that of its eighth.
struct Entry {
  std::uint64_t key;
  std::uint32_t point;

  std::uint64_t cell() const { return key >> 3; }
  bool operator<(const Entry& o) const { return key < o.key; }
};

std::uint64_t packed(std::uint64_t x, std::uint64_t y, std::uint64_t z) {
  return z << 40 | y << 20 | x;
}

std::uint64_t key_of(const Vec3& p, double cell) {
  const Vec3 halves = (p * 2 / cell).array().floor() + 2 * kReach;
  const auto x = static_cast<std::uint64_t>(halves.x()), y = static_cast<std::uint64_t>(halves.y()),
             z = static_cast<std::uint64_t>(halves.z());
  return packed(x >> 1, y >> 1, z >> 1) << 3 | (z & 1) << 2 | (y & 1) << 1 | (x & 1);
}

// The unlabelled points, by cube.
std::vector<Entry> sort_points(const PointCloud& cloud, const std::vector<std::int32_t>& labels,
                               double cell) {
  constexpr std::size_t kPart = 1 << 14;
  const std::size_t parts = part_count(labels.size(), kPart);
  std::vector<std::vector<Entry>> found(parts);
  parallel_for(parts, [&](std::size_t part) {
    const auto [begin, end] = part_of(part, labels.size(), kPart);
    for (std::size_t i = begin; i < end; ++i) {
      if (labels[i] >= 0) continue;
      const Vec3 p = cloud.points[i].cast<double>();
      if (p.cwiseAbs().maxCoeff() < (kReach - 2) * cell)
        found[part].push_back({key_of(p, cell), static_cast<std::uint32_t>(i)});
    }
  });
  std::vector<Entry> entries;
  for (const auto& list : found) entries.insert(entries.end(), list.begin(), list.end());
  parallel_sort(entries);
  return entries;
}

struct ClutterCell {
  std::uint64_t key;
  std::size_t begin, end;  // its entries
};

std::vector<ClutterCell> cells_of(const std::vector<Entry>& entries) {
  std::vector<ClutterCell> cells;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (cells.empty() || cells.back().key != entries[i].cell())
      cells.push_back({entries[i].cell(), i, i});
    cells.back().end = i + 1;
  }
  return cells;
}

// Calls body(i, j) for all neighbours among the 26 of each cell, once for each two.
template <typename Body>
void for_each_pair(const std::vector<ClutterCell>& cells, Body body) {
  const std::uint64_t y = packed(0, 1, 0), z = packed(0, 0, 1);
  for (std::uint64_t step : {std::uint64_t{1}, y - 1, y, y + 1, z - y - 1, z - y, z - y + 1, z - 1,
                             z, z + 1, z + y - 1, z + y, z + y + 1})
    for (std::size_t i = 0, j = 0; i < cells.size(); ++i) {
      while (j < cells.size() && cells[j].key < cells[i].key + step) ++j;
      if (j < cells.size() && cells[j].key == cells[i].key + step) body(i, j);
    }
}

// How many points are in each cell and the 26 around it.
std::vector<double> count_around(const std::vector<ClutterCell>& cells) {
  std::vector<double> count(cells.size());
  const auto own = [&](std::size_t i) {
    return static_cast<double>(cells[i].end - cells[i].begin);
  };
  for (std::size_t i = 0; i < cells.size(); ++i) count[i] += own(i);
  for_each_pair(cells,
                [&](std::size_t i, std::size_t j) { count[i] += own(j), count[j] += own(i); });
  return count;
}

// Keeps the entries that keep(cell) tells, and with them the cells.
template <typename Keep>
void keep_cells(std::vector<Entry>& entries, std::vector<ClutterCell>& cells, Keep keep) {
  std::vector<Entry> kept;
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (keep(i))
      kept.insert(kept.end(), entries.begin() + static_cast<std::ptrdiff_t>(cells[i].begin),
                  entries.begin() + static_cast<std::ptrdiff_t>(cells[i].end));
  entries = std::move(kept);
  cells = cells_of(entries);
}

// A surface, to tell how far points are from it.
struct FlatSurface {
  Plane plane;
  PlaneFrame frame;
  geos::Rings rings;
  double reach;  // [m] points no farther belong to it, but for more noise in places
  Box3 box;

  // Whether a point is no farther than this.
  bool is_near(const Vec3& p, double distance) const {
    if (box.squaredExteriorDistance(p) > distance * distance ||
        std::abs(plane.signed_distance(p)) > distance)
      return false;
    const Vec2 q = frame.to_plane(p);
    if (is_inside(rings, q)) return true;
    for (const auto& ring : rings)
      for (std::size_t k = 0; k < ring.size(); ++k) {
        const Vec2 a = ring[k], way = ring[(k + 1) % ring.size()] - a;
        const double along = std::clamp(way.dot(q - a) / way.squaredNorm(), 0.0, 1.0);
        if ((a + along * way - q).squaredNorm() < distance * distance) return true;
      }
    return false;
  }
};

std::vector<FlatSurface> flatten(const World& world, const ClutterScale& scale,
                                 const ClutterOptions& options) {
  std::vector<FlatSurface> flat;
  for (const Surface& s : world.surfaces) {
    FlatSurface f{.plane = s.plane,
                  .frame = frame_of(s.plane, world.vertices[static_cast<std::size_t>(s.outer[0])]),
                  .rings = rings_of(world, s),
                  .reach = options.surface_distance * std::max(scale.noise, s.support.rms),
                  .box = {}};
    for (int v : s.outer) f.box.extend(world.vertices[static_cast<std::size_t>(v)]);
    flat.push_back(std::move(f));
  }
  return flat;
}

// Drops the points that a surface explains.
void drop_explained(const PointCloud& cloud, const std::vector<FlatSurface>& surfaces,
                    const NoiseMap& local, double surface_distance, std::vector<Entry>& entries,
                    std::vector<ClutterCell>& cells) {
  const double farthest = surface_distance * local.largest();
  constexpr std::size_t kRun = 64;  // cells that lie close together, mostly
  std::vector<char> explained(entries.size());
  parallel_for(part_count(cells.size(), kRun), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, cells.size(), kRun);
    Box3 box;
    for (std::size_t i = cells[begin].begin; i < cells[end - 1].end; ++i)
      box.extend(cloud.points[entries[i].point].cast<double>());
    std::vector<const FlatSurface*> near;
    for (const FlatSurface& s : surfaces)
      if (grown(s.box, std::max(s.reach, farthest)).intersects(box)) near.push_back(&s);
    for (std::size_t i = cells[begin].begin; i < cells[end - 1].end; ++i) {
      const Vec3 p = cloud.points[entries[i].point].cast<double>();
      const double reach = surface_distance * local.at(p);
      explained[i] = std::any_of(near.begin(), near.end(), [&](const FlatSurface* s) {
        return s->is_near(p, std::max(s->reach, reach));
      });
    }
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries.size(); ++i)
    if (!explained[i]) entries[kept++] = entries[i];
  entries.resize(kept);
  cells = cells_of(entries);
}

// For each cell the lowest of those that it is connected to.
std::vector<std::uint32_t> connect(const std::vector<ClutterCell>& cells) {
  DisjointSets sets(cells.size());
  for_each_pair(cells, [&](std::size_t i, std::size_t j) { sets.unite(i, j); });
  std::vector<std::uint32_t> root(cells.size());
  for (std::size_t i = 0; i < cells.size(); ++i) root[i] = sets.find(i);
  return root;
}

std::vector<std::vector<std::size_t>> group(const std::vector<std::uint32_t>& root) {
  std::vector<std::vector<std::size_t>> groups;
  std::vector<std::size_t> index(root.size());
  for (std::size_t i = 0; i < root.size(); ++i) {
    if (root[i] == i) index[i] = groups.size(), groups.emplace_back();
    groups[index[root[i]]].push_back(i);
  }
  return groups;
}

// Where a thing has far fewer points than in its middle, it is a curtain of points between its edge
// and what is behind.
void drop_curtains(std::vector<Entry>& entries, std::vector<ClutterCell>& cells, double share) {
  const std::vector<double> count = count_around(cells);
  std::vector<char> keep(cells.size());
  for (const auto& thing : group(connect(cells))) {
    std::vector<double> sorted;
    for (std::size_t i : thing) sorted.push_back(count[i]);
    const double middle = median(std::move(sorted));
    for (std::size_t i : thing) keep[i] = count[i] >= share * middle;
  }
  keep_cells(entries, cells, [&](std::size_t i) { return keep[i] != 0; });
}

// The means of the points in each cube, in whole micrometres so that their order does not matter.
void thin(const PointCloud& cloud, const std::vector<Entry>& entries, const ClutterCell& cell,
          std::vector<Vec3>& points) {
  for (std::size_t i = cell.begin; i < cell.end;) {
    std::array<std::int64_t, 3> sum{};
    std::size_t k = i;
    for (; k < cell.end && entries[k].key == entries[i].key; ++k)
      for (int axis = 0; axis < 3; ++axis)
        sum[static_cast<std::size_t>(axis)] +=
            std::llround(static_cast<double>(cloud.points[entries[k].point][axis]) * 1e6);
    const double scale = 1e-6 / static_cast<double>(k - i);
    points.push_back(Vec3(static_cast<double>(sum[0]), static_cast<double>(sum[1]),
                          static_cast<double>(sum[2])) *
                     scale);
    i = k;
  }
}

}  // namespace

Clutter find_clutter(const PointCloud& cloud, const std::vector<std::int32_t>& labels,
                     const World& world, const ClutterScale& scale, const ClutterOptions& options) {
  Clutter clutter;
  clutter.cell = std::max({options.min_cell, options.cell_per_spacing * scale.spacing,
                           options.cell_per_noise * scale.noise});
  std::vector<Entry> entries = sort_points(cloud, labels, clutter.cell);
  std::vector<ClutterCell> cells = cells_of(entries);
  // A surface goes through nine of the cells around one. Where a scan is dense on the whole, it may
  // not be in all places.
  const double ratio = std::min(3.0, clutter.cell / std::max(scale.spacing, 1e-6));
  const double least = 9 * options.min_density * ratio * ratio;
  const auto drop_sparse = [&] {
    const std::vector<double> count = count_around(cells);
    keep_cells(entries, cells, [&](std::size_t i) { return count[i] >= least; });
  };
  drop_sparse();
  const std::vector<FlatSurface> surfaces = flatten(world, scale, options);
  drop_explained(cloud, surfaces, scale.local, options.surface_distance, entries, cells);
  drop_sparse();
  drop_curtains(entries, cells, options.min_own_density);

  // Between what is dropped as a surface's and what is left there may be a cell without points.
  const auto touches = [&](const FlatSurface& s, const Vec3& p) {
    return s.is_near(p, s.reach + 1.5 * clutter.cell);
  };
  clutter.first.push_back(0);
  for (const auto& thing : group(connect(cells))) {
    std::size_t points = 0;
    for (std::size_t i : thing) points += cells[i].end - cells[i].begin;
    if (points < static_cast<std::size_t>(options.min_points)) continue;
    for (std::size_t i : thing) thin(cloud, entries, cells[i], clutter.points);
    Box3 box;
    for (std::size_t i = clutter.first.back(); i < clutter.points.size(); ++i)
      box.extend(clutter.points[i]);
    const auto begin = clutter.points.begin() + static_cast<std::ptrdiff_t>(clutter.first.back());
    const bool is_kept = box.sizes().maxCoeff() >= options.min_size &&
                         (points >= static_cast<std::size_t>(options.min_floating_points) ||
                          std::any_of(surfaces.begin(), surfaces.end(), [&](const FlatSurface& s) {
                            return std::any_of(begin, clutter.points.end(),
                                               [&](const Vec3& p) { return touches(s, p); });
                          }));
    if (!is_kept)
      clutter.points.resize(clutter.first.back());
    else
      clutter.first.push_back(clutter.points.size());
  }
  return clutter;
}

}  // namespace scanworld
