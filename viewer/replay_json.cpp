// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "replay_json.h"

#include "base64.h"
#include "packed_points.h"

namespace scanworld {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kReplayVersion = 1;

// What holds all that is shown; vertices may lie outside of all points.
Box3 box_of(const Replay& replay) {
  Box3 box;
  for (const Vec3& p : replay.points) box.extend(p);
  for (const ReplayStep& step : replay.steps)
    for (const ReplayLoop& loop : step.loops)
      for (const Vec3& v : loop.vertices) box.extend(v);
  return box;
}

Json json_of(const ReplayStep& step, const Box3& box) {
  std::vector<std::int32_t> cluster, size;
  std::vector<Vec3> vertices;
  for (const ReplayLoop& loop : step.loops) {
    const auto count = static_cast<std::int32_t>(loop.vertices.size());
    cluster.push_back(loop.cluster);
    size.push_back(loop.is_hole ? -count : count);
    vertices.insert(vertices.end(), loop.vertices.begin(), loop.vertices.end());
  }
  return {{"stage", step.stage},
          {"text", step.text},
          {"clusters", step.clusters},
          {"changed", step.changed},
          {"points", base64(step.points)},
          {"cluster", base64(step.cluster)},
          {"polygons",
           {{"cluster", base64(cluster)},
            {"size", base64(size)},
            {"vertices", base64(pack(vertices, box))}}}};
}

}  // namespace

std::string replay_text(const Replay& replay) {
  const Box3 box = box_of(replay);
  Json steps = Json::array();
  for (const ReplayStep& step : replay.steps) steps.push_back(json_of(step, box));
  const Json json = {{"schema", {{"name", "scanworld-replay"}, {"version", kReplayVersion}}},
                     {"method", replay.method},
                     {"points",
                      {{"count", replay.points.size()},
                       {"box", box_json(box)},
                       {"positions", base64(pack(replay.points, box))}}},
                     {"steps", steps}};
  return json.dump() + "\n";
}

}  // namespace scanworld
