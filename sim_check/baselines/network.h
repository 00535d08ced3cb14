// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "types.h"

namespace scanworld::sim {

constexpr int kNothing = -1;  // no node, edge or face

// Nodes, edges that connect two of them, and triangular faces between three edges; not more than
// one edge between two nodes, one face between three, and two faces at an edge. Where the nodes are
// is not its business. What is removed leaves its number to what is added next.
class Network {
 public:
  struct Edge {
    std::array<int, 2> nodes{kNothing, kNothing};
    std::array<int, 2> faces{kNothing, kNothing};  // the first ones are taken first
    int age = 0;                                   // signals since it was used

    bool exists() const { return nodes[0] != kNothing; }
    int face_count() const { return (faces[0] != kNothing) + (faces[1] != kNothing); }
    int other(int node) const { return nodes[nodes[0] == node]; }
  };
  struct Face {
    std::array<int, 3> nodes{kNothing, kNothing, kNothing};
    std::array<int, 3> edges{kNothing, kNothing, kNothing};

    bool exists() const { return nodes[0] != kNothing; }
  };

  int add_node();
  int add_edge(int a, int b);          // between two that are not connected
  bool add_face(int a, int b, int c);  // false where the three edges leave no room for one
  void remove_node(int node);          // with its edges
  void remove_edge(int edge);          // with its faces
  void remove_face(int face);

  int node_count() const { return node_count_; }
  bool has_node(int node) const { return exists_[static_cast<std::size_t>(node)] != 0; }
  const std::vector<int>& edges_of(int node) const {
    return edges_of_[static_cast<std::size_t>(node)];
  }
  Edge& edge(int e) { return edges_[static_cast<std::size_t>(e)]; }
  const Edge& edge(int e) const { return edges_[static_cast<std::size_t>(e)]; }
  const Face& face(int f) const { return faces_[static_cast<std::size_t>(f)]; }

  // One more than the highest number; what is between need not exist.
  int node_end() const { return static_cast<int>(edges_of_.size()); }
  int edge_end() const { return static_cast<int>(edges_.size()); }
  int face_end() const { return static_cast<int>(faces_.size()); }

  int find_edge(int a, int b) const;  // or nothing
  std::vector<int> common_neighbors(int a, int b) const;
  int apex(int face, int edge) const;                 // the node of a face that is not on its edge
  std::vector<std::array<int, 3>> triangles() const;  // the nodes of all faces

 private:
  bool has_face(int edge, int apex_node) const;

  std::vector<std::vector<int>> edges_of_;
  std::vector<char> exists_;
  std::vector<Edge> edges_;
  std::vector<Face> faces_;
  std::vector<int> free_nodes_, free_edges_, free_faces_;
  int node_count_ = 0;
};

// These triangles between nodes at `positions`, moved by `origin`; other nodes are left out.
Mesh triangle_mesh(const std::vector<std::array<int, 3>>& triangles,
                   const std::vector<Vec3>& positions, const Vec3& origin);

}  // namespace scanworld::sim
