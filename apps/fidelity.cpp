// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "fidelity.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <map>
#include <tuple>

#include "cli.h"
#include "reconstruct.h"
#include "rival/scale.h"
#include "scan/distinct.h"
#include "scan/read_scan.h"

namespace scanworld::cli {

namespace {

constexpr std::size_t kNamedSurfaces = 5;  // in the text
constexpr std::size_t kFewPoints = 10;     // say little about a surface

Json json_of(const Distances& d) { return {{"median", d.median}, {"p95", d.p95}}; }

Json json_of(const std::optional<double>& value) { return value ? Json(*value) : Json(nullptr); }

Json json_of(const FloorQuality& quality) {
  Json floors = Json::array();
  for (const WholeFloor& floor : quality.floors)
    floors.push_back({{"area", floor.area}, {"pieces", floor.pieces}});
  return {{"area", quality.area},
          {"steps", quality.steps},
          {"gaps", quality.gaps},
          {"each", std::move(floors)}};
}

Json json_of(const StraySurfaces& strays) {
  return {{"floating", strays.floating},
          {"floating_area", strays.floating_area},
          {"area", strays.area},
          {"crossings", strays.crossings},
          {"edges", strays.edges}};
}

std::string length_text(double metres) { return figure_text(metres, "m"); }

std::string criterion_line(const Criterion& c) {
  if (!c.value) return fmt::format("  {:<30} not asked: no {}\n", c.name, c.lacking);
  return fmt::format("  {:<30} {:>15}  {} {:<14}  {}\n", c.name, figure_text(*c.value, c.unit),
                     c.is_minimum ? "at least" : "at most ", figure_text(c.limit, c.unit),
                     c.is_met() ? "passed" : "FAILED");
}

// The surfaces that are farthest from their points, by rms; those that are misplaced first.
std::vector<SurfaceFidelity> worst_surfaces(const Fidelity& fidelity) {
  std::vector<SurfaceFidelity> worst = fidelity.surfaces;
  const auto rank = [&](const SurfaceFidelity& s) {
    return std::tuple(std::ranges::count(fidelity.misplaced, s.id), s.points >= kFewPoints, s.rms);
  };
  std::ranges::stable_sort(worst, std::greater(), rank);
  worst.resize(std::min(worst.size(), kNamedSurfaces));
  return worst;
}

}  // namespace

PointCloud read_scan_with_poses(const std::vector<std::filesystem::path>& scans,
                                const std::filesystem::path& poses) {
  return read_scan(scans, poses.empty() ? std::vector<Vec3>{} : read_poses(poses));
}

Fidelity fidelity_of(const World& world, const PointCloud& scan, std::size_t points) {
  const DistinctPoints distinct = find_distinct(scan);
  const PointCloud& cloud = distinct.of(scan);
  ReconstructOptions options;
  apply_preset(options, preset_for(cloud));
  const OptionList list = list_options(options);
  const auto& used = world.provenance.options;
  for (const Option& option : list)
    if (option.name.starts_with("rival.scale.") && used.contains(option.name))
      set_option(list, option.name, scanworld::text_of(used.at(option.name)));
  const rival::Scale scale = rival::estimate_scale(cloud, options.rival.scale);
  return measure_fidelity(world, cloud,
                          {.noise = scale.noise,
                           .spacing = scale.spacing,
                           .depth_step = scale.depth_step,
                           .points = points});
}

Json json_of(const Fidelity& f) {
  Json surfaces = Json::array(), criteria = Json::array();
  for (const SurfaceFidelity& s : f.surfaces)
    surfaces.push_back({{"id", s.id},
                        {"area", s.area},
                        {"points", s.points},
                        {"rms", s.rms},
                        {"offset", s.offset},
                        {"coverage", json_of(s.coverage)}});
  for (const Criterion& c : f.criteria)
    criteria.push_back({{"name", c.name},
                        {"unit", c.unit},
                        {"value", json_of(c.value)},
                        {c.is_minimum ? "at_least" : "at_most", c.limit},
                        {"met", c.value ? Json(c.is_met()) : Json(nullptr)}});
  return {{"faithful", f.is_faithful()},
          {"verdict", verdict_of(f)},
          {"points", f.points},
          {"places", f.places},
          {"rays", f.rays},
          {"noise", f.noise},
          {"spacing", f.spacing},
          {"bend", f.bend},
          {"tolerance", f.tolerance},
          {"max_distance", f.max_distance},
          {"scan_to_world", json_of(f.scan_to_world)},
          {"world_to_scan", json_of(f.world_to_scan)},
          {"measured_area", f.measured_area},
          {"inferred_area", f.inferred_area},
          {"coverage", f.coverage},
          {"unexplained", f.unexplained},
          {"close", f.close},
          {"inside", f.inside},
          {"flat", f.flat},
          {"doubled", json_of(f.doubled)},
          {"free_space_violations", json_of(f.free_space_violations)},
          {"leaks", json_of(f.leaks)},
          {"misplaced", f.misplaced},
          {"floors", json_of(f.floors)},
          {"strays", json_of(f.strays)},
          {"criteria", criteria},
          {"surfaces", surfaces}};
}

std::string verdict_of(const Fidelity& fidelity) {
  std::string failed, not_asked;
  const auto add = [](std::string& list, const std::string& item) {
    list += (list.empty() ? "" : ", ") + item;
  };
  std::map<std::string, std::string> lacking;
  for (const Criterion& c : fidelity.criteria) {
    if (!c.value)
      add(lacking[c.lacking], c.name);
    else if (!c.is_met())
      add(failed, fmt::format("{} {}", c.name, figure_text(*c.value, c.unit)));
  }
  for (const auto& [what, names] : lacking) add(not_asked, fmt::format("{} (no {})", names, what));
  return (failed.empty() ? "faithful" : "not faithful: " + failed) +
         (not_asked.empty() ? "" : "; not asked: " + not_asked);
}

std::string text_of(const Fidelity& f, const World& world) {
  std::string text = fmt::format(
      "looked at {} points, {} places on surfaces and {} rays; noise {}, spacing {}, tolerance {}\n"
      "{:<18} median {:>9}, 95 % within {:>9}\n{:<18} median {:>9}, 95 % within {:>9}\n",
      grouped(f.points), grouped(f.places), grouped(f.rays), length_text(f.noise),
      length_text(f.spacing), length_text(f.tolerance), "scan to world",
      length_text(f.scan_to_world.median), length_text(f.scan_to_world.p95), "world to scan",
      length_text(f.world_to_scan.median), length_text(f.world_to_scan.p95));
  text += fmt::format("{:<18} {:.2f} m2 measured, {:.2f} m2 inferred\n", "surfaces",
                      f.measured_area, f.inferred_area);
  text += "surfaces farthest from their points\n";
  for (const SurfaceFidelity& s : worst_surfaces(f)) {
    const auto surface = std::ranges::find(world.surfaces, s.id, &Surface::id);
    text += fmt::format("  {:>5} {:<8} {:8.2f} m2  rms {:>8}  off by {:>8}  {} points\n", s.id,
                        name_of(surface->kind), s.area, length_text(s.rms), length_text(s.offset),
                        grouped(s.points));
  }
  text += "criteria\n";
  for (const Criterion& c : f.criteria) text += criterion_line(c);
  return text + fmt::format("verdict: {}\n", verdict_of(f));
}

}  // namespace scanworld::cli
