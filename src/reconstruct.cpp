// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "reconstruct.h"

#include <fmt/format.h>

#include <algorithm>

#include "error.h"
#include "find_surfaces.h"
#include "quantile.h"
#include "rival/curve_points.h"
#include "scan/distinct.h"
#include "thesis/labels.h"
#include "thesis/triangulation.h"
#include "thesis/walls.h"
#include "version.h"
#include "world/assemble.h"
#include "world/cloud_in_world.h"
#include "world/find_frame.h"
#include "world/glass.h"
#include "world/mend.h"
#include "world/obstacles.h"
#include "world/openings.h"

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
  result.labels = labels_by(new_id, std::move(result.labels));
}

double median_rms(const std::vector<FoundSurface>& surfaces) {
  std::vector<double> rms;
  for (const FoundSurface& s : surfaces) rms.push_back(s.support.rms);
  return median(std::move(rms));
}

// A scan with more than this is hardly one in metres.
constexpr double kLargestNoise = 0.3, kLargestSpacing = 1.5;  // [m]
constexpr double kManyDuplicates = 0.01;                      // of the points; fewer are no news

// The stages of the thesis, by the names in its Table 4, and what comes after them.
std::vector<FoundSurface> find_by_thesis(const PointCloud& cloud,
                                         const thesis::ThesisOptions& options, StageLog& log,
                                         ReconstructResult& result, Recorder& recorder) {
  using namespace thesis;
  const FilteredPoints filtered = log.run("Filtering", "points -> medians", cloud,
                                          [&] { return filter_points(cloud, options.filter); });
  const double delta = result.report.scale = filtered.delta;
  const KdTree tree = log.run("Building the tree", "medians -> nodes", filtered,
                              [&] { return KdTree(filtered.points); });
  const std::vector<Cluster> placed =
      log.run("Placing small clusters", "medians -> clusters", tree,
              [&] { return place_clusters(tree, delta, options.placing); });
  record_placing(recorder, filtered.points, placed);
  const std::vector<Cluster> walls =
      log.run("Spreading clusters", "clusters -> walls", placed, [&] {
        return spread_clusters(tree, delta, placed, options.spreading,
                               watch_spreading(recorder, filtered.points.size()));
      });
  record_walls(recorder, filtered.points.size(), walls);
  result.labels = log.run("Labelling points", "points -> points", cloud, [&] {
    return label_points(cloud, filtered, walls, tree, options.spreading.min_distance * delta);
  });
  const auto fitted = log.run("Fitting to planes", "walls -> points", walls,
                              [&] { return fit_to_planes(filtered.points, walls); });
  std::vector<Polygon> polygons = log.run("Finding polygons border", "points -> vertices", fitted,
                                          [&] { return find_borders(fitted, walls); });
  polygons = log.run("Polygons vertices fitting", "vertices -> vertices", polygons,
                     [&] { return snap_vertices(polygons, walls, tree, delta, options.snapping); });
  recorder.add("Final approximation", "vertices go to where planes meet", loops_of(polygons));
  polygons = log.run("Vertices reduction", "vertices -> vertices", polygons,
                     [&] { return reduce_vertices(polygons, delta, options.reduction); });
  recorder.add("Final approximation", "vertices on straight edges are dropped", loops_of(polygons));
  const auto triangles = log.run("Triangulation", "vertices -> triangles", polygons,
                                 [&] { return triangulate(polygons, walls); });
  recorder.add("Final approximation", "polygons become triangles", loops_of(polygons, triangles));
  return log.run("Describing walls", "walls -> surfaces", walls, [&] {
    return describe_walls(cloud, result.labels, filtered.points, delta, walls, polygons);
  });
}

// The voxels' points with their planes.
surface::Surroundings surroundings_of(const rival::Grid& grid, std::vector<std::int32_t> planes) {
  std::vector<Vec3f> sites;
  for (const rival::Site& site : grid.sites) sites.push_back(site.mean);
  surface::Surroundings around = surface::surroundings_of(std::move(sites), std::move(planes));
  around.viewers = grid.viewers;
  // No ray need have met a stray: a point alone and of no plane.
  for (std::size_t i = 0; i < around.viewers.size(); ++i)
    if (grid.sites[i].points == 1 && around.planes[i] < 0) around.viewers[i] = -1;
  return around;
}

