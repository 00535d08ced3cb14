// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "rival.h"

#include <algorithm>
#include <cmath>

namespace scanworld::rival {

namespace {

void tell(const Observer& observe, std::string_view what, const Clustering& clusters) {
  if (observe) observe(what, clusters);
}

// The places of what is left are about a voxel apart.
Scale scale_of_rough(Scale scale, double roughness, const ScaleOptions& options) {
  scale.noise = roughness;
  scale.spacing = scale.voxel;
  scale.voxel =
      std::max(options.voxel_per_spacing * scale.spacing, options.voxel_per_noise * scale.noise);
  return scale;
}

// Parts the rough clusters; the others stay as they are.
Clustering part_rough(const Grid& grid, const Neighbors& neighbors, Clustering c,
                      const SplitOptions& options) {
  const auto is_rough = [](const Cluster& k) { return k.roughness > 0; };
  if (std::none_of(c.clusters.begin(), c.clusters.end(), is_rough)) return c;
  const Clustering parted = split_clusters(grid, neighbors, c, options);
  const auto first = static_cast<std::int32_t>(c.clusters.size());
  for (std::size_t i = 0; i < c.label.size(); ++i)
    if (c.label[i] != kNone && is_rough(c.clusters[static_cast<std::size_t>(c.label[i])]))
      c.relabel(i, parted.label[i] == kNone ? kNone : first + parted.label[i]);
  c.clusters.insert(c.clusters.end(), parted.clusters.begin(), parted.clusters.end());
  refit(grid, c);
  return c;
}

// How far the neighbourhoods of what is left may reach: as far as points are sparse, so less where
// voxels are larger than that because of noise.
int reach_of_births(const Scale& scale, const RivalOptions& options) {
  const double sparse = options.scale.voxel_per_spacing * scale.spacing / scale.voxel;
  const int reach = static_cast<int>(std::lround(options.birth_reach * std::min(1.0, sparse)));
  return std::min(options.birth_reach, std::max(options.neighbors.max_reach + 1, reach));
}

}  // namespace

Flatness find_flatness(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                       Clustering c, const RivalOptions& options) {
  Scale loose = scale;  // for which a surface is what has no step
  loose.flatness.max_sag = 1;
  c = merge_clusters(grid, neighbors, loose, std::move(c), options.merge);
  return measure_flatness(grid, c, scale.flatness, options.flatness);
}

Clustering settle(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                  std::vector<LocalPlane>& local, Clustering c, const RivalOptions& options,
                  const Observer& observe) {
  c = compete(grid, neighbors, scale, local, std::move(c), options.rivalry, observe);
  c = merge_clusters(grid, neighbors, scale, std::move(c), options.merge);
  tell(observe, "neighbours with one plane are united", c);
  NeighborOptions wider = options.neighbors;
  wider.max_reach = reach_of_births(scale, options);
  std::vector<std::uint8_t> left(grid.sites.size());
  for (int round = 0; round < options.birth_rounds; ++round) {
    for (std::size_t i = 0; i < left.size(); ++i)
      left[i] = c.label[i] == kNone && !neighbors.of(i).empty();
    const Neighbors around = find_neighbors(grid, wider, left);
    local = fit_locally(grid, around, scale, options.local, std::move(local));
    c = grow_clusters(grid, around, scale, local, std::move(c), options.growth);
    tell(observe, "new clusters grow from what is left", c);
    c = compete(grid, neighbors, scale, local, std::move(c), options.rivalry, observe);
    c = merge_clusters(grid, neighbors, scale, std::move(c), options.merge);
    tell(observe, "neighbours with one plane are united", c);
  }
  return c;
}

Clustering part(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                const std::vector<LocalPlane>& local, Clustering c, const RivalOptions& options,
                const Observer& observe) {
  c = split_clusters(grid, neighbors, std::move(c), options.split);
  tell(observe, "what another plane parts becomes two", c);
  c = bridge_clusters(grid, scale, std::move(c), options.bridge);
  tell(observe, "what is only hidden is bridged", c);
  return compete(grid, neighbors, scale, local, std::move(c), options.rivalry, observe);
}

Clustering confirm(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                   const std::vector<LocalPlane>& local, Clustering c, const RivalOptions& options,
                   const Observer& observe) {
  c = weigh_evidence(grid, neighbors, scale, std::move(c), options.evidence);
  c = drop_columns(grid, neighbors, scale, std::move(c), options.columns);
  tell(observe, "what is no plane is dropped", c);
  c = join_layers(grid, scale, std::move(c), options.layers);
  tell(observe, "layers of one surface are joined", c);
  c = bridge_pieces(grid, scale, std::move(c), options.bridge);
  tell(observe, "pieces of one surface are joined", c);
  return compete(grid, neighbors, scale, local, std::move(c), options.rivalry, observe);
}

Clustering find_rough(const Grid& grid, const Neighbors& neighbors, const Scale& scale,
                      Clustering c, const RivalOptions& options, const Observer& observe) {
  for (double roughness : list_roughness(scale, options.rough)) {
    const Leftover left = find_leftover(grid, neighbors, c);
    if (left.sites.empty()) break;
    const Scale coarse = scale_of_rough(scale, roughness, options.scale);
    const Grid places = build_grid(left.places, coarse.voxel);
    const Neighbors around = find_neighbors(places, options.neighbors);
    const std::vector<LocalPlane> local = fit_locally(places, around, coarse, options.local);
    Clustering found = grow_clusters(places, around, coarse, local, {}, options.growth);
    found = compete(places, around, coarse, local, std::move(found), options.rivalry);
    MergeOptions merge = options.merge;
    merge.min_step = std::max(merge.min_step, 2 * roughness);
    found = merge_clusters(places, around, coarse, std::move(found), merge);
    c = take_rough(grid, neighbors, scale, std::move(c), left, places, found, options.rough);
  }
  c = part_rough(grid, neighbors, std::move(c), options.split);
  tell(observe, "rough surfaces are found in what is left", c);
  return c;
}

OptionList list_options(RivalOptions& o) {
  return {
      {"rival.scale.noise", &o.scale.noise, "m",
       "standard deviation of the points off their surface; 0 = from the scan", 0},
      {"rival.scale.spacing", &o.scale.spacing, "m",
       "between neighbouring points on a surface; 0 = from the scan", 0},
      {"rival.scale.voxel", &o.scale.voxel, "m", "edge of the voxels; 0 = from noise and spacing",
       0},
      {"rival.scale.min_noise", &o.scale.min_noise, "m",
       "a scan is not taken to be better than this", 0},
      {"rival.scale.min_voxel", &o.scale.min_voxel, "m",
       "voxels are not smaller where their size is derived", 0},
      {"rival.scale.voxel_per_spacing", &o.scale.voxel_per_spacing, "",
       "a voxel's edge in spacings", 0},
      {"rival.scale.voxel_per_noise", &o.scale.voxel_per_noise, "",
       "and at least so many times the noise", 0},
      {"rival.scale.depth_step", &o.scale.depth_step, "1/m",
       "a depth camera's noise is at least this times range squared", 0},
      {"rival.scale.max_bend", &o.scale.max_bend, "m",
       "surfaces are not taken to bend by more; 0 = all are flat", 0},
      {"rival.scale.max_sag", &o.scale.max_sag, "",
       "a surface may bend by this share of its extent, however flat others are", 0},
      {"rival.neighbors.min_points", &o.neighbors.min_points, "",
       "a neighbourhood grows until it holds so many", 0},
      {"rival.neighbors.min_sites", &o.neighbors.min_sites, "",
       "in so many voxels, as a single scan line is no neighbourhood", 1, 1000},
      {"rival.neighbors.max_reach", &o.neighbors.max_reach, "voxel", "but it reaches no farther", 1,
       8},
      {"rival.local.max_noise", &o.local.max_noise, "noise", "planar is what is no rougher", 0},
      {"rival.local.min_extent", &o.local.min_extent, "noise",
       "and what is at least so wide, as a standard deviation", 0},
      {"rival.local.min_ratio", &o.local.min_ratio, "",
       "of the variances along and off the plane, at least", 0},
      {"rival.sides.min_ratio", &o.sides.min_ratio, "",
       "of the variances along and across two layers, at least", 0},
      {"rival.sides.max_noise", &o.sides.max_noise, "noise", "each layer may be no rougher", 0},
      {"rival.sides.min_distance", &o.sides.min_distance, "noise",
       "between layers, where they are told by offset alone", 0},
      {"rival.sides.min_share", &o.sides.min_share, "", "of the points around, in each layer", 0,
       0.5},
      {"rival.growth.max_distance", &o.growth.max_distance, "noise",
       "a site with one point is taken from no farther", 0},
      {"rival.growth.max_rms", &o.growth.max_rms, "noise",
       "one with many may be no rougher about the plane", 0},
      {"rival.growth.max_angle", &o.growth.max_angle, "rad",
       "between the plane and those of its sites' neighbourhoods", 0},
      {"rival.growth.min_points", &o.growth.min_points, "", "clusters of fewer are dropped", 0},
      {"rival.rivalry.max_sweeps", &o.rivalry.max_sweeps, "", "rivalry ends after so many", 0},
      {"rival.rivalry.stop_share", &o.rivalry.stop_share, "",
       "of the changes of the sweep with most: with fewer, it ends", 0},
      {"rival.rivalry.smoothness", &o.rivalry.smoothness, "",
       "price of a site among others' sites, in squared noise", 0},
      {"rival.rivalry.wrong_normal", &o.rivalry.wrong_normal, "",
       "price per point where the neighbourhood's plane is another", 0},
      {"rival.rivalry.max_angle", &o.rivalry.max_angle, "rad",
       "another plane is one at more than this", 0},
      {"rival.rivalry.no_plane", &o.rivalry.no_plane, "",
       "price per point of being in no cluster, in squared noise", 0},
      {"rival.rivalry.weight", &o.rivalry.weight, "",
       "points of a site that count; the others do not add evidence", 0},
      {"rival.merge.max_rms", &o.merge.max_rms, "noise", "of each part about the plane in common",
       0},
      {"rival.birth_rounds", &o.birth_rounds, "",
       "in which clusters are grown from what no cluster explains", 0, 100},
      {"rival.birth_reach", &o.birth_reach, "voxel",
       "that the neighbourhoods of what is left may reach", 1, 8},
      {"rival.split.reach", &o.split.reach, "voxel", "in which a crossing cluster must be there", 1,
       8},
      {"rival.split.min_points", &o.split.min_points, "",
       "parts of fewer points are left to whoever competes for them", 0},
      {"rival.bridge.max_gap", &o.bridge.max_gap, "voxel",
       "clusters with a plane in common are united across no more", 0},
      {"rival.bridge.max_rms", &o.bridge.max_rms, "noise", "of each part about the plane in common",
       0},
      {"rival.bridge.open_share", &o.bridge.open_share, "",
       "of the shortest ways across a gap that nothing may cross, at least", 0, 1},
      {"rival.bridge.piece_gap", &o.bridge.piece_gap, "m",
       "between two pieces of one surface; 0 = each is one of its own", 0},
      {"rival.bridge.max_step", &o.bridge.max_step, "m",
       "from one to the other in the midst of the gap", 0},
      {"rival.bridge.max_angle", &o.bridge.max_angle, "rad", "between them", 0, 0.5},
      {"rival.layers.max_offset", &o.layers.max_offset, "m",
       "between layers of one surface; 0 = all are surfaces of their own", 0},
      {"rival.layers.min_offset", &o.layers.min_offset, "voxel",
       "nearer ones are the heights and depths of what is rough", 0},
      {"rival.layers.max_angle", &o.layers.max_angle, "rad", "between their normals", 0, 1.5},
      {"rival.layers.cell", &o.layers.cell, "voxel",
       "edge of the squares in which two are compared", 0.1},
      {"rival.layers.min_overlap", &o.layers.min_overlap, "",
       "share of the lesser layer's squares that the other is in as well", 0, 1},
      {"rival.layers.room", &o.layers.room, "m", "a side has at least so much room before it", 0},
      {"rival.layers.min_share", &o.layers.min_share, "",
       "of the scan's area that is in layers, for its registration to drift", 0, 1},
      {"rival.layers.bend", &o.layers.bend, "drift",
       "what a surface may then bend by, and over each metre", 0},
      {"rival.evidence.min_points", &o.evidence.min_points, "",
       "clusters of fewer points are dropped", 0},
      {"rival.evidence.min_area", &o.evidence.min_area, "m2", "and those of less area", 0},
      {"rival.evidence.area_noise", &o.evidence.area_noise, "",
       "and the square of this many times the noise", 0},
      {"rival.evidence.min_width", &o.evidence.min_width, "voxel",
       "narrower ones are mixtures in the voxels of an edge", 0},
      {"rival.evidence.min_density", &o.evidence.min_density, "",
       "points where the spacing of the scan leads to expect one", 0},
      {"rival.evidence.sparse_points", &o.evidence.sparse_points, "",
       "clusters with so many may be less dense", 0},
      {"rival.evidence.min_sparse_points", &o.evidence.min_sparse_points, "",
       "and those with so many", 0},
      {"rival.evidence.min_purity", &o.evidence.min_purity, "",
       "if they hold so much of what is around them", 0, 1},
      {"rival.evidence.max_curvature", &o.evidence.max_curvature, "",
       "and a quadric explains no more of their variance off the plane", 0, 1},
      {"rival.evidence.explained_share", &o.evidence.explained_share, "",
       "of the points that larger clusters next to them explain as well", 0},
      {"rival.evidence.explained_distance", &o.evidence.explained_distance, "noise",
       "from the larger one's plane", 0},
      {"rival.evidence.small_area", &o.evidence.small_area, "m2",
       "smaller clusters are weighed: they may be pieces of things", 0},
      {"rival.evidence.min_log_odds", &o.evidence.min_log_odds, "",
       "that a small cluster is a plane, as a logarithm", -100, 100},
      {"rival.evidence.prior_share", &o.evidence.prior_share, "",
       "of what the scan's own share of planes would add to the odds", 0, 1},
      {"rival.evidence.max_prior", &o.evidence.max_prior, "", "and the most of it", 0},
      {"rival.columns.max_slope", &o.columns.max_slope, "rad",
       "off upright of the facets of a round column", 0, 1},
      {"rival.columns.max_radius", &o.columns.max_radius, "m", "a wider curve is a wall", 0},
      {"rival.columns.max_noise", &o.columns.max_noise, "noise",
       "rms of the points off a round column", 0},
      {"rival.curves.min_radius", &o.curves.min_radius, "m",
       "of what is found as a curve; thinner things are left to the obstacles", 0},
      {"rival.curves.max_radius", &o.curves.max_radius, "m",
       "wider curves are walls that are not quite flat; 0 = no curves are found", 0},
      {"rival.curves.roundness", &o.curves.roundness, "radius",
       "that built things are off round, beside the noise", 0, 0.1},
      {"rival.curves.max_distance", &o.curves.max_distance, "noise and roundness",
       "a site with one point is taken from no farther", 0},
      {"rival.curves.max_rms", &o.curves.max_rms, "noise and roundness",
       "one with many may be no rougher", 0},
      {"rival.curves.max_own", &o.curves.max_own, "noise and roundness",
       "nor may a curve as a whole", 0},
      {"rival.curves.max_angle", &o.curves.max_angle, "rad",
       "between a curve and the planes of its sites' neighbourhoods", 0, 1.5},
      {"rival.curves.weight", &o.curves.weight, "", "points of a site that count", 1},
      {"rival.curves.min_points", &o.curves.min_points, "", "curves of fewer are none", 0},
      {"rival.curves.min_area", &o.curves.min_area, "m2", "and those with less that has points", 0},
      {"rival.curves.min_bend", &o.curves.min_bend, "m", "and those with a smaller sagitta", 0},
      {"rival.curves.min_height", &o.curves.min_height, "m", "of a column or pipe", 0},
      {"rival.curves.min_slimness", &o.curves.min_slimness, "radius", "and of its height at least",
       0},
      {"rival.curves.min_sweep", &o.curves.min_sweep, "rad", "of its side that was seen", 0, 6},
      {"rival.curves.min_cover", &o.curves.min_cover, "", "share of its extent that has points", 0,
       1},
      {"rival.curves.min_gain", &o.curves.min_gain, "",
       "squared noise per point that planes explain it worse"},
      {"rival.curves.max_turn", &o.curves.max_turn, "rad",
       "rms between it and the planes of its neighbourhoods", 0},
      {"rival.curves.min_taper", &o.curves.min_taper, "m",
       "by which a cone's radius grows; else it is a cylinder", 0},
      {"rival.curves.min_taper_share", &o.curves.min_taper_share, "",
       "and share of the larger radius", 0, 1},
      {"rival.curves.min_wide", &o.curves.min_wide, "m2 rad2",
       "of a curve wider than a column, area times the square of its sweep", 0},
      {"rival.curves.min_dome", &o.curves.min_dome, "rad", "sweep of a sphere", 0, 6},
      {"rival.curves.min_wide_cover", &o.curves.min_wide_cover, "", "as min_cover, of a wide one",
       0, 1},
      {"rival.curves.min_wide_gain", &o.curves.min_wide_gain, "",
       "as min_gain: many narrow planes may explain a vault better", -10, 10},
      {"rival.curves.max_wide_turn", &o.curves.max_wide_turn, "rad", "as max_turn", 0},
      {"rival.curves.max_point_distance", &o.curves.max_point_distance, "noise and roundness",
       "points farther from a curve are not on it", 0},
      {"rival.rough.max_roughness", &o.rough.max_roughness, "m",
       "of surfaces that is looked for in what is left; half more is found; 0 = all are smooth", 0},
      {"rival.rough.step", &o.rough.step, "",
       "by which roughness is less, each time that is looked", 1.1},
      {"rival.rough.min_roughness", &o.rough.min_roughness, "noise",
       "what is less rough is found without", 1},
      {"rival.rough.min_area", &o.rough.min_area, "m2", "of a rough surface", 0},
      {"rival.rough.min_width", &o.rough.min_width, "roughness", "and of its lesser extent", 0},
      {"rival.rough.min_fill", &o.rough.min_fill, "",
       "share that it has of the smallest rectangle around it", 0, 1},
      {"rival.rough.max_beside", &o.rough.max_beside, "",
       "voxels before or behind it that are left, against its own", 0},
      {"rival.rough.max_curvature", &o.rough.max_curvature, "",
       "share of its roughness that a quadratic surface explains", 0, 1},
      {"rival.rough.small_area", &o.rough.small_area, "m2",
       "smaller clusters within its roughness are pieces of it", 0},
      {"rival.rough.max_smoother", &o.rough.max_smoother, "",
       "and larger ones, if they are no more times smoother", 1},
      {"rival.floors.max_rms", &o.floors.max_rms, "noise",
       "of each piece of a floor about the plane in common", 0},
      {"rival.floors.max_tilt", &o.floors.max_tilt, "rad",
       "off level of floors and ceilings; 0 = their pieces are not joined", 0, 0.5},
      {"rival.floors.max_height", &o.floors.max_height, "m",
       "what is no higher over a larger level surface stands on it", 0},
      {"rival.floors.max_offset", &o.floors.max_offset, "m",
       "between layers of one floor, as it is not seen below itself", 0},
      {"rival.floors.min_overlap", &o.floors.min_overlap, "",
       "share of the lesser layer where the other is as well", 0, 1},
      {"rival.regularise.max_angle", &o.regularise.max_angle, "rad",
       "planes that differ by less may be parallel or square; 0 = none is turned", 0, 0.5},
      {"rival.regularise.max_rise", &o.regularise.max_rise, "",
       "of a plane's chi-square, by turning it", 0},
      {"rival.regularise.max_shift", &o.regularise.max_shift, "m",
       "at a plane's edge by turning it, beside its own uncertainty", 0},
      {"rival.regularise.max_offset", &o.regularise.max_offset, "",
       "standard deviations; parallel planes nearer than this are one plane", 0},
      {"rival.regularise.max_step", &o.regularise.max_step, "",
       "noise; a plane nowhere farther off a larger one beside it takes that one's plane", 0},
      {"rival.regularise.max_crack", &o.regularise.max_crack, "m",
       "if it is no farther off than this", 0},
      {"rival.regularise.max_gap", &o.regularise.max_gap, "m", "nor farther away", 0},
      {"rival.labels.max_distance", &o.labels.max_distance, "noise",
       "points farther from a plane are not in it", 0},
      {"rival.labels.max_own", &o.labels.max_own, "noise",
       "nor are points farther than so many times its own noise", 0},
      {"rival.labels.min_noise", &o.labels.min_noise, "noise",
       "a plane's own noise is at least this", 0},
      {"rival.labels.smoothness", &o.labels.smoothness, "",
       "price of a point among other clusters' sites, in squared noise", 0},
      {"rival.labels.min_points", &o.labels.min_points, "",
       "planes with fewer points in the end are dropped", 0},
  };
}

}  // namespace scanworld::rival
