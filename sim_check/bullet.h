// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulation.h"

namespace scanworld::sim {

// A place in Bullet, in single precision, as Debian builds it. A world's solids are static bodies,
// and rays meet a mesh of their own (exporters/bullet.h); a mesh is a btBvhTriangleMeshShape, of as
// many parts as its number of triangles asks for. Parts have 2,097,151 triangles at most.
std::unique_ptr<Simulation> make_bullet(const Place& place, const std::vector<Pose>& robots,
                                        const RobotOptions& robot, const EngineOptions& options);

}  // namespace scanworld::sim