// What planes say about up, by the number of their points.
std::vector<Facing> facings_of(const rival::Clustering& clustering) {
  std::vector<Facing> facings;
  for (const rival::Cluster& cluster : clustering.clusters)
    facings.push_back({cluster.fit.plane.normal, cluster.moments.n, cluster.moments.mean()});
  return facings;
}

// What a method finds.
struct Found {
  std::vector<FoundSurface> surfaces;
  surface::Surroundings around;
  std::vector<Curve> curves;
  NoiseMap noise = {};
};

// The lines of sight to what is around.
std::vector<SightLine> sight_lines_of(const surface::Surroundings& around,
                                      const CloudInWorld& place) {
  std::vector<SightLine> lines;
  for (std::size_t i = 0; i < around.viewers.size(); ++i)
    if (const std::int32_t v = around.viewers[i]; v >= 0)
      lines.push_back({place.to_world(around.viewpoints[static_cast<std::size_t>(v)]),
                       place.to_world(around.points[i].cast<double>())});
  return lines;
}

std::vector<Vec3> places_of(const surface::Surroundings& around, const CloudInWorld& place) {
  std::vector<Vec3> places;
  for (const Vec3f& p : around.points) places.push_back(place.to_world(p.cast<double>()));
  return places;
}

// The default method, docs/method.md.
Found find_by_rival(const PointCloud& cloud, const ReconstructOptions& all, StageLog& log,
                    ReconstructResult& result, Recorder& recorder) {
  using namespace rival;
  const RivalOptions& options = all.rival;
  Scale scale = log.run("Estimating the scale", "points -> lengths", cloud,
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
    return with_viewers(cloud,
                        part_sides(cloud, std::move(grid), neighbors, local, scale, options.sides));
  });
  local = log.run("Fitting sides", "sites -> sites", grid, [&] {
    std::vector<std::uint8_t> changed;
    neighbors = update_neighbors(grid, options.neighbors, std::move(neighbors), changed);
    return fit_locally(grid, neighbors, scale, options.local, std::move(local), changed);
  });
  record_seeds(recorder, grid, local);
  const auto grow = [&](const Observer& observe) {
    return grow_clusters(grid, neighbors, scale, local, {}, options.growth, observe);
  };
  Clustering clusters =
      log.run("Growing clusters", "sites -> clusters", local, [&] { return grow({}); });
  const Curves curves = log.run("Finding curves", "clusters -> curves", clusters, [&] {
    Curves found = find_curves(grid, neighbors, scale, local, clusters, options.curves);
    set_aside(found, grid, neighbors, local, clusters);
    return found;
  });
  scale.flatness = log.run("Measuring flatness", "clusters -> lengths", clusters, [&] {
    return find_flatness(grid, neighbors, scale, clusters, options);
  });
  result.report.flatness = scale.flatness.bend_at(1);
  // What is flat, and without curves, grows as it did; but a replay shows how.
  const bool is_as_before = scale.flatness.samples.empty() && curves.curves.empty();
  clusters = log.run("Growing on what bends", "sites -> clusters", local, [&] {
    return is_as_before && !recorder.is_on() ? std::move(clusters)
                                             : grow(watch(recorder, "Growth"));
  });
  const auto settle_all = [&] {
    return settle(grid, neighbors, scale, local, std::move(clusters), options,
                  watch(recorder, "Rivalry"));
  };
  clusters = log.run("Rivalry", "clusters -> clusters", clusters, settle_all);
  scale.flatness = log.run("Finding layers", "clusters -> lengths", clusters, [&] {
    const Layers layers = find_layers(grid, scale, clusters, options.layers);
    return allow_drift(scale.flatness, layers, options.layers);
  });
  result.report.drift = scale.flatness.drift;
  if (scale.flatness.drift > 0)
    result.report.warnings.push_back(fmt::format(
        "surfaces are there more than once, {:.3g} m apart: the registration drifts. What lies in "
        "layers and is seen from one side is taken for one surface",
        scale.flatness.drift));
  clusters = log.run("Rivalry amid drift", "clusters -> clusters", clusters,
                     [&] { return scale.flatness.drift > 0 ? settle_all() : std::move(clusters); });
  clusters = log.run("Parting and bridging", "clusters -> clusters", clusters, [&] {
    return part(grid, neighbors, scale, local, std::move(clusters), options,
                watch(recorder, "Parting and bridging"));
  });
  clusters = log.run("Weighing evidence", "clusters -> clusters", clusters, [&] {
    return confirm(grid, neighbors, scale, local, std::move(clusters), options,
                   watch(recorder, "Evidence"));
  });
  clusters = log.run("Finding rough surfaces", "clusters -> clusters", clusters, [&] {
    return find_rough(grid, neighbors, scale, std::move(clusters), options,
                      watch(recorder, "Evidence"));
  });
  const Vec3 up = find_frame(cloud, facings_of(clusters)).up;
  clusters = log.run("Joining floors", "clusters -> clusters", clusters, [&] {
    return join_floors(grid, scale, std::move(clusters), up, options.floors, options.merge,
                       options.bridge);
  });
  clusters = log.run("Regularising", "clusters -> clusters", clusters,
                     [&] { return regularise(scale, std::move(clusters), options.regularise); });
  clusters = log.run("Folding floors", "clusters -> clusters", clusters, [&] {
    return fold_floors(grid, scale, std::move(clusters), up, options.floors, options.merge,
                       options.bridge);
  });
  local = {};
  scale.local = log.run("Mapping noise", "clusters -> places", clusters, [&] {
    const std::vector<NoiseSample> samples = sample_noise(grid, clusters, cloud.viewpoints);
    result.report.noise_model = describe_noise(samples, cloud.viewpoints);
    return map_noise(grid, scale, samples);
  });
  LabelledPoints labelled = log.run("Labelling points", "points -> planes", cloud, [&] {
    return label_points(cloud, grid, neighbors, scale, clusters, options.labels);
  });
  labelled = log.run("Spreading floors", "planes -> planes", labelled, [&] {
    return spread_floors(cloud, grid, neighbors, std::move(labelled), up,
                         all.floor_tolerance + scale.noise);
  });
  result.labels = std::move(labelled.labels);
  for (const LabelledPlane& plane : labelled.planes)
    result.report.plane_noise.push_back(plane.noise);
  std::vector<Plane> planes;
  for (const LabelledPlane& plane : labelled.planes) planes.push_back(plane.fit.plane);
  recorder.add("Evidence", "planes are turned parallel and square where the points allow it",
               labelled.sites, planes);
  if (!curves.curves.empty())
    result.curve_labels = label_curve_points(cloud, grid, scale, curves, options.curves);
  const CutCurves round = cut_curves(cloud, curves.curves, all.surface.facets, planes, result);
  const double voxel = grid.voxel;
  const auto find_around = [&] {
    surface::Surroundings around = surroundings_of(grid, std::move(labelled.sites));
    for (std::size_t i = 0; i < around.planes.size(); ++i)
      if (const std::int32_t c = curves.of_site[i]; c != kNone)
        around.planes[i] = round.plane_of(c, grid.sites[i].position());
    grid = {}, neighbors = {};
    return around;
  };
  SurfacesInScan made =
      find_surfaces({cloud, planes, round, voxel, find_around}, all, log, result, recorder);
  return {std::move(made.surfaces), std::move(made.around), round.curves, std::move(scale.local)};
}

