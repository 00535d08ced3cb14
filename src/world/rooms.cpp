// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rooms.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "../quantile.h"
#include "room_cells.h"
#include "upright.h"

namespace scanworld {

namespace {

constexpr double kMaxCells = 4e6;       // of a storey
constexpr double kMinShared = 0.25;     // [m2] or [m] of a room with a surface that bounds it
constexpr double kLeastHeadroom = 1.2;  // [m] what is lower over a floor is furniture

// The height that few ceilings over a level are below; nothing where there are none.
std::optional<double> low_ceiling(const World& world, double level, double next_level) {
  std::vector<std::pair<double, double>> ceilings;  // height, area
  double sum = 0;
  for (const Surface& s : world.surfaces) {
    if (s.kind != Kind::ceiling) continue;
    const double height = world.frame.up.dot(centroid(world, s));
    if (height < level + kLeastHeadroom || height > next_level) continue;
    ceilings.emplace_back(height, area(world, s));
    sum += ceilings.back().second;
  }
  std::sort(ceilings.begin(), ceilings.end());
  double below = 0;
  for (const auto& [height, area] : ceilings)
    if ((below += area) >= 0.1 * sum) return height;
  return std::nullopt;
}

// A room before it has its id.
struct Region {
  std::size_t cells = 0;
  Vec2 sum = Vec2::Zero();                 // of its cells' centres
  std::size_t border = 0;                  // sides of cells that other regions or none are beyond
  double walls = 0;                        // [m] that look into it
  std::map<std::size_t, double> surfaces;  // index -> [m2] or [m] in common
  std::vector<double> heights;             // [m] of its cells, from the floor to the ceiling
};

// The rooms of one storey.
class StoreyRooms {
 public:
  StoreyRooms(const World& world, const Upright& upright, const Storey& storey, double next_level,
              const RoomOptions& options)
      : world_(world), upright_(upright), options_(options), level_(storey.level) {
    Rectangle box;
    for (int f : storey.floors)
      for (const Vec3& v : upright.ring(world.surfaces[static_cast<std::size_t>(f)].outer))
        box.extend(Vec2(v.head<2>()));
    const double cell = std::max(options.cell, std::sqrt(std::max(0.0, box.volume()) / kMaxCells));
    // Where gaps are no wider than cells, nothing can be told.
    if (cell > std::max(options.cell, options.min_gap / 2)) return;
    grid_ = grid_over(box, cell);
    const auto ceiling = low_ceiling(world, level_, next_level);
    cut_ = level_ + options.cut;
    if (ceiling) cut_ = std::min(cut_, *ceiling - options.below_ceiling);
    make_regions();
    measure_regions();
  }

  // The regions that are rooms, the largest first.
  std::vector<std::size_t> rooms() const {
    std::vector<std::size_t> found;
    for (std::size_t r = 0; r < regions_.size(); ++r)
      if (is_room(regions_[r])) found.push_back(r);
    std::stable_sort(found.begin(), found.end(), [&](std::size_t a, std::size_t b) {
      return regions_[a].cells > regions_[b].cells;
    });
    return found;
  }

  Room describe(std::size_t region) const {
    const Region& r = regions_[region];
    Room room{.area = area_of(r)};
    if (2 * r.heights.size() >= r.cells) {
      room.height = median(r.heights);
      room.volume = *room.area * std::accumulate(r.heights.begin(), r.heights.end(), 0.0) /
                    static_cast<double>(r.heights.size());
    }
    for (const auto& [s, shared] : r.surfaces)
      if (shared >= kMinShared) room.surfaces.push_back(world_.surfaces[s].id);
    std::sort(room.surfaces.begin(), room.surfaces.end());
    const Vec2 middle = r.sum / static_cast<double>(r.cells);
    Vec2 center = middle;
    double least = std::numeric_limits<double>::max();
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (cells_.of[i] != static_cast<std::int32_t>(region)) continue;
      const Vec2 p = grid_.center(i);
      if (const double d = (p - middle).squaredNorm(); d < least) least = d, center = p;
    }
    const Vec3 place = upright_.turn.conjugate() * Vec3(center.x(), center.y(), level_);
    room.center = (place * 1e6).array().round() / 1e6;
    return room;
  }

