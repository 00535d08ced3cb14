// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "ground.h"

#include <algorithm>
#include <cmath>

#include "../parallel.h"
#include "../world/simplify.h"
#include "../world/vertex_pool.h"
#include "gaps.h"
#include "rough.h"

namespace scanworld::terrain {

namespace {

using surface::Raster;

// The ground of one storey: it grows from the largest floor, and from those that lie beside what is
// found by then. Takes them from the list, and leaves those that are over or under it.
Heights grow_storey(const SpotColumns& spots, const Level& level, std::vector<Flat>& floors,
                    const HeightOptions& options) {
  constexpr double kApart = 1;  // [m] between a floor and one under it
  Heights heights = spots.none();
  for (bool is_first = true;; is_first = false) {
    bool any = false;
    std::vector<Flat> left;
    Raster taken = heights.known;  // also by the floors of this round
    for (Flat& floor : floors) {
      std::size_t known = 0, apart = 0;
      for (const std::size_t i : floor.cells) {
        const double height = floor.height_at(level, taken.middle(i));
        known += taken.bits[i];
        apart += heights.known.bits[i] && std::abs(heights.height[i] - height) > kApart;
      }
      if (2 * apart > floor.cells.size() || (is_first && any)) {
        left.push_back(std::move(floor));
        continue;
      }
      if (20 * known > floor.cells.size()) continue;
      for (const std::size_t i : floor.cells) {
        if (taken.bits[i]) continue;
        taken.bits[i] = 1;
        const double expected = floor.height_at(level, taken.middle(i));
        if (const auto height = spots.near(i, expected, 1.5 * options.tolerance)) {
          heights.known.bits[i] = 1, heights.height[i] = *height;
          any = true;
        }
      }
    }
    floors = std::move(left);
    if (!any) return heights;
    heights = grow_ground(spots, std::move(heights), options);
  }
}

class GroundFinder {
 public:
  GroundFinder(World& world, const std::vector<Vec3>& places, const std::vector<SightLine>& lines,
               const GroundScale& scale, const GroundOptions& options)
      : world_(world),
        lines_(lines),
        tolerance_(scale.tolerance),
        options_(options),
        heights_(options.heights),
        level_(world.frame.up),
        dropped_(world.surfaces.size()) {
    constexpr double kBeyond = 30;  // [m] of all surfaces, places are strays
    const Box3 near = grown(bounds(world), kBeyond);
    for (const Vec3& p : places)
      if (near.contains(p)) spots_.push_back(level_.spot(p));
    heights_.tolerance = tolerance_;
    heights_.cell = std::max(heights_.cell, heights_.per_spacing * scale.spacing);
    heights_.reach = std::max(heights_.reach, 2 * heights_.cell);
  }

  Ground find() {
    const SpotColumns columns(spots_, heights_);
    ground_.cells = columns.none().known;
    constexpr double kWalkable = 0.9, kCeiling = -0.5;  // cosines
    flats_ = flats_of(world_, level_, ground_.cells, kWalkable, 1);
    ceilings_ = flats_of(world_, level_, ground_.cells, -1, kCeiling);
    std::vector<Flat> floors;
    for (const Flat& flat : flats_)
      if (world_.surfaces[flat.surface].kind == Kind::floor &&
          flat.cells.size() >= cells_of(options_.min_floor))
        floors.push_back(flat);
    while (!floors.empty()) {
      const Heights known = grow_storey(columns, level_, floors, heights_);
      Storey storey = uncovered(known);
      std::vector<Facet> facets = cut(storey);
      for (const bool in_parts : {true, false})
        if (drop_rough(facets, storey, in_parts)) facets = cut(storey);
      replace_floors(storey);
      cut_.push_back(std::move(facets));
    }
    drop_floors();
    for (const std::vector<Facet>& facets : cut_) add(facets);
    drop_vertices(world_);
    ground_.world = std::move(world_);
    return std::move(ground_);
  }

 private:
  // What is told of the ground of a storey.
  struct Storey {
    Heights ground;
    Raster seen;                          // where it is known from points ...
    Raster counts;                        // ... and not as the floor of a room
    Raster wanted;                        // where no floor that stays covers it ...
    Raster under;                         // ... and a little under those
    std::vector<const Flat*> fit, unfit;  // floors that stay, and that may give way

