// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <queue>
#include <set>

#include "mesh_rays.h"
#include "robustness.h"
#include "world/solids.h"

namespace scanworld::sim {

namespace {

enum class Ground : char { unknown, floor, blocked, gap };

constexpr double kStep = 0.03;   // [m] that wheels climb or drop
constexpr double kSteep = 0.85;  // of a normal's height: steeper than 32 degrees is no floor
constexpr double kDrop = 0.15;   // [m] without ground so far down is a gap; less is a step
constexpr double kRoom = 0.1;    // [m] over the floor that must be free
constexpr std::size_t kMostCells = 40000000;

// A grid over a place, seen from above.
class Grid {
 public:
  Grid(const Box3& box, double cell) : low_(box.min()), cell_(cell) {
    const double area = box.sizes().x() * box.sizes().y();
    // Of very large places cells are larger.
    cell_ = std::max(cell_, std::sqrt(area / kMostCells));
    width_ = static_cast<int>(box.sizes().x() / cell_) + 1;
    height_ = static_cast<int>(box.sizes().y() / cell_) + 1;
    cells_.assign(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_),
                  Ground::unknown);
  }
  int width() const { return width_; }
  int height() const { return height_; }
  double cell() const { return cell_; }
  bool has(int x, int y) const { return x >= 0 && y >= 0 && x < width_ && y < height_; }
  Ground& at(int x, int y) { return cells_[index(x, y)]; }
  Ground at(int x, int y) const { return cells_[index(x, y)]; }
  Vec3 middle(int x, int y, double z) const {
    return {low_.x() + (x + 0.5) * cell_, low_.y() + (y + 0.5) * cell_, z};
  }
  std::pair<int, int> of(const Vec3& p) const {
    return {static_cast<int>((p.x() - low_.x()) / cell_),
            static_cast<int>((p.y() - low_.y()) / cell_)};
  }

 private:
  std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
           static_cast<std::size_t>(x);
  }
  Vec3 low_;
  double cell_;
  int width_, height_;
  std::vector<Ground> cells_;
};

// The solids of a place, found by where they are in plan.
class Solids {
 public:
  explicit Solids(const Place& place) {
    for (const ExportBody& body : place.solids) {
      Solid solid{{}, mesh_of(body)};
      for (const Vec3& v : solid.mesh.vertices) solid.box.extend(v);
      const auto [x0, y0] = bin_of(solid.box.min());
      const auto [x1, y1] = bin_of(solid.box.max());
      for (int x = x0; x <= x1; ++x)
        for (int y = y0; y <= y1; ++y) bins_[{x, y}].push_back(solids_.size());
      solids_.push_back(std::move(solid));
    }
  }
  Mesh mesh() const {
    Mesh all;
    for (const Solid& solid : solids_) append(all, solid.mesh);
    return all;
  }
  bool contain(const Vec3& p) const {
    const auto bin = bins_.find(bin_of(p));
    return bin != bins_.end() && std::ranges::any_of(bin->second, [&](std::size_t i) {
             return solids_[i].box.contains(p) && contains(solids_[i].mesh, p);
           });
  }

 private:
  struct Solid {
    Box3 box;
    Mesh mesh;
  };
  static std::pair<int, int> bin_of(const Vec3& p) {
    return {static_cast<int>(std::floor(p.x())), static_cast<int>(std::floor(p.y()))};
  }
  std::vector<Solid> solids_;
  std::map<std::pair<int, int>, std::vector<std::size_t>> bins_;  // of a metre
};

// The floor under a place where it is expected to be.
struct Look {
  Ground ground;
  double height = 0;  // [m] of the floor
};

// What robots touch.
struct Touched {
  explicit Touched(const Place& place)
      : solids(place), mesh(place.solids.empty() ? place.seen : solids.mesh()), rays(mesh) {}

  bool is_steep(std::size_t triangle) const {
    const Vec3 n = vector_area(mesh, triangle);
    return std::abs(n.z()) < kSteep * n.norm();
  }

  Solids solids;
  Mesh mesh;
  MeshRays rays;
};

Look look(const Touched& touched, const Vec3& floor) {
  const Vec3 above = floor + Vec3(0, 0, kRoom);
  if (touched.solids.contain(above)) return {Ground::blocked};
  const auto hit = touched.rays.cast(above, -Vec3::UnitZ(), kRoom + kDrop);
  if (!hit) return {Ground::gap};
  if (std::abs(hit->distance - kRoom) > kStep || touched.is_steep(hit->triangle))
    return {Ground::blocked};
  return {Ground::floor, floor.z() + kRoom - hit->distance};
}

