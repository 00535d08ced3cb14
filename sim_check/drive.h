// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "simulation.h"

namespace scanworld::sim {

struct DriveOptions {
  double speed = 0.5;          // [m/s] at most
  double acceleration = 12;    // [m/s2] that the wheels, so to speak, can give
  double turn_every = 1;       // [s] each robot then goes another way
  bool at_full_speed = false;  // else at any speed up to the most
  std::uint64_t seed = 1;
};

// Poses for robots on these spots, each turned by chance. Their lower sides are `above` [m] over
// the floor.
std::vector<Pose> poses_on(const std::vector<Vec3>& spots, double size, std::uint64_t seed,
                           double above = 0);

// Drives robots at random over the floor. The commands depend on the seed and the time alone, so
// that robots in all places get the same. One that has fallen off the place or is a room's length
// outside of it is put back to its start.
class Driver {
 public:
  Driver(const Place& place, std::vector<Pose> starts, const RobotOptions& robot,
         const DriveOptions& options);

  // Before each step, of this length. Returns the robots that were put back.
  std::vector<std::size_t> drive(Simulation& simulation, double seconds);

  std::size_t put_back() const { return put_back_; }  // so many times so far

 private:
  std::vector<Pose> starts_;
  DriveOptions options_;
  double mass_, time_ = 0;
  Box3 box_;  // where robots can be
  std::size_t put_back_ = 0;
};

}  // namespace scanworld::sim