    Raster all() const {
      Raster cells = wanted;
      for (std::size_t i = 0; i < cells.bits.size(); ++i) cells.bits[i] |= under.bits[i];
      return cells;
    }
  };

  std::vector<Facet> cut(const Storey& storey) const {
    const Raster all = storey.all();
    if (std::count(all.bits.begin(), all.bits.end(), 1) == 0) return {};
    return cut_facets(storey.ground, all, storey.seen, options_.error * tolerance_);
  }

  // Leaves out what needs too many facets; false where there is nothing.
  bool drop_rough(const std::vector<Facet>& facets, Storey& storey, bool in_parts) const {
    const Raster all = storey.all();
    Raster left = without_rough(all, storey.seen, facets, options_.max_facets, in_parts);
    if (left.bits == all.bits) return false;
    left = large(left, storey.counts);
    for (std::size_t i = 0; i < left.bits.size(); ++i)
      storey.wanted.bits[i] &= left.bits[i], storey.under.bits[i] &= left.bits[i];
    return true;
  }

  // The pieces with so much of them that counts that they are ground.
  Raster large(const Raster& wanted, const Raster& counts) const {
    return large_pieces(wanted, counts, cells_of(options_.min_area), options_.min_seen);
  }

  // Floors that most of the ground takes the place of go, and others are parts of it.
  void replace_floors(const Storey& storey) {
    for (const Flat* floor : storey.unfit) {
      std::size_t all = 0, taken = 0;
      for (const std::size_t i : floor->cells)
        all += storey.seen.bits[i], taken += storey.seen.bits[i] && storey.wanted.bits[i];
      if (2 * taken > all) dropped_[floor->surface] = 1;
    }
    note_parts(storey.wanted, storey.fit);
  }

  std::size_t cells_of(double area) const {
    return static_cast<std::size_t>(area / (ground_.cells.cell * ground_.cells.cell));
  }

  // The share of a floor's cells where the ground is known that are off it by more than the
  // tolerance; 2 where it is none of this ground: where none is known, or most is far off.
  double share_off(const Flat& floor, const Heights& seen) const {
    constexpr double kNear = 0.15;  // [m]
    std::size_t count = 0, off = 0, far = 0;
    for (const std::size_t i : floor.cells) {
      if (!seen.known.bits[i]) continue;
      const double distance =
          std::abs(seen.height[i] - floor.height_at(level_, seen.known.middle(i)));
      ++count, off += distance > tolerance_, far += distance > kNear;
    }
    return count == 0 || 2 * far > count ? 2
                                         : static_cast<double>(off) / static_cast<double>(count);
  }

  // The ground of a storey that none of the floors that stay covers.
  Storey uncovered(const Heights& heights) const {
    constexpr double kRoom = 1.5;  // [m] under a ceiling
    constexpr double kSlab = 0.5;  // [m] or beside one: its upper side, or that of a roof
    const Heights seen = heights.smoothed(3, 2 * tolerance_);
    const Raster& known = seen.known;
    const int reach = std::max(1, static_cast<int>(std::lround(heights_.reach / known.cell)));
    const int margin = static_cast<int>(std::ceil(options_.margin / known.cell));
    const int beyond = static_cast<int>(std::ceil(options_.beyond / known.cell));
    Heights ground =
        filled(seen, surface::grow(surface::close(known, reach), beyond), std::max(reach, beyond));
    const Raster open = seen_through(ground, level_, lines_, 5 * tolerance_);
    for (std::size_t i = 0; i < open.bits.size(); ++i)
      if (open.bits[i] && !known.bits[i]) ground.known.bits[i] = 0;

    Storey storey{.seen = known};
    Raster covered = surface::empty_like(known);
    std::vector<double> floor_height(known.bits.size(), -1e300);
    for (const Flat& floor : flats_) {
      const double off = share_off(floor, seen);
      if (off > 1) continue;
      if (off > options_.max_off) {
        storey.unfit.push_back(&floor);
        continue;
      }
      storey.fit.push_back(&floor);
      for (const std::size_t i : floor.cells) {
        covered.bits[i] = 1;
        floor_height[i] = std::max(floor_height[i], floor.height_at(level_, known.middle(i)));
      }
    }
    ground = ground.smoothed(3, 2 * tolerance_);
    Raster wanted = ground.known;
    for (std::size_t i = 0; i < wanted.bits.size(); ++i) wanted.bits[i] &= !covered.bits[i];
    // What is seen right beside a floor may be the floor's, and rooms have floors.
    Raster counts = known;
    const Raster beside = surface::grow(covered, margin);
    for (std::size_t i = 0; i < counts.bits.size(); ++i) counts.bits[i] &= !beside.bits[i];
    for (const Flat& ceiling : ceilings_)
      for (const std::size_t i : ceiling.cells) {
        const double over = ceiling.height_at(level_, known.middle(i)) - ground.height[i];
        if (over > kRoom || std::abs(over) < kSlab) counts.bits[i] = 0;
      }
    wanted = large(wanted, counts);

    // A little goes on under the floors around; where it is over them, down to them.
    const Heights own{.known = wanted, .height = ground.height};
    const Heights under = filled(own, surface::grow(wanted, margin), margin + 2);
    storey.under = surface::empty_like(known);
    for (std::size_t i = 0; i < wanted.bits.size(); ++i)
      if (covered.bits[i] && under.known.bits[i] && !wanted.bits[i]) {
        storey.under.bits[i] = ground.known.bits[i] = 1;
        ground.height[i] = std::min(under.height[i], floor_height[i]);
      }
    storey.ground = std::move(ground), storey.wanted = std::move(wanted);
    storey.counts = std::move(counts);
    return storey;
  }

