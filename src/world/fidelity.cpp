// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "fidelity.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

#include "../error.h"
#include "../parallel.h"
#include "../quantile.h"
#include "bend.h"
#include "cloud_in_world.h"
#include "fidelity_samples.h"
#include "inferred_parts.h"
#include "near_points.h"
#include "ray_scene.h"
#include "sight_lines.h"
#include "solids.h"

namespace scanworld {

namespace {

constexpr double kFewPoints = 0.01;  // share near the world below which it is of another place

// Where most of some numbers are: the median of those in the densest window of this width.
double densest(std::vector<double> values, double width) {
  std::sort(values.begin(), values.end());
  std::size_t best = 0, most = 0;
  for (std::size_t i = 0, end = 0; i < values.size(); ++i) {
    while (end < values.size() && values[end] <= values[i] + width) ++end;
    if (end - i > most) best = i, most = end - i;
  }
  return values[best + most / 2];
}

// Of distances with what each of them stands for: the smallest that so much of the whole is within.
Distances distances_of(std::vector<std::pair<double, double>> weighted) {
  std::sort(weighted.begin(), weighted.end());
  double whole = 0, sum = 0;
  for (const auto& [distance, weight] : weighted) whole += weight;
  Distances found;
  for (const auto& [distance, weight] : weighted) {
    if (sum < 0.5 * whole) found.median = distance;
    if (sum < 0.95 * whole) found.p95 = distance;
    sum += weight;
  }
  return found;
}

// The points that are looked at, and what of the world is nearest to each.
class Measurement {
 public:
  Measurement(const World& world, const PointCloud& cloud, const FidelityOptions& options)
      : world_(world), cloud_(cloud, world.frame), options_(options), scene_(world) {
    if (cloud.points.empty()) throw Error(Cause::bad_input, "the scan has no points");
    const double sparse = options.cover_per_spacing * options.spacing;
    max_distance_ = std::max(options.max_distance, 2 * std::hypot(sparse, options.max_tolerance));
    for (const std::uint32_t i : sample_points(cloud_, options.points)) {
      points_.push_back(cloud_.point(i));
      viewers_.push_back(cloud.viewer_of(i));
    }
    if (options.depth_step > 0)
      camera_ = cloud.viewpoints.empty() ? cloud_.to_world(Vec3::Zero()) : viewpoints()[0];
    for (const Obstacle& obstacle : world.obstacles) {
      solids_.push_back(mesh_of(obstacle, world.frame));
      boxes_.emplace_back();
      for (const Vec3& v : solids_.back().vertices) boxes_.back().extend(v);
    }
    list_curves();
    noise_.resize(points_.size());
    near_.resize(points_.size());
    parallel_for(points_.size(), [&](std::size_t i) {
      noise_[i] =
          std::max(options.noise, options.depth_step * (points_[i] - camera_).squaredNorm());
      near_[i] = scene_.nearest(points_[i], max_distance_);
      if (near_[i]) near_[i]->distance = std::min(near_[i]->distance, off_curve(i));
    });
    refuse_another_place();
    bend_ = std::min(measure_bend(world, points_, near_), options.max_bend);
    cover_ = std::hypot(sparse, tolerance_of(options.noise));
  }

  Fidelity run() {
    const double noise = median(noise_);
    Fidelity result{.points = points_.size(),
                    .noise = noise,
                    .spacing = options_.spacing,
                    .bend = bend_,
                    .tolerance = tolerance_of(noise),
                    .max_distance = max_distance_};
    for (const Surface& s : world_.surfaces)
      result.surfaces.push_back({.id = s.id, .area = area(world_, s)});
    look_at_points(result);
    look_at_places(result);
    describe_surfaces(result);
    find_flat(result);
    result.doubled = measure_doubled(world_, points_, near_, options_.doubled);
    if (!cloud_.cloud().viewpoints.empty()) look_along_rays(result);
    result.floors = measure_floors(world_, scene_, options_.floors);
    StrayOptions strays = options_.strays;
    strays.near = std::max(strays.near, cover_);
    result.strays = find_stray_surfaces(world_, strays);
    return result;
  }

 private:
  std::vector<Vec3> viewpoints() const { return cloud_.viewpoints(); }

