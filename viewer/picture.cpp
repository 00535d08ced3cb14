// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "error.h"
#include "mesh_rays.h"
#include "palette.h"
#include "parallel.h"
#include "world/glass.h"
#include "world/solids.h"
#include "world/triangulate.h"

namespace scanworld {

namespace {

constexpr int kMaxEdge = 16384;  // pixels
constexpr int kMaxPanes = 16;    // that a ray goes through
constexpr double kPane = 0.3;    // share of a pane's own colour in what is seen through it
const Vec3 kBackground(0.98, 0.98, 0.97), kEdge(0.13, 0.15, 0.18), kGlass(0.45, 0.7, 0.95),
    kClutter(0.62, 0.6, 0.57);

Vec3 to_linear(const Color& c) { return Vec3(c.r, c.g, c.b) / 255; }

// What a triangle belongs to. All panes have one colour.
struct Part {
  bool is_pane = false;
  Vec3 color = kGlass;
};

// All that may be seen by a camera, as triangles.
struct Scene {
  Mesh mesh;
  std::vector<int> part_of;  // each triangle
  std::vector<Vec3> normal;  // of each triangle
  std::vector<Part> parts;

  void add(const Mesh& from, std::size_t triangle, const Vec3& unit_normal) {
    for (int v : from.triangles[triangle])
      mesh.vertices.push_back(from.vertices[static_cast<std::size_t>(v)]);
    const int n = static_cast<int>(mesh.vertices.size());
    mesh.triangles.push_back({n - 3, n - 2, n - 1});
    part_of.push_back(static_cast<int>(parts.size()) - 1);
    normal.push_back(unit_normal);
  }
};

bool faces(const Camera& camera, const Vec3& normal, const Vec3& at) {
  return normal.dot(camera.orthographic ? camera.ahead : Vec3(at - camera.eye)) < 0;
}

void add_surfaces(Scene& scene, const World& world, const Camera& camera) {
  const World all = with_panes(world);
  const WorldMesh mesh = triangulate(all);
  int last = -1;
  for (std::size_t t = 0; t < mesh.surface.size(); ++t) {
    const auto index = static_cast<std::size_t>(mesh.surface[t]);
    const Surface& s = all.surfaces[index];
    const bool is_pane = index >= world.surfaces.size();  // seen from both sides
    if (!is_pane &&
        !faces(camera, s.plane.normal, world.vertices[static_cast<std::size_t>(s.outer[0])]))
      continue;
    if (mesh.surface[t] != last)
      scene.parts.push_back({is_pane, is_pane ? kGlass : to_linear(color_of_id(s.id))});
    last = mesh.surface[t];
    scene.add(mesh.mesh, t, s.plane.normal);
  }
}

void add_solid(Scene& scene, const Mesh& solid, const Camera& camera) {
  scene.parts.push_back({false, kClutter});
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    const Vec3 normal = vector_area(solid, t).normalized();
    if (faces(camera, normal, solid.vertices[static_cast<std::size_t>(solid.triangles[t][0])]))
      scene.add(solid, t, normal);
  }
}

Scene scene_of(const World& world, const Camera& camera) {
  Scene scene;
  add_surfaces(scene, world, camera);
  for (const Obstacle& o : world.obstacles) add_solid(scene, mesh_of(o, world.frame), camera);
  return scene;
}

// What a ray sees: a triangle, or none, through so many panes.
struct Seen {
  std::int32_t triangle = -1;
  std::int32_t panes = 0;
};

class Painter {
 public:
  Painter(const World& world, const Camera& camera, const PictureOptions& options)
      : camera_(camera),
        samples_(options.samples),
        width_(options.width * samples_),
        height_(options.height * samples_),
        scene_(scene_of(world, camera)),
        rays_(scene_.mesh) {
    // Light that comes over the viewer's left shoulder.
    light_ = (camera.up * 0.8 - camera.right * 0.5 - camera.ahead * 0.9).normalized();
  }

  Image paint() const {
    Image image{width_ / samples_, height_ / samples_, {}};
    image.rgb.resize(3 * static_cast<std::size_t>(image.width) *
                     static_cast<std::size_t>(image.height));
    constexpr std::size_t kRows = 16;
    parallel_for(part_count(static_cast<std::size_t>(image.height), kRows), [&](std::size_t band) {
      const auto [begin, end] = part_of(band, static_cast<std::size_t>(image.height), kRows);
      paint_rows(static_cast<int>(begin), static_cast<int>(end), image);
    });
    return image;
  }