  bool is_level(const Flat& floor) const {
    double low = 1e300, high = -1e300;
    for (const std::size_t i : floor.cells) {
      const double height = floor.height_at(level_, ground_.cells.middle(i));
      low = std::min(low, height), high = std::max(high, height);
    }
    return high - low <= tolerance_;
  }

  // Floors that stay, are not level and lie beside the cells of ground are parts of it.
  void note_parts(const Raster& wanted, const std::vector<const Flat*>& floors) {
    const Raster beside = surface::grow(wanted, 1);
    for (const Flat* floor : floors) {
      const bool is_beside = std::any_of(floor->cells.begin(), floor->cells.end(),
                                         [&](std::size_t i) { return beside.bits[i] != 0; });
      if (!is_beside || is_level(*floor)) continue;
      Surface& surface = world_.surfaces[floor->surface];
      surface.ground = true, surface.kind = Kind::floor;
    }
  }

  void drop_floors() {
    std::vector<Surface> kept;
    for (std::size_t s = 0; s < dropped_.size(); ++s) {
      ground_.new_id.push_back(dropped_[s] ? -1 : static_cast<std::int32_t>(kept.size()));
      if (dropped_[s]) continue;
      kept.push_back(std::move(world_.surfaces[s]));
      kept.back().id = ground_.new_id.back();
    }
    world_.surfaces = std::move(kept);
  }

  // Adds the facets of a storey.
  void add(const std::vector<Facet>& facets) {
    std::vector<std::int32_t> id_of_cell(ground_.cells.bits.size(), -1);
    VertexPool pool(world_.vertices);
    for (const Facet& facet : facets) {
      const auto place = [&](const Vec2& p) { return level_.to_space(p, facet.height_at(p)); };
      const auto loop_of = [&](const std::vector<Vec2>& ring) {
        std::vector<Vec3> points;
        for (const Vec2& p : ring) points.push_back(place(p));
        return pool.add(points);
      };
      const int id = static_cast<int>(world_.surfaces.size());
      const Vec3 normal =
          level_.up - facet.slope.x() * level_.frame.u - facet.slope.y() * level_.frame.v;
      Surface s{.id = id,
                .kind = Kind::floor,
                .source = facet.seen > 0 ? Source::measured : Source::inferred,
                .plane = plane_through(place(facet.rings[0][0]), normal.normalized()),
                .outer = loop_of(facet.rings[0]),
                .ground = true};
      if (s.outer.size() < 3) continue;
      for (std::size_t k = 1; k < facet.rings.size(); ++k)
        s.holes.push_back(loop_of(facet.rings[k]));
      if (facet.seen > 0)
        s.support.coverage =
            static_cast<double>(facet.seen) / static_cast<double>(facet.cells.size());
      for (const std::size_t i : facet.cells) id_of_cell[i] = id;
      world_.surfaces.push_back(std::move(s));
      ++ground_.facets;
    }
    ground_.id_of_cell.push_back(std::move(id_of_cell));
  }

