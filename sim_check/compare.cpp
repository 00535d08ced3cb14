// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "budget.h"
#include "error.h"

namespace scanworld::sim {

namespace {

// A scan in the coordinates of a frame.
PointCloud brought(const PointCloud& scan, const Frame& to) {
  PointCloud cloud;
  for (const Vec3f& p : scan.points)
    cloud.points.push_back(to.to_world(scan.origin + p.cast<double>()).cast<float>());
  for (const Vec3& p : scan.viewpoints) cloud.viewpoints.push_back(to.to_world(scan.origin + p));
  return cloud;
}

// Tells places in the coordinates that a world's own file has.
void tell_as_built(Robustness& found, const Frame& from, const Frame& built) {
  const auto turn = [&](Vec3& p) { p = built.to_world(from.to_scan(p)); };
  for (Lost& lost : found.lost) std::ranges::for_each(lost.at, turn);
  for (FloorGap& gap : found.floor.gaps) turn(gap.at);
}

std::vector<Criterion> promises_of(const Row& row, const CompareOptions& options) {
  const PromiseOptions& limits = options.promises;
  std::vector<Criterion> promises;
  if (options.with_robustness) {
    const Robustness& r = row.robustness;
    double lost = 0;
    for (const Lost& l : r.lost)
      if (l.speed <= limits.lost_speed) lost += static_cast<double>(l.at.size());
    promises.push_back(
        {fmt::format("robots lost, up to {:g} m/s", limits.lost_speed), "", lost, 0});
    if (r.lanes > 0)
      promises.push_back(
          {"speed lost by a sliding cube", "%", r.cube.speed_lost, limits.speed_lost});
    if (r.doors) {
      promises.push_back({"doors that a robot does not get through", "",
                          static_cast<double>(r.doors->wide - r.doors->passed), 0});
      promises.push_back({"places where one gets through a wall", "",
                          static_cast<double>(r.doors->walls_open), 0});
    }
    promises.push_back({"gaps in the floor", "", static_cast<double>(r.floor.gaps.size()), 0});
    if (r.lidar) promises.push_back({"lidar error, median", "m", r.lidar->median, limits.lidar});
  }
  if (limits.budget > 0 && row.speed.contact)
    promises.push_back({"contact test, mean", "s", row.speed.contact->cpu.mean, limits.budget});
  return promises;
}

bool is_over_budget(const Row& row, const PromiseOptions& promises) {
  return row.sort == Sort::world && promises.budget > 0 && row.speed.contact &&
         row.speed.contact->cpu.mean > promises.budget;
}

// Leaves out what robots could not touch in this engine, and returns the names.
std::vector<std::string> leave_out_meshes(std::vector<Place>& places, const EngineMaker& engine) {
  std::vector<std::string> names;
  if (engine.takes_meshes) return names;
  std::erase_if(places, [&](const Place& place) {
    if (place.sort == Sort::mesh) names.push_back(place.name);
    return place.sort == Sort::mesh;
  });
  if (places.empty())
    throw Error(Cause::usage, engine.name + " takes no meshes, and there is no world");
  return names;
}

// Ratios that changed much between rounds, and times on the wall that others took part of.
std::vector<std::string> noise_of(const std::vector<Row>& rows) {
  std::size_t all = 0, uneven = 0;
  double cpu = 0, wall = 0;
  const auto look = [&](const Timing& t) {
    ++all;
    uneven += t.is_noisy();
    cpu += t.cpu.mean, wall += t.wall.mean;
  };
  for (const Row& row : rows) {
    for (const StepSpeed& step : row.speed.steps) look(step.time);
    look(row.speed.collide), look(row.speed.lidar);
    if (row.speed.contact) look(*row.speed.contact), look(*row.speed.sweep);
  }
  std::vector<std::string> noise;
  if (4 * uneven > all)
    noise.push_back(fmt::format(
        "{} of {} ratios differ by more than a fifth between the quartiles of their rounds", uneven,
        all));
  if (wall > 1.5 * cpu)
    noise.push_back(fmt::format("steps and queries took {:.1f} times their CPU time", wall / cpu));
  return noise;
}

double load_average() {
  double load = 0;
  return getloadavg(&load, 1) == 1 ? load : 0;
}

}  // namespace

bool Comparison::keeps_promises() const {
  return std::ranges::all_of(
      rows, [](const Row& row) { return std::ranges::all_of(row.promises, &Criterion::is_met); });
}

Comparison compare(const std::vector<std::filesystem::path>& paths, const PointCloud* scan,
                   const CompareOptions& options, const Progress& progress) {
  std::vector<Place> places;
  for (const auto& path : paths) {
    if (progress) progress("reading " + path.filename().string(), 0);
    places.push_back(read_place(path, options.place));
    if (options.both && places.back().sort == Sort::world) {
      PlaceOptions as_mesh = options.place;
      as_mesh.as_mesh = true;
      places.push_back(read_place(path, as_mesh));
      places.back().name += " (triangles)";
    }
  }
  return compare(std::move(places), scan, options, progress);
}

Comparison compare(std::vector<Place> places, const PointCloud* scan, const CompareOptions& options,
                   const Progress& progress) {
  Comparison result{.options = options};
  SpeedOptions& speed = result.options.speed;
  RobustnessOptions& robustness = result.options.robustness;
  speed.size = robustness.size = options.size;
  speed.seed = robustness.seed = options.seed;
  const EngineMaker& engine = engine_named(options.engine);
  const auto part = [&](double from, double to) -> Progress {
    if (!progress) return {};
    return [&progress, from, to](std::string_view what, double share) {
      progress(what, from + share * (to - from));
    };
  };

  const Frame frame = align(places);
  result.left_out = leave_out_meshes(places, engine);
  const PointCloud cloud = scan ? brought(*scan, frame) : PointCloud{};
  const Spots spots = find_spots(
      places, {.count = std::max(*std::ranges::max_element(speed.robots), robustness.robots),
               .size = options.size,
               .clearance = 1.5 * options.size,
               .seed = options.seed});
  result.spots = spots.floor.size(), result.shared = spots.shared;
  std::vector<Robustness> trust(places.size());
  const double middle = !options.with_robustness ? 0 : options.with_speed ? 0.5 : 1;
  if (options.with_robustness)
    trust = measure_robustness(places, spots, engine, scan ? &cloud : nullptr, robustness,
                               part(0, middle));
  for (std::size_t i = 0; i < places.size(); ++i)
    if (places[i].world) tell_as_built(trust[i], frame, places[i].built);
  places.push_back({.name = "plane", .sort = Sort::plane, .height = spots.height});
  places.push_back({.name = "empty", .sort = Sort::empty});
  trust.resize(places.size());
  std::vector<Speed> speeds(places.size());
  if (options.with_speed) speeds = measure_speed(places, spots, engine, speed, part(middle, 1));

  for (std::size_t i = 0; i < places.size(); ++i) {
    Row row{places[i].name, places[i].sort, speeds[i], trust[i], {}, {}};
    if (row.sort == Sort::world) row.promises = promises_of(row, options);
    if (is_over_budget(row, options.promises))
      row.in_the_way = slowest_places(places[i], {.size = options.size, .seed = options.seed});
    result.rows.push_back(std::move(row));
  }
  if (options.with_speed) result.noise = noise_of(result.rows);
  result.load = load_average();
  return result;
}

}  // namespace scanworld::sim
