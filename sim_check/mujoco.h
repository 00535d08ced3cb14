// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulation.h"

namespace scanworld::sim {

// A place in MuJoCo, with its own settings but for friction, which is the product here as in the
// other engines, where its own rule is the larger. Rays meet meshes of their own where a world has
// any. Finding contacts is all in `narrowphase`; `solver` is making and solving the equations.
// Throws usage naming a place whose triangles robots would touch: MuJoCo takes the convex hull of
// any mesh. Throws failure where MuJoCo gives up: where numbers grow without bound, or where there
// are more contacts than its tables can hold, some two thousand.
std::unique_ptr<Simulation> make_mujoco(const Place& place, const std::vector<Pose>& robots,
                                        const RobotOptions& robot, const EngineOptions& options);

}  // namespace scanworld::sim
