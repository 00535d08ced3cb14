// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "welder.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "../disjoint_sets.h"
#include "merge_planes.h"

namespace scanworld::surface {

namespace {

constexpr double kMinDeterminant = 0.05;  // of three normals whose planes meet in a clear point
constexpr double kRidge = 1e-3;           // weight of a point's place where planes do not tell it

// Both lists, each patch once.
std::vector<int> together(std::vector<int> a, const std::vector<int>& b) {
  a.insert(a.end(), b.begin(), b.end());
  std::sort(a.begin(), a.end());
  a.erase(std::unique(a.begin(), a.end()), a.end());
  return a;
}

}  // namespace

Welder::Welder(const std::vector<CornerPolygon>& polygons, const std::vector<Plane>& planes,
               const WeldOptions& options)
    : planes_(planes), options_(options), plane_name_(merge_planes(polygons, planes, options)) {
  for (const CornerPolygon& polygon : polygons)
    for (const auto& loop : polygon.loops)
      for (const Corner& corner : loop) add(corner, polygon.patch);
  join();
  for (const auto& [key, v] : index_)
    for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}, {1, 2}})
      on_line_[{key[static_cast<std::size_t>(a)], key[static_cast<std::size_t>(b)]}].push_back(
          name_[static_cast<std::size_t>(v)]);
  for (auto& [line, list] : on_line_) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
  }
}

std::vector<HalfEdge> Welder::edges_of(const CornerPolygon& polygon) {
  std::vector<HalfEdge> edges;
  for (const auto& all : polygon.loops) {
    const std::vector<Corner> loop = corners_of(all);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      int from = vertex_of(loop[k]);
      const int to = vertex_of(loop[(k + 1) % loop.size()]);
      if (from == to) continue;
      for (int v : between(polygon.patch, loop[k].next, from, to)) {
        owners_[static_cast<std::size_t>(v)].push_back(polygon.patch);
        edges.push_back({from, v});
        from = v;
      }
      edges.push_back({from, to});
    }
  }
  return edges;
}

std::vector<HalfEdge> Welder::lone_edges_of(const CornerPolygon& polygon) const {
  std::vector<HalfEdge> edges;
  for (const auto& all : polygon.loops) {
    const std::vector<Corner> loop = corners_of(all);
    const auto at = [&](std::size_t k) { return index_.at(*key_of(loop[k % loop.size()])); };
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (at(k) != at(k + 1)) edges.push_back({at(k), at(k + 1)});
  }
  return edges;
}

bool Welder::bring(int v, int patch) {
  const auto k = static_cast<std::size_t>(v);
  const std::vector<int> owners = together(owners_[k], {patch});
  const auto to = meeting_point(owners, at_[k]);
  if (!to) return false;
  at_[k] = *to;
  owners_[k] = owners;
  return true;
}

bool Welder::is_in_plane(int patch, const Vec3& p) const {
  return std::abs(plane(patch).signed_distance(p)) < options_.off_plane;
}

// A point near p that is in the planes of all these polygons, or nearly: p where that is, else the
// one with the least squares of distances from them. Two planes that are nearly one do not tell
// where they meet: so far along them it does not go.
std::optional<Vec3> Welder::meeting_point(const std::vector<int>& patches, const Vec3& p) const {
  const auto is_in_all = [&](const Vec3& q) {
    return std::all_of(patches.begin(), patches.end(),
                       [&](int patch) { return is_in_plane(patch, q); });
  };
  if (is_in_all(p)) return p;
  Mat3 known = kRidge * Mat3::Identity();
  Vec3 pull = Vec3::Zero();
  for (int patch : patches) {
    const Vec3& n = plane(patch).normal;
    known += n * n.transpose();
    pull -= plane(patch).signed_distance(p) * n;
  }
  const Vec3 q = p + known.inverse() * pull;
  if ((q - p).norm() > options_.same || !is_in_all(q)) return std::nullopt;
  return q;
}

// The planes that count; none where two of them are one, as there is no corner between two lines
// that are one.
std::optional<Welder::Key> Welder::key_of(const Corner& corner) const {
  Key key;
  std::transform(corner.planes.begin(), corner.planes.end(), key.begin(),
                 [&](int plane) { return name_of(plane); });
  std::sort(key.begin(), key.end());
  if (key[0] == key[1] || key[1] == key[2]) return std::nullopt;
  return key;
}

std::vector<Corner> Welder::corners_of(std::vector<Corner> loop) const {
  std::erase_if(loop, [&](const Corner& corner) { return !key_of(corner); });
  return loop;
}

int Welder::vertex_of(const Corner& corner) const {
  return name_[static_cast<std::size_t>(index_.at(*key_of(corner)))];
}

void Welder::add(const Corner& corner, int patch) {
  const auto key = key_of(corner);
  if (!key) return;
  const auto [found, is_new] = index_.try_emplace(*key, static_cast<int>(at_.size()));
  if (!is_new) return owners_[static_cast<std::size_t>(found->second)].push_back(patch);
  Mat3 normals;
  Vec3 offsets;
  for (int k = 0; k < 3; ++k) {
    const Plane& p = plane((*key)[static_cast<std::size_t>(k)]);
    normals.row(k) = p.normal.transpose(), offsets[k] = -p.offset;
  }
  const bool is_clear = std::abs(normals.determinant()) > kMinDeterminant;
  owners_.push_back({patch});
  at_.push_back(is_clear ? Vec3(normals.inverse() * offsets) : corner.at);
}

// Corners that are nearly one become one.
void Welder::join() {
  DisjointSets sets(at_.size());
  std::vector<std::size_t> order(at_.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::vector<Vec3> was = at_;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const Vec3 &p = was[a], &q = was[b];
    return std::lexicographical_compare(p.data(), p.data() + 3, q.data(), q.data() + 3);
  });
  for (std::size_t i = 0; i < order.size(); ++i)
    for (std::size_t k = i + 1; k < order.size(); ++k) {
      const Vec3 &p = was[order[i]], &q = was[order[k]];
      if (q.x() - p.x() > options_.same) break;
      if ((q - p).norm() > options_.same) continue;
      const auto [a, b] = std::minmax({sets.find(order[i]), sets.find(order[k])});
      if (a == b) continue;
      const std::vector<int> owners = together(owners_[a], owners_[b]);
      auto to = meeting_point(owners, at_[a]);
      if (!to) to = meeting_point(owners, at_[b]);
      if (!to) continue;
      at_[a] = *to;
      owners_[a] = owners;
      sets.unite(a, b);
    }
  for (std::size_t v = 0; v < at_.size(); ++v) name_.push_back(static_cast<int>(sets.find(v)));
}

// The vertices on the line of two planes strictly between two of them, on the way.
std::vector<int> Welder::between(int patch, int other, int from, int to) const {
  const auto found = on_line_.find(std::minmax({name_of(patch), name_of(other)}));
  if (found == on_line_.end()) return {};
  const Vec3& start = at(from);
  const Vec3 way = at(to) - start;
  const double length = way.norm();
  std::vector<std::pair<double, int>> inside;
  for (int v : found->second) {
    if (v == from || v == to || !is_in_plane(patch, at(v))) continue;
    const double t = way.dot(at(v) - start) / length;
    if (t > options_.same && t < length - options_.same) inside.push_back({t, v});
  }
  std::sort(inside.begin(), inside.end());
  std::vector<int> vertices;
  for (const auto& [t, v] : inside) vertices.push_back(v);
  return vertices;
}

}  // namespace scanworld::surface
