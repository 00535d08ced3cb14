// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Whether robots can trust a place: a fast world that they fall out of is worth nothing.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "mesh_rays.h"
#include "progress.h"
#include "simulation.h"
#include "spots.h"

namespace scanworld::sim {

struct RobustnessOptions {
  double size = 0.1;                          // [m] of cubes and balls
  std::size_t robots = 200;                   // that are driven against the walls
  double seconds = 4;                         // [s] that they are
  std::vector<double> speeds = {1, 2, 5, 8};  // [m/s]
  std::vector<double> rates = {60, 240};      // [Hz] of steps
  double push = 30;                           // [m/s2] with which they are driven
  std::size_t lanes = 8;                      // that a cube slides and a ball rolls along
  double lane = 1.5;                          // [m] of each
  double width = 0.5;                         // [m] of the robot that goes through doors
  double height = 0.5;                        // [m] of it
  double margin = 0.02;                       // [m] by which a door must be wider than it, at least
  std::size_t walls = 300;                    // places on walls where one tries to go through
  double wheelbase = 0.3;                     // [m] narrower gaps in the floor catch wheels
  double cell = 0.02;                         // [m] that the floor is looked at in
  std::size_t rays = 5000;                    // of the scan that lidar is held against
  std::uint64_t seed = 1;
};

// Robots driven at a speed, and how many went through a surface.
struct Lost {
  double speed = 0, rate = 0;
  std::size_t robots = 0;
  std::vector<Vec3> at;  // where the lost ones last were right
};

// Of a body that moves at 1 m/s over a level floor, without friction.
struct Glide {
  double speed_lost = 0;  // share, the mean over the lanes
  double bump = 0;        // [m/s] the fastest up or down
};

struct Doors {
  std::size_t wide = 0, passed = 0;  // doors wide enough, and of these those that let it through
  std::vector<int> blocked;          // ids of the openings that do not
  std::size_t narrow = 0;
  std::size_t walls = 0, walls_open = 0;  // places on walls, and those that a box goes through
};

// Gaps in the floor, narrower than a wheelbase, between places where robots can drive.
struct FloorGap {
  Vec3 at = Vec3::Zero();  // one place in it
  double area = 0;         // [m2]
};
struct FloorGaps {
  double drivable = 0;         // [m2] that was looked at
  double area = 0;             // [m2] of all gaps
  std::vector<FloorGap> gaps;  // the largest first
};

// Of ranges that a scan has, against the engine's [m].
struct LidarError {
  std::size_t rays = 0;
  double median = 0, p95 = 0;
  double missed = 0;  // share of the rays that meet nothing
};

struct Robustness {
  std::vector<Lost> lost;
  std::size_t lanes = 0;
  Glide cube, ball;
  std::optional<Doors> doors;  // where a world tells of doors and the engine has sweeps
  FloorGaps floor;
  std::optional<LidarError> lidar;  // where there is a scan with scanner positions
};

// Doors and walls are a world's own, and for meshes those of the reference (spots.h) where that is
// a world; the scan, if any, is in the places' coordinates.
std::vector<Robustness> measure_robustness(const std::vector<Place>& places, const Spots& spots,
                                           const EngineMaker& engine, const PointCloud* scan,
                                           const RobustnessOptions& options,
                                           const Progress& progress = {});

// Its parts, each for one place; `seen` is what is seen of it, ready for rays.
Lost drive_at(const Place& place, const MeshRays& seen, const Spots& spots,
              const EngineMaker& engine, double speed, double rate,
              const RobustnessOptions& options);
Glide glide(const Place& place, const std::vector<Lane>& lanes, const EngineMaker& engine,
            RobotKind kind, const RobustnessOptions& options);
Doors go_through(const World& truth, Simulation& simulation, const RobustnessOptions& options);
FloorGaps find_floor_gaps(const Place& place, const Spots& spots, const PointCloud* scan,
                          const RobustnessOptions& options);
LidarError compare_lidar(Simulation& simulation, const PointCloud& scan,
                         const RobustnessOptions& options);

}  // namespace scanworld::sim