struct Cell {
  int x, y;
  double height;  // [m]
};

// What can be driven to over floor from the spots.
std::vector<Cell> drivable(Grid& grid, const Spots& spots, const Touched& touched) {
  std::queue<Cell> open;
  std::vector<Cell> floor;
  const auto visit = [&](int x, int y, double height) {
    if (!grid.has(x, y) || grid.at(x, y) != Ground::unknown) return;
    const Look found = look(touched, grid.middle(x, y, height));
    if (found.ground == Ground::gap) return;  // from here; there may be a way from below
    grid.at(x, y) = found.ground;
    if (found.ground == Ground::floor) open.push({x, y, found.height});
  };
  for (const Vec3& spot : spots.floor) visit(grid.of(spot).first, grid.of(spot).second, spot.z());
  while (!open.empty()) {
    const Cell c = open.front();
    open.pop();
    floor.push_back(c);
    visit(c.x + 1, c.y, c.height), visit(c.x - 1, c.y, c.height);
    visit(c.x, c.y + 1, c.height), visit(c.x, c.y - 1, c.height);
  }
  return floor;
}

using GapCells = std::set<std::pair<int, int>>;

// Adds the cells between a cell of floor and the next floor straight ahead, if all are gaps and
// they are narrow.
void add_gap_ahead(const Grid& grid, const Touched& touched, const Cell& from, int dx, int dy,
                   double widest, GapCells& gaps) {
  std::vector<std::pair<int, int>> between;
  const double length = grid.cell() * std::hypot(dx, dy);
  for (int k = 1; (k - 1) * length <= widest; ++k) {
    const int x = from.x + k * dx, y = from.y + k * dy;
    if (!grid.has(x, y)) return;
    const Ground ground = grid.at(x, y) == Ground::unknown
                              ? look(touched, grid.middle(x, y, from.height)).ground
                              : grid.at(x, y);
    if (ground == Ground::blocked) return;
    if (ground == Ground::floor) return gaps.insert(between.begin(), between.end());
    between.push_back({x, y});
  }
}

// Leaves out those where a scanner saw what is below the floor.
void leave_out_seen(GapCells& gaps, const Grid& grid, const PointCloud& scan, double floor) {
  for (const Vec3f& point : scan.points)
    if (const Vec3 p = point.cast<double>(); p.z() < floor - 0.1) gaps.erase(grid.of(p));
}

// Takes one connected group out of the cells.
std::vector<std::pair<int, int>> take_group(GapCells& cells) {
  std::vector<std::pair<int, int>> group = {*cells.begin()};
  cells.erase(cells.begin());
  for (std::size_t i = 0; i < group.size(); ++i)
    for (int dx = -1; dx <= 1; ++dx)
      for (int dy = -1; dy <= 1; ++dy)
        if (const std::pair next{group[i].first + dx, group[i].second + dy}; cells.erase(next))
          group.push_back(next);
  return group;
}

}  // namespace

FloorGaps find_floor_gaps(const Place& place, const Spots& spots, const PointCloud* scan,
                          const RobustnessOptions& options) {
  FloorGaps found;
  if (place.seen.triangles.empty()) return found;
  Box3 box;
  for (const Vec3& v : place.seen.vertices) box.extend(v);
  for (const Vec3& v : spots.floor) box.extend(v);
  Grid grid(box, options.cell);
  const Touched touched(place);
  const std::vector<Cell> floor = drivable(grid, spots, touched);
  GapCells gaps;
  for (const Cell& cell : floor)
    for (const auto& [dx, dy] : {std::pair{1, 0}, {0, 1}, {1, 1}, {1, -1}})
      add_gap_ahead(grid, touched, cell, dx, dy, options.wheelbase, gaps);
  if (scan) leave_out_seen(gaps, grid, *scan, spots.height);
  const double area = grid.cell() * grid.cell();
  found.drivable = area * static_cast<double>(floor.size());
  found.area = area * static_cast<double>(gaps.size());
  while (!gaps.empty()) {
    const auto group = take_group(gaps);
    found.gaps.push_back({grid.middle(group[0].first, group[0].second, spots.height),
                          area * static_cast<double>(group.size())});
  }
  std::ranges::stable_sort(found.gaps, std::greater(), &FloorGap::area);
  return found;
}

}  // namespace scanworld::sim
