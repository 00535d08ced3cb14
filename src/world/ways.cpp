// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "ways.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "../quantile.h"
#include "way_profile.h"

namespace scanworld {

namespace {

constexpr int kMostMissing = 6;       // steps after each other that nothing was seen of
constexpr double kOffRiser = 0.25;    // [riser] a tread is off where it should be, at most
constexpr double kOffTread = 0.3;     // [tread] the same in plan
constexpr double kBeyondEnd = 0.1;    // [m] so far beyond its end there is a floor
constexpr double kSameHeight = 0.05;  // [m] as a ramp's end

// What most lines meet at one place.
struct Step {
  int k = 0;  // of a flight; 0 is the one that it was found from
  std::size_t level = 0;
  double from = 0, to = 0, height = 0;
};

struct Flight {
  std::vector<Step> steps;  // from the lowest; a floor it begins on is the first
  double riser = 0, tread = 0;
  bool begins = false, ends = false;  // at a floor
};

// What two lines or more meet that pleases, with its height at a place; of more on one line the
// first.
template <typename Pleases>
std::optional<Step> step_where(const WayProfile& profile, double u, const Pleases& pleases) {
  std::vector<WayStretch> met;
  for (const auto& line : profile.lines) {
    const auto found = std::find_if(line.begin(), line.end(), pleases);
    if (found != line.end()) met.push_back(*found);
  }
  if (met.size() < 2) return std::nullopt;
  const auto middle = [&](auto member) {
    std::vector<double> values;
    for (const WayStretch& s : met) values.push_back(s.*member);
    return median(values);
  };
  return Step{0, met[1].level, middle(&WayStretch::from), middle(&WayStretch::to),
              profile.height(met[1], u)};
}

// Least squares: a value of the steps as a line over their number.
struct Line {
  double start = 0, slope = 0;

  double at(int k) const { return start + slope * k; }
};

Line line_through(const std::vector<Step>& steps, double Step::*value) {
  double n = 0, k = 0, v = 0, kk = 0, kv = 0;
  for (const Step& s : steps)
    n += 1, k += s.k, v += s.*value, kk += s.k * s.k, kv += s.k * (s.*value);
  const double slope = (n * kv - k * v) / (n * kk - k * k);
  return {(v - slope * k) / n, slope};
}

// Follows a flight from one of its treads, up or down.
void follow(const WayProfile& profile, int way, const WayOptions& options, Flight& flight) {
  std::vector<Step> treads = flight.steps;  // without a floor below, whose `from` says nothing
  const Step start = treads[0];
  int missing = 0;
  for (int k = start.k + way; missing <= kMostMissing; k += way) {
    const double height = start.height + flight.riser * (k - start.k);
    const double from = start.from + flight.tread * (k - start.k);
    const double off = kOffTread * flight.tread;
    const auto is_at = [&](const WayStretch& s, double u) {
      return std::abs(profile.height(s, u) - height) <= kOffRiser * flight.riser;
    };
    auto step = step_where(profile, from, [&](const WayStretch& s) {
      return is_at(s, from) && std::abs(s.from - from) <= off;
    });
    bool is_floor = step && step->to - step->from >= options.min_floor && way > 0;
    if (!step && way < 0) {
      const double end = from + flight.tread;
      step = step_where(profile, end, [&](const WayStretch& s) {
        return is_at(s, end) && s.from < from - off && s.to >= end - off;
      });
      is_floor = step.has_value();
    }
    if (!step) {
      ++missing;
      continue;
    }
    missing = 0;
    step->k = k;
    flight.steps.push_back(*step);
    if (is_floor) {
      (way > 0 ? flight.ends : flight.begins) = true;
      return;
    }
    treads.push_back(*step);
    flight.riser = line_through(treads, &Step::height).slope;
    flight.tread = line_through(treads, &Step::from).slope;
  }
}

// The longest flight that a tread on an axis is part of.
Flight flight_at(const WayProfile& profile, const Step& seed, const WayOptions& options) {
  Flight best;
  for (const WayStretch& next : profile.lines[kWayLines.size() / 2]) {
    const double riser = profile.height(next, next.from) - seed.height;
    const double tread = next.from - seed.from;
    if (riser < options.min_riser || riser > options.max_riser || tread < options.min_tread ||
        tread > options.max_tread || 2 * riser + tread < options.min_pace ||
        2 * riser + tread > options.max_pace)
      continue;
    Flight flight{.steps = {seed}, .riser = riser, .tread = tread};
    follow(profile, +1, options, flight);
    if (flight.steps.size() < 2) continue;
    follow(profile, -1, options, flight);
    if (flight.steps.size() > best.steps.size()) best = std::move(flight);
  }
  std::sort(best.steps.begin(), best.steps.end(),
            [](const Step& a, const Step& b) { return a.k < b.k; });
  return best;
}

Vec2 longest_edge(const std::vector<Vec2>& ring) {
  Vec2 longest = Vec2::Zero();
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 edge = ring[(i + 1) % ring.size()] - ring[i];
    if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
  }
  return longest.normalized();
}

class Finder {
 public:
  Finder(const World& world, const Upright& upright, const WayOptions& options)
      : world_(world),
        upright_(upright),
        options_(options),
        levels_(levels_of(world, upright, options.max_slope)) {}

