// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "patches.h"

namespace scanworld::test {

using namespace surface;

int LabelledScan::add(const Vec3& corner, const Vec3& a, const Vec3& b, int plane, double noise) {
  if (plane < 0) {
    plane = static_cast<int>(planes.size());
    planes.push_back(plane_through(corner, a.cross(b).normalized()));
  }
  add_rectangle(cloud, corner, a, b, 0.02, noise, random_);
  labels.resize(cloud.points.size(), plane);
  return plane;
}

std::vector<Patch> LabelledScan::patches() const {
  std::vector<Patch> found = find_patches(cloud, members(), planes, 0.04);
  const PatchRays rays(found);
  return face_free_side(std::move(found), rays, cloud, members(), Vec3::UnitZ()).patches;
}

std::vector<Patch> LabelledScan::weighed_patches() const {
  const std::vector<Patch> found = patches();
  return weigh_gaps(found, lines_of(found, find_seams(found)), surroundings(), Vec3::UnitZ());
}

Surroundings LabelledScan::surroundings() const {
  Surroundings around = surroundings_of(cloud.points, labels);
  around.viewpoints = cloud.viewpoints;
  around.viewers = cloud.viewers;
  around.viewers = find_sole_viewers(around, PatchRays(patches()), cloud.viewpoints);
  return around;
}

float evidence_at(const Patch& patch, const Vec3& p) {
  return patch.evidence[patch.hit.find(patch.frame.to_plane(p)).value()];
}

Patch blank_patch(const Vec2& size, double cell) {
  Patch patch{.plane = {}, .frame = {Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()}};
  Raster& hit = patch.hit;
  hit.cell = cell;
  hit.width = static_cast<int>(size.x() / cell + 0.5);
  hit.height = static_cast<int>(size.y() / cell + 0.5);
  hit.bits.assign(static_cast<std::size_t>(hit.width * hit.height), 0);
  for (int y = 0; y < hit.height; ++y)
    for (int x = 0; x < hit.width; ++x) patch.middle.push_back(hit.middle(x, y));
  patch.evidence.assign(hit.bits.size(), -1);
  patch.covered = hit;
  return patch;
}

double area_of(const Arrangement& arrangement, const std::vector<int>& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 &p = arrangement.vertices[static_cast<std::size_t>(ring[i])],
               &q = arrangement.vertices[static_cast<std::size_t>(ring[(i + 1) % ring.size()])];
    sum += p.x() * q.y() - p.y() * q.x();
  }
  return sum / 2;
}

double area_of(const Arrangement& arrangement, const Arrangement::Cell& cell) {
  std::vector<int> ring;
  for (const auto& side : cell.sides) ring.push_back(side.from);
  return area_of(arrangement, ring);
}

CutLine line_through(const Vec2& p, const Vec2& q, int other) {
  const Vec3 from(p.x(), p.y(), 0), direction = (Vec3(q.x(), q.y(), 0) - from).normalized();
  CutLine line{.other = other, .line = {from, direction}};
  line.reach = {direction.dot(from), direction.dot(Vec3(q.x(), q.y(), 0))};
  line.seen = {line.reach};
  return line;
}

std::vector<CutLine> random_lines(int count, std::uint64_t seed) {
  Random random(seed);
  std::vector<CutLine> lines;
  for (int k = 0; k < count; ++k) {
    const auto any = [&] { return Vec2(random.uniform(0, 4), random.uniform(0, 3)); };
    const Vec2 p = any();
    lines.push_back(line_through(p, any(), k + 1));
  }
  return lines;
}

Patch random_patch(std::uint64_t seed) {
  Patch patch = blank_patch({4, 3}, 0.1);
  Random random(seed);
  for (float& e : patch.evidence) e = static_cast<float>(random.uniform(-1, 1));
  return patch;
}

}  // namespace scanworld::test
