// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "error.h"
#include "thesis/labels.h"
#include "thesis/triangulation.h"
#include "thesis/walls.h"
#include "version.h"
#include "world/assemble.h"

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

// A camera is pitched as it likes, so the largest surface that faces roughly against its y axis
// tells what is level.
Frame frame_of_scan(const PointCloud& cloud, const std::vector<FoundSurface>& surfaces) {
  constexpr double kMaxPitch = 0.87;  // [rad] 50 degrees
  Frame frame{.origin = cloud.origin};
  frame.assumed.push_back("coordinates are metres: the scan does not say otherwise");
  if (!cloud.camera_frame) {
    frame.assumed.push_back("up is +z: the scan does not say otherwise");
    return frame;
  }
  frame.up = -Vec3::UnitY();
  std::size_t most = 0;
  for (const FoundSurface& s : surfaces)
    if (-s.plane.normal.y() > std::cos(kMaxPitch) && s.support.points > most)
      most = s.support.points, frame.up = s.plane.normal;
  frame.assumed.push_back(
      most > 0 ? "up is the normal of the largest surface that faces against the camera's y axis: "
                 "the scan is "
                 "one image of a camera, in whose frame y points down"
               : "up is -y: the scan is one image of a camera, in whose frame y points down");
  return frame;
}

double median_rms(const std::vector<FoundSurface>& surfaces) {
  std::vector<double> rms;
  for (const FoundSurface& s : surfaces) rms.push_back(s.support.rms);
  const auto middle = rms.begin() + static_cast<std::ptrdiff_t>(rms.size() / 2);
  std::nth_element(rms.begin(), middle, rms.end());
  return *middle;
}

// The stages of the thesis, by the names in its Table 4.
std::vector<FoundSurface> find_surfaces(const PointCloud& cloud,
                                        const thesis::ThesisOptions& options,
                                        const Progress& progress, ReconstructResult& result) {
  using namespace thesis;
  StageLog stages(result.report, progress, 10);
  const FilteredPoints filtered = stages.run(
      "Filtering", "points -> medians", cloud.points.size(),
      [&] { return filter_points(cloud, options.filter); },
      [](const auto& f) { return f.points.size(); });
  const double delta = result.report.scale = filtered.delta;
  const KdTree tree = stages.run(
      "Building the tree", "medians -> nodes", filtered.points.size(),
      [&] { return KdTree(filtered.points); }, [](const auto& t) { return t.points().size(); });
  std::vector<Cluster> clusters =
      stages.run("Placing small clusters", "medians -> clusters", filtered.points.size(),
                 [&] { return place_clusters(tree, delta, options.placing); });
  clusters = stages.run("Spreading clusters", "clusters -> walls", clusters.size(), [&] {
    return spread_clusters(tree, delta, std::move(clusters), options.spreading);
  });
  const auto on_planes = stages.run("Fitting to planes", "walls -> walls", clusters.size(),
                                    [&] { return fit_to_planes(filtered.points, clusters); });
  const auto count_vertices = [](const std::vector<Polygon>& polygons) {
    std::size_t count = 0;
    for (const Polygon& p : polygons) count += p.size();
    return count;
  };
  std::vector<Polygon> polygons = stages.run(
      "Finding polygons border", "walls -> vertices", clusters.size(),
      [&] { return find_borders(on_planes, clusters); }, count_vertices);
  polygons = stages.run(
      "Polygons vertices fitting", "vertices -> vertices", count_vertices(polygons),
      [&] { return snap_vertices(polygons, clusters, tree, delta, options.snapping); },
      count_vertices);
  polygons = stages.run(
      "Vertices reduction", "vertices -> vertices", count_vertices(polygons),
      [&] { return reduce_vertices(std::move(polygons), delta, options.reduction); },
      count_vertices);
  stages.run(
      "Triangulation", "vertices -> triangles", count_vertices(polygons),
      [&] {
        std::size_t triangles = 0;
        for (std::size_t i = 0; i < polygons.size(); ++i)
          triangles += triangulate_convex(polygons[i], clusters[i].fit.plane.normal).size();
        return triangles;
      },
      [](std::size_t triangles) { return triangles; });
  return stages.run("Describing walls", "walls -> surfaces", clusters.size(), [&] {
    const double max_distance = options.spreading.min_distance * delta;
    result.labels = label_points(cloud, filtered, clusters, tree, max_distance);
    return describe_walls(cloud, result.labels, filtered.points, delta, clusters, polygons);
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
  result.world = assemble_world(surfaces, frame_of_scan(cloud, surfaces));

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
