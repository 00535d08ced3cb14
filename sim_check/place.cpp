// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "place.h"

#include <fmt/format.h>

#include "bullet_file.h"
#include "child.h"
#include "error.h"
#include "exporters/assimp.h"
#include "exporters/export.h"
#include "exporters/parts.h"
#include "files.h"
#include "mesh_rays.h"
#include "timing.h"
#include "world/level.h"
#include "world/solids.h"
#include "world/world_json.h"

namespace scanworld::sim {

namespace {

// [m] A place that is smaller or larger is probably not in metres.
constexpr double kSmallest = 0.5, kLargest = 2000;

constexpr double kElsewhere = 1;       // [m] what is farther away is another place
constexpr double kFarFromZero = 8000;  // [m] there single precision is worse than half a millimetre

void check_mesh(const std::string& name, const Mesh& mesh) {
  if (mesh.triangles.empty()) throw Error(Cause::bad_input, name + ": no triangle in it");
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    if (!mesh.vertices[i].allFinite())
      throw Error(Cause::bad_input, fmt::format("{}: vertex {} is not finite", name, i + 1));
  if (area_of(mesh) <= 0) throw Error(Cause::bad_input, name + ": its triangles have no area");
}

void check_size(const std::string& name, const Mesh& mesh) {
  Box3 box;
  for (const Vec3& v : mesh.vertices) box.extend(v);
  const double length = box.sizes().maxCoeff();
  if (length < kSmallest || length > kLargest)
    throw Error(Cause::bad_input,
                fmt::format("{}: {:.6g} m long; if its unit is not the metre, say --unit mm, cm or "
                            "in, and if it is, --unit m",
                            name, length));
}

Place read_mesh_place(const std::filesystem::path& path, const PlaceOptions& options) {
  if (!comes_to_end([&] { read_mesh(path); }))
    throw Error(Cause::bad_input, path.string() + ": damaged; assimp's reader fails on it");
  const Stopwatch watch;
  Mesh mesh = read_mesh(path);
  const std::string extension = lower_extension(path);
  const bool is_gltf = extension == ".glb" || extension == ".gltf";
  const bool y_up = options.up ? options.up == 'y' : is_gltf;
  const double unit = options.unit > 0 ? options.unit : extension == ".3mf" ? 1e-3 : 1;
  for (Vec3& v : mesh.vertices) v = unit * (y_up ? Vec3(v.x(), -v.z(), v.y()) : v);
  check_mesh(path.string(), mesh);
  if (options.unit == 0 && !is_gltf) check_size(path.string(), mesh);
  Place place = place_of(path.string(), std::move(mesh));
  place.load_seconds = watch.wall();
  return place;
}

Place read_world_place(const std::filesystem::path& path, const PlaceOptions& options) {
  const Stopwatch watch;
  const World world = read_valid_world(path);
  if (world.surfaces.empty()) throw Error(Cause::bad_input, path.string() + ": no surface in it");
  Place place = place_of(path.string(), world, options);
  place.load_seconds = watch.wall();
  return place;
}

Place read_bullet_place(const std::filesystem::path& path, const PlaceOptions& options) {
  BulletFile file = read_bullet(path);
  Place place{.name = path.string(), .sort = Sort::world, .seen = std::move(file.seen)};
  place.load_seconds = file.seconds;
  check_mesh(place.name, place.seen);
  if (options.as_mesh || file.solids.empty())
    place.sort = Sort::mesh;
  else
    place.solids = std::move(file.solids);
  return place;
}

// How far a mesh is from another, mostly: the median over some of its vertices, at most kElsewhere.
double distance_of(const Mesh& mesh, const Frame& from, const Frame& to, const MeshRays& target) {
  constexpr std::size_t kLooks = 500;
  std::vector<double> distances;
  const std::size_t step = std::max<std::size_t>(1, mesh.vertices.size() / kLooks);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += step) {
    const auto hit = target.nearest(to.to_world(from.to_scan(mesh.vertices[i])), kElsewhere);
    distances.push_back(hit ? hit->distance : kElsewhere);
  }
  return median_of(distances);
}

void change_frame(Place& place, const Frame& from, const Frame& to) {
  move(place, to.rotation.conjugate() * from.rotation, to.to_world(from.origin));
}

}  // namespace

const char* name_of(Sort sort) {
  constexpr const char* names[] = {"world", "mesh", "plane", "empty"};
  return names[static_cast<int>(sort)];
}

Place read_place(const std::filesystem::path& path, const PlaceOptions& options) {
  std::error_code ignored;
  const std::string extension = lower_extension(path);
  if (!std::filesystem::exists(path, ignored))
    throw Error(Cause::bad_input, path.string() + ": no such file or folder");
  if (extension == ".bullet") return read_bullet_place(path, options);
  if (extension == ".json" || std::filesystem::is_directory(path, ignored))
    return read_world_place(path, options);
  return read_mesh_place(path, options);
}

Place place_of(std::string name, Mesh mesh) {
  return {.name = std::move(name), .sort = Sort::mesh, .seen = std::move(mesh)};
}

Place place_of(std::string name, const World& world, const PlaceOptions& options) {
  Place place{.name = std::move(name), .sort = options.as_mesh ? Sort::mesh : Sort::world};
  place.built = world.frame;
  place.world = prepare_export(world, {.level = true});
  const std::vector<ExportPart> parts = export_parts(*place.world, {.merge = true});
  if (!parts.empty()) place.seen = parts[0].mesh;
  if (!options.as_mesh) place.solids = export_bodies(*place.world, {});
  return place;
}

Frame align(std::vector<Place>& places) {
  if (places.empty()) return {};
  auto first = std::ranges::find_if(places, [](const Place& p) { return p.world.has_value(); });
  std::vector<Frame> candidates = {Frame{}};  // the scan's coordinates
  Frame to;
  if (first == places.end()) {
    first = places.begin();
    const Vec3& corner = first->seen.vertices[0];
    if (corner.norm() > kFarFromZero) to.origin = corner.array().round();
    change_frame(*first, Frame{}, to);
  } else {
    to = first->world->frame;
    candidates.insert(candidates.end(), {first->built, to});
  }
  const MeshRays target(first->seen);
  for (Place& place : places) {
    if (&place == &*first) continue;
    if (place.world) {
      change_frame(place, place.world->frame, to);
      continue;
    }
    std::vector<double> distances;
    for (const Frame& from : candidates)
      distances.push_back(distance_of(place.seen, from, to, target));
    const auto best = std::ranges::min_element(distances);
    if (*best >= kElsewhere)
      throw Error(Cause::bad_input,
                  fmt::format("{}: not the same place as {}: most of it is more than {} m away",
                              place.name, first->name, kElsewhere));
    change_frame(place, candidates[static_cast<std::size_t>(best - distances.begin())], to);
  }
  return to;
}

void move(Place& place, const Eigen::Quaterniond& rotation, const Vec3& shift) {
  for (Vec3& v : place.seen.vertices) v = rotation * v + shift;
  for (ExportBody& body : place.solids) {
    body.position = rotation * body.position + shift;
    body.rotation = rotation * body.rotation;
  }
  if (place.world) place.world = moved(std::move(*place.world), rotation, shift);
}

}  // namespace scanworld::sim
