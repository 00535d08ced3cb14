// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// The options of `reconstruct`, by their names.
#include <fmt/format.h>

#include "error.h"
#include "reconstruct.h"

namespace scanworld {

Method method_named(const std::string& name) {
  for (Method method : {Method::rival, Method::thesis})
    if (name == name_of(method)) return method;
  throw Error(Cause::usage, fmt::format("there is no method '{}'; there are rival, thesis", name));
}

const char* name_of(Method method) { return method == Method::thesis ? "thesis" : "rival"; }

OptionList list_options(ReconstructOptions& options) {
  OptionList list = rival::list_options(options.rival);
  for (const OptionList& more :
       {surface::list_options(options.surface), space::list_options(options.space),
        terrain::list_options(options.ground), thesis::list_options(options.thesis),
        list_options(options.thickness), list_options(options.colliders),
        list_options(options.obstacles), list_options(options.leaves), list_options(options.stairs),
        list_options(options.rooms), list_options(options.rooms.ways), list_options(options.frame)})
    list.insert(list.end(), more.begin(), more.end());
  list.push_back({"floor_tolerance", &options.floor_tolerance, "m",
                  "what lies no higher on a floor is that floor, as carpets are", 0});
  return list;
}

const std::vector<std::string>& preset_names() {
  static const std::vector<std::string> names = {"indoor", "outdoor", "rgbd", "fast"};
  return names;
}

std::string preset_for(const PointCloud& cloud) { return cloud.camera_frame ? "rgbd" : "indoor"; }

void apply_preset(ReconstructOptions& options, const std::string& preset) {
  thesis::FilterOptions& filter = options.thesis.filter;
  rival::RivalOptions& rival = options.rival;
  if (preset == "indoor") return;
  if (preset == "outdoor")
    filter.min_size = 0.2, rival.scale.min_voxel = 0.1, rival.evidence.min_area = 0.5;
  else if (preset == "rgbd")
    // A Kinect's step is 7 cm at 5 m, its noise about half of that.
    filter.depth_step = 0.003, rival.scale.depth_step = 0.0015, rival.scale.min_voxel = 0.02;
  else if (preset == "fast")
    filter.min_size = 0.1, filter.points_per_cube = 16, rival.scale.voxel_per_spacing = 2,
    rival.scale.min_voxel = 0.06, options.space.is_on = false;
  else
    throw Error(Cause::usage, fmt::format("there is no preset '{}'; there are {}", preset,
                                          fmt::join(preset_names(), ", ")));
}

}  // namespace scanworld
