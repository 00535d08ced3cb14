// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <optional>
#include <utility>

#include "trace_loops.h"
#include "weld.h"

namespace scanworld::surface {

// The vertices of polygons whose corners are told by planes: one for all corners of the same
// planes, and for those that are nearly one.
class Welder {
 public:
  Welder(const std::vector<CornerPolygon>& polygons, const std::vector<Plane>& planes,
         const WeldOptions& options);

  // The edges of a polygon from vertex to vertex, with the vertices on their lines between. It then
  // has all of these.
  std::vector<HalfEdge> edges_of(const CornerPolygon& polygon);

  // The same from corner to corner, none of them joined with others.
  std::vector<HalfEdge> lone_edges_of(const CornerPolygon& polygon) const;

  // Makes a vertex one of a polygon too, moving it a little where it is off its plane. False, and
  // nothing is changed, where the planes of the other polygons that have it do not let it.
  bool bring(int v, int patch);

  const Vec3& at(int v) const { return at_[static_cast<std::size_t>(v)]; }

 private:
  using Key = std::array<int, 3>;

  int name_of(int plane) const { return plane_name_[static_cast<std::size_t>(plane)]; }
  const Plane& plane(int k) const { return planes_[static_cast<std::size_t>(k)]; }
  bool is_in_plane(int patch, const Vec3& p) const;
  std::optional<Vec3> meeting_point(const std::vector<int>& patches, const Vec3& p) const;

  std::optional<Key> key_of(const Corner& corner) const;
  std::vector<Corner> corners_of(std::vector<Corner> loop) const;
  int vertex_of(const Corner& corner) const;
  void add(const Corner& corner, int patch);
  void join();
  std::vector<int> between(int patch, int other, int from, int to) const;

  const std::vector<Plane>& planes_;
  const WeldOptions& options_;
  const std::vector<int> plane_name_;     // of each plane, the one that counts in its place
  std::map<Key, int> index_;              // of the corner of these planes
  std::vector<Vec3> at_;                  // of each corner
  std::vector<std::vector<int>> owners_;  // the patches of each corner, and of those joined with it
  std::vector<int> name_;                 // of each corner, the first of those joined with it
  std::map<std::pair<int, int>, std::vector<int>> on_line_;  // vertices by planes
};

}  // namespace scanworld::surface
