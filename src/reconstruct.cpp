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
void drop_degenerate(std::vector<FoundSurface>& surfaces, ReconstructResult& result) {
  std::vector<std::int32_t> new_id(surfaces.size(), -1);
  std::vector<FoundSurface> kept;
  std::vector<double> noise;
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    if (surfaces[i].outer.size() < 3) continue;
    new_id[i] = static_cast<std::int32_t>(kept.size());
    kept.push_back(std::move(surfaces[i]));
    if (!result.report.plane_noise.empty()) noise.push_back(result.report.plane_noise[i]);
  }
  surfaces = std::move(kept);
  result.report.plane_noise = std::move(noise);
  for (std::int32_t& label : result.labels)
    if (label >= 0) label = new_id[static_cast<std::size_t>(label)];
}

double median_rms(const std::vector<FoundSurface>& surfaces) {
  std::vector<double> rms;
  for (const FoundSurface& s : surfaces) rms.push_back(s.support.rms);
  const auto middle = rms.begin() + static_cast<std::ptrdiff_t>(rms.size() / 2);
  std::nth_element(rms.begin(), middle, rms.end());
  return *middle;
}

// A scan with more than this is hardly one in metres.
constexpr double kLargestNoise = 0.3, kLargestSpacing = 1.5;  // [m]

// What the polygons are made of: points, the walls that they are in, and the length to measure by.
struct Walls {
  std::vector<Vec3> points;
  std::vector<thesis::Cluster> clusters;
  double delta = 0;  // [m]
};

// The last stages of the thesis, which make the polygons for both methods.
std::vector<FoundSurface> make_polygons(const PointCloud& cloud, const Walls& walls,
                                        const thesis::KdTree& tree,
                                        const std::vector<std::int32_t>& labels,
                                        const thesis::ThesisOptions& options, StageLog& log) {
  using namespace thesis;
  const auto fitted = log.run("Fitting to planes", "walls -> points", walls.clusters,
                              [&] { return fit_to_planes(walls.points, walls.clusters); });
  std::vector<Polygon> polygons = log.run("Finding polygons border", "points -> vertices", fitted,
                                          [&] { return find_borders(fitted, walls.clusters); });
  polygons = log.run("Polygons vertices fitting", "vertices -> vertices", polygons, [&] {
    return snap_vertices(polygons, walls.clusters, tree, walls.delta, options.snapping);
  });
  polygons = log.run("Vertices reduction", "vertices -> vertices", polygons,
                     [&] { return reduce_vertices(polygons, walls.delta, options.reduction); });
  log.run("Triangulation", "vertices -> triangles", polygons,
          [&] { return triangulate(polygons, walls.clusters); });
  return log.run("Describing walls", "walls -> surfaces", walls.clusters, [&] {
    return describe_walls(cloud, labels, walls.points, walls.delta, walls.clusters, polygons);
  });
}

std::size_t count_of(const Walls& walls) { return walls.points.size(); }

// The planes as walls, their sites thinned: each 2 x 2 x 2 voxels have one point for each plane.
Walls walls_of(const rival::Grid& grid, const rival::Clustering& clusters,
               const rival::LabelledPoints& labelled) {
  Walls walls;
  walls.delta = 1.5 * grid.voxel;
  for (const rival::LabelledPlane& p : labelled.planes)
    walls.clusters.push_back({{}, {p.fit.centroid, p.fit.plane}});
  struct Thinned {
    std::uint32_t cell;
    std::int32_t plane;
    Vec3 sum;
    int sites;
  };
  std::vector<Thinned> here;
  const auto finish = [&] {
    for (const Thinned& t : here) {
      walls.clusters[static_cast<std::size_t>(t.plane)].members.push_back(
          static_cast<int>(walls.points.size()));
      walls.points.push_back(t.sum / t.sites);
    }
    here.clear();
  };
  for (std::size_t i = 0; i < grid.sites.size(); ++i) {
    const std::int32_t l = clusters.label[i];
    const std::int32_t plane =
        l == rival::kNone ? l : labelled.plane_of[static_cast<std::size_t>(l)];
    if (plane == rival::kNone) continue;
    constexpr std::uint32_t kHalf = ~0b001001001u;  // drops the lowest bit of x, y and z
    const std::uint32_t cell = grid.sites[i].voxel & kHalf;
    if (!here.empty() && here.back().cell >> 9 != cell >> 9) finish();
    auto at = std::find_if(here.begin(), here.end(),
                           [&](const Thinned& t) { return t.cell == cell && t.plane == plane; });
    if (at == here.end()) at = here.insert(here.end(), {cell, plane, Vec3::Zero(), 0});
    at->sum += grid.sites[i].position();
    ++at->sites;
  }
  finish();
  return walls;
}