// Takes over a mended world: labels and what is told of each surface follow.
void take(Mended mended, ReconstructResult& result) {
  std::vector<std::int32_t> id_of(result.world.surfaces.size(), -1);
  std::vector<double> noise;
  for (std::size_t k = mended.from.size(); k-- > 0;)
    id_of[mended.from[k]] = mended.world.surfaces[k].id;
  if (!result.report.plane_noise.empty())
    for (const std::size_t from : mended.from) noise.push_back(result.report.plane_noise[from]);
  result.report.plane_noise = std::move(noise);
  result.labels = labels_by(id_of, std::move(result.labels));
  std::vector<std::string>& warnings = result.report.warnings;
  warnings.insert(warnings.end(), mended.warnings.begin(), mended.warnings.end());
  result.world = std::move(mended.world);
  if (result.world.surfaces.empty())
    throw Error(Cause::nothing_found, fmt::format("none of the {} surfaces found can be kept: {}",
                                                  id_of.size(), fmt::join(mended.warnings, "; ")));
}

// Adds ground that no floor fits; labels and what is told of each surface follow. Returns the id of
// the first facet.
std::int32_t add_ground(const CloudInWorld& cloud, const std::vector<Vec3>& places,
                        const std::vector<SightLine>& lines, const ReconstructOptions& options,
                        StageLog& log, ReconstructResult& result) {
  // What is nearer can't be told from noise.
  const double tolerance = std::max(options.floor_tolerance, 3 * result.report.noise);
  terrain::Ground found =
      log.run("Finding ground", "surfaces -> facets", result.world.surfaces, [&] {
        return terrain::find_ground(std::move(result.world), places, lines,
                                    {tolerance, result.report.spacing}, options.ground);
      });
  result.labels = label_ground(cloud, labels_by(found.new_id, std::move(result.labels)),
                               tolerance + 2 * result.report.noise, found);
  result.world = std::move(found.world);
  const auto first = static_cast<std::int32_t>(result.world.surfaces.size() - found.facets);
  if (result.report.plane_noise.empty()) return first;
  std::vector<double> noise;
  for (std::size_t i = 0; i < found.new_id.size(); ++i)
    if (found.new_id[i] >= 0) noise.push_back(result.report.plane_noise[i]);
  for (std::size_t i = noise.size(); i < result.world.surfaces.size(); ++i)
    noise.push_back(result.world.surfaces[i].support.rms);
  result.report.plane_noise = std::move(noise);
  return first;
}

