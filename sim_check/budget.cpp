// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "budget.h"

#include <fmt/format.h>

#include <algorithm>

#include "bullet.h"
#include "drive.h"
#include "mesh_rays.h"
#include "spots.h"
#include "timing.h"

namespace scanworld::sim {

namespace {

std::vector<Pose> probes_of(const Place& place, const BudgetOptions& options) {
  return poses_on(find_probes({place}, options.probes, options.size / 2, options.seed), 0,
                  options.seed);
}

// [s] of a contact test in each place, in turns: medians of the means over the probes.
std::vector<double> contact_tests(const std::vector<Place>& places, const std::vector<Pose>& probes,
                                  const BudgetOptions& options) {
  std::vector<std::unique_ptr<Simulation>> simulations;
  for (const Place& place : places) simulations.push_back(make_bullet(place, {}, {}, {}));
  std::vector<Task> tasks;
  for (const auto& simulation : simulations)
    tasks.push_back({.run =
                         [&] {
                           for (const Pose& pose : probes)
                             simulation->touches(Vec3::Constant(options.size), pose);
                         },
                     .count = probes.size()});
  std::vector<double> seconds;
  for (const Timing& timing : time_in_rounds(tasks, {.rounds = options.rounds, .runs = 5}))
    seconds.push_back(timing.cpu.median);
  return seconds;
}

std::string names_near(const Place& place, const Vec3& at, double reach) {
  std::string names;
  for (const ExportBody& body : place.solids)
    if (MeshRays(mesh_of(body)).nearest(at, reach))
      names += (names.empty() ? "" : ", ") + body.name;
  return names.empty() ? "nothing near" : names;
}

}  // namespace

Budget meet_budget(const World& world, double limit, const BudgetOptions& options) {
  Budget budget{.limit = limit, .world = world};
  std::vector<World> worlds;
  std::vector<Place> places;
  for (const SimplifyOptions& step :
       {SimplifyOptions{}, SimplifyOptions{true, 0}, SimplifyOptions{true, 0.05},
        SimplifyOptions{true, 0.1}, SimplifyOptions{true, 0.2}, SimplifyOptions{true, 0.4}}) {
    worlds.push_back(simplify(world, step));
    places.push_back(place_of("world", worlds.back()));
    budget.tries.push_back({step, worlds.back().surfaces.size(), worlds.back().obstacles.size(),
                            places.back().solids.size()});
  }
  const std::vector<double> seconds = contact_tests(places, probes_of(places[0], options), options);
  for (std::size_t i = 0; i < worlds.size(); ++i) budget.tries[i].seconds = seconds[i];
  const auto met = std::ranges::find_if(seconds, [&](double s) { return s <= limit; });
  if (met == seconds.end()) {
    budget.in_the_way = slowest_places(places[0], options);
    return budget;
  }
  budget.is_met = true;
  const auto chosen = static_cast<std::size_t>(met - seconds.begin());
  budget.world = std::move(worlds[chosen]);
  budget.tries.resize(chosen + 1);
  return budget;
}

std::vector<std::string> slowest_places(const Place& place, const BudgetOptions& options,
                                        std::size_t count) {
  const std::vector<Pose> probes = probes_of(place, options);
  const auto simulation = make_bullet(place, {}, {}, {});
  std::vector<std::pair<double, std::size_t>> times;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const auto touch = [&] { simulation->touches(Vec3::Constant(options.size), probes[i]); };
    const Task often{.run =
                         [&] {
                           for (int k = 0; k < 20; ++k) touch();
                         },
                     .count = 20};
    times.push_back(
        {time_in_rounds({often}, {.warm_up = 1, .rounds = 1, .runs = 3})[0].cpu.min, i});
  }
  std::ranges::sort(times, std::greater());
  std::vector<std::string> words;
  for (std::size_t k = 0; k < std::min(count, times.size()); ++k) {
    const Vec3& at = probes[times[k].second].position;
    words.push_back(fmt::format("{:.1f} us at {:.2f} {:.2f} {:.2f}: {}", 1e6 * times[k].first,
                                at.x(), at.y(), at.z(), names_near(place, at, options.size)));
  }
  return words;
}

}  // namespace scanworld::sim
