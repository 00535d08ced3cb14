// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "report_json.h"

#include "cli.h"
#include "fidelity.h"
#include "version.h"
#include "world/cracks.h"
#include "world/world_json.h"

namespace scanworld::cli {

namespace {

Json json_of(const StageReport& s) {
  return {{"name", s.name},
          {"seconds", s.seconds},
          {"cpu_seconds", s.cpu_seconds},
          {"peak_memory_mb", s.peak_memory_mb},
          {"in", s.in},
          {"out", s.out},
          {"what", s.what}};
}

Json json_of(const NoiseModel& model) {
  Json at_range = Json::array();
  for (const NoiseAtRange& n : model.at_range)
    at_range.push_back({{"range", {n.min_range, n.max_range}},
                        {"incidence", {n.min_incidence, n.max_incidence}},
                        {"noise", n.noise},
                        {"area", n.area}});
  return {{"low", model.low},
          {"middle", model.middle},
          {"high", model.high},
          {"at_range", std::move(at_range)}};
}

Json planes_json(const ReconstructResult& result) {
  Json planes = Json::array();
  for (std::size_t i = 0; i < result.world.surfaces.size(); ++i) {
    const Surface& s = result.world.surfaces[i];
    Json plane = {{"id", s.id},
                  {"points", s.support.points},
                  {"rms", s.support.rms},
                  {"coverage", s.support.coverage}};
    if (!result.report.plane_noise.empty()) plane["noise"] = result.report.plane_noise[i];
    planes.push_back(std::move(plane));
  }
  return planes;
}

}  // namespace

Json report_json(const ReconstructResult& result, const Fidelity& fidelity,
                 const PointCloud& cloud) {
  const Report& report = result.report;
  Json stages = Json::array();
  double cpu = 0;
  for (const StageReport& s : report.stages) {
    stages.push_back(json_of(s));
    cpu += s.cpu_seconds;
  }
  const std::vector<Crack> cracks = find_cracks(result.world);
  return {{"schema", {{"name", "scanworld-report"}, {"version", 1}}},
          {"program", std::string("scanworld ") + version()},
          {"points",
           {{"input", cloud.input_size()},
            {"not_finite", cloud.skipped.size()},
            {"duplicates", report.duplicates}}},
          {"scale", report.scale},
          {"spacing", report.spacing},
          {"noise", report.noise},
          {"noise_model", json_of(report.noise_model)},
          {"flatness", report.flatness},
          {"drift", report.drift},
          {"planes", planes_json(result)},
          {"triangles", triangle_count(result.world)},
          {"surfaces", kind_counts(result.world)},
          {"fidelity", json_of(fidelity)},
          {"t_junctions", count_of(cracks, Crack::Kind::t_junction)},
          {"cracks", count_of(cracks, Crack::Kind::crack)},
          {"stages", stages},
          {"cpu_seconds", cpu},
          {"peak_memory_mb", peak_memory_mb()},
          {"warnings", report.warnings},
          {"world_hash", world_hash(result.world)}};
}

}  // namespace scanworld::cli
