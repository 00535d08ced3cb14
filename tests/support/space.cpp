// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "space.h"

#include <optional>

namespace scanworld::test {

using namespace surface;

namespace {

// Whether a rectangle is between two places.
bool is_between(const RoomSide& side, const Vec3& from, const Vec3& to) {
  const Vec3 normal = side.a.cross(side.b).normalized();
  const double h0 = normal.dot(from - side.corner), h1 = normal.dot(to - side.corner);
  if ((h0 < 0) == (h1 < 0)) return false;
  const Vec3 p = from + (to - from) * (h0 / (h0 - h1)) - side.corner;
  const double s = p.dot(side.a) / side.a.squaredNorm(), t = p.dot(side.b) / side.b.squaredNorm();
  return s > 0 && s < 1 && t > 0 && t < 1;
}

}  // namespace

LabelledScan seen_from(const std::vector<RoomSide>& sides, const std::vector<Vec3>& viewpoints,
                       double lowest) {
  LabelledScan all;
  for (const RoomSide& side : sides) all.add(side.corner, side.a, side.b, -1, 0);
  LabelledScan seen = all;
  seen.cloud.points.clear(), seen.labels.clear();
  seen.cloud.viewpoints = viewpoints;
  Random random(11);
  for (std::size_t i = 0; i < all.cloud.points.size(); ++i) {
    const Vec3 p = all.cloud.points[i].cast<double>();
    for (std::size_t v = 0; v < viewpoints.size(); ++v) {
      const Vec3 way = p - viewpoints[v];
      if (way.z() < std::sin(lowest) * way.norm()) continue;
      bool is_hidden = false;
      for (std::size_t k = 0; k < sides.size() && !is_hidden; ++k)
        is_hidden = static_cast<int>(k) != all.labels[i] && is_between(sides[k], viewpoints[v], p);
      if (is_hidden) continue;
      const Vec3& normal = all.planes[static_cast<std::size_t>(all.labels[i])].normal;
      seen.cloud.points.push_back((p + 0.003 * random.gauss() * normal).cast<float>());
      seen.cloud.viewers.push_back(static_cast<std::int32_t>(v));
      seen.labels.push_back(all.labels[i]);
      break;
    }
  }
  return seen;
}

std::vector<RoomSide> room_sides() { return box_sides(Vec3::Zero(), kRoomSize, true); }

std::vector<RoomSide> table_room_sides() {
  std::vector<RoomSide> sides = room_sides();
  for (const RoomSide& side : box_sides(kTableTop.min(), kTableTop.sizes(), true))
    sides.push_back(side);
  return sides;
}

SpaceStages run_space(const LabelledScan& scan, const space::SpaceOptions& options) {
  const Members members = scan.members();
  const std::vector<Patch> patches = scan.patches();
  const PatchRays rays(patches);
  std::vector<Seam> seams = find_seams(patches);
  const auto lines = lines_of(patches, seams);
  Surroundings around = surroundings_of(scan.cloud.points, scan.labels);
  around.viewpoints = scan.cloud.viewpoints, around.viewers = scan.cloud.viewers;
  space::Outlook outlook = space::look_out(patches, rays, seams, around, 0.04, 0.003, options);
  std::vector<Patch> weighed = scan.weighed_patches();
  std::vector<SharedEdge> edges =
      share_edges(find_free_edges(scan.cloud, members, weighed, lines), weighed, seams);
  edges = move_to_reveals(std::move(edges), weighed, around);
  return {std::move(weighed), std::move(seams), std::move(edges), std::move(around),
          std::move(outlook)};
}

std::size_t patch_at(const std::vector<Patch>& patches, const Vec3& place, const Vec3& normal) {
  std::optional<std::size_t> found;
  for (std::size_t k = 0; k < patches.size(); ++k)
    if (std::abs(patches[k].plane.signed_distance(place)) < 0.02 &&
        patches[k].plane.normal.dot(normal) > 0.99 &&
        patches[k].covered.is_set(patches[k].frame.to_plane(place)))
      found = k;
  REQUIRE(found);
  return *found;
}

space::Evidence bare_evidence(const space::CellComplex& cells) {
  space::Evidence evidence;
  for (const space::CellFacet& facet : cells.facets())
    evidence.facets.push_back({.area = cells.area_of(facet)});
  evidence.cells.resize(cells.cells().size());
  for (std::size_t c = 0; c < evidence.cells.size(); ++c) {
    evidence.cells[c].volume = cells.volume_of(static_cast<int>(c));
    for (const int f : cells.cells()[c].facets)
      evidence.cells[c].around += evidence.facets[static_cast<std::size_t>(f)].area;
  }
  return evidence;
}

}  // namespace scanworld::test
