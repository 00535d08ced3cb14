// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// A comparison for programs: JSON and CSV.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "report.h"
#include "version.h"

namespace scanworld::sim {

namespace {

using Json = nlohmann::ordered_json;

Json stats_json(const Stats& s) {
  return {{"mean", s.mean}, {"deviation", s.deviation}, {"median", s.median}, {"p99", s.p99},
          {"min", s.min},   {"samples", s.samples}};
}

Json timing_json(const Timing& t) {
  return {{"cpu", stats_json(t.cpu)},
          {"wall", stats_json(t.wall)},
          {"ratio", t.ratio},
          {"ratio_quartiles", {t.ratio_low, t.ratio_high}}};
}

Json step_json(const StepSpeed& s) {
  return {{"robot", name_of(s.kind)},
          {"robots", s.robots},
          {"time", timing_json(s.time)},
          {"broadphase", s.phases.broadphase},
          {"narrowphase", s.phases.narrowphase},
          {"solver", s.phases.solver},
          {"contacts", s.contacts},
          {"left", s.put_back}};
}

Json speed_json(const Speed& s) {
  Json steps = Json::array();
  for (const StepSpeed& step : s.steps) steps.push_back(step_json(step));
  Json json = {{"triangles", s.triangles},
               {"area", s.area},
               {"solids", s.solids},
               {"memory", s.memory},
               {"load_seconds", s.load_seconds},
               {"build_seconds", s.build_seconds},
               {"steps", steps},
               {"detection", timing_json(s.collide)},
               {"detection_contacts", s.collide_contacts}};
  if (s.contact) json["contact_test"] = timing_json(*s.contact);
  if (s.sweep) json["sweep"] = timing_json(*s.sweep);
  json["lidar"] = timing_json(s.lidar);
  return json;
}

Json at(const Vec3& p) { return {p.x(), p.y(), p.z()}; }

Json floor_json(const FloorGaps& floor) {
  Json places = Json::array();
  for (const FloorGap& gap : floor.gaps) places.push_back({{"at", at(gap.at)}, {"area", gap.area}});
  return {{"drivable", floor.drivable},
          {"gaps", floor.gaps.size()},
          {"gap_area", floor.area},
          {"gaps_at", places}};
}

Json robustness_json(const Robustness& r) {
  Json lost = Json::array();
  for (const Lost& l : r.lost) {
    Json places = Json::array();
    for (const Vec3& p : l.at) places.push_back(at(p));
    lost.push_back({{"speed", l.speed},
                    {"rate", l.rate},
                    {"robots", l.robots},
                    {"lost", l.at.size()},
                    {"lost_at", places}});
  }
  Json json = {{"lost", lost}, {"lanes", r.lanes}};
  json["cube"] = {{"speed_lost", r.cube.speed_lost}, {"bump", r.cube.bump}};
  json["ball"] = {{"speed_lost", r.ball.speed_lost}, {"bump", r.ball.bump}};
  if (r.doors)
    json["doors"] = {{"wide", r.doors->wide},       {"passed", r.doors->passed},
                     {"blocked", r.doors->blocked}, {"narrow", r.doors->narrow},
                     {"walls", r.doors->walls},     {"walls_open", r.doors->walls_open}};
  json["floor"] = floor_json(r.floor);
  if (r.lidar)
    json["lidar"] = {{"rays", r.lidar->rays},
                     {"median", r.lidar->median},
                     {"p95", r.lidar->p95},
                     {"missed", r.lidar->missed}};
  return json;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (char c : text) out += c == '"' ? "\"\"" : std::string(1, c);
  return out + "\"";
}

std::string timing_line(const std::string& place, const std::string& figure,
                        const std::string& robot, std::size_t robots, const Timing& t) {
  return fmt::format("{},{},{},{},s,{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g},{:.6g}\n",
                     quoted(place), figure, robot, robots, t.cpu.mean, t.cpu.deviation,
                     t.cpu.median, t.cpu.p99, t.wall.mean, t.ratio, t.ratio_low, t.ratio_high);
}

std::string value_line(const std::string& place, const std::string& figure, const std::string& unit,
                       double value) {
  return fmt::format("{},{},,,{},{:.6g},,,,,,,\n", quoted(place), figure, unit, value);
}

std::string speed_lines(const std::string& name, const Speed& s) {
  std::string text = value_line(name, "triangles", "", static_cast<double>(s.triangles)) +
                     value_line(name, "area", "m2", s.area) +
                     value_line(name, "solids", "", static_cast<double>(s.solids)) +
                     value_line(name, "memory", "B", s.memory) +
                     value_line(name, "load", "s", s.load_seconds) +
                     value_line(name, "build", "s", s.build_seconds);
  for (const StepSpeed& step : s.steps)
    text += timing_line(name, "step", name_of(step.kind), step.robots, step.time);
  text += timing_line(name, "detection", "cube", s.steps.empty() ? 0 : s.steps.back().robots,
                      s.collide);
  if (s.contact) text += timing_line(name, "contact_test", "", 0, *s.contact);
  if (s.sweep) text += timing_line(name, "sweep", "", 0, *s.sweep);
  return text + timing_line(name, "lidar", "", 0, s.lidar);
}

std::string robustness_lines(const std::string& name, const Robustness& r) {
  std::string text;
  for (const Lost& l : r.lost)
    text += value_line(name, fmt::format("lost_{:g}_m/s_{:g}_Hz", l.speed, l.rate), "",
                       static_cast<double>(l.at.size()) / static_cast<double>(l.robots));
  text += value_line(name, "cube_speed_lost", "", r.cube.speed_lost) +
          value_line(name, "ball_speed_lost", "", r.ball.speed_lost);
  if (r.doors)
    text += value_line(name, "doors_blocked", "", static_cast<double>(r.doors->blocked.size())) +
            value_line(name, "walls_open", "", static_cast<double>(r.doors->walls_open));
  text += value_line(name, "floor_gap_area", "m2", r.floor.area);
  if (r.lidar) text += value_line(name, "lidar_error_median", "m", r.lidar->median);
  return text;
}

}  // namespace

std::string csv_of(const Comparison& c) {
  std::string text =
      "place,figure,robot,robots,unit,mean,deviation,median,p99,wall_mean,ratio,ratio_q25,ratio_q75"
      "\n";
  for (const Row& row : c.rows) {
    if (c.options.with_speed) text += speed_lines(row.name, row.speed);
    if (!row.robustness.lost.empty()) text += robustness_lines(row.name, row.robustness);
  }
  return text;
}

std::string json_of(const Comparison& c) {
  const CompareOptions& o = c.options;
  Json rows = Json::array();
  for (const Row& row : c.rows) {
    Json json = {{"name", row.name}, {"sort", name_of(row.sort)}};
    if (o.with_speed) json["speed"] = speed_json(row.speed);
    if (!row.robustness.lost.empty()) json["robustness"] = robustness_json(row.robustness);
    for (const Criterion& p : row.promises)
      json["promises"].push_back({{"name", p.name},
                                  {"unit", p.unit},
                                  {"value", *p.value},
                                  {"at_most", p.limit},
                                  {"kept", p.is_met()}});
    if (!row.in_the_way.empty()) json["in_the_way"] = row.in_the_way;
    rows.push_back(json);
  }
  return Json{{"program", std::string("scanworld ") + version()},
              {"engine", o.engine},
              {"robot_size", o.size},
              {"rate", o.speed.rate},
              {"rounds", o.speed.rounds},
              {"seed", o.seed},
              {"spots", c.spots},
              {"shared_spots", c.shared},
              {"load_average", c.load},
              {"noise", c.noise},
              {"left_out", c.left_out},
              {"rows", rows},
              {"keeps_promises", c.keeps_promises()},
              {"verdict", verdict_of(c)}}
             .dump(2) +
         "\n";
}

}  // namespace scanworld::sim