  // The curves that surfaces are facets of, and obstacles are.
  void list_curves() {
    std::map<int, const Curve*> by_id;
    for (const CurvedPart& c : world_.curves) by_id[c.id] = &c.curve;
    const auto curve_of = [&](const auto& thing) {
      const auto found = thing.curve ? by_id.find(*thing.curve) : by_id.end();
      return found == by_id.end() ? nullptr : found->second;
    };
    for (const Surface& s : world_.surfaces) surface_curves_.push_back(curve_of(s));
    for (const Obstacle& o : world_.obstacles) obstacle_curves_.push_back(curve_of(o));
  }

  // The distance of a point from the curve that what is nearest to it stands for: nobody blames a
  // point for the facets. Infinite where there is none beside it.
  double off_curve(std::size_t point) const {
    const Nearest& near = *near_[point];
    const Curve* c = (near.is_surface ? surface_curves_ : obstacle_curves_)[near.index];
    if (!c) return INFINITY;
    const double height = c->height_of(points_[point]), margin = options_.max_tolerance;
    if (height < c->low - margin || height > c->high + margin) return INFINITY;
    return std::abs(c->shape.signed_distance(points_[point]));
  }

  // Of a point from its surface, or the curve that this is a facet of; positive on the free side.
  double offset_of(std::size_t point) const {
    const std::size_t s = near_[point]->index;
    const Plane& plane = world_.surfaces[s].plane;
    const Curve* c = surface_curves_[s];
    const double off_plane = plane.signed_distance(points_[point]);
    if (!c || std::abs(off_plane) <= near_[point]->distance) return off_plane;
    const double outwards = plane.normal.dot(c->shape.normal_at(points_[point])) > 0 ? 1 : -1;
    return outwards * c->shape.signed_distance(points_[point]);
  }

  // What a depth camera's model says is believed; noise and bend that were found may be those of a
  // scan that has no surfaces.
  // A surface may be as rough as its own points told.
  double tolerance_of(double noise, double roughness = 0) const {
    const double scatter =
        options_.tolerance_per_noise * std::hypot(std::max(noise, roughness), bend_);
    const double most =
        noise > options_.noise ? options_.tolerance_per_noise * noise : options_.max_tolerance;
    return std::clamp(scatter, options_.min_tolerance, std::max(most, options_.max_tolerance));
  }

  // At a point, by what it may be on.
  double tolerance_at(std::size_t point) const {
    const auto& near = near_[point];
    const double roughness =
        near && near->is_surface ? world_.surfaces[near->index].support.rms : 0;
    return tolerance_of(noise_[point], roughness);
  }

  void refuse_another_place() const {
    const auto count = std::count_if(near_.begin(), near_.end(), [](const auto& n) { return !!n; });
    if (static_cast<double>(count) >= kFewPoints * static_cast<double>(near_.size())) return;
    Box3 box;
    for (const Vec3& p : points_) box.extend(p);
    const auto text = [&](const Box3& b) {
      if (b.isEmpty()) return std::string("nowhere");
      Box3 there;
      for (int k = 0; k < 8; ++k)
        there.extend(world_.frame.to_scan(b.corner(static_cast<Box3::CornerType>(k))));
      const Vec3 &low = there.min(), &high = there.max();
      return fmt::format("from {:.1f} {:.1f} {:.1f} to {:.1f} {:.1f} {:.1f}", low.x(), low.y(),
                         low.z(), high.x(), high.y(), high.z());
    };
    throw Error(Cause::bad_input,
                fmt::format("the world and the scan are of different places: {:.2g} % of the "
                            "points are within {} m of the world (the scan goes {}, the world {})",
                            100 * static_cast<double>(count) / static_cast<double>(near_.size()),
                            max_distance_, text(box), text(bounds(world_))));
  }

  bool is_in_obstacle(const Vec3& p) const {
    for (std::size_t o = 0; o < solids_.size(); ++o)
      if (boxes_[o].contains(p) && contains(solids_[o], p)) return true;
    return false;
  }

  void look_at_points(Fidelity& result) {
    std::vector<std::pair<double, double>> distances(points_.size());
    explained_.resize(points_.size());
    std::vector<char> inside(points_.size());
    result.atlas.points.resize(points_.size());
    parallel_for(points_.size(), [&](std::size_t i) {
      double distance = near_[i] ? near_[i]->distance : max_distance_;
      const double tolerance = tolerance_at(i);
      inside[i] = distance > tolerance && is_in_obstacle(points_[i]);
      if (inside[i]) distance = 0;
      explained_[i] = distance <= tolerance;
      distances[i] = {distance, 1};
      const bool on_surface = explained_[i] && near_[i] && near_[i]->is_surface;
      result.atlas.points[i] = {points_[i], distance,
                                on_surface ? static_cast<int>(near_[i]->index) : -1,
                                explained_[i] != 0};
    });
    result.scan_to_world = distances_of(std::move(distances));
    std::size_t near = 0, close = 0;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (result.atlas.points[i].surface < 0) continue;
      ++near, close += near_[i]->distance <= tolerance_at(i) / 2;
    }
    if (near > 0) result.close = static_cast<double>(close) / static_cast<double>(near);
    result.inside = static_cast<double>(std::count(inside.begin(), inside.end(), 1)) /
                    static_cast<double>(points_.size());
    result.unexplained = static_cast<double>(std::count(explained_.begin(), explained_.end(), 0)) /
                         static_cast<double>(points_.size());
  }

