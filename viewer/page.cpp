// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "page.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "base64.h"
#include "packed_points.h"
#include "world/triangulate.h"
#include "world/world_json.h"

namespace scanworld {

std::string empty_page();  // viewer/page.html, made into code by cmake/embed.cmake

namespace {

using Json = nlohmann::ordered_json;

constexpr int kPageVersion = 1;
constexpr std::size_t kMaxRays = 5000;  // violations, and leaks, that are shown
constexpr std::string_view kPlace =
    R"(<script id="scanworld-data" type="application/json">null</script>)";

Json triangles_json(const World& world) {
  const WorldMesh mesh = triangulate(world);
  std::vector<std::int32_t> corners;
  for (const auto& t : mesh.mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  return {{"corners", base64(corners)}, {"surface", base64(mesh.surface)}};
}

// What is shown around a world: what lies much farther out would make all else coarse.
Box3 shown_box(const World& world) {
  const Box3 box = bounds(world);
  return grown(box, std::max(2.0, 0.25 * box.sizes().maxCoeff()));
}

// Some of a list, spread evenly over it.
template <typename T>
std::vector<T> some_of(const std::vector<T>& all, std::size_t most) {
  if (all.size() <= most) return all;
  std::vector<T> some;
  for (std::size_t i = 0; i < most; ++i) some.push_back(all[i * all.size() / most]);
  return some;
}

void add(std::vector<float>& numbers, const Vec3& v) {
  for (int k = 0; k < 3; ++k) numbers.push_back(static_cast<float>(v[k]));
}

Json scan_json(const World& world, const ScanView& scan) {
  const Fidelity& fidelity = scan.fidelity;
  const Box3 box = shown_box(world);
  std::vector<Vec3> positions;
  std::vector<std::int16_t> surface;
  std::vector<std::uint16_t> distance;
  for (const ErrorAtlas::Point& p : fidelity.atlas.points) {
    if (!box.contains(p.at)) continue;
    positions.push_back(p.at);
    surface.push_back(static_cast<std::int16_t>(p.surface < 32768 ? p.surface : -1));
    distance.push_back(static_cast<std::uint16_t>(std::min(std::lround(1e4 * p.distance), 65535L)));
  }
  std::vector<float> violations, leaks;
  for (const Violation& v : some_of(fidelity.atlas.violations, kMaxRays))
    add(violations, v.from), add(violations, v.met), add(violations, v.point);
  for (const Leak& l : some_of(fidelity.atlas.leaks, kMaxRays))
    add(leaks, l.from), add(leaks, l.point);
  return {{"points", scan.points},
          {"left_out", fidelity.atlas.points.size() - positions.size()},
          {"box", box_json(box)},
          {"positions", base64(pack(positions, box))},
          {"surface", base64(surface)},
          {"distance", base64(distance)},
          {"max_distance", fidelity.max_distance},
          {"tolerance", fidelity.tolerance},
          {"has_rays", fidelity.rays > 0},
          {"violations_found", fidelity.atlas.violations.size()},
          {"violations", base64(violations)},
          {"leaks_found", fidelity.atlas.leaks.size()},
          {"leaks", base64(leaks)}};
}

// A document in which no text can end the script that it stands in.
std::string escaped(const std::string& json) {
  std::string text;
  text.reserve(json.size());
  for (char c : json) c == '<' ? text += "\\u003c" : text += c;
  return text;
}

}  // namespace

std::string page_of(const PageContent& content) {
  const auto or_null = [](const std::string& json) { return json.empty() ? "null" : json; };
  std::string data =
      "{\"schema\":" + Json{{"name", "scanworld-page"}, {"version", kPageVersion}}.dump();
  const auto add = [&](const char* key, const std::string& json) {
    data += std::string(",\"") + key + "\":" + json;
  };
  add("title", Json(content.title).dump(-1, ' ', false, Json::error_handler_t::replace));
  add("world", world_text(content.world));
  add("triangles", triangles_json(content.world).dump());
  add("scan", content.scan ? scan_json(content.world, *content.scan).dump() : "null");
  add("fidelity", or_null(content.scan ? content.scan->fidelity_json : ""));
  add("report", or_null(content.report));
  add("replay", or_null(content.replay));
  add("sim", or_null(content.sim_check));
  data += "}";

  std::string page = empty_page();
  const std::size_t at = page.find(kPlace);
  if (at == std::string::npos) throw std::logic_error("viewer/page.html has no place for the data");
  const std::size_t null = at + kPlace.find("null");
  return page.replace(null, 4, escaped(data));
}

}  // namespace scanworld
