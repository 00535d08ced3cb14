// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "network.h"

#include <algorithm>

namespace scanworld::sim {

namespace {

// The number of a free slot, or of a new one.
template <typename T>
int take_slot(std::vector<T>& slots, std::vector<int>& free) {
  if (free.empty()) {
    slots.emplace_back();
    return static_cast<int>(slots.size()) - 1;
  }
  const int slot = free.back();
  free.pop_back();
  return slot;
}

}  // namespace

int Network::add_node() {
  const int node = take_slot(edges_of_, free_nodes_);
  exists_.resize(edges_of_.size());
  exists_[static_cast<std::size_t>(node)] = 1;
  ++node_count_;
  return node;
}

int Network::add_edge(int a, int b) {
  const int e = take_slot(edges_, free_edges_);
  edge(e) = {.nodes = {a, b}};
  for (int node : {a, b}) edges_of_[static_cast<std::size_t>(node)].push_back(e);
  return e;
}

bool Network::add_face(int a, int b, int c) {
  const std::array<int, 3> edges{find_edge(a, b), find_edge(b, c), find_edge(c, a)};
  for (int e : edges)
    if (e == kNothing || edge(e).face_count() == 2) return false;
  if (has_face(edges[0], c)) return false;
  const int f = take_slot(faces_, free_faces_);
  faces_[static_cast<std::size_t>(f)] = {{a, b, c}, edges};
  for (int e : edges) edge(e).faces[edge(e).faces[0] != kNothing] = f;
  return true;
}

void Network::remove_node(int node) {
  while (!edges_of(node).empty()) remove_edge(edges_of(node).back());
  exists_[static_cast<std::size_t>(node)] = 0;
  free_nodes_.push_back(node);
  --node_count_;
}

void Network::remove_edge(int e) {
  while (edge(e).faces[0] != kNothing) remove_face(edge(e).faces[0]);
  for (int node : edge(e).nodes) std::erase(edges_of_[static_cast<std::size_t>(node)], e);
  edge(e) = {};
  free_edges_.push_back(e);
}

void Network::remove_face(int f) {
  for (int e : face(f).edges) {
    auto& faces = edge(e).faces;
    if (faces[0] == f) faces[0] = faces[1];
    faces[1] = kNothing;
  }
  faces_[static_cast<std::size_t>(f)] = {};
  free_faces_.push_back(f);
}

int Network::find_edge(int a, int b) const {
  for (int e : edges_of(a))
    if (edge(e).other(a) == b) return e;
  return kNothing;
}

std::vector<int> Network::common_neighbors(int a, int b) const {
  std::vector<int> common;
  for (int e : edges_of(a)) {
    const int node = edge(e).other(a);
    if (find_edge(b, node) != kNothing) common.push_back(node);
  }
  return common;
}

int Network::apex(int f, int e) const {
  const auto& [a, b] = edge(e).nodes;
  for (int node : face(f).nodes)
    if (node != a && node != b) return node;
  return kNothing;
}

bool Network::has_face(int e, int apex_node) const {
  for (int f : edge(e).faces)
    if (f != kNothing && apex(f, e) == apex_node) return true;
  return false;
}

std::vector<std::array<int, 3>> Network::triangles() const {
  std::vector<std::array<int, 3>> triangles;
  for (const Face& f : faces_)
    if (f.exists()) triangles.push_back(f.nodes);
  return triangles;
}

Mesh triangle_mesh(const std::vector<std::array<int, 3>>& triangles,
                   const std::vector<Vec3>& positions, const Vec3& origin) {
  Mesh mesh{{}, triangles};
  std::vector<int> vertex_of(positions.size(), kNothing);
  for (auto& triangle : mesh.triangles)
    for (int& corner : triangle) {
      const auto node = static_cast<std::size_t>(corner);
      if (vertex_of[node] == kNothing) {
        vertex_of[node] = static_cast<int>(mesh.vertices.size());
        mesh.vertices.push_back(positions[node] + origin);
      }
      corner = vertex_of[node];
    }
  return mesh;
}

}  // namespace scanworld::sim