  // The regions of the rooms on the back and on the front of an opening, -1 for none; nothing where
  // it is in another storey.
  std::optional<std::array<std::int32_t, 2>> sides_of(const Opening& opening) const {
    const std::vector<Vec3> ring = upright_.ring(opening.loop);
    if (grid_.size() == 0 || std::abs(foot_of(ring) - level_) > options_.step) return std::nullopt;
    const Vec2 front = front_of(opening), along(-front.y(), front.x());
    double low = std::numeric_limits<double>::max(), high = -low;
    for (const Vec3& p : ring) {
      low = std::min(low, along.dot(p.head<2>()));
      high = std::max(high, along.dot(p.head<2>()));
    }
    const double off = front.dot(ring[0].head<2>());
    std::array<std::int32_t, 2> sides{};
    for (std::size_t k = 0; k < 2; ++k) {
      std::map<std::int32_t, int> votes;
      for (const double share : {0.1, 0.3, 0.5, 0.7, 0.9})
        ++votes[first_room(along * (low + share * (high - low)) + front * off,
                           k == 0 ? Vec2(-front) : front)];
      sides[k] = std::max_element(votes.begin(), votes.end(), [](auto& a, auto& b) {
                   return a.second < b.second;
                 })->first;
    }
    return sides;
  }

  // The region of the room at an end of a way, which leads out of there in a direction; -1 where
  // there is none, nothing where the end is in another storey.
  std::optional<std::int32_t> room_at(const Vec3& end, const Vec2& out) const {
    const Vec3 place = upright_.turn * end;
    if (grid_.size() == 0 || std::abs(place.z() - level_) > options_.step) return std::nullopt;
    return first_room(place.head<2>(), out);
  }

 private:
  static double foot_of(const std::vector<Vec3>& ring) {
    double foot = std::numeric_limits<double>::max();
    for (const Vec3& p : ring) foot = std::min(foot, p.z());
    return foot;
  }

  Vec2 front_of(const Opening& opening) const {
    const Surface* s = find_surface(world_, opening.surface);
    if (!s) return Vec2::UnitX();  // no valid world
    return upright_.normals[static_cast<std::size_t>(s - world_.surfaces.data())]
        .head<2>()
        .normalized();
  }

  // Triangles of surfaces of a kind, whose middle is between two heights.
  template <typename Visit>
  void visit_cells(Kind kind, double low, double high, const Visit& visit) const {
    for (std::size_t t = 0; t < upright_.mesh.surface.size(); ++t) {
      const auto s = static_cast<std::size_t>(upright_.mesh.surface[t]);
      if (world_.surfaces[s].kind != kind) continue;
      const auto corners = upright_.corners(t);
      const double height = (corners[0].z() + corners[1].z() + corners[2].z()) / 3;
      if (height < low || height > high) continue;
      visit_covered(grid_, {corners[0].head<2>(), corners[1].head<2>(), corners[2].head<2>()},
                    [&](std::size_t i) { visit(i, s, height); });
    }
  }

  void make_regions() {
    CellMask floor(grid_.size()), walls(grid_.size());
    visit_cells(Kind::floor, level_ - options_.step, level_ + options_.step,
                [&](std::size_t i, std::size_t, double) { floor[i] = 1; });
    const auto block = [&](const std::vector<Vec2>& ring) {
      visit_touched(grid_, ring, [&](std::size_t i) { walls[i] = 1; });
    };
    cuts_ = cut_at(cut_, upright_);
    for (const WallCut& c : cuts_)
      block({c.a - kBehindFace * c.front, c.b - kBehindFace * c.front});
    for (const Opening& o : world_.openings) {
      const std::vector<Vec3> ring = upright_.ring(o.loop);
      const double foot = foot_of(ring);
      if (foot < level_ - options_.step || foot > cut_) continue;
      const Vec2 behind = -kBehindFace * front_of(o);
      for (std::size_t k = 0; k < ring.size(); ++k)
        block({ring[k].head<2>() + behind, ring[(k + 1) % ring.size()].head<2>() + behind});
    }
    CellMask free(grid_.size());
    for (std::size_t i = 0; i < free.size(); ++i) free[i] = floor[i] && !walls[i];
    const auto radius = static_cast<std::size_t>(options_.min_gap / 2 / grid_.cell);
    cells_ = find_regions(grid_, free, walls, radius);
    // Half of a cell that a wall goes through is floor: by its centre, as all others.
    grow(grid_, floor, 1, cells_);
  }