  World& world_;
  const std::vector<SightLine>& lines_;
  const double tolerance_;
  const GroundOptions options_;
  HeightOptions heights_;
  const Level level_;
  std::vector<Spot> spots_;
  std::vector<Flat> flats_;  // all that can be walked on, the largest first
  std::vector<Flat> ceilings_;
  std::vector<std::uint8_t> dropped_;  // surfaces
  std::vector<std::vector<Facet>> cut_;
  Ground ground_;
};

}  // namespace

Ground find_ground(World world, const std::vector<Vec3>& places,
                   const std::vector<SightLine>& lines, const GroundScale& scale,
                   const GroundOptions& options) {
  return GroundFinder(world, places, lines, scale, options).find();
}

std::vector<std::int32_t> label_ground(const CloudInWorld& cloud, std::vector<std::int32_t> labels,
                                       double tolerance, Ground& ground) {
  if (ground.facets == 0) return labels;
  std::vector<Surface>& surfaces = ground.world.surfaces;
  const auto first = static_cast<std::int32_t>(surfaces.size() - ground.facets);
  const Level level(ground.world.frame.up);
  const auto facet_at = [&](const Vec3& p) {
    if (const auto at = ground.cells.find(level.frame.to_plane(p)))
      for (const std::vector<std::int32_t>& ids : ground.id_of_cell)
        if (const std::int32_t id = ids[*at];
            id >= 0 &&
            std::abs(surfaces[static_cast<std::size_t>(id)].plane.signed_distance(p)) <= tolerance)
          return id;
    return -1;
  };
  constexpr std::size_t kPart = 1 << 14;
  parallel_for(part_count(labels.size(), kPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, labels.size(), kPart);
    for (std::size_t i = begin; i < end; ++i)
      if (labels[i] < 0) labels[i] = facet_at(cloud.point(i));
  });
  // Sums of whole numbers, so that the order of the points does not matter.
  constexpr double kUnit = 1e-6;  // [m]
  std::vector<std::int64_t> squares(surfaces.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < first) continue;
    Surface& s = surfaces[static_cast<std::size_t>(labels[i])];
    const auto off = std::llround(s.plane.signed_distance(cloud.point(i)) / kUnit);
    ++s.support.points, squares[static_cast<std::size_t>(labels[i])] += off * off;
  }
  for (Surface& s : surfaces)
    if (s.id >= first && s.support.points > 0)
      s.support.rms =
          kUnit * std::sqrt(static_cast<double>(squares[static_cast<std::size_t>(s.id)]) /
                            static_cast<double>(s.support.points));
  return labels;
}

OptionList list_options(GroundOptions& o) {
  return {
      {"ground.on", &o.is_on, "", "whether ground that no plane fits is found"},
      {"ground.cell", &o.heights.cell, "m", "edge of the cells that have a height each", 0.01},
      {"ground.per_spacing", &o.heights.per_spacing, "",
       "and at least so many times the spacing of the scan", 0},
      {"ground.turn", &o.heights.turn, "",
       "ground turns by no more for each metre to what is known of it", 0},
      {"ground.reach", &o.heights.reach, "m",
       "gaps in what is seen of it are closed up to twice this", 0},
      {"ground.min_area", &o.min_area, "m2", "that was seen of ground that no floor fits", 0},
      {"ground.min_seen", &o.min_seen, "", "share of such ground that was seen", 0, 1},
      {"ground.max_facets", &o.max_facets, "1/m2",
       "of a piece of it; stairs and heaps need more, and are none", 0},
      {"ground.min_floor", &o.min_floor, "m2", "of a floor that ground goes on from", 0},
      {"ground.max_off", &o.max_off, "",
       "share of a floor's cells off the ground; a floor with more is none", 0, 1},
      {"ground.error", &o.error, "floor_tolerance", "facets are off the ground by no more", 0.01},
      {"ground.margin", &o.margin, "m", "ground goes on so far under the floors beside it", 0},
      {"ground.beyond", &o.beyond, "m", "and so far beyond what is seen of it", 0},
  };
}

}  // namespace scanworld::terrain
