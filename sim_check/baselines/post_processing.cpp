// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "post_processing.h"

#include <algorithm>
#include <cmath>

namespace scanworld::sim {

namespace {

double angle_between(const Vec3& a, const Vec3& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

class PostProcessor {
 public:
  PostProcessor(Network& network, const std::vector<Vec3>& positions,
                const PostProcessingOptions& options)
      : network_(network), positions_(positions), options_(options) {}

  void run() {
    remove_wide_faces();
    remove_folds();
    clean_edges();
    close_holes();
    clean_edges();
    close_holes();
    remove_remnants();
    close_holes();
    remove_remnants();
    close_triangles();
  }

 private:
  const Vec3& at(int node) const { return positions_[static_cast<std::size_t>(node)]; }

  // The angle at b.
  double corner(int a, int b, int c) const { return angle_between(at(a) - at(b), at(c) - at(b)); }
  bool is_wide(int a, int b, int c) const {
    return std::max({corner(a, b, c), corner(b, c, a), corner(c, a, b)}) > options_.max_corner;
  }
  double area(const Network::Face& f) const {
    const auto& [a, b, c] = f.nodes;
    return (at(b) - at(a)).cross(at(c) - at(a)).norm() / 2;
  }
  // Between the half planes from an edge through two nodes.
  double dihedral(const Network::Edge& edge, int p, int q) const {
    const Vec3 along = (at(edge.nodes[1]) - at(edge.nodes[0])).normalized();
    return angle_between(along.cross(at(p) - at(edge.nodes[0])),
                         along.cross(at(q) - at(edge.nodes[0])));
  }
  int neighbor_count(const Network::Face& f) const {
    return static_cast<int>(std::count_if(
        f.edges.begin(), f.edges.end(), [&](int e) { return network_.edge(e).face_count() == 2; }));
  }

  void remove_wide_faces() {
    for (int f = 0; f < network_.face_end(); ++f) {
      const auto& [a, b, c] = network_.face(f).nodes;
      if (a != kNothing && is_wide(a, b, c)) network_.remove_face(f);
    }
  }

  // Of two faces with a sharp edge, the one that is less part of the rest.
  void remove_folds() {
    for (int e = 0; e < network_.edge_end(); ++e) {
      const Network::Edge& edge = network_.edge(e);
      if (edge.face_count() < 2) continue;
      const auto [f, g] = edge.faces;
      if (dihedral(edge, network_.apex(f, e), network_.apex(g, e)) >= options_.min_dihedral)
        continue;
      const auto rank = [&](int face) {
        return std::pair(neighbor_count(network_.face(face)), area(network_.face(face)));
      };
      network_.remove_face(rank(f) < rank(g) ? f : g);
    }
  }

  // Whether an edge hangs loose at this end: all others there, if any, are between two faces.
  bool is_loose_at(int node, const Network::Edge& edge) const {
    const auto& edges = network_.edges_of(node);
    return edge.face_count() == 0 && std::count_if(edges.begin(), edges.end(), [&](int e) {
                                       return network_.edge(e).face_count() < 2;
                                     }) == 1;
  }

  void clean_edges() {
    for (bool changed = true; changed;) {
      changed = false;
      for (int e = 0; e < network_.edge_end(); ++e) {
        const Network::Edge& edge = network_.edge(e);
        if (!edge.exists()) continue;
        if (!is_loose_at(edge.nodes[0], edge) && !is_loose_at(edge.nodes[1], edge)) continue;
        network_.remove_edge(e);
        changed = true;
      }
    }
    for (int node = 0; node < network_.node_end(); ++node)
      if (network_.has_node(node)) merge_edges_at(node);
  }

  // Makes one edge of two that are nearly straight and have no faces.
  void merge_edges_at(int node) {
    const auto& edges = network_.edges_of(node);
    if (edges.size() != 2) return;
    const Network::Edge &first = network_.edge(edges[0]), &second = network_.edge(edges[1]);
    const int a = first.other(node), b = second.other(node);
    if (first.face_count() > 0 || second.face_count() > 0) return;
    if (corner(a, node, b) <= options_.min_merge_angle) return;
    network_.remove_node(node);
    if (network_.find_edge(a, b) == kNothing) network_.add_edge(a, b);
  }

  void close_holes() {
    for (bool changed = true; changed;) {
      changed = false;
      for (int e = 0; e < network_.edge_end(); ++e)
        if (network_.edge(e).face_count() == 1 && close_at(e)) changed = true;
    }
  }

  // Adds a face or two at an edge that has one.
  bool close_at(int e) {
    const auto [u, v] = network_.edge(e).nodes;
    for (int c : network_.common_neighbors(u, v))
      if (try_face(u, v, c)) return true;
    const int at_u = border_at(u, e), at_v = border_at(v, e);
    if (at_u == kNothing && at_v == kNothing) return false;
    if (at_u == kNothing) return try_ear(u, v, network_.edge(at_v).other(v));
    if (at_v == kNothing) return try_ear(v, u, network_.edge(at_u).other(u));
    const int a = network_.edge(at_u).other(u), b = network_.edge(at_v).other(v);
    return a != b && try_quad(a, u, v, b);
  }

  // The only other edge with one face at the end of an edge, if there is not one with none.
  int border_at(int node, int edge) const {
    int border = kNothing;
    for (int e : network_.edges_of(node)) {
      const int faces = network_.edge(e).face_count();
      if (faces == 2 || e == edge) continue;
      if (faces == 0 || border != kNothing) return kNothing;
      border = e;
    }
    return border;
  }

  // Adds the face with a new edge from a to c.
  bool try_ear(int a, int b, int c) {
    if (network_.find_edge(a, c) != kNothing) return false;
    const int e = network_.add_edge(a, c);
    if (try_face(a, b, c)) return true;
    network_.remove_edge(e);
    return false;
  }

  // Two faces that share the shorter diagonal.
  bool try_quad(int a, int b, int c, int d) {
    const bool from_a = (at(a) - at(c)).squaredNorm() < (at(b) - at(d)).squaredNorm();
    if (!from_a) std::swap(a, d), std::swap(b, c);
    if (network_.find_edge(a, c) != kNothing) return false;
    const int e = network_.add_edge(a, c);
    if (try_face(a, b, c) && try_face(a, c, d)) return true;
    network_.remove_edge(e);
    return false;
  }

  bool try_face(int a, int b, int c) {
    if (is_wide(a, b, c)) return false;
    const std::array<std::array<int, 3>, 3> sides{{{a, b, c}, {b, c, a}, {c, a, b}}};
    for (const auto& [p, q, apex] : sides) {
      const int e = network_.find_edge(p, q);
      if (e == kNothing) return false;
      const Network::Edge& edge = network_.edge(e);
      if (edge.face_count() == 1 &&
          dihedral(edge, network_.apex(edge.faces[0], e), apex) < options_.min_dihedral)
        return false;
    }
    return network_.add_face(a, b, c);
  }

  // Faces on their own, and edges and nodes that have nothing on them.
  void remove_remnants() {
    for (int f = 0; f < network_.face_end(); ++f)
      if (network_.face(f).exists() && neighbor_count(network_.face(f)) == 0)
        network_.remove_face(f);
    for (int e = 0; e < network_.edge_end(); ++e)
      if (network_.edge(e).exists() && network_.edge(e).face_count() == 0) network_.remove_edge(e);
    for (int node = 0; node < network_.node_end(); ++node)
      if (network_.has_node(node) && network_.edges_of(node).empty()) network_.remove_node(node);
  }

  // At last, holes of three edges, whatever their angles.
  void close_triangles() {
    for (int e = 0; e < network_.edge_end(); ++e) {
      const auto [u, v] = network_.edge(e).nodes;
      if (!network_.edge(e).exists() || network_.edge(e).face_count() == 2) continue;
      for (int c : network_.common_neighbors(u, v))
        if (network_.edge(network_.find_edge(u, c)).face_count() == 1 &&
            network_.edge(network_.find_edge(v, c)).face_count() == 1 && network_.add_face(u, v, c))
          break;
    }
  }

  Network& network_;
  const std::vector<Vec3>& positions_;
  const PostProcessingOptions& options_;
};

}  // namespace

void post_process(Network& network, const std::vector<Vec3>& positions,
                  const PostProcessingOptions& options) {
  PostProcessor(network, positions, options).run();
}

}  // namespace scanworld::sim
