// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "grid.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include "../parallel.h"
#include "../viewers.h"

namespace scanworld::rival {

namespace {

constexpr int kBias = 1 << 17;         // blocks to each side of the origin
constexpr std::size_t kMinStray = 12;  // fewer points that are far from all others are no site

// Where a point is: its voxel, and its place in it in 1/4096.
struct Place {
  std::array<int, 3> voxel{};
  std::array<int, 3> within{};
};

class Raster {
 public:
  explicit Raster(double voxel) : scale_(4096 / voxel) {}

  bool place(const Vec3f& p, Place& at) const {
    constexpr double kShift = 4096.0 * (1 << 20);  // makes all positive, so that casts round down
    for (int a = 0; a < 3; ++a) {
      const double fine = static_cast<double>(p[a]) * scale_;
      if (!(std::abs(fine) < 4096.0 * (1 << 19))) return false;
      const auto whole =
          static_cast<std::int64_t>(fine + kShift) - static_cast<std::int64_t>(kShift);
      at.voxel[static_cast<std::size_t>(a)] = static_cast<int>(whole >> 12);
      at.within[static_cast<std::size_t>(a)] = static_cast<int>(whole & 4095);
    }
    return true;
  }

 private:
  double scale_;
};

std::uint64_t key_of(int x, int y, int z) {
  return static_cast<std::uint64_t>(z + kBias) << 40 | static_cast<std::uint64_t>(y + kBias) << 20 |
         static_cast<std::uint64_t>(x + kBias);
}
std::array<int, 3> block_of(std::uint64_t key) {
  const auto part = [&](int shift) { return static_cast<int>(key >> shift & 0xfffff) - kBias; };
  return {part(0), part(20), part(40)};
}
std::uint64_t block_key(const Place& at) {
  return key_of(at.voxel[0] >> 3, at.voxel[1] >> 3, at.voxel[2] >> 3);
}
// A hash table with open addressing from blocks' keys to numbers, which grows.
class BlockIndex {
 public:
  // Adds the key with this number; where it is there already, changes nothing and tells so.
  bool add(std::uint64_t key, std::int32_t number) {
    if (2 * (size_ + 1) > slots_.size()) grow();
    Slot& slot = slots_[place_of(key)];
    if (slot.number >= 0) return false;
    slot = {key, number};
    ++size_;
    return true;
  }
  // The key's number, or -1.
  std::int32_t find(std::uint64_t key) const { return slots_[place_of(key)].number; }

 private:
  struct Slot {
    std::uint64_t key;
    std::int32_t number;
  };

  // Where the key is, or would be put.
  std::size_t place_of(std::uint64_t key) const {
    std::uint64_t hash = key * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 29;
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = hash & mask;
    while (slots_[at].number >= 0 && slots_[at].key != key) at = (at + 1) & mask;
    return at;
  }
  void grow() {
    const std::vector<Slot> before =
        std::exchange(slots_, std::vector<Slot>(2 * slots_.size(), Slot{0, -1}));
    for (const Slot& slot : before)
      if (slot.number >= 0) slots_[place_of(slot.key)] = slot;
  }