// Adds what was not seen of flights of stairs; what is told of each surface follows.
void complete_stairs(const std::vector<SightLine>& lines, const ReconstructOptions& options,
                     StageLog& log, ReconstructResult& result) {
  result.world = log.run("Completing stairs", "surfaces -> surfaces", result.world.surfaces, [&] {
    return complete_stairs(std::move(result.world), lines, options.stairs, options.rooms.ways);
  });
  if (!result.report.plane_noise.empty())
    result.report.plane_noise.resize(result.world.surfaces.size());
}

// Adds the solids of what no surface explains.
void enclose_clutter(const PointCloud& cloud, NoiseMap noise, const ObstacleOptions& options,
                     StageLog& log, ReconstructResult& result) {
  const ClutterScale scale{result.report.noise, result.report.spacing, std::move(noise)};
  Obstacles obstacles = log.run("Enclosing clutter", "points -> obstacles", cloud, [&] {
    std::vector<std::int32_t> explained = result.labels;
    for (std::size_t i = 0; i < result.curve_labels.size(); ++i)
      if (result.curve_labels[i] >= 0) explained[i] = 0;
    return find_obstacles(cloud, explained, result.world, scale, options);
  });
  if (obstacles.left_out > 0)
    result.report.warnings.push_back(
        fmt::format("{} obstacles, the smallest, are left out: no more than {} are asked for",
                    obstacles.left_out, options.max_obstacles));
  std::vector<Obstacle>& all = result.world.obstacles;
  all.insert(all.end(), obstacles.kept.begin(), obstacles.kept.end());
  for (std::size_t k = 0; k < all.size(); ++k) all[k].id = static_cast<int>(k);
}

}  // namespace