  std::vector<Way> run() {
    find_stairs();
    for (const WalkLevel& level : levels_) find_ramp(level);
    std::stable_sort(ways_.begin(), ways_.end(), [&](const Way& a, const Way& b) {
      return world_.frame.up.dot(a.foot) < world_.frame.up.dot(b.foot);
    });
    for (std::size_t i = 0; i < ways_.size(); ++i) ways_[i].id = static_cast<int>(i);
    return std::move(ways_);
  }

 private:
  struct Found {
    WayAxis axis;
    Flight flight;
  };

  double slope(const WalkLevel& level) const { return std::acos(std::min(1.0, level.normal.z())); }

  bool is_tread(const WalkLevel& level) const {
    return !world_.surfaces[level.surface].ground && slope(level) < options_.min_slope;
  }

  // Flights by what was found of them; each tread is of the first that it is in.
  void find_stairs() {
    std::vector<Found> found;
    for (const WalkLevel& level : levels_) {
      if (!is_tread(level)) continue;
      const Vec2 edge = longest_edge(level.rings[0]);
      for (const Vec2& along : {Vec2(edge.y(), -edge.x()), Vec2(-edge.y(), edge.x())}) {
        const WayAxis axis = axis_over(level, along);
        if (axis.width < options_.min_width) continue;
        const auto [low, high] = range_along(level, along);
        if (high - low > options_.max_tread) continue;
        const WayProfile profile = profile_of(levels_, axis);
        const Step seed{0, static_cast<std::size_t>(&level - levels_.data()), 0, high - low,
                        level.height(axis.from)};
        Flight flight = flight_at(profile, seed, options_);
        if (is_stairs(flight)) found.push_back({axis, std::move(flight)});
      }
    }
    std::stable_sort(found.begin(), found.end(), [](const Found& a, const Found& b) {
      return a.flight.steps.size() > b.flight.steps.size();
    });
    std::set<std::size_t> taken;
    for (const Found& f : found) {
      const auto treads = treads_of(f.flight);
      if (std::any_of(treads.begin(), treads.end(),
                      [&](std::size_t level) { return taken.count(level) > 0; }))
        continue;
      taken.insert(treads.begin(), treads.end());
      ways_.push_back(describe(f));
    }
  }

  // A floor, as many treads as steps are asked for, and fewer missing than there are.
  bool is_stairs(const Flight& flight) const {
    if (!flight.begins && !flight.ends) return false;
    const auto treads = static_cast<int>(treads_of(flight).size());
    const int steps = flight.steps.back().k - flight.steps.front().k;
    const int missing = steps + 1 - static_cast<int>(flight.steps.size());
    return steps >= options_.min_steps && treads >= options_.min_steps - 1 && treads > missing;
  }

  static std::vector<std::size_t> treads_of(const Flight& flight) {
    std::vector<std::size_t> treads;
    for (const Step& s : flight.steps) treads.push_back(s.level);
    if (flight.ends) treads.pop_back();
    if (flight.begins) treads.erase(treads.begin());
    return treads;
  }

