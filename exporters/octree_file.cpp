// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "octree_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "files.h"
#include "occupancy_grid.h"

namespace scanworld {

namespace {

// What free and occupied are read as.
const float kFree = log_odds_of(OccupancyOptions{}.lowest);
const float kOccupied = log_odds_of(OccupancyOptions{}.highest);

// What a node says of each of its children in a binary file.
constexpr std::uint16_t kFreeBits = 1, kOccupiedBits = 2, kInnerBits = 3;

std::uint16_t bits_of(const OctreeNode& child) {
  switch (child.is) {
    case OctreeNode::Is::unknown:
      return 0;
    case OctreeNode::Is::leaf:
      return child.log_odds < 0 ? kFreeBits : kOccupiedBits;
    case OctreeNode::Is::inner:
      return kInnerBits;
  }
  return 0;
}

constexpr std::size_t kBinaryHead = 2;                   // bytes: two bits a child
constexpr std::size_t kLogOddsHead = sizeof(float) + 1;  // bytes: the value, and a bit a child

}  // namespace

OctreeNode OctreeNodes::add_leaf(float log_odds) {
  if (kind_ == OctreeKind::binary) {
    log_odds = log_odds < 0 ? kFree : kOccupied;
  } else {
    bytes_.append(reinterpret_cast<const char*>(&log_odds), sizeof(log_odds));
    bytes_.push_back(0);  // no children
  }
  ++count_;
  return {OctreeNode::Is::leaf, log_odds};
}

std::size_t OctreeNodes::open() {
  const std::size_t at = bytes_.size();
  bytes_.resize(at + (kind_ == OctreeKind::binary ? kBinaryHead : kLogOddsHead));
  return at;
}

OctreeNode OctreeNodes::close(std::size_t opened, const std::array<OctreeNode, 8>& children) {
  using Is = OctreeNode::Is;
  const bool is_uniform = std::all_of(children.begin(), children.end(), [&](const OctreeNode& c) {
    return c.is != Is::inner && c.is == children[0].is && c.log_odds == children[0].log_odds;
  });
  if (is_uniform) {
    bytes_.resize(opened);
    if (children[0].is == Is::unknown) return {};
    count_ -= children.size();
    return add_leaf(children[0].log_odds);
  }

  std::uint16_t bits = 0;
  std::uint8_t exists = 0;
  float greatest = std::numeric_limits<float>::lowest();
  for (std::size_t k = 0; k < children.size(); ++k) {
    if (children[k].is == Is::unknown) continue;
    bits = static_cast<std::uint16_t>(bits | bits_of(children[k]) << 2 * k);
    exists = static_cast<std::uint8_t>(exists | 1 << k);
    greatest = std::max(greatest, children[k].log_odds);
  }
  char* head = bytes_.data() + opened;
  if (kind_ == OctreeKind::binary) {
    head[0] = static_cast<char>(bits & 0xff), head[1] = static_cast<char>(bits >> 8);
  } else {
    std::memcpy(head, &greatest, sizeof(greatest));
    head[sizeof(greatest)] = static_cast<char>(exists);
  }
  ++count_;
  return {Is::inner, greatest};
}

void OctreeNodes::append(const OctreeNodes& subtree) {
  bytes_ += subtree.bytes_;
  count_ += subtree.count_;
}

void OctreeNodes::write(const std::filesystem::path& path, double resolution,
                        const Frame& frame) const {
  const Vec3& o = frame.origin;
  const auto& q = frame.rotation.coeffs();
  OutputFile file(path);
  file.write(fmt::format(
      "{}\n# by scanworld, in metres\n# in the scan: rotation {} {} {} {}, origin {} {} {}\n"
      "id OcTree\nsize {}\nres {}\ndata\n",
      kind_ == OctreeKind::binary ? "# Octomap OcTree binary file" : "# Octomap OcTree file", q[0],
      q[1], q[2], q[3], o.x(), o.y(), o.z(), count_, resolution));
  file.write(bytes_);
  file.commit();
}

}  // namespace scanworld