  void look_at_places(Fidelity& result) const {
    const std::vector<PlaceOnSurface> places =
        sample_surfaces(world_, options_.places, options_.places_each);
    std::vector<Vec3> at;
    for (const PlaceOnSurface& place : places) at.push_back(place.at);
    const std::vector<double> distances =
        nearest_point_distances(at, cloud_, cover_ / 2, max_distance_);
    std::vector<std::pair<double, double>> weighted;
    std::vector<double> covered(world_.surfaces.size()), whole(world_.surfaces.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      weighted.emplace_back(distances[i], places[i].area);
      whole[places[i].surface] += places[i].area;
      if (distances[i] <= cover_) covered[places[i].surface] += places[i].area;
    }
    for (std::size_t s = 0; s < whole.size(); ++s)
      if (whole[s] > 0) result.surfaces[s].coverage = covered[s] / whole[s];
    const double all = std::accumulate(whole.begin(), whole.end(), 0.0);
    for (const Surface& s : world_.surfaces) result.measured_area += area(world_, s);
    result.inferred_area = inferred_area(world_);
    result.measured_area -= result.inferred_area;
    result.places = places.size();
    result.world_to_scan = distances_of(std::move(weighted));
    result.coverage = all > 0 ? std::accumulate(covered.begin(), covered.end(), 0.0) / all : 0;
  }

  void describe_surfaces(Fidelity& result) const {
    struct Around {
      double squares = 0;
      std::vector<double> offsets, noise;
    };
    std::vector<Around> around(world_.surfaces.size());
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double reach = std::max(options_.reach, 3 * tolerance_of(noise_[i]));
      if (!near_[i] || !near_[i]->is_surface || near_[i]->distance > reach) continue;
      const std::size_t s = near_[i]->index;
      around[s].squares += near_[i]->distance * near_[i]->distance;
      around[s].offsets.push_back(offset_of(i));
      around[s].noise.push_back(noise_[i]);
    }
    for (std::size_t s = 0; s < around.size(); ++s) {
      SurfaceFidelity& surface = result.surfaces[s];
      surface.points = around[s].offsets.size();
      if (surface.points == 0) continue;
      const double tolerance =
          tolerance_of(median(around[s].noise), world_.surfaces[s].support.rms);
      surface.rms = std::sqrt(around[s].squares / static_cast<double>(surface.points));
      surface.offset = densest(around[s].offsets, tolerance);
      // What was inferred has no points of its own, but stray ones of others.
      if (world_.surfaces[s].source == Source::measured &&
          surface.points >= options_.min_points_each &&
          std::abs(surface.offset) > options_.max_offset_per_tolerance * tolerance)
        result.misplaced.push_back(surface.id);
    }
  }

