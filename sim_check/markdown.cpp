// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "report.h"

namespace scanworld::sim {

namespace {

using Cells = std::vector<std::string>;

// Columns as wide as what is in them, so that it reads well as plain text too.
std::string table_of(const std::vector<Cells>& rows) {
  std::vector<std::size_t> width(rows[0].size(), 3);
  for (const Cells& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], row[k].size());
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t k = 0; k < rows[i].size(); ++k)
      text += k == 0 ? fmt::format("| {:<{}} ", rows[i][k], width[k])
                     : fmt::format("| {:>{}} ", rows[i][k], width[k]);
    text += "|\n";
    if (i > 0) continue;
    for (std::size_t k = 0; k < width.size(); ++k)
      text += k == 0 ? fmt::format("| {:-<{}} ", "", width[k])
                     : fmt::format("| {:->{}}: ", "", width[k] - 1);
    text += "|\n";
  }
  return text + "\n";
}

// Three figures, without an exponent.
std::string short_text(double x) {
  const double size = std::abs(x);
  return size == 0     ? "0"
         : size >= 100 ? fmt::format("{:.0f}", x)
         : size >= 10  ? fmt::format("{:.1f}", x)
         : size >= 1   ? fmt::format("{:.2f}", x)
                       : fmt::format("{:.3f}", x);
}

std::string memory_text(double bytes) {
  return bytes <= 0     ? "-"
         : bytes >= 1e6 ? short_text(bytes / 1e6) + " MB"
                        : short_text(bytes / 1e3) + " kB";
}

// "mean +- deviation", and the ratio to the first row; "~" where that is not certain.
void add_timing(Cells& cells, const Timing& timing, double unit) {
  cells.push_back(short_text(timing.cpu.mean / unit) + " ± " +
                  short_text(timing.cpu.deviation / unit));
  cells.push_back((timing.is_noisy() ? "~" : "") + short_text(timing.ratio));
}

std::string places_table(const Comparison& c) {
  std::vector<Cells> rows = {
      {"place", "robots touch", "triangles", "per m2", "solids", "memory", "load s", "build ms"}};
  for (const Row& row : c.rows) {
    const Speed& s = row.speed;
    if (s.triangles == 0) continue;
    rows.push_back(
        {row.name, row.sort == Sort::world ? "solids" : "triangles", fmt::to_string(s.triangles),
         short_text(static_cast<double>(s.triangles) / s.area), fmt::to_string(s.solids),
         memory_text(s.memory), short_text(s.load_seconds), short_text(1e3 * s.build_seconds)});
  }
  return table_of(rows);
}

std::string speed_table(const Comparison& c) {
  Cells head = {"place"};
  const auto add_head = [&](const std::string& what) { head.insert(head.end(), {what, "x"}); };
  for (const StepSpeed& step : c.rows[0].speed.steps)
    if (step.robots == c.rows[0].speed.steps.back().robots)
      add_head(fmt::format("step, {} {}s, ms", step.robots, name_of(step.kind)));
  add_head("detection alone, ms");
  if (c.rows[0].speed.contact) add_head("contact test, us"), add_head("sweep 1 m, us");
  add_head("lidar 16x360, ms");
  std::vector<Cells> rows = {head};
  for (const Row& row : c.rows) {
    Cells cells = {row.name};
    for (const StepSpeed& step : row.speed.steps)
      if (step.robots == row.speed.steps.back().robots) add_timing(cells, step.time, 1e-3);
    add_timing(cells, row.speed.collide, 1e-3);
    if (row.speed.contact)
      add_timing(cells, *row.speed.contact, 1e-6), add_timing(cells, *row.speed.sweep, 1e-6);
    add_timing(cells, row.speed.lidar, 1e-3);
    rows.push_back(cells);
  }
  return table_of(rows);
}

std::string steps_table(const Comparison& c) {
  std::vector<Cells> rows = {{"robots", "place", "step ms", "x", "median", "99 %", "wall",
                              "broadphase", "narrowphase", "solver", "contacts", "left"}};
  for (std::size_t k = 0; k < c.rows[0].speed.steps.size(); ++k)
    for (const Row& row : c.rows) {
      const StepSpeed& step = row.speed.steps[k];
      Cells cells = {fmt::format("{} {}s", step.robots, name_of(step.kind)), row.name};
      add_timing(cells, step.time, 1e-3);
      for (double seconds : {step.time.cpu.median, step.time.cpu.p99, step.time.wall.mean,
                             step.phases.broadphase, step.phases.narrowphase, step.phases.solver})
        cells.push_back(short_text(1e3 * seconds));
      cells.push_back(short_text(step.contacts));
      cells.push_back(fmt::to_string(step.put_back));
      rows.push_back(cells);
    }
  return table_of(rows);
}

// What the columns of speed_table() are short of.
std::string figures_table(const Comparison& c) {
  std::vector<Cells> rows = {{"figure", "place", "mean", "x", "median", "99 %", "wall"}};
  const auto add = [&](const char* figure, double unit, auto timing_of) {
    for (const Row& row : c.rows) {
      const Timing* timing = timing_of(row.speed);
      if (!timing) continue;
      Cells cells = {figure, row.name};
      add_timing(cells, *timing, unit);
      for (double seconds : {timing->cpu.median, timing->cpu.p99, timing->wall.mean})
        cells.push_back(short_text(seconds / unit));
      rows.push_back(cells);
    }
  };
  const auto maybe = [](const std::optional<Timing>& t) { return t ? &*t : nullptr; };
  add("detection, ms", 1e-3, [](const Speed& s) { return &s.collide; });
  add("contact test, us", 1e-6, [&](const Speed& s) { return maybe(s.contact); });
  add("sweep, us", 1e-6, [&](const Speed& s) { return maybe(s.sweep); });
  add("lidar, ms", 1e-3, [](const Speed& s) { return &s.lidar; });
  return table_of(rows);
}

