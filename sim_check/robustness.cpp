// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "robustness.h"

#include <algorithm>
#include <cmath>
#include <deque>

#include "drive.h"
#include "random.h"
#include "timing.h"
#include "turn.h"

namespace scanworld::sim {

namespace {

// Tells when a robot has gone through a surface. At some metres a second its middle is beyond one
// for a step or two before it is pushed out again, and it cuts corners, so it is lost when it
// neither comes back nor is where it could have come on a way around.
class Watch {
 public:
  Watch(const MeshRays& surfaces, const Vec3& start) : surfaces_(surfaces) { restart(start); }

  void see(const Vec3& position, double seconds) {
    if (is_lost_) return;
    if (can_come_to(position)) {
      last_ = position, beyond_ = 0;
      if ((position - way_.back()).norm() > kApart) way_.push_back(position);
      if (way_.size() > kRemembered) way_.pop_front();
    } else {
      beyond_ += seconds;
    }
    is_lost_ = beyond_ > kReturn;
  }
  void restart(const Vec3& start) { last_ = start, way_ = {start}, beyond_ = 0; }
  bool is_lost() const { return is_lost_; }
  const Vec3& last() const { return last_; }

 private:
  static constexpr double kReturn = 0.25;           // [s]
  static constexpr double kCorners[] = {0.1, 0.2};  // [m] around which a way can lead
  static constexpr double kApart = 0.05;            // [m]
  static constexpr std::size_t kRemembered = 6;     // places on its way

  bool is_free(const Vec3& from, const Vec3& to) const {
    const double length = (to - from).norm();
    return length == 0 || surfaces_.is_free(from, (to - from) / length, length);
  }
  bool can_come_to(const Vec3& position) const {
    return is_free(last_, position) ||
           std::ranges::any_of(way_, [&](const Vec3& p) { return leads_around(p, position); });
  }
  bool leads_around(const Vec3& from, const Vec3& to) const {
    constexpr int kWays = 16;
    for (double distance : kCorners)
      for (int i = 0; i < kWays; ++i) {
        const double a = 2 * M_PI * i / kWays;
        const Vec3 corner = from + distance * Vec3(std::cos(a), std::sin(a), 0);
        if (is_free(from, corner) && is_free(corner, to)) return true;
      }
    return false;
  }

