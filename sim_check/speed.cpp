// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "speed.h"

#include <malloc.h>

#include <algorithm>

#include "drive.h"
#include "random.h"
#include "world/solids.h"

namespace scanworld::sim {

namespace {

using Simulations = std::vector<std::unique_ptr<Simulation>>;

// Bytes that the program holds on its heap.
double heap() {
  const auto info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

// All that is measured, with what it shares.
class Bench {
 public:
  Bench(const std::vector<Place>& places, const Spots& spots, const EngineMaker& engine,
        const SpeedOptions& options, const Progress& progress)
      : places_(places), spots_(spots), engine_(engine), options_(options), progress_(progress) {
    rounds_ = {.warm_up = 3,
               .rounds = options.rounds,
               .runs = options.steps,
               .seconds = options.seconds,
               .tick = [this] { tick(); }};
    turns_ = static_cast<double>(places.size()) * options.rounds *
             static_cast<double>(options.kinds.size() * options.robots.size() + 4);
  }

  std::vector<Speed> run() {
    std::vector<Speed> speeds(places_.size());
    for (std::size_t i = 0; i < places_.size(); ++i) measure_size(places_[i], speeds[i]);
    for (RobotKind kind : options_.kinds)
      for (std::size_t robots : options_.robots) time_steps(kind, robots, speeds);
    time_detection(speeds);
    time_queries(speeds);
    return speeds;
  }

 private:
  void tick() {
    done_ += 1;
    if (progress_) progress_("timing " + what_, std::min(1.0, done_ / turns_));
  }

  void measure_size(const Place& place, Speed& speed) const {
    speed.triangles = place.seen.triangles.size();
    speed.solids = place.solids.size();
    speed.area = area_of(place.seen);
    speed.load_seconds = place.load_seconds;
    // [bytes, s of CPU time]
    const auto cost_of = [&](const Place& built) {
      const double before = heap();
      const Stopwatch watch;
      const auto simulation = engine_.make(built, {}, {}, {});
      const double seconds = watch.cpu();
      return std::pair(heap() - before, seconds);
    };
    const auto [memory, seconds] = cost_of(place);
    // What an engine takes for itself is not the place's.
    speed.memory = memory - cost_of({.sort = Sort::empty}).first;
    speed.build_seconds = seconds;
  }

  std::vector<Pose> starts(std::size_t count, double above) const {
    std::vector<Vec3> floor = spots_.floor;
    floor.resize(std::min(count, floor.size()));
    return poses_on(floor, options_.size, options_.seed, above);
  }

  Simulations simulations(const std::vector<Pose>& robots, const RobotOptions& robot) const {
    Simulations all;
    for (const Place& place : places_) all.push_back(engine_.make(place, robots, robot, {}));
    return all;
  }

  void time_steps(RobotKind kind, std::size_t count, std::vector<Speed>& speeds) {
    what_ = std::to_string(count) + " " + name_of(kind) + "s";
    const double seconds = 1 / options_.rate;
    const RobotOptions robot{.kind = kind, .size = options_.size};
    // A dense mesh is uneven: robots begin a little above it.
    const std::vector<Pose> from = starts(count, 0.02);
    const Simulations all = simulations(from, robot);
    std::vector<Driver> drivers;
    for (const Place& place : places_)
      drivers.emplace_back(place, from, robot, DriveOptions{.seed = options_.seed});
    std::vector<Task> tasks;
    for (std::size_t i = 0; i < all.size(); ++i)
      tasks.push_back({.prepare = [&, i] { drivers[i].drive(*all[i], seconds); },
                       .run = [&, i] { all[i]->step(seconds); }});
    RoundOptions rounds = rounds_;
    rounds.warm_up = options_.warm_up;
    const std::vector<Timing> timings = time_in_rounds(tasks, rounds);
    for (std::size_t i = 0; i < all.size(); ++i) {
      StepSpeed step{.kind = kind, .robots = from.size(), .time = timings[i]};
      look_into(*all[i], drivers[i], seconds, step);
      speeds[i].steps.push_back(step);
    }
  }

  // Phases and contacts, from further steps, as telling them takes time.
  void look_into(Simulation& simulation, Driver& driver, double seconds, StepSpeed& step) const {
    const int steps = std::max(2, options_.steps / 2);
    for (int i = 0; i < steps; ++i) {
      driver.drive(simulation, seconds);
      const Phases phases = simulation.step_by_phases(seconds);
      step.phases.broadphase += phases.broadphase / steps;
      step.phases.narrowphase += phases.narrowphase / steps;
      step.phases.solver += phases.solver / steps;
      step.contacts += static_cast<double>(simulation.contacts()) / steps;
    }
    step.put_back = driver.put_back();
  }

  void time_detection(std::vector<Speed>& speeds) {
    what_ = "collision detection";
    std::vector<Vec3> floor = spots_.floor;
    floor.resize(std::min(options_.robots.back(), floor.size()));
    floor = touching(places_, floor, options_.size);
    const std::vector<Pose> poses = poses_on(floor, options_.size, options_.seed);
    for (Vec3& spot : floor) spot.z() = spots_.height - 0.001;
    const std::vector<Pose> on_plane = poses_on(floor, options_.size, options_.seed);
    Simulations all;
    for (const Place& place : places_)
      all.push_back(engine_.make(place, place.sort == Sort::plane ? on_plane : poses,
                                 {.size = options_.size}, {}));
    std::vector<Task> tasks;
    for (const auto& simulation : all) tasks.push_back({.run = [&] { simulation->collide(); }});
    const std::vector<Timing> timings = time_in_rounds(tasks, rounds_);
    for (std::size_t i = 0; i < all.size(); ++i) {
      speeds[i].collide = timings[i];
      speeds[i].collide_contacts = all[i]->contacts();
    }
  }

  void time_queries(std::vector<Speed>& speeds) {
    const Simulations all = simulations({}, {});
    if (all[0]->has_queries()) {
      const Vec3 size = Vec3::Constant(options_.size);
      const std::vector<Vec3> probes =
          find_probes(places_, options_.probes, options_.size / 2, options_.seed);
      const std::vector<Pose> poses = poses_on(probes, 0, options_.seed);
      time_probes("contact tests", all, poses.size(), speeds, &Speed::contact,
                  [&](Simulation& s, std::size_t i) { s.touches(size, poses[i]); });
      const std::vector<Pose> from = starts(options_.probes, 0.3);
      Random random(options_.seed + 4);
      std::vector<Vec3> to;
      for (const Pose& pose : from) to.push_back(pose.position + random.level_direction());
      time_probes("sweeps", all, from.size(), speeds, &Speed::sweep,
                  [&](Simulation& s, std::size_t i) { s.sweep(size, from[i], to[i]); });
    }
    time_lidar(all, speeds);
  }

  // Times something done at each of many places; a sample is a tenth of them, so that the clock
  // does not count.
  template <typename Probe>
  void time_probes(const char* what, const Simulations& all, std::size_t count,
                   std::vector<Speed>& speeds, std::optional<Timing> Speed::*figure,
                   const Probe& probe) {
    what_ = what;
    const std::size_t batch = std::max<std::size_t>(1, count / 10);
    std::vector<std::size_t> next(all.size(), 0);
    std::vector<Task> tasks;
    for (std::size_t k = 0; k < all.size(); ++k)
      tasks.push_back({.run =
                           [&, k] {
                             for (std::size_t i = 0; i < batch; ++i)
                               probe(*all[k], next[k]++ % count);
                           },
                       .count = batch});
    const std::vector<Timing> timings = time_in_rounds(tasks, rounds_);
    for (std::size_t k = 0; k < all.size(); ++k) speeds[k].*figure = timings[k];
  }

  void time_lidar(const Simulations& all, std::vector<Speed>& speeds) {
    what_ = "lidar";
    std::vector<std::size_t> next(all.size(), 0);
    std::vector<Task> tasks;
    for (std::size_t k = 0; k < all.size(); ++k)
      tasks.push_back({.run = [&, k] { scan(*all[k], next[k]++); }});
    RoundOptions rounds = rounds_;
    rounds.runs = std::max(2, options_.steps / 4);
    const std::vector<Timing> timings = time_in_rounds(tasks, rounds);
    for (std::size_t k = 0; k < all.size(); ++k) speeds[k].lidar = timings[k];
  }

  // 16 rows within 15 degrees of level, from half a metre over the floor, up to 30 m.
  void scan(Simulation& simulation, std::size_t turn) const {
    const Vec3 from = spots_.floor[turn % spots_.floor.size()] + Vec3(0, 0, 0.5);
    for (int row = 0; row < 16; ++row)
      for (int column = 0; column < 360; ++column) {
        const double up = (-15 + 2 * row) * M_PI / 180, around = column * M_PI / 180;
        const Vec3 way(std::cos(up) * std::cos(around), std::cos(up) * std::sin(around),
                       std::sin(up));
        simulation.cast(from, from + 30 * way);
      }
  }

  const std::vector<Place>& places_;
  const Spots& spots_;
  const EngineMaker& engine_;
  const SpeedOptions& options_;
  const Progress& progress_;
  RoundOptions rounds_;
  std::string what_;
  double done_ = 0, turns_ = 1;
};

}  // namespace

std::vector<Speed> measure_speed(const std::vector<Place>& places, const Spots& spots,
                                 const EngineMaker& engine, const SpeedOptions& options,
                                 const Progress& progress) {
  return Bench(places, spots, engine, options, progress).run();
}

}  // namespace scanworld::sim
