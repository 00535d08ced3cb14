// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"
#include "thesis/labels.h"
#include "thesis/triangulation.h"
#include "thesis/walls.h"
#include "version.h"
#include "world/assemble.h"
#include "world/find_frame.h"

namespace scanworld {

namespace {

// Found surfaces with an area; labels follow them.
void drop_degenerate(std::vector<FoundSurface>& surfaces, std::vector<std::int32_t>& labels) {
  std::vector<std::int32_t> new_id(surfaces.size(), -1);
  std::vector<FoundSurface> kept;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].outer.size() < 3) continue;
    new_id[i] = static_cast<std::int32_t>(kept.size());
    kept.push_back(std::move(surfaces[i]));
  }
  surfaces = std::move(kept);
  for (std::int32_t& label : labels)
    if (label >= 0) label = new_id[static_cast<std::size_t>(label)];
}

double median_rms(const std::vector<FoundSurface>& surfaces) {
  std::vector<double> rms;
  for (const FoundSurface& s : surfaces) rms.push_back(s.support.rms);
  const auto middle = rms.begin() + static_cast<std::ptrdiff_t>(rms.size() / 2);
  std::nth_element(rms.begin(), middle, rms.end());
  return *middle;
}

// The stages of the thesis, by the names in its Table 4, and what comes after them.
std::vector<FoundSurface> find_surfaces(const PointCloud& cloud,
                                        const thesis::ThesisOptions& options,
                                        const Progress& progress, ReconstructResult& result) {
  using namespace thesis;
  StageLog log(result.report, progress, 11);
  const FilteredPoints filtered = log.run("Filtering", "points -> medians", cloud,
                                          [&] { return filter_points(cloud, options.filter); });
  const double delta = result.report.scale = filtered.delta;
  const KdTree tree = log.run("Building the tree", "medians -> nodes", filtered,
                              [&] { return KdTree(filtered.points); });
  const std::vector<Cluster> placed =
      log.run("Placing small clusters", "medians -> clusters", tree,
              [&] { return place_clusters(tree, delta, options.placing); });
  const std::vector<Cluster> walls =
      log.run("Spreading clusters", "clusters -> walls", placed,
              [&] { return spread_clusters(tree, delta, placed, options.spreading); });
  const auto fitted = log.run("Fitting to planes", "walls -> medians", walls,
                              [&] { return fit_to_planes(filtered.points, walls); });
  std::vector<Polygon> polygons = log.run("Finding polygons border", "medians -> vertices", fitted,
                                          [&] { return find_borders(fitted, walls); });
  polygons = log.run("Polygons vertices fitting", "vertices -> vertices", polygons,
                     [&] { return snap_vertices(polygons, walls, tree, delta, options.snapping); });
  polygons = log.run("Vertices reduction", "vertices -> vertices", polygons,
                     [&] { return reduce_vertices(polygons, delta, options.reduction); });
  log.run("Triangulation", "vertices -> triangles", polygons,
          [&] { return triangulate(polygons, walls); });
  result.labels = log.run("Labelling points", "points -> points", cloud, [&] {
    return label_points(cloud, filtered, walls, tree, options.spreading.min_distance * delta);
  });
  return log.run("Describing walls", "walls -> surfaces", walls, [&] {
    return describe_walls(cloud, result.labels, filtered.points, delta, walls, polygons);
  });
}

}  // namespace

ReconstructResult reconstruct(const PointCloud& cloud, const ReconstructOptions& options,
                              const Progress& progress) {
  ReconstructResult result;
  std::vector<FoundSurface> surfaces = find_surfaces(cloud, options.thesis, progress, result);
  drop_degenerate(surfaces, result.labels);
  if (surfaces.empty())
    throw Error(
        Cause::nothing_found,
        fmt::format("no plane found in {} points (they were looked at in cubes of {:.3g} m)",
                    cloud.points.size(), result.report.scale));
  result.report.noise = median_rms(surfaces);
  result.world = assemble_world(surfaces, find_frame(cloud, surfaces));

  ReconstructOptions used = options;
  for (const Option& option : list_options(used))
    result.world.provenance.options[option.name] = option.value();
  result.world.provenance.options["method"] = "thesis";
  result.world.provenance.program = std::string("scanworld ") + version();
  return result;
}

OptionList list_options(ReconstructOptions& options) {
  return thesis::list_options(options.thesis);
}

const std::vector<std::string>& preset_names() {
  static const std::vector<std::string> names = {"indoor", "outdoor", "rgbd", "fast"};
  return names;
}

std::string preset_for(const PointCloud& cloud) { return cloud.camera_frame ? "rgbd" : "indoor"; }

void apply_preset(ReconstructOptions& options, const std::string& preset) {
  thesis::FilterOptions& filter = options.thesis.filter;
  if (preset == "indoor") return;
  if (preset == "outdoor")
    filter.min_size = 0.2;
  else if (preset == "rgbd")
    filter.depth_step = 0.003;  // Kinect: 7 cm at 5 m
  else if (preset == "fast")
    filter.min_size = 0.1, filter.points_per_cube = 16;
  else
    throw Error(Cause::usage, fmt::format("there is no preset '{}'; there are {}", preset,
                                          fmt::join(preset_names(), ", ")));
}

}  // namespace scanworld