  std::size_t size_ = 0;
  std::vector<Slot> slots_ = std::vector<Slot>(1 << 10, Slot{0, -1});
};

// The keys of all blocks that hold points, ascending.
std::vector<std::uint64_t> find_blocks(const PointCloud& cloud, const Raster& raster) {
  const std::size_t parts = part_count(cloud.points.size(), kPointsPerPart);
  std::vector<std::vector<std::uint64_t>> found(parts);
  parallel_for(parts, [&](std::size_t i) {
    const auto [begin, end] = part_of(i, cloud.points.size(), kPointsPerPart);
    BlockIndex seen;
    Place at;
    std::uint64_t last = ~0ull;
    for (std::size_t k = begin; k < end; ++k) {
      if (!raster.place(cloud.points[k], at)) continue;
      const std::uint64_t key = block_key(at);
      if (key != last && seen.add(key, 0)) found[i].push_back(key);
      last = key;
    }
  });
  std::vector<std::uint64_t> all;
  for (const auto& f : found) all.insert(all.end(), f.begin(), f.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

// What the points of a voxel add up to, in 1/4096 of its edge.
struct Sums {
  std::int64_t x = 0, y = 0, z = 0, xx = 0, xy = 0, xz = 0, yy = 0, yz = 0, zz = 0;
  std::uint32_t n = 0;

  void add(const std::array<std::uint16_t, 3>& at) {
    const std::int64_t a = at[0] & 4095, b = at[1] & 4095, c = at[2] & 4095;
    ++n, x += a, y += b, z += c;
    xx += a * a, xy += a * b, xz += a * c, yy += b * b, yz += b * c, zz += c * c;
  }

  Site site(const std::array<int, 3>& voxel, double size) const {
    const double count = n, unit = size / 4096;
    // Half a unit, as places are rounded down.
    const double mx = static_cast<double>(x) / count, my = static_cast<double>(y) / count,
                 mz = static_cast<double>(z) / count;
    const auto cov = [&](std::int64_t products, double a, double b) {
      return static_cast<float>((static_cast<double>(products) / count - a * b) * unit * unit);
    };
    Site s;
    s.mean = (Vec3(voxel[0] * 4096.0 + mx + 0.5, voxel[1] * 4096.0 + my + 0.5,
                   voxel[2] * 4096.0 + mz + 0.5) *
              unit)
                 .cast<float>();
    s.covariance = {cov(xx, mx, mx), cov(xy, mx, my), cov(xz, mx, mz),
                    cov(yy, my, my), cov(yz, my, mz), cov(zz, mz, mz)};
    s.points = n;
    return s;
  }
};

// The points in the order of their blocks, in each as they come, with their places in them.
struct Sorted {
  std::vector<std::uint32_t> points;                 // indices into the cloud
  std::vector<std::array<std::uint16_t, 3>> places;  // voxel << 12 | within, of each axis
  std::vector<std::size_t> first;  // for each block its first point; one more at the end
};

// A counting sort over parts of the cloud.
Sorted sort_by_block(const PointCloud& cloud, const Raster& raster, const BlockIndex& index,
                     std::size_t blocks) {
  const std::size_t points = cloud.points.size();
  const std::size_t size = std::max(kPointsPerPart, (points + 31) / 32);
  const std::size_t parts = part_count(points, size);
  // Calls body(point, place, block) for each point of a part.
  const auto for_each = [&](std::size_t part, const auto& body) {
    const auto [begin, end] = part_of(part, points, size);
    Place at;
    std::uint64_t last_key = ~0ull;
    std::size_t block = 0;
    for (std::size_t k = begin; k < end; ++k) {
      if (!raster.place(cloud.points[k], at)) continue;
      const std::uint64_t key = block_key(at);
      if (key != last_key) last_key = key, block = static_cast<std::size_t>(index.find(key));
      body(k, at, block);
    }
  };
  std::vector<std::vector<std::uint32_t>> count(parts, std::vector<std::uint32_t>(blocks));
  parallel_for(parts, [&](std::size_t i) {
    for_each(i, [&](std::size_t, const Place&, std::size_t block) { ++count[i][block]; });
  });
  Sorted sorted;
  sorted.first.resize(blocks + 1);
  std::uint32_t sum = 0;
  for (std::size_t b = 0; b < blocks; ++b) {
    sorted.first[b] = sum;
    for (auto& c : count) sum += std::exchange(c[b], sum);
  }
  sorted.first[blocks] = sum;
  sorted.points.resize(sum), sorted.places.resize(sum);
  parallel_for(parts, [&](std::size_t i) {
    for_each(i, [&](std::size_t k, const Place& at, std::size_t block) {
      const std::uint32_t to = count[i][block]++;
      sorted.points[to] = static_cast<std::uint32_t>(k);
      for (std::size_t a = 0; a < 3; ++a)
        sorted.places[to][a] = static_cast<std::uint16_t>((at.voxel[a] & 7) << 12 | at.within[a]);
    });
  });
  return sorted;
}

// Puts the points of a block in the order of their voxels and makes a site of each voxel.
class BlockFiller {
 public:
  BlockFiller(const Sorted& sorted, double voxel) : sorted_(sorted), voxel_(voxel) {}

  // `corner`: of the block, in voxels; `points`: those of the sorted, which are reordered in place.
  void fill(std::size_t b, const std::array<int, 3>& corner, std::vector<std::uint32_t>& points,
            Block& block, std::vector<Site>& sites) {
    const std::size_t start = sorted_.first[b], count = sorted_.first[b + 1] - start;
    const auto* const places = sorted_.places.data() + start;
    const auto voxel_at = [&](std::size_t k) {
      const auto& at = places[k];
      return static_cast<std::size_t>((at[2] >> 12) << 6 | (at[1] >> 12) << 3 | at[0] >> 12);
    };
    std::array<std::uint32_t, 513> next{};
    for (std::size_t k = 0; k < count; ++k) ++next[voxel_at(k) + 1];
    std::partial_sum(next.begin(), next.end(), next.begin());
    reordered_.resize(count), from_.resize(count);
    for (std::size_t k = 0; k < count; ++k) {
      const std::uint32_t to = next[voxel_at(k)]++;
      reordered_[to] = points[start + k], from_[to] = static_cast<std::uint32_t>(k);
    }
    std::copy(reordered_.begin(), reordered_.end(),
              points.begin() + static_cast<std::ptrdiff_t>(start));
    for (std::size_t k = 0; k < count;) {
      const std::size_t v = voxel_at(from_[k]);
      const auto first = static_cast<std::uint32_t>(start + k);
      Sums sums;
      for (const std::size_t last = next[v]; k < last; ++k) sums.add(places[from_[k]]);
      Site site =
          sums.site({corner[0] + static_cast<int>(v & 7), corner[1] + static_cast<int>(v >> 3 & 7),
                     corner[2] + static_cast<int>(v >> 6)},
                    voxel_);
      site.first = first;
      site.voxel = static_cast<std::uint32_t>(b << 9 | v);
      sites.push_back(site);
      block.occupied[v >> 6] |= std::uint64_t{1} << (v & 63);
    }
  }

 private:
  const Sorted& sorted_;
  const double voxel_;
  std::vector<std::uint32_t> reordered_, from_;
};

// Fills all blocks; gives their sites in parts.
std::vector<std::vector<Site>> fill_blocks(const Sorted& sorted,
                                           const std::vector<std::uint64_t>& keys,
                                           const BlockIndex& index, Grid& grid) {
  constexpr std::size_t kBlocks = 64;
  std::vector<std::vector<Site>> sites(part_count(keys.size(), kBlocks));
  parallel_for(sites.size(), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, keys.size(), kBlocks);
    BlockFiller filler(sorted, grid.voxel);
    for (std::size_t b = begin; b < end; ++b) {
      Block& block = grid.blocks[b];
      const std::array<int, 3> at = block_of(keys[b]);
      int near = 0;
      for (int n = 0; n < 27; ++n) {
        const std::uint64_t key =
            key_of(at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1);
        near += (block.near[static_cast<std::size_t>(n)] = index.find(key)) >= 0;
      }
      const bool is_stray = near == 1 && sorted.first[b + 1] - sorted.first[b] < kMinStray;
      if (!is_stray)
        filler.fill(b, {at[0] * 8, at[1] * 8, at[2] * 8}, grid.points, block, sites[part]);
    }
  });
  return sites;
}

}  // namespace

Grid build_grid(const PointCloud& cloud, double voxel) {
  const Raster raster(voxel);
  const std::vector<std::uint64_t> keys = find_blocks(cloud, raster);
  BlockIndex index;
  for (std::size_t b = 0; b < keys.size(); ++b) index.add(keys[b], static_cast<std::int32_t>(b));

  Grid grid;
  grid.voxel = voxel;
  grid.blocks.resize(keys.size());
  std::vector<std::vector<Site>> sites;
  {
    Sorted sorted = sort_by_block(cloud, raster, index, keys.size());
    grid.points = std::move(sorted.points);
    sites = fill_blocks(sorted, keys, index, grid);
  }
  std::size_t count = 0;
  for (const auto& s : sites) count += s.size();
  grid.sites.reserve(count + count / 32);  // room for sites that are parted later
  for (auto& s : sites) {
    grid.sites.insert(grid.sites.end(), s.begin(), s.end());
    s = {};
  }
  std::uint32_t site = 0;
  for (Block& block : grid.blocks)
    for (std::size_t z = 0; z < 8; ++z) {
      block.first[z] = site;
      site += static_cast<std::uint32_t>(std::popcount(block.occupied[z]));
    }
  return grid;
}

void part_site(const PointCloud& cloud, std::uint32_t i, const Plane& between, Grid& grid) {
  grid.separator.resize(grid.sites.size(), -1);
  grid.twin.resize(grid.sites.size(), -1);
  grid.separator[i] = static_cast<std::int32_t>(grid.separators.size());
  grid.separators.push_back(between);

  const auto begin = grid.points.begin() + grid.sites[i].first;
  const auto end = begin + grid.sites[i].points;
  const auto middle = std::stable_partition(begin, end, [&](std::uint32_t p) {
    return between.signed_distance(cloud.points[p].cast<double>()) > 0;
  });
  if (middle == begin || middle == end) return;
  const Raster raster(grid.voxel);
  const auto site_of = [&](auto from, auto to) {
    Sums sums;
    Place at;
    for (auto p = from; p != to; ++p) {
      raster.place(cloud.points[*p], at);
      sums.add({static_cast<std::uint16_t>(at.within[0]), static_cast<std::uint16_t>(at.within[1]),
                static_cast<std::uint16_t>(at.within[2])});
    }
    Site site = sums.site(at.voxel, grid.voxel);
    site.first = static_cast<std::uint32_t>(from - grid.points.begin());
    site.voxel = grid.sites[i].voxel;
    return site;
  };
  const Site before = site_of(begin, middle), behind = site_of(middle, end);
  const bool more_before = before.points >= behind.points;
  grid.sites[i] = more_before ? before : behind;
  grid.twin[i] = static_cast<std::int32_t>(grid.sites.size());
  grid.sites.push_back(more_before ? behind : before);
  grid.twin.push_back(-1);
  grid.separator.push_back(grid.separator[i]);
}

Grid with_viewers(const PointCloud& cloud, Grid grid) {
  if (cloud.viewers.empty()) return grid;
  grid.viewers.resize(grid.sites.size());
  parallel_for(part_count(grid.sites.size(), kSitesPerPart), [&](std::size_t part) {
    const auto [begin, end] = part_of(part, grid.sites.size(), kSitesPerPart);
    std::vector<std::int32_t> viewers;
    for (std::size_t i = begin; i < end; ++i) {
      viewers.clear();
      for (const std::uint32_t p : grid.points_of(i)) viewers.push_back(cloud.viewers[p]);
      grid.viewers[i] = main_viewer(viewers, cloud.viewpoints, grid.sites[i].position());
    }
  });
  return grid;
}

}  // namespace scanworld::rival