// The stages of the thesis, by the names in its Table 4, and what comes after them.
std::vector<FoundSurface> find_by_thesis(const PointCloud& cloud,
                                         const thesis::ThesisOptions& options, StageLog& log,
                                         ReconstructResult& result) {
  using namespace thesis;
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
  result.labels = log.run("Labelling points", "points -> points", cloud, [&] {
    return label_points(cloud, filtered, walls, tree, options.spreading.min_distance * delta);
  });
  return make_polygons(cloud, {filtered.points, walls, delta}, tree, result.labels, options, log);
}

// Turns surfaces to the side that most of their points' normals point to.
void face_normals(const PointCloud& cloud, const std::vector<std::int32_t>& labels,
                  std::vector<FoundSurface>& surfaces) {
  std::vector<std::int64_t> along(surfaces.size());
  for (std::size_t i = 0; i < labels.size(); ++i) {
    if (labels[i] < 0) continue;
    const auto l = static_cast<std::size_t>(labels[i]);
    along[l] += cloud.normals[i].cast<double>().dot(surfaces[l].plane.normal) > 0 ? 1 : -1;
  }
  for (std::size_t k = 0; k < surfaces.size(); ++k)
    if (along[k] < 0) {
      surfaces[k].plane = surfaces[k].plane.flipped();
      std::reverse(surfaces[k].outer.begin(), surfaces[k].outer.end());
    }
}

// The default method, docs/method.md.
std::vector<FoundSurface> find_by_rival(const PointCloud& cloud, const ReconstructOptions& all,
                                        StageLog& log, ReconstructResult& result) {
  using namespace rival;
  const RivalOptions& options = all.rival;
  const Scale scale = log.run("Estimating the scale", "points -> lengths", cloud,
                              [&] { return estimate_scale(cloud, options.scale); });
  result.report.scale = scale.voxel;
  result.report.spacing = scale.spacing;
  result.report.noise = scale.noise;
  if (scale.noise > kLargestNoise || scale.spacing > kLargestSpacing)
    result.report.warnings.push_back(fmt::format(
        "the noise is {:.3g} m and points are {:.3g} m apart: are the coordinates metres?",
        scale.noise, scale.spacing));
  Grid grid = log.run("Sorting into voxels", "points -> sites", cloud,
                      [&] { return build_grid(cloud, scale.voxel); });
  Neighbors neighbors = log.run("Finding neighbours", "sites -> sites", grid,
                                [&] { return find_neighbors(grid, options.neighbors); });
  std::vector<LocalPlane> local = log.run("Fitting locally", "sites -> sites", grid, [&] {
    return fit_locally(grid, neighbors, scale, options.local);
  });
  grid = log.run("Parting sides", "sites -> sites", grid, [&] {
    return part_sides(cloud, std::move(grid), neighbors, local, scale, options.sides);
  });
  local = log.run("Fitting sides", "sites -> sites", grid, [&] {
    std::vector<std::uint8_t> changed;
    neighbors = update_neighbors(grid, options.neighbors, std::move(neighbors), changed);
    return fit_locally(grid, neighbors, scale, options.local, std::move(local), changed);
  });
  Clustering clusters = log.run("Growing clusters", "sites -> clusters", local, [&] {
    return grow_clusters(grid, neighbors, scale, local, {}, options.growth);
  });
  clusters = log.run("Rivalry", "clusters -> clusters", clusters, [&] {
    return settle(grid, neighbors, scale, local, std::move(clusters), options);
  });
  clusters = log.run("Parting and bridging", "clusters -> clusters", clusters, [&] {
    return part(grid, neighbors, scale, local, std::move(clusters), options);
  });
  clusters = log.run("Weighing evidence", "clusters -> clusters", clusters, [&] {
    return confirm(grid, neighbors, scale, local, std::move(clusters), options);
  });
  clusters = log.run("Regularising", "clusters -> clusters", clusters,
                     [&] { return regularise(scale, std::move(clusters), options.regularise); });
  local = {};
  LabelledPoints labelled = log.run("Labelling points", "points -> planes", cloud, [&] {
    return label_points(cloud, grid, neighbors, scale, clusters, options.labels);
  });
  result.labels = std::move(labelled.labels);
  for (const LabelledPlane& plane : labelled.planes)
    result.report.plane_noise.push_back(plane.noise);
  const Walls walls = log.run("Thinning sites", "sites -> points", grid,
                              [&] { return walls_of(grid, clusters, labelled); });
  const thesis::KdTree tree = log.run("Building the tree", "points -> nodes", walls,
                                      [&] { return thesis::KdTree(walls.points); });
  std::vector<FoundSurface> surfaces =
      make_polygons(cloud, walls, tree, result.labels, all.thesis, log);
  if (!cloud.normals.empty()) face_normals(cloud, result.labels, surfaces);
  return surfaces;
}

}  // namespace

