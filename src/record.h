// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// What `reconstruct` notes for a replay on its way.
#pragma once

#include <optional>

#include "replay.h"
#include "rival/cluster.h"
#include "rival/local.h"
#include "space/space.h"
#include "surface/weld.h"
#include "thesis/polygons.h"
#include "thesis/spreading.h"
#include "world/world.h"

namespace scanworld {

// Makes a replay of clusterings of the same points, one after the other. One that is off does
// nothing.
class Recorder {
 public:
  explicit Recorder(bool is_on) : is_on_(is_on) {}
  bool is_on() const { return is_on_; }

  // What a method clusters, of which about so many are shown, evenly chosen. Clusters are drawn as
  // the outlines of their points in cells of this size [m], or where it is 0, as the method of 2012
  // does, by their convex border.
  void start(std::string method, std::vector<Vec3> points, double cell = 0,
             std::size_t shown = 20000);

  // Adds a step: the cluster of each point, -1 = none, and the planes of the clusters, each of
  // which is drawn. A cluster is the one of the step before that it has most points of.
  void add(std::string stage, std::string text, const std::vector<std::int32_t>& label,
           const std::vector<Plane>& planes);

  // Adds a step in which some points are marked but in no cluster yet.
  void mark(std::string stage, std::string text, const std::vector<std::int32_t>& label);

  // Adds a step in which the clusters of the last one are these polygons, each with its label.
  void add(std::string stage, std::string text, std::vector<ReplayLoop> loops);

  // The replay, its coordinates turned into a world's; `origin` is the cloud's.
  std::optional<Replay> finish(const Frame& frame, const Vec3& origin) &&;

 private:
  std::vector<int> find_ids(const std::vector<std::int32_t>& label, std::size_t clusters);
  std::vector<ReplayLoop> drawn(const std::vector<std::int32_t>& label,
                                const std::vector<Plane>& planes) const;

  const bool is_on_;
  double cell_ = 0;
  std::vector<Vec3> points_;
  std::vector<std::uint32_t> shown_;  // indices into points_
  std::vector<std::int32_t> now_;     // the cluster of each point, by its number in the replay
  std::vector<int> ids_;              // the numbers of the last step's labels
  int next_id_ = 0;
  Replay replay_;
};

// The default method: starts with the sites that clusters may grow from, and watches a stage.
void record_seeds(Recorder& recorder, const rival::Grid& grid,
                  const std::vector<rival::LocalPlane>& local);
rival::Observer watch(Recorder& recorder, std::string stage);

// The thesis: starts with the clusters as they are placed, in about ten steps; watches them spread;
// and the walls that they are in the end.
void record_placing(Recorder& recorder, const std::vector<Vec3>& points,
                    const std::vector<thesis::Cluster>& placed);
thesis::SpreadingObserver watch_spreading(Recorder& recorder, std::size_t points);
void record_walls(Recorder& recorder, std::size_t points,
                  const std::vector<thesis::Cluster>& walls);

// The cells that planes cut space into, by their facets: the largest of those that lie in planes
// with points, each by the patch with most points in its plane. And what the cut leaves of them:
// facets between what is free and what is solid, those of planes without points too.
std::vector<ReplayLoop> cells_of(const space::LabelledSpace& space, std::size_t most = 4000);
std::vector<ReplayLoop> free_sides_of(const space::LabelledSpace& space);

// Polygons, by the index of their plane or cluster.
std::vector<ReplayLoop> loops_of(const std::vector<surface::CornerPolygon>& polygons);
std::vector<ReplayLoop> loops_of(const std::vector<surface::Piece>& pieces);
std::vector<ReplayLoop> loops_of(const std::vector<thesis::Polygon>& polygons);
std::vector<ReplayLoop> loops_of(const std::vector<thesis::Polygon>& polygons,
                                 const std::vector<std::vector<std::array<int, 3>>>& triangles);

}  // namespace scanworld
