// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "distinct.h"

#include <algorithm>
#include <bit>
#include <numeric>
#include <tuple>
#include <utility>

#include "../mix.h"
#include "../parallel.h"

namespace scanworld {

namespace {

constexpr std::uint32_t kEmpty = ~0u;

// A point, and the lower half of the hash of its place; the upper half tells the bucket.
struct HashedPoint {
  std::uint32_t hash, point;
};

// The points by buckets, so that those of one place are in one bucket.
struct Buckets {
  std::vector<HashedPoint> points;
  std::vector<std::size_t> first;  // of each bucket, and an end
};

// A counting sort over parts of the scan.
Buckets sort_by_hash(const std::vector<Vec3f>& points) {
  constexpr std::size_t kPerBucket = 1 << 12;
  const int bits = std::min(12, static_cast<int>(std::bit_width(points.size() / kPerBucket)));
  const std::size_t size = std::max(kPointsPerPart, (points.size() + 31) / 32);
  const std::size_t parts = part_count(points.size(), size);
  // Calls body(point, hash, bucket) for each point of a part.
  const auto for_each = [&](std::size_t part, const auto& body) {
    const auto [begin, end] = part_of(part, points.size(), size);
    for (std::size_t k = begin; k < end; ++k) {
      const std::uint64_t hash = hash_of_place(points[k].x(), points[k].y(), points[k].z());
      body(k, static_cast<std::uint32_t>(hash), (hash >> 32) & ((1u << bits) - 1));
    }
  };
  std::vector<std::vector<std::size_t>> next(parts, std::vector<std::size_t>(1u << bits));
  parallel_for(parts, [&](std::size_t i) {
    for_each(i, [&](std::size_t, std::uint32_t, std::size_t bucket) { ++next[i][bucket]; });
  });
  Buckets sorted;
  std::size_t sum = 0;
  for (std::size_t b = 0; b < 1u << bits; ++b) {
    sorted.first.push_back(sum);
    for (auto& n : next) sum += std::exchange(n[b], sum);
  }
  sorted.first.push_back(sum);
  sorted.points.resize(sum);
  parallel_for(parts, [&](std::size_t i) {
    for_each(i, [&](std::size_t k, std::uint32_t hash, std::size_t bucket) {
      sorted.points[next[i][bucket]++] = {hash, static_cast<std::uint32_t>(k)};
    });
  });
  return sorted;
}

// Whether a point is to be kept rather than another of its place.
bool is_before(const PointCloud& scan, std::uint32_t a, std::uint32_t b) {
  if (!scan.normals.empty()) {
    const Vec3f &m = scan.normals[a], &n = scan.normals[b];
    if (m != n) return std::lexicographical_compare(m.data(), m.data() + 3, n.data(), n.data() + 3);
  }
  if (!scan.colors.empty()) {
    const Color &c = scan.colors[a], &d = scan.colors[b];
    if (c != d) return std::tie(c.r, c.g, c.b) < std::tie(d.r, d.g, d.b);
  }
  if (const std::int32_t v = scan.viewer_of(a), w = scan.viewer_of(b); v != w) {
    if (v < 0 || w < 0) return v > w;
    const Vec3 &p = scan.viewpoints[static_cast<std::size_t>(v)],
               &q = scan.viewpoints[static_cast<std::size_t>(w)];
    // By place, as indices change with the order of files.
    if (p != q) return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
    return v < w;
  }
  return a < b;
}

// A hash table with open addressing of the points of a bucket, one for each place.
class PlaceTable {
 public:
  PlaceTable(const PointCloud& scan, std::size_t points)
      : scan_(scan), slots_(std::bit_ceil(2 * points + 1), HashedPoint{0, kEmpty}) {}

  // Where the point of this place is kept, or would be.
  HashedPoint& slot_of(const HashedPoint& p) {
    const std::size_t mask = slots_.size() - 1;
    std::size_t at = p.hash & mask;
    while (slots_[at].point != kEmpty &&
           (slots_[at].hash != p.hash || scan_.points[slots_[at].point] != scan_.points[p.point]))
      at = (at + 1) & mask;
    return slots_[at];
  }

 private:
  const PointCloud& scan_;
  std::vector<HashedPoint> slots_;
};

struct Duplicate {
  std::uint32_t point, kept;
};

std::vector<Duplicate> find_duplicates(const PointCloud& scan, const HashedPoint* begin,
                                       const HashedPoint* end) {
  PlaceTable table(scan, static_cast<std::size_t>(end - begin));
  std::size_t count = 0;
  for (const HashedPoint* p = begin; p != end; ++p) {
    HashedPoint& slot = table.slot_of(*p);
    const bool is_new = slot.point == kEmpty;
    count += !is_new;
    if (is_new || is_before(scan, p->point, slot.point)) slot = *p;
  }
  std::vector<Duplicate> duplicates;
  if (count == 0) return duplicates;
  duplicates.reserve(count);
  for (const HashedPoint* p = begin; p != end; ++p)
    if (const std::uint32_t kept = table.slot_of(*p).point; kept != p->point)
      duplicates.push_back({p->point, kept});
  return duplicates;
}

// Those items that are marked with their own number.
template <typename T>
std::vector<T> kept_of(const std::vector<T>& items, const std::vector<std::uint32_t>& kept) {
  std::vector<T> result;
  for (std::size_t i = 0; i < items.size(); ++i)
    if (kept[i] == i) result.push_back(items[i]);
  return result;
}

}  // namespace

std::vector<std::int32_t> DistinctPoints::expand(std::vector<std::int32_t> labels) const {
  if (!cloud || labels.empty()) return labels;
  std::vector<std::int32_t> expanded;
  expanded.reserve(place.size());
  for (const std::uint32_t p : place) expanded.push_back(labels[p]);
  return expanded;
}

DistinctPoints find_distinct(const PointCloud& scan) {
  std::vector<std::vector<Duplicate>> duplicates;
  {
    const Buckets sorted = sort_by_hash(scan.points);
    duplicates.resize(sorted.first.size() - 1);
    parallel_for(duplicates.size(), [&](std::size_t b) {
      duplicates[b] = find_duplicates(scan, sorted.points.data() + sorted.first[b],
                                      sorted.points.data() + sorted.first[b + 1]);
    });
  }
  DistinctPoints result;
  if (std::ranges::all_of(duplicates, [](const auto& some) { return some.empty(); })) return result;
  std::vector<std::uint32_t>& place = result.place;  // first as numbers of points of the scan
  place.resize(scan.points.size());
  std::iota(place.begin(), place.end(), 0);
  for (const auto& some : duplicates)
    for (const Duplicate& d : some) place[d.point] = d.kept;
  result.cloud = PointCloud{kept_of(scan.points, place),
                            kept_of(scan.normals, place),
                            kept_of(scan.colors, place),
                            scan.origin,
                            scan.viewpoints,
                            kept_of(scan.viewers, place),
                            scan.skipped,
                            scan.camera_frame};
  std::vector<std::uint32_t> number(place.size());
  std::uint32_t next = 0;
  for (std::size_t i = 0; i < place.size(); ++i)
    if (place[i] == i) number[i] = next++;
  for (std::uint32_t& p : place) p = number[p];
  return result;
}

}  // namespace scanworld
