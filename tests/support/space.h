// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Places of rectangles as scanners see them, and the stages of labelled space.
#pragma once

#include "meshes.h"
#include "patches.h"
#include "space/space.h"

namespace scanworld::test {

constexpr double kLowestSeen = -65 * kDegree;  // elevation that a scanner sees down to

// The points of rectangles that a scanner at one of the viewpoints sees, as LabelledScan has them:
// not what is behind others, nor what is below its field of view.
LabelledScan seen_from(const std::vector<RoomSide>& sides, const std::vector<Vec3>& viewpoints,
                       double lowest = kLowestSeen);

// A room from the origin, 4 m by 3 m, 2.5 m high: ceiling, walls at y = 0, y = 3, x = 0 and x = 4,
// floor.
inline const Vec3 kRoomSize(4, 3, 2.5);
inline const Vec3 kScanner(1, 1.5, 1.5);  // where its scanner is
std::vector<RoomSide> room_sides();

// The room with a table top over its floor, 4 cm thick and against no wall.
inline const Box3 kTableTop(Vec3(2, 1, 0.7), Vec3(3.2, 1.8, 0.74));
std::vector<RoomSide> table_room_sides();

// What the stages make of a scan, up to where space is cut.
struct SpaceStages {
  std::vector<surface::Patch> patches;
  std::vector<surface::Seam> seams;
  std::vector<surface::SharedEdge> edges;
  surface::Surroundings around;  // each point with its own viewer, where they are known
  space::Outlook outlook;

  space::SpaceInput input() const {
    return {patches, outlook.covers, seams, edges, Vec3::UnitZ(), 0.003};
  }
  std::vector<space::SpacePlane> planes() const {
    return space::planes_of_space(input(), outlook.sight, outlook.free);
  }
  space::LabelledSpace label(const space::SpaceOptions& options = {}) const {
    return space::label_space(input(), outlook, around.viewpoints, options);
  }
};

SpaceStages run_space(const LabelledScan& scan, const space::SpaceOptions& options = {});

// The patch that has points around a place and looks along `normal`; it must be there.
std::size_t patch_at(const std::vector<surface::Patch>& patches, const Vec3& place,
                     const Vec3& normal);

// The box of space of a complex, cut by planes through all of it, and its bare evidence.
space::Evidence bare_evidence(const space::CellComplex& cells);

}  // namespace scanworld::test
