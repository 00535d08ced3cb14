// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "simulation.h"

namespace scanworld::sim {

// A place in ODE, in double precision, with the settings of the Symbrion simulator: a hash space,
// 32 contacts a pair at most, ERP 0.8, CFM 1e-4; 20 iterations of dWorldQuickStep. Rays meet a mesh
// of their own where a world has one. ODE does not tell its broad from its narrow phase: finding
// contacts is all in `narrowphase`. Its balls meet triangles only from where their corners go
// counter-clockwise; all else meets both sides.
std::unique_ptr<Simulation> make_ode(const Place& place, const std::vector<Pose>& robots,
                                     const RobotOptions& robot, const EngineOptions& options);

}  // namespace scanworld::sim
