// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "drive.h"

#include "random.h"

namespace scanworld::sim {

namespace {

constexpr double kFallen = 1;  // [m] below the lowest start or outside of the place
constexpr double kLag = 0.05;  // [s] in which the speed asked for is reached, if the wheels can

}  // namespace

std::vector<Pose> poses_on(const std::vector<Vec3>& spots, double size, std::uint64_t seed,
                           double above) {
  Random random(seed + 3);
  std::vector<Pose> poses;
  for (const Vec3& spot : spots)
    poses.push_back({spot + Vec3(0, 0, size / 2 + above),
                     Eigen::Quaterniond(Eigen::AngleAxisd(random.angle(), Vec3::UnitZ()))});
  return poses;
}

Driver::Driver(const Place& place, std::vector<Pose> starts, const RobotOptions& robot,
               const DriveOptions& options)
    : starts_(std::move(starts)),
      options_(options),
      mass_(robot.kind == RobotKind::module ? 1.2 : 1) {
  for (const Vec3& v : place.seen.vertices) box_.extend(v);
  for (const Pose& start : starts_) box_.extend(start.position);
  double lowest = box_.max().z();
  for (const Pose& start : starts_) lowest = std::min(lowest, start.position.z());
  box_ = grown(box_, kFallen);
  box_.min().z() = lowest - kFallen;
}

std::vector<std::size_t> Driver::drive(Simulation& simulation, double seconds) {
  const auto turn = static_cast<std::uint64_t>(time_ / options_.turn_every);
  time_ += seconds;
  std::vector<std::size_t> put_back;
  for (std::size_t i = 0; i < starts_.size(); ++i) {
    if (!box_.contains(simulation.position(i))) {
      simulation.put(i, starts_[i], Vec3::Zero());
      put_back.push_back(i);
      continue;
    }
    Random random(options_.seed * 1000003 + i * 7919 + turn * 104729);
    const Vec3 way = random.level_direction();
    const double speed = options_.speed * (options_.at_full_speed ? 1 : random.unit());
    Vec3 change = (speed * way - simulation.velocity(i)) / kLag;
    change.z() = 0;
    if (const double most = options_.acceleration; change.norm() > most)
      change *= most / change.norm();
    simulation.push(i, mass_ * change);
    simulation.bend(i, 4 * (random.unit() - 0.5));
  }
  put_back_ += put_back.size();
  return put_back;
}

}  // namespace scanworld::sim