  // What is planar, but on no surface: the world lacks a wall there, or a solid has swallowed it.
  void find_flat(Fidelity& result) {
    const auto is_on_surface = [&](std::size_t i) {
      return explained_[i] && near_[i] && near_[i]->is_surface;
    };
    std::vector<Vec3> others;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!is_on_surface(i)) others.push_back(points_[i]);
    const auto normals = planar_normals(
        others, cloud_,
        {.cell = std::max(options_.planar_cell, 12 * options_.noise), .noise = options_.noise});
    flat_.resize(points_.size());
    std::size_t other = 0, flat = 0;
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (!is_on_surface(i)) flat += (flat_[i] = normals[other++]).has_value();
    result.flat = static_cast<double>(flat) / static_cast<double>(points_.size());
  }

  // Rays to all that is there: points that the world explains, and others where the scan is
  // planar. The rest may be stray points or a mirror's, of which no ray came.
  void look_along_rays(Fidelity& result) const {
    std::vector<SeenPoint> seen;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      if (!explained_[i]) {
        if (flat_[i]) seen.push_back({points_[i], flat_[i], viewers_[i]});
      } else if (near_[i] && near_[i]->is_surface) {
        seen.push_back({points_[i], world_.surfaces[near_[i]->index].plane.normal, viewers_[i]});
      } else {
        seen.push_back({points_[i], {}, viewers_[i]});
      }
    }
    SightLines lines = follow_sight_lines(seen, viewpoints(), scene_,
                                          {.before = options_.before,
                                           .behind = options_.behind,
                                           .min_range = options_.min_range,
                                           .max_incidence = options_.max_incidence});
    result.rays = lines.free_rays;
    const auto share = [](std::size_t part, std::size_t whole) -> std::optional<double> {
      if (whole == 0) return std::nullopt;
      return static_cast<double>(part) / static_cast<double>(whole);
    };
    result.free_space_violations = share(lines.violations.size(), lines.free_rays);
    result.leaks = share(lines.leaks.size(), lines.ending_rays);
    result.atlas.violations = std::move(lines.violations);
    result.atlas.leaks = std::move(lines.leaks);
  }

  const World& world_;
  const CloudInWorld cloud_;
  const FidelityOptions& options_;
  const RayScene scene_;
  double cover_ = 0, max_distance_ = 0, bend_ = 0;  // [m]
  Vec3 camera_ = Vec3::Zero();
  std::vector<Vec3> points_;
  std::vector<std::int32_t> viewers_;  // of each point its viewpoint, or -1
  std::vector<const Curve*> surface_curves_, obstacle_curves_;
  std::vector<double> noise_;                 // [m] of each point
  std::vector<std::optional<Nearest>> near_;  // of each point
  std::vector<std::optional<Vec3>> flat_;     // normals of planes that points off surfaces lie in
  std::vector<char> explained_;               // whether each point is near a surface or obstacle
  std::vector<Mesh> solids_;                  // the obstacles
  std::vector<Box3> boxes_;                   // around them
};

void judge(Fidelity& f, const FidelityOptions& o) {
  const std::string viewpoints = "viewpoints", floor = "floor";
  const auto of_floor = [&](double value) {
    return f.floors.area > 0 ? std::optional(value / f.floors.area) : std::nullopt;
  };
  f.criteria = {
      {"median distance of the points", "m", f.scan_to_world.median,
       std::max(o.max_median_per_noise * f.tolerance / o.tolerance_per_noise, o.min_tolerance / 2)},
      {"unexplained points", "%", f.unexplained, o.max_unexplained},
      {"points close to their surfaces", "%", f.close, o.min_close, true},
      {"points inside obstacles", "%", f.inside, o.max_inside},
      {"coverage of the surfaces", "%", f.coverage, o.min_coverage, true},
      {"surfaces off their points", "", static_cast<double>(f.misplaced.size()), 0},
      {"floor pieces", "per 100 m2", of_floor(f.floors.most_pieces() * f.floors.area), o.max_pieces,
       false, floor},
      {"steps in floors", "m per 100 m2", of_floor(100 * f.floors.steps), o.max_steps, false,
       floor},
      {"gaps in floors", "%", of_floor(f.floors.gaps), o.max_gaps, false, floor},
      {"floating surfaces", "%", f.strays.floating_area / f.strays.area, o.max_floating},
      {"flat points off surfaces", "%", f.flat, o.max_flat},
      {"doubled surfaces", "%", f.doubled, o.max_doubled, false, "dense points"},
      {"crossing surfaces", "%", f.strays.crossings / f.strays.edges, o.max_crossings},
      {"free-space violations", "%", f.free_space_violations, o.max_violations, false, viewpoints},
      {"leaks", "%", f.leaks, o.max_leaks, false, viewpoints},
  };
}

}  // namespace

std::string figure_text(double value, const std::string& unit) {
  if (unit == "m") return fmt::format("{:.1f} mm", 1e3 * value);
  if (unit == "%") return fmt::format("{:.2f} %", 100 * value);
  return unit.empty() ? fmt::format("{:.0f}", value) : fmt::format("{:.3g} {}", value, unit);
}

bool Fidelity::is_faithful() const {
  return std::all_of(criteria.begin(), criteria.end(),
                     [](const Criterion& c) { return c.is_met(); });
}

Fidelity measure_fidelity(const World& world, const PointCloud& cloud,
                          const FidelityOptions& options) {
  Fidelity result = Measurement(world, cloud, options).run();
  judge(result, options);
  return result;
}

}  // namespace scanworld
