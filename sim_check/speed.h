// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// How fast places are to simulate in. docs/sim_check.md has the design of the benchmark.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "progress.h"
#include "simulation.h"
#include "spots.h"
#include "timing.h"

namespace scanworld::sim {

struct SpeedOptions {
  std::vector<std::size_t> robots = {1, 7, 50, 200};  // ascending
  std::vector<RobotKind> kinds = {RobotKind::cube, RobotKind::module};
  double size = 0.1;  // [m] of a robot
  double rate = 240;  // [Hz] of steps
  int rounds = 9;
  int warm_up = 120;     // steps, untimed
  int steps = 40;        // in a round
  double seconds = 0.4;  // [s] in a round, about, for each place and figure
  std::size_t probes = 200;
  std::uint64_t seed = 1;
};

// Steps with so many robots.
struct StepSpeed {
  RobotKind kind = RobotKind::cube;
  std::size_t robots = 0;
  Timing time;               // of a step
  Phases phases;             // [s] means, from steps of their own
  double contacts = 0;       // points, the mean
  std::size_t put_back = 0;  // robots that left the place
};

struct Speed {
  std::size_t triangles = 0, solids = 0;
  double area = 0;                             // [m2] of the triangles
  double load_seconds = 0, build_seconds = 0;  // file to memory, memory to engine
  double memory = 0;                           // [bytes] that the engine takes for the place
  std::vector<StepSpeed> steps;
  Timing collide;  // of detection alone, at poses that all places share
  std::size_t collide_contacts = 0;
  std::optional<Timing> contact, sweep;  // of one box; where the engine has such queries
  Timing lidar;                          // of a scan of 16 x 360 rays
};

// Measures all places, in turns. The ratios are to the first. Progress goes from 0 to 1.
std::vector<Speed> measure_speed(const std::vector<Place>& places, const Spots& spots,
                                 const EngineMaker& engine, const SpeedOptions& options,
                                 const Progress& progress = {});

}  // namespace scanworld::sim
