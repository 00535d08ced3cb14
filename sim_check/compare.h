// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "robustness.h"
#include "speed.h"
#include "world/fidelity.h"

namespace scanworld::sim {

// What a world promises. Meshes are what worlds are held against; they promise nothing.
struct PromiseOptions {
  double lost_speed = 5;      // [m/s] up to which no robot is lost
  double speed_lost = 0.002;  // share of its speed that a cube loses, sliding over the floor
  double lidar = 0.03;        // [m] median error against the scan
  double budget = 0;          // [s] mean time of a contact test; 0: no limit
};

struct CompareOptions {
  PlaceOptions place;
  bool both = false;  // worlds twice: by their solids, and by their triangles
  std::string engine = "bullet";
  bool with_speed = true, with_robustness = true;
  double size = 0.1;  // [m] of robots
  std::uint64_t seed = 1;
  SpeedOptions speed;            // its size and seed are those above
  RobustnessOptions robustness;  // too
  PromiseOptions promises;
};

// One place.
struct Row {
  std::string name;
  Sort sort = Sort::mesh;
  Speed speed;
  Robustness robustness;                // of `plane` and `empty` nothing
  std::vector<Criterion> promises;      // of worlds
  std::vector<std::string> in_the_way;  // of a contact test within the budget, where it is broken
};

struct Comparison {
  CompareOptions options;
  std::size_t spots = 0;              // where robots stood
  std::size_t shared = 0;             // of these, where they stand free in all places
  std::vector<Row> rows;              // as given; then `plane` and `empty`
  std::vector<std::string> left_out;  // places that the engine does not take
  double load = 0;                    // of the machine, processes that wanted to run, at the end
  std::vector<std::string> noise;     // what says that the machine was too noisy to judge

  bool keeps_promises() const;
};

// Reads places, brings them together, and measures them in one run. With a scan, in its own
// coordinates, the places are held against it. Throws what the parts throw.
Comparison compare(const std::vector<std::filesystem::path>& paths, const PointCloud* scan,
                   const CompareOptions& options, const Progress& progress = {});

// The same of places that are read; what `align` does is done here.
Comparison compare(std::vector<Place> places, const PointCloud* scan, const CompareOptions& options,
                   const Progress& progress = {});

}  // namespace scanworld::sim