  Way describe(const Found& found) const {
    const auto& [axis, flight] = found;
    std::vector<double> lows, highs;
    for (const std::size_t level : treads_of(flight)) {
      const auto [low, high] = range_along(levels_[level], axis.across());
      lows.push_back(low), highs.push_back(high);
    }
    const double low = median(lows), high = median(highs);
    const Step &first = flight.steps.front(), &last = flight.steps.back();
    const int steps = last.k - first.k;
    // Of a floor that stairs begin on it says nothing where that begins.
    const Line fronts = line_through(
        {flight.steps.begin() + (flight.begins ? 1 : 0), flight.steps.end()}, &Step::from);
    const double start = fronts.at(first.k + 1), end = fronts.at(last.k);
    const auto place = [&](double u, double height) {
      const Vec2 p = axis.at(u) + ((low + high) / 2 - axis.across().dot(axis.from)) * axis.across();
      return world_place(p, height);
    };
    return {.kind = WayKind::stairs,
            .foot = place(start, first.height),
            .top = place(end, last.height),
            .width = high - low,
            .steps = steps,
            .riser = (last.height - first.height) / steps,
            .tread = fronts.slope,
            .floors = {flight.begins ? id_of(first.level) : std::nullopt,
                       flight.ends ? id_of(last.level) : std::nullopt}};
  }

  std::optional<int> id_of(std::size_t level) const {
    return world_.surfaces[levels_[level].surface].id;
  }

  Vec3 world_place(const Vec2& p, double height) const {
    const Vec3 place = upright_.turn.conjugate() * Vec3(p.x(), p.y(), height);
    return (place * 1e6).array().round() / 1e6;
  }

  void find_ramp(const WalkLevel& level) {
    if (world_.surfaces[level.surface].ground || slope(level) < options_.min_slope) return;
    const WayAxis axis = axis_over(level, -level.normal.head<2>().normalized());
    if (axis.width < options_.min_width) return;
    const WayProfile profile = profile_of(levels_, axis);
    const auto index = static_cast<std::size_t>(&level - levels_.data());
    const auto ramp = step_where(profile, 0, [&](const WayStretch& s) {
      return s.level == index && s.to - s.from >= options_.min_floor;
    });
    if (!ramp) return;
    const double foot = level.height(axis.at(ramp->from)), top = level.height(axis.at(ramp->to));
    if (top - foot < options_.min_rise) return;
    const auto floor_at = [&](double u, double height) {
      return step_where(profile, u, [&](const WayStretch& s) {
        return s.level != index && s.from <= u && s.to >= u &&
               slope(levels_[s.level]) < slope(level) / 2 &&
               std::abs(profile.height(s, u) - height) <= kSameHeight;
      });
    };
    const auto below = floor_at(ramp->from - kBeyondEnd, foot);
    const auto above = floor_at(ramp->to + kBeyondEnd, top);
    if (!below || !above) return;
    ways_.push_back({.kind = WayKind::ramp,
                     .foot = world_place(axis.at(ramp->from), foot),
                     .top = world_place(axis.at(ramp->to), top),
                     .width = axis.width,
                     .slope = slope(level),
                     .floors = {id_of(below->level), id_of(above->level)}});
  }

  const World& world_;
  const Upright& upright_;
  const WayOptions& options_;
  const std::vector<WalkLevel> levels_;
  std::vector<Way> ways_;
};

}  // namespace

std::vector<Way> find_ways(const World& world, const Upright& upright, const WayOptions& options) {
  return Finder(world, upright, options).run();
}

OptionList list_options(WayOptions& o) {
  return {
      {"ways.min_width", &o.min_width, "m", "of stairs and ramps", 0},
      {"ways.min_riser", &o.min_riser, "m", "of stairs", 0.01},
      {"ways.max_riser", &o.max_riser, "m", "of stairs", 0.01},
      {"ways.min_tread", &o.min_tread, "m", "of stairs", 0.01},
      {"ways.max_tread", &o.max_tread, "m", "of stairs", 0.01},
      {"ways.min_pace", &o.min_pace, "m", "of stairs: twice the riser and the tread", 0},
      {"ways.max_pace", &o.max_pace, "m", "of stairs", 0},
      {"ways.min_steps", &o.min_steps, "", "risers of stairs", 2, 100},
      {"ways.min_slope", &o.min_slope, "rad", "of a ramp; less is a floor", 0.01},
      {"ways.max_slope", &o.max_slope, "rad", "of a ramp; more is a roof", 0.01},
      {"ways.min_rise", &o.min_rise, "m", "of a ramp", 0},
      {"ways.min_floor", &o.min_floor, "m", "deep is a floor or a landing at a way's end", 0},
  };
}

}  // namespace scanworld
