// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "world.h"

namespace scanworld {

struct CrackOptions {
  double same_line = 0.001;  // [m] edges that are nowhere farther apart run on one line
  double max_width = 0.005;  // [m] of a crack; what is farther apart is apart
};

// A place where two surfaces meet without sharing their vertices.
struct Crack {
  enum class Kind { t_junction, crack };
  Kind kind = Kind::crack;
  int surface = 0, other = 0;       // ids
  std::array<int, 2> edge{};        // of `surface`, by its vertices
  std::array<int, 2> other_edge{};  // of `other`
  int vertex = -1;                  // of a T-junction: of `other`, inside `edge`
  double width = 0, length = 0;     // [m] how far apart the edges run, at most, and how long
};

// Where surfaces that meet are not joined. Two surfaces meet where an edge of one runs alongside an
// edge of the other: over the whole stretch where they are side by side, and that is longer than
// twice their distance may be.
// - T-junction: edges on one line (`same_line`), and a vertex of one is inside the other, farther
//   than `same_line` from its ends.
// - Crack: edges nowhere farther apart than `max_width`, one of which no other surface shares, that
//   are not the same two vertices. The two faces of a thing that is thinner are no crack.
// No fault are: surfaces that cross or touch in a point; edges that end on the inside of a surface,
// as a table's leg on the floor; edges that part at an angle; edges of one surface. The world must
// be valid. In the order of the world's surfaces and edges; each vertex that a surface lacks once.
std::vector<Crack> find_cracks(const World& world, const CrackOptions& options = {});

std::size_t count_of(const std::vector<Crack>& cracks, Crack::Kind kind);

// The fault in words.
std::string text_of(const Crack& crack);

}  // namespace scanworld
