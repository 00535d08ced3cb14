// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// How true a world is to a scan of it. docs/fidelity.md says what each figure means.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "doubled.h"
#include "floor_quality.h"
#include "sight_lines.h"
#include "stray_surfaces.h"
#include "world.h"

namespace scanworld {

struct FidelityOptions {
  // What the scan is like; to be measured on the scan, not on the world.
  double noise = 0.01;    // [m] standard deviation of the points off what they were measured on
  double spacing = 0.02;  // [m] between neighbouring points
  double depth_step = 0;  // [1/m] a depth camera's noise is at least this times range squared

  // What counts as near.
  double tolerance_per_noise = 4;  // a point on a surface is hardly ever farther from it than three
                                   // times the noise, and the surface may be off by as much as one
  double min_tolerance = 0.01;     // [m] nobody minds so little
  double max_tolerance = 0.05;     // [m] however noisy or bent the scan is; only a depth camera's
                                   // noise, which is known beforehand, may be more
  double max_bend = 0.02;          // [m] of surfaces that are one; more is not their own
  double reach = 0.1;  // [m] points that are no farther from the surface that is nearest to them
                       // tell whether it is in its place; at least three times the tolerance
  double cover_per_spacing = 4;  // a place is covered if a point is so near; far from the scanner
                                 // points are some times farther apart than in the middle
  double max_distance = 0.5;     // [m] what is farther apart counts as this far; at least twice as
                                 // far as what is covered

  // How much is looked at.
  std::size_t points = 100000;   // of the scan, about
  std::size_t places = 20000;    // on the surfaces, about
  std::size_t places_each = 16;  // at least, on each surface

  // Rays from the scanners.
  double before = 0.1;           // [m] free space ends so far before a point
  double behind = 0.2;           // [m] a surface at a point is met at the latest so far behind it
  double min_range = 0.3;        // [m] of points whose rays tell of free space
  double max_incidence = 1.309;  // [rad] off a surface's normal (75 degrees): beyond, a centimetre
                                 // of noise would decide
  double planar_cell = 0.4;  // [m] points that no surface explains lie on one where they are planar
                             // over so much; round things of half a metre are not

  // What else is looked at.
  FloorQualityOptions floors;
  StrayOptions strays;
  DoubledOptions doubled;

  // The limits of the verdict.
  double max_median_per_noise = 1.5;  // of the distance scan to world; 0.67 where all is right
  double max_unexplained = 0.05;      // share of the points; strays and mixed pixels are some 2 %
  double min_coverage = 0.9;          // share of the area; furniture hides some of a room
  double max_offset_per_tolerance = 0.5;  // of a surface from where most of its points are
  std::size_t min_points_each = 30;       // of a surface whose place is judged
  double max_violations = 0.01;           // share of the rays
  double max_leaks = 0.02;                // share of the rays
  double min_close = 0.7;      // share of the points within the tolerance that are within half of
                               // it; 0.5 where points are everywhere, 0.95 of those of a surface
  double max_inside = 0.15;    // share of the points: things are seen from outside
  double max_pieces = 2;       // of a floor, by the started 100 m2
  double max_steps = 5;        // [m] small ones, by 100 m2 of floor: thresholds, and carpets' edges
  double max_gaps = 0.01;      // share of the floors' area
  double max_floating = 0.05;  // share of the surfaces' area
  double max_crossings = 0.01;  // share of the edges' length
  double max_doubled = 0.2;     // share of the surfaces' area in two layers
  double max_flat = 0.05;       // share of the points that are flat, and on no surface
};

// Of distances between a scan and a world [m], up to Fidelity::max_distance.
struct Distances {
  double median = 0, p95 = 0;
};

// How a surface lies among the points that are nearest to it and within reach.
struct SurfaceFidelity {
  int id = 0;
  double area = 0;         // [m2]
  std::size_t points = 0;  // of those that were looked at
  double rms = 0;          // [m] of their distances
  double offset = 0;  // [m] of where most of them are, to the free side; zero where there are none
  std::optional<double> coverage;  // share of the area that has points near; not of inferred ones
};

// Where a scan and a world differ, place by place, in the world's axes.
struct ErrorAtlas {
  struct Point {
    Vec3 at;
    double distance = 0;     // [m] to the surface or obstacle nearest to it, 0 inside an obstacle
    int surface = -1;        // index into World::surfaces of the one that explains it; -1 = none
    bool explained = false;  // it is within the tolerance of a surface or an obstacle
  };
  std::vector<Point> points;  // that were looked at; the first n are an even choice too
  std::vector<Violation> violations;
  std::vector<Leak> leaks;
};

// One thing that a world must keep to be called faithful.
struct Criterion {
  std::string name, unit;       // "m" and "%" are told in mm and per cent, others as they are, and
                                // a count has none
  std::optional<double> value;  // nothing where it could not be measured
  double limit = 0;
  bool is_minimum = false;   // else the limit is a maximum
  std::string lacking = {};  // without which it cannot be measured, in words

  bool is_met() const { return !value || (is_minimum ? *value >= limit : *value <= limit); }
};

// A figure in the unit of a criterion, in words: lengths in millimetres, shares as per cent.
std::string figure_text(double value, const std::string& unit);

struct Fidelity {
  std::size_t points = 0, places = 0, rays = 0;  // that were looked at
  double noise = 0, spacing = 0;  // [m] as given; of a depth camera's points the median noise
  double bend = 0;                // [m] how far surfaces are off planes by themselves
  double tolerance = 0;           // [m] at this noise and bend
  double max_distance = 0;        // [m] as used
  Distances scan_to_world, world_to_scan;
  double measured_area = 0, inferred_area = 0;  // [m2] of the surfaces; inferred parts are judged
                                                // by free space alone
  double coverage = 0;     // share of the measured area that has points near
  double unexplained = 0;  // share of the points farther than the tolerance from all there is
  double close = 0;   // share of the points within the tolerance of a surface that are within half
  double inside = 0;  // share of the points that are in obstacles, farther than the tolerance from
                      // all skins and surfaces
  double flat = 0;    // share of the points that lie in planes over planar_cell, but on no surface
  std::optional<double> doubled;  // share of the surfaces' area whose points lie in two layers
  std::optional<double> free_space_violations;  // share of the rays that go through the world
  std::optional<double> leaks;            // share of the rays that go on where they should end
  std::vector<SurfaceFidelity> surfaces;  // in the order of the world's
  std::vector<int> misplaced;             // ids of surfaces that are off their points
  FloorQuality floors;
  StraySurfaces strays;
  std::vector<Criterion> criteria;
  ErrorAtlas atlas;

  bool is_faithful() const;
};

inline std::size_t count_of(const Fidelity& fidelity) { return fidelity.criteria.size(); }

// Measures a valid world against a scan of it, whose viewpoints are used where it has some. The
// figures do not depend on the order of the points or the number of threads; of large scans a part
// is looked at that the points' coordinates choose. Throws bad_input where the scan is empty, or
// hardly a point of it is near the world: they are of different places.
Fidelity measure_fidelity(const World& world, const PointCloud& cloud,
                          const FidelityOptions& options = {});

}  // namespace scanworld