ReconstructResult reconstruct(const PointCloud& cloud, const ReconstructOptions& options,
                              const Progress& progress) {
  ReconstructResult result;
  StageLog log(result.report, progress, options.method == Method::thesis ? 11 : 20);
  std::vector<FoundSurface> surfaces = options.method == Method::thesis
                                           ? find_by_thesis(cloud, options.thesis, log, result)
                                           : find_by_rival(cloud, options, log, result);
  drop_degenerate(surfaces, result);
  if (surfaces.empty())
    throw Error(
        Cause::nothing_found,
        fmt::format("no plane found in {} points (they were looked at in cubes of {:.3g} m)",
                    cloud.points.size(), result.report.scale));
  if (result.report.noise == 0) result.report.noise = median_rms(surfaces);
  result.world = assemble_world(surfaces, find_frame(cloud, surfaces));

  ReconstructOptions used = options;
  for (const Option& option : list_options(used))
    result.world.provenance.options[option.name] = option.value();
  result.world.provenance.options["method"] = name_of(options.method);
  result.world.provenance.program = std::string("scanworld ") + version();
  return result;
}

Method method_named(const std::string& name) {
  for (Method method : {Method::rival, Method::thesis})
    if (name == name_of(method)) return method;
  throw Error(Cause::usage, fmt::format("there is no method '{}'; there are rival, thesis", name));
}

const char* name_of(Method method) { return method == Method::thesis ? "thesis" : "rival"; }

OptionList list_options(ReconstructOptions& options) {
  OptionList list = rival::list_options(options.rival);
  const OptionList more = thesis::list_options(options.thesis);
  list.insert(list.end(), more.begin(), more.end());
  return list;
}

const std::vector<std::string>& preset_names() {
  static const std::vector<std::string> names = {"indoor", "outdoor", "rgbd", "fast"};
  return names;
}

std::string preset_for(const PointCloud& cloud) { return cloud.camera_frame ? "rgbd" : "indoor"; }

void apply_preset(ReconstructOptions& options, const std::string& preset) {
  thesis::FilterOptions& filter = options.thesis.filter;
  rival::RivalOptions& rival = options.rival;
  if (preset == "indoor") return;
  if (preset == "outdoor")
    filter.min_size = 0.2, rival.scale.min_voxel = 0.1, rival.evidence.min_area = 0.5;
  else if (preset == "rgbd")
    // A Kinect's step is 7 cm at 5 m, its noise about half of that.
    filter.depth_step = 0.003, rival.scale.depth_step = 0.0015, rival.scale.min_voxel = 0.02;
  else if (preset == "fast")
    filter.min_size = 0.1, filter.points_per_cube = 16, rival.scale.voxel_per_spacing = 2,
    rival.scale.min_voxel = 0.06;
  else
    throw Error(Cause::usage, fmt::format("there is no preset '{}'; there are {}", preset,
                                          fmt::join(preset_names(), ", ")));
}

}  // namespace scanworld