  std::int32_t region_at(const Vec2& p) const {
    const auto i = grid_.at(p);
    return i ? cells_.of[*i] : -1;
  }

  // The first room that is met on a way from the face of a wall.
  std::int32_t first_room(const Vec2& from, const Vec2& way) const {
    // Cells that the line of a slanting wall goes through may be either side's.
    for (double d = 2.5 * grid_.cell; d < options_.max_thickness + options_.min_gap;
         d += grid_.cell)
      if (const std::int32_t r = region_at(from + d * way);
          r >= 0 && is_room(regions_[static_cast<std::size_t>(r)]))
        return r;
    return -1;
  }

  void measure_regions() {
    regions_.resize(cells_.size.size());
    for (std::size_t i = 0; i < grid_.size(); ++i) {
      if (cells_.of[i] < 0) continue;
      Region& r = regions_[static_cast<std::size_t>(cells_.of[i])];
      ++r.cells;
      r.sum += grid_.center(i);
      for (const std::size_t n : {i - grid_.columns, i - 1, i + 1, i + grid_.columns})
        r.border += n >= grid_.size() || cells_.of[n] != cells_.of[i];
    }
    const double square = grid_.cell * grid_.cell;
    std::vector<double> floor(grid_.size(), std::numeric_limits<double>::lowest());
    visit_cells(Kind::floor, level_ - options_.step, level_ + options_.step,
                [&](std::size_t i, std::size_t s, double) {
                  share(i, s, square);
                  floor[i] = std::max(floor[i], height_over(i, s));
                });
    add_ceilings(floor);
    for (const WallCut& c : cuts_) {
      const double length = (c.b - c.a).norm();
      const int parts = static_cast<int>(std::ceil(length / grid_.cell));
      for (int k = 0; k < parts; ++k) {
        const Vec2 p = c.a + (c.b - c.a) * ((k + 0.5) / parts);
        auto i = grid_.at(p + 1.5 * grid_.cell * c.front);
        if (!i || cells_.of[*i] < 0) continue;
        share(*i, c.surface, length / parts);
        regions_[static_cast<std::size_t>(cells_.of[*i])].walls += length / parts;
      }
    }
  }

  void share(std::size_t cell, std::size_t surface, double amount) {
    if (const std::int32_t r = cells_.of[cell]; r >= 0)
      regions_[static_cast<std::size_t>(r)].surfaces[surface] += amount;
  }

  // The height of a surface at the middle of a cell.
  double height_over(std::size_t cell, std::size_t surface) const {
    return height_at(upright_.normals[surface], world_.surfaces[surface].plane.offset,
                     grid_.center(cell));
  }

  // The lowest ceiling over each cell, and how high that is over the floor there.
  void add_ceilings(const std::vector<double>& floor) {
    constexpr double kHighest = std::numeric_limits<double>::max();
    struct Over {
      double height = kHighest;
      std::int32_t surface = -1;
    };
    std::vector<Over> lowest(grid_.size());
    visit_cells(Kind::ceiling, level_ + kLeastHeadroom, kHighest,
                [&](std::size_t i, std::size_t s, double height) {
                  if (height < lowest[i].height) lowest[i] = {height, static_cast<std::int32_t>(s)};
                });
    for (std::size_t i = 0; i < lowest.size(); ++i) {
      if (lowest[i].surface < 0) continue;
      const auto ceiling = static_cast<std::size_t>(lowest[i].surface);
      share(i, ceiling, grid_.cell * grid_.cell);
      if (const std::int32_t r = cells_.of[i]; r >= 0)  // then it has a floor
        regions_[static_cast<std::size_t>(r)].heights.push_back(height_over(i, ceiling) - floor[i]);
    }
  }