  const MeshRays& surfaces_;
  Vec3 last_;             // where it was last
  std::deque<Vec3> way_;  // and before
  double beyond_ = 0;     // [s] that it has been where it can't be
  bool is_lost_ = false;
};

}  // namespace

Lost drive_at(const Place& place, const MeshRays& seen, const Spots& spots,
              const EngineMaker& engine, double speed, double rate,
              const RobustnessOptions& options) {
  std::vector<Vec3> floor = spots.floor;
  floor.resize(std::min(options.robots, floor.size()));
  const std::vector<Pose> starts = poses_on(floor, options.size, options.seed, 0.02);
  const RobotOptions robot{.size = options.size};
  const auto simulation = engine.make(place, starts, robot, {});
  Driver driver(place, starts, robot,
                {.speed = speed,
                 .acceleration = options.push,
                 .at_full_speed = true,
                 .seed = options.seed + 5});
  std::vector<Watch> watches;
  for (const Pose& start : starts) watches.emplace_back(seen, start.position);
  const int steps = static_cast<int>(std::lround(options.seconds * rate));
  for (int step = 0; step < steps; ++step) {
    for (std::size_t i : driver.drive(*simulation, 1 / rate))
      watches[i].restart(starts[i].position);
    simulation->step(1 / rate);
    for (std::size_t i = 0; i < starts.size(); ++i)
      watches[i].see(simulation->position(i), 1 / rate);
  }
  Lost lost{.speed = speed, .rate = rate, .robots = starts.size()};
  for (const Watch& watch : watches)
    if (watch.is_lost()) lost.at.push_back(watch.last());
  return lost;
}

Glide glide(const Place& place, const std::vector<Lane>& lanes, const EngineMaker& engine,
            RobotKind kind, const RobustnessOptions& options) {
  constexpr double kSpeed = 1, kRate = 240;  // [m/s], [Hz]
  Glide glide;
  const double half = options.size / 2;
  const auto simulation =
      engine.make(place, {Pose{}}, {.kind = kind, .size = options.size, .friction = 0}, {});
  for (const Lane& lane : lanes) {
    const Vec3 along = (lane.to - lane.from).normalized();
    const Pose start{lane.from + Vec3(0, 0, half), turn_between(Vec3::UnitX(), along)};
    const Vec3 rolling = kSpeed / half * Vec3::UnitZ().cross(along);
    simulation->put(0, start, kSpeed * along, kind == RobotKind::ball ? rolling : Vec3::Zero());
    const int steps = static_cast<int>((lane.to - lane.from).norm() / kSpeed * kRate);
    for (int step = 0; step < steps; ++step) {
      simulation->step(1 / kRate);
      glide.bump = std::max(glide.bump, std::abs(simulation->velocity(0).z()));
    }
    const double lost = 1 - simulation->velocity(0).dot(along) / kSpeed;
    glide.speed_lost += lost / static_cast<double>(lanes.size());
  }
  return glide;
}

LidarError compare_lidar(Simulation& simulation, const PointCloud& scan,
                         const RobustnessOptions& options) {
  Random random(options.seed + 6);
  LidarError error;
  std::vector<double> errors;
  for (std::size_t i = 0; i < options.rays; ++i) {
    const Vec3 p = scan.points[random.next() % scan.points.size()].cast<double>();
    const Vec3 from = nearest_of(scan.viewpoints, p);
    const double range = (p - from).norm();
    if (range < 0.3) continue;
    ++error.rays;
    const double far = range + 5;
    const double share = simulation.cast(from, from + far / range * (p - from));
    if (share >= 1)
      error.missed += 1;
    else
      errors.push_back(std::abs(share * far - range));
  }
  if (error.rays > 0) error.missed /= static_cast<double>(error.rays);
  if (!errors.empty()) error.median = median_of(errors), error.p95 = quantile_of(errors, 0.95);
  return error;
}

std::vector<Robustness> measure_robustness(const std::vector<Place>& places, const Spots& spots,
                                           const EngineMaker& engine, const PointCloud* scan,
                                           const RobustnessOptions& options,
                                           const Progress& progress) {
  const std::vector<Lane> lanes = find_lanes(places, spots, options.lane, options.lanes,
                                             {.size = options.size, .seed = options.seed});
  std::vector<Robustness> all(places.size());
  double done = 0;
  const double turns = static_cast<double>(places.size()) *
                       static_cast<double>(options.speeds.size() * options.rates.size() + 2);
  const auto tell = [&](const char* what) {
    if (progress) progress(what, std::min(1.0, done++ / turns));
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const Place& place = places[i];
    Robustness& found = all[i];
    const MeshRays seen(place.seen);
    for (double rate : options.rates)
      for (double speed : options.speeds) {
        tell("driving against walls");
        found.lost.push_back(drive_at(place, seen, spots, engine, speed, rate, options));
      }
    tell("gliding over the floor");
    found.lanes = lanes.size();
    found.cube = glide(place, lanes, engine, RobotKind::cube, options);
    found.ball = glide(place, lanes, engine, RobotKind::ball, options);
    tell("going through doors");
    const auto simulation = engine.make(place, {}, {}, {});
    const auto& truth = place.world ? place.world : reference_of(places).world;
    if (truth && simulation->has_queries()) found.doors = go_through(*truth, *simulation, options);
    found.floor = find_floor_gaps(place, spots, scan, options);
    if (scan && !scan->viewpoints.empty()) found.lidar = compare_lidar(*simulation, *scan, options);
  }
  return all;
}

}  // namespace scanworld::sim
