// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>

#include "world/world.h"

namespace scanworld {

// The two kinds of file of OctoMap (those of liboctomap 1.9).
enum class OctreeKind {
  binary,   // .bt: a leaf is free or occupied
  log_odds  // .ot: every node has the logarithm of its odds to be occupied; inner ones the greatest
            // of their children
};

// A cube of the tree: nothing known of it, the same all over, or divided.
struct OctreeNode {
  enum class Is { unknown, leaf, inner } is = Is::unknown;
  float log_odds = 0;
};

// The nodes of a tree as the files have them, depth first. Eight leaves of one value become one
// leaf of their parent's size.
class OctreeNodes {
 public:
  explicit OctreeNodes(OctreeKind kind) : kind_(kind) {}

  // In a binary tree all that is as likely occupied as not, or more, is alike, and so is the rest.
  OctreeNode add_leaf(float log_odds);

  // Begins a node; then its children are added in the order of their index (x + 2y + 4z, each 0 for
  // the lower half); close() ends it and says what it has become.
  std::size_t open();
  OctreeNode close(std::size_t opened, const std::array<OctreeNode, 8>& children);

  // Adds the nodes of a subtree that was made apart.
  void append(const OctreeNodes& subtree);

  // The file of the tree whose root is all that was added; of none where nothing is known. Its
  // comment says how the tree lies in the coordinates of the scan. It appears whole or not at all.
  void write(const std::filesystem::path& path, double resolution, const Frame& frame) const;

 private:
  OctreeKind kind_;
  std::string bytes_;
  std::size_t count_ = 0;
};

}  // namespace scanworld