  double area_of(const Region& r) const {
    return static_cast<double>(r.cells) * grid_.cell * grid_.cell;
  }

  bool is_room(const Region& r) const {
    return area_of(r) >= options_.min_area &&
           r.walls >= options_.min_enclosed * static_cast<double>(r.border) * grid_.cell;
  }

  const World& world_;
  const Upright& upright_;
  const RoomOptions& options_;
  const double level_;
  PlanGrid grid_;
  double cut_ = 0;  // [m] height along up
  std::vector<WallCut> cuts_;
  Regions cells_;
  std::vector<Region> regions_;
};

}  // namespace

RoomMap find_rooms(const World& world, const RoomOptions& options) {
  RoomMap map;
  const std::vector<Storey> storeys = find_storeys(world, options.storeys);
  if (storeys.empty()) return map;
  const Upright upright(world);
  map.ways = find_ways(world, upright, options.ways);
  for (std::size_t k = 0; k < storeys.size(); ++k) {
    const double next =
        k + 1 < storeys.size() ? storeys[k + 1].level : std::numeric_limits<double>::max();
    const StoreyRooms storey(world, upright, storeys[k], next, options);
    std::map<std::int32_t, int> id_of;
    for (const std::size_t region : storey.rooms()) {
      Room room = storey.describe(region);
      room.id = static_cast<int>(map.rooms.size());
      room.name = fmt::format("room_{}", room.id);
      id_of[static_cast<std::int32_t>(region)] = room.id;
      map.rooms.push_back(std::move(room));
    }
    for (const Opening& o : world.openings) {
      if (o.kind == OpeningKind::window) continue;
      const auto sides = storey.sides_of(o);
      if (!sides || !id_of.count((*sides)[0]) || !id_of.count((*sides)[1])) continue;
      const auto [a, b] = std::minmax(id_of[(*sides)[0]], id_of[(*sides)[1]]);
      if (a != b) map.doors.push_back({o.id, {a, b}});
    }
    for (Way& way : map.ways) {
      const Vec3 up = upright.turn * (way.top - way.foot);
      const Vec2 along = up.head<2>().normalized();
      for (std::size_t end = 0; end < 2; ++end)
        if (const auto region =
                storey.room_at(end == 0 ? way.foot : way.top, end == 0 ? Vec2(-along) : along);
            region && id_of.count(*region))
          way.rooms[end] = id_of[*region];
    }
  }
  return map;
}

void set_rooms(World& world, RoomMap map) {
  world.rooms = std::move(map.rooms);
  world.doors = std::move(map.doors);
  world.ways = std::move(map.ways);
}

OptionList list_options(RoomOptions& o) {
  return {
      {"rooms.storeys.min_height", &o.storeys.min_height, "m", "from one storey to the next", 0.5},
      {"rooms.storeys.min_area", &o.storeys.min_area, "m2", "of a storey's largest floor", 0},
      {"rooms.cell", &o.cell, "m", "edge of the cells that rooms are found in", 0.01},
      {"rooms.cut", &o.cut, "m", "over the floor, where walls are looked for", 0.1},
      {"rooms.below_ceiling", &o.below_ceiling, "m",
       "and so far below the storey's lowest ceilings", 0},
      {"rooms.step", &o.step, "m", "floors so far from a storey's level are walked on still", 0},
      {"rooms.min_gap", &o.min_gap, "m", "between walls: narrower ones lead nowhere", 0},
      {"rooms.min_area", &o.min_area, "m2", "of a room", 0},
      {"rooms.min_enclosed", &o.min_enclosed, "",
       "of a room's border that is walls which look into it", 0, 1},
      {"rooms.max_thickness", &o.max_thickness, "m", "of the walls that doors lead through", 0},
  };
}

}  // namespace scanworld