 private:
  // Samples one more row on each side, so that edges are found across the borders of bands.
  void paint_rows(int begin, int end, Image& image) const {
    const int first = begin * samples_ - 1, last = end * samples_ + 1;
    std::vector<Seen> seen;
    seen.reserve(static_cast<std::size_t>(last - first) * static_cast<std::size_t>(width_));
    for (int row = first; row < last; ++row)
      for (int column = 0; column < width_; ++column)
        seen.push_back(look(column, std::clamp(row, 0, height_ - 1)));
    std::size_t at = 3 * static_cast<std::size_t>(begin) * static_cast<std::size_t>(image.width);
    for (int row = begin; row < end; ++row)
      for (int column = 0; column < image.width; ++column) {
        const Vec3 color = mean_of(seen, column, (row - begin) * samples_ + 1);
        for (int k = 0; k < 3; ++k)
          image.rgb[at++] =
              static_cast<std::uint8_t>(std::lround(255 * std::clamp(color[k], 0.0, 1.0)));
      }
  }

  Seen look(int column, int row) const {
    const double per_sample = 2 * camera_.half_height / height_;
    const Vec3 aside = camera_.right * ((column + 0.5 - 0.5 * width_) * per_sample) +
                       camera_.up * ((0.5 * height_ - row - 0.5) * per_sample);
    const Vec3 from = camera_.orthographic ? Vec3(camera_.eye + aside) : camera_.eye;
    const Vec3 direction =
        camera_.orthographic ? camera_.ahead : Vec3((camera_.ahead + aside).normalized());
    double near = 0;
    Seen seen;
    for (; seen.panes < kMaxPanes; ++seen.panes) {
      const auto hit = rays_.cast(from, direction, std::numeric_limits<float>::max(), near);
      if (!hit) break;
      seen.triangle = static_cast<std::int32_t>(hit->triangle);
      if (!part(seen).is_pane) break;
      seen.triangle = -1;
      near = hit->distance + 1e-5 * std::max(1.0, hit->distance);
    }
    return seen;
  }

  int part_index(const Seen& seen) const {
    return seen.triangle < 0 ? -1 : scene_.part_of[static_cast<std::size_t>(seen.triangle)];
  }
  const Part& part(const Seen& seen) const {
    return scene_.parts[static_cast<std::size_t>(part_index(seen))];
  }
  const Vec3& normal(const Seen& seen) const {
    return scene_.normal[static_cast<std::size_t>(seen.triangle)];
  }

  Vec3 color_of(const Seen& seen) const {
    Vec3 color = kBackground;
    if (seen.triangle >= 0)
      color = (0.72 + 0.28 * std::max(0.0, normal(seen).dot(light_))) * part(seen).color;
    const double through = std::pow(1 - kPane, seen.panes);
    return through * color + (1 - through) * kGlass;
  }

  // Whether two samples side by side see different things, or faces of one that meet sharply.
  bool is_edge(const Seen& a, const Seen& b) const {
    if (a.triangle == b.triangle) return a.panes != b.panes;
    if (part_index(a) != part_index(b) || a.panes != b.panes) return true;
    return normal(a).dot(normal(b)) < 0.5;
  }

  // Of a pixel whose first sample is in this row of the band.
  Vec3 mean_of(const std::vector<Seen>& seen, int column, int first) const {
    const auto at = [&](int x, int y) -> const Seen& {
      return seen[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                  static_cast<std::size_t>(std::clamp(x, 0, width_ - 1))];
    };
    Vec3 sum = Vec3::Zero();
    for (int y = first; y < first + samples_; ++y)
      for (int x = column * samples_; x < (column + 1) * samples_; ++x) {
        const Seen& own = at(x, y);
        const bool edge = is_edge(own, at(x + 1, y)) || is_edge(own, at(x - 1, y)) ||
                          is_edge(own, at(x, y + 1)) || is_edge(own, at(x, y - 1));
        sum += edge ? kEdge : color_of(own);
      }
    return sum / (samples_ * samples_);
  }

  const Camera& camera_;
  const int samples_, width_, height_;  // the latter two in samples
  const Scene scene_;
  const MeshRays rays_;
  Vec3 light_;
};

}  // namespace

Image draw(const World& world, const Camera& camera, const PictureOptions& options) {
  for (int edge : {options.width, options.height})
    if (edge < 1 || edge > kMaxEdge)
      throw Error(Cause::usage,
                  fmt::format("a picture of {} x {} pixels: from 1 to {} are possible",
                              options.width, options.height, kMaxEdge));
  return Painter(world, camera, options).paint();
}

}  // namespace scanworld