std::string percent(double share) { return fmt::format("{:.1f} %", 100 * share + 0.0); }

std::string robustness_table(const Comparison& c) {
  Cells head = {"place"};
  for (const Lost& l : c.rows[0].robustness.lost)
    head.push_back(fmt::format("lost, {:g} m/s {:g} Hz", l.speed, l.rate));
  for (const char* what : {"cube slides: speed lost", "bump mm/s", "ball rolls: speed lost",
                           "doors passed", "walls open", "floor gaps", "lidar mm"})
    head.push_back(what);
  std::vector<Cells> rows = {head};
  for (const Row& row : c.rows) {
    const Robustness& r = row.robustness;
    if (r.lost.empty()) continue;
    Cells cells = {row.name};
    for (const Lost& l : r.lost)
      cells.push_back(percent(static_cast<double>(l.at.size()) / static_cast<double>(l.robots)));
    const bool glides = r.lanes > 0;
    cells.push_back(glides ? percent(r.cube.speed_lost) : "-");
    cells.push_back(glides ? short_text(1e3 * r.cube.bump) : "-");
    cells.push_back(glides ? percent(r.ball.speed_lost) : "-");
    cells.push_back(r.doors ? fmt::format("{} of {}", r.doors->passed, r.doors->wide) : "-");
    cells.push_back(r.doors ? fmt::format("{} of {}", r.doors->walls_open, r.doors->walls) : "-");
    cells.push_back(fmt::format("{} ({:.3f} m2)", r.floor.gaps.size(), r.floor.area));
    cells.push_back(r.lidar ? short_text(1e3 * r.lidar->median) : "-");
    rows.push_back(cells);
  }
  return table_of(rows);
}

std::string promise_line(const Criterion& p) {
  const auto text = [&](double value) {
    return p.unit == "%"   ? fmt::format("{:.2f} %", 100 * value)
           : p.unit == "s" ? fmt::format("{:.2f} us", 1e6 * value)
           : p.unit == "m" ? fmt::format("{:.1f} mm", 1e3 * value)
                           : fmt::format("{:g}", value);
  };
  return fmt::format("- {}: {}, at most {}: {}\n", p.name, text(*p.value), text(p.limit),
                     p.is_met() ? "kept" : "BROKEN");
}

// Where to look: gaps in the floor, and the robots that are lost.
std::string places_of(const Row& row) {
  constexpr std::size_t kMost = 6;
  const auto listed = [](const std::vector<Vec3>& places) {
    std::string text;
    for (std::size_t i = 0; i < places.size() && i < kMost; ++i)
      text += fmt::format("{}({:.2f}, {:.2f}, {:.2f})", i ? ", " : "", places[i].x(), places[i].y(),
                          places[i].z());
    return text + (places.size() > kMost ? ", ..." : "");
  };
  std::string text;
  for (const Lost& l : row.robustness.lost)
    if (!l.at.empty())
      text += fmt::format("  - lost at {:g} m/s and {:g} Hz: {}\n", l.speed, l.rate, listed(l.at));
  std::vector<Vec3> gaps;
  for (const FloorGap& gap : row.robustness.floor.gaps) gaps.push_back(gap.at);
  return gaps.empty() ? text : text + fmt::format("  - gaps at: {}\n", listed(gaps));
}

}  // namespace

std::string verdict_of(const Comparison& c) {
  std::string broken;
  for (const Row& row : c.rows)
    for (const Criterion& p : row.promises)
      if (!p.is_met()) broken += (broken.empty() ? "" : "; ") + row.name + ": " + p.name;
  return broken.empty() ? "all promises are kept" : "promises are broken: " + broken;
}

std::string markdown_of(const Comparison& c) {
  const CompareOptions& o = c.options;
  std::string text;
  if (o.with_speed) {
    text += places_table(c);
    text += fmt::format(
        "Robots of {:g} m, {:g} Hz, {}, one thread. CPU time, mean ± deviation; x: how many times "
        "as fast as the first row, the median of {} rounds in which all took turns; ~: the rounds "
        "disagree.\n\n",
        o.size, o.speed.rate, o.engine, o.speed.rounds);
    text += speed_table(c) + steps_table(c) + figures_table(c);
  }
  if (o.with_robustness) {
    text += fmt::format(
        "Of {} robots driven at random with {:g} m/s2, for {:g} s, those that went through a "
        "surface; the rest at 240 Hz.\n\n",
        std::min(c.spots, o.robustness.robots), o.robustness.push, o.robustness.seconds);
    text += robustness_table(c);
  }
  for (const std::string& name : c.left_out)
    text += fmt::format("{} is left out: {} takes no meshes.\n\n", name, o.engine);
  if (c.shared < c.spots)
    text += fmt::format(
        "{} of {} robots began where a mesh has no level floor, or something in the way.\n\n",
        c.spots - c.shared, c.spots);
  for (const Row& row : c.rows) {
    if (row.promises.empty()) continue;
    text += row.name + "\n\n";
    for (const Criterion& p : row.promises) text += promise_line(p);
    text += places_of(row);
    for (const std::string& place : row.in_the_way) text += "  - " + place + "\n";
    text += "\n";
  }
  for (const std::string& noise : c.noise)
    text += fmt::format("The machine was too noisy to judge: {} (load {:.1f}).\n", noise, c.load);
  return text + "Verdict: " + verdict_of(c) + ".\n";
}

}  // namespace scanworld::sim