ReconstructResult reconstruct(const PointCloud& scan, const ReconstructOptions& options,
                              const Progress& progress) {
  ReconstructResult result;
  Recorder recorder(options.record);
  StageLog log(result.report, progress,
               options.method == Method::thesis
                   ? 16
                   : 34 + options.space.is_on + options.ground.is_on + options.stairs.is_on);
  const DistinctPoints distinct = log.run("Merging duplicates", "points -> duplicates", scan,
                                          [&] { return find_distinct(scan); });
  const PointCloud& cloud = distinct.of(scan);
  result.report.duplicates = count_of(distinct);
  if (static_cast<double>(result.report.duplicates) >
      kManyDuplicates * static_cast<double>(scan.points.size()))
    result.report.warnings.push_back(
        fmt::format("{} of {} points are at the very place of another and count for nothing",
                    result.report.duplicates, scan.points.size()));
  Found found = options.method == Method::thesis
                    ? Found{find_by_thesis(cloud, options.thesis, log, result, recorder),
                            {.viewpoints = cloud.viewpoints},
                            {}}
                    : find_by_rival(cloud, options, log, result, recorder);
  drop_degenerate(found.surfaces, result);
  if (found.surfaces.empty())
    throw Error(
        Cause::nothing_found,
        fmt::format("no plane found in {} points (they were looked at in cubes of {:.3g} m)",
                    cloud.points.size(), result.report.scale));
  if (result.report.noise == 0) result.report.noise = median_rms(found.surfaces);
  result.world = assemble_world(found.surfaces, find_frame(cloud, facings_of(found.surfaces)));
  take(mend_surfaces(result.world), result);
  World& world = result.world;
  const CloudInWorld place(cloud, world.frame);
  std::vector<Vec3> places = places_of(found.around, place);
  std::vector<SightLine> lines = sight_lines_of(found.around, place);
  const std::int32_t first_facet = options.method == Method::rival && options.ground.is_on
                                       ? add_ground(place, places, lines, options, log, result)
                                       : static_cast<std::int32_t>(world.surfaces.size());
  if (options.method == Method::rival && options.stairs.is_on)
    complete_stairs(lines, options, log, result);
  world.openings = log.run("Finding openings", "surfaces -> openings", world.surfaces, [&] {
    FoundOpenings openings = find_openings(world, {lines, places});
    world.vertices.insert(world.vertices.end(), openings.corners.begin(), openings.corners.end());
    std::vector<Vec3> viewpoints;
    for (const Vec3& v : found.around.viewpoints) viewpoints.push_back(place.to_world(v));
    return flag_glass(world, std::move(openings.openings), places, viewpoints,
                      cloud.viewers.empty() ? std::vector<std::int32_t>{} : found.around.viewers);
  });
  add_curves(found.curves, world);
  NoiseMap noise = std::move(found.noise);
  found = {}, places = {}, lines = {};
  const std::vector<FacePair> pairs = log.run("Pairing faces", "surfaces -> pairs", world.surfaces,
                                              [&] { return pair_faces(world, options.thickness); });
  set_thickness(world, pairs);
  world.openings = hang_leaves(world, options.leaves);
  world.colliders = log.run("Making colliders", "surfaces -> colliders", world.surfaces,
                            [&] { return make_colliders(world, options.colliders); });
  if (options.method == Method::rival)
    enclose_clutter(cloud, std::move(noise), options.obstacles, log, result);
  // A label names a plane; curves and ground have many.
  for (std::size_t i = 0; i < result.curve_labels.size(); ++i)
    if (result.curve_labels[i] >= 0) result.labels[i] = -1;
  for (std::int32_t& label : result.labels)
    if (label >= first_facet) label = -1;
  result.labels = distinct.expand(std::move(result.labels));
  result.curve_labels = distinct.expand(std::move(result.curve_labels));
  world = level_world(std::move(world), options.frame);
  set_rooms(world, log.run("Finding rooms", "surfaces -> rooms", world.surfaces,
                           [&] { return find_rooms(world, options.rooms); }));
  take(leave_out_invalid(world), result);

  result.replay = std::move(recorder).finish(world.frame, cloud.origin);
  ReconstructOptions used = options;
  for (const Option& option : list_options(used))
    result.world.provenance.options[option.name] = option.value();
  result.world.provenance.options["method"] = name_of(options.method);
  if (options.space.unknown != space::Unknown::behind)
    result.world.provenance.options["unknown"] = std::string(name_of(options.space.unknown));
  result.world.provenance.program = std::string("scanworld ") + version();
  return result;
}

}  // namespace scanworld
