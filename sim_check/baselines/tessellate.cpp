// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "tessellate.h"

#include <cmath>
#include <map>
#include <unordered_map>

#include "../random.h"
#include "error.h"
#include "world/solids.h"

namespace scanworld::sim {

namespace {

constexpr std::size_t kMostTessellated = 50000000;

// The middles of edges, made once for both of their triangles.
class Middles {
 public:
  Middles(Mesh& mesh, double longest) : mesh_(mesh), longest_(longest) {}

  // The vertex in the middle of an edge, or -1 where the edge is short enough.
  int of(int a, int b) {
    if ((mesh_.vertices[a] - mesh_.vertices[b]).norm() <= longest_) return -1;
    const auto low = static_cast<std::uint64_t>(std::min(a, b)),
               high = static_cast<std::uint64_t>(std::max(a, b));
    const auto [found, is_new] =
        index_of_.try_emplace(low << 32 | high, static_cast<int>(mesh_.vertices.size()));
    if (is_new) mesh_.vertices.push_back((mesh_.vertices[a] + mesh_.vertices[b]) / 2);
    return found->second;
  }

 private:
  Mesh& mesh_;
  double longest_;
  std::unordered_map<std::uint64_t, int> index_of_;
};

// Cuts the edges of a triangle that are long, each of which both of its triangles cut alike.
void split(const std::array<int, 3>& t, Middles& middles, std::vector<std::array<int, 3>>& to) {
  const std::array<int, 3> m = {middles.of(t[0], t[1]), middles.of(t[1], t[2]),
                                middles.of(t[2], t[0])};
  const auto cut = 3 - std::ranges::count(m, -1);
  if (cut == 0) return to.push_back(t);
  if (cut == 3) {
    for (std::size_t k = 0; k < 3; ++k) to.push_back({t[k], m[k], m[(k + 2) % 3]});
    return to.push_back(m);
  }
  // Turned so that the first edge is cut, and of two the next one as well.
  std::size_t k = 0;
  while (m[k] < 0 || (cut == 2 && m[(k + 1) % 3] < 0)) ++k;
  const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = m[k], bc = m[(k + 1) % 3];
  to.push_back({a, ab, c});
  if (cut == 1) return to.push_back({ab, b, c});
  to.insert(to.end(), {{ab, b, bc}, {ab, bc, c}});
}

// All edges no longer than this.
Mesh refined(Mesh mesh, double longest) {
  for (std::size_t before = 0; before != mesh.triangles.size();) {
    before = mesh.triangles.size();
    std::vector<std::array<int, 3>> cut;
    Middles middles(mesh, longest);
    for (const auto& t : mesh.triangles) split(t, middles, cut);
    mesh.triangles = std::move(cut);
    if (mesh.triangles.size() > kMostTessellated)
      throw Error(Cause::usage, "more triangles than can be made: over 50 million");
  }
  return mesh;
}

double gaussian(Random& random) {
  return std::sqrt(-2 * std::log(1 - random.unit())) * std::cos(random.angle());
}

void roughen(Mesh& mesh, double noise, std::uint64_t seed) {
  std::vector<Vec3> normals(mesh.vertices.size(), Vec3::Zero());
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int v : mesh.triangles[i]) normals[v] += vector_area(mesh, i);
  Random random(seed);
  for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
    mesh.vertices[i] += noise * gaussian(random) * normals[i].normalized();
}

}  // namespace

Mesh tessellate(const Mesh& mesh, const TessellateOptions& options) {
  if (options.triangles == 0 || options.triangles > kMostTessellated / 4)
    throw Error(Cause::usage,
                "triangles: " + std::to_string(options.triangles) + " is not from 1 to 12,500,000");
  if (!(options.noise >= 0)) throw Error(Cause::usage, "noise: is not a length");
  // The number of triangles jumps where edges get long enough to be cut, so it is searched for.
  const double even = std::sqrt(area_of(mesh) / static_cast<double>(options.triangles));
  double fine = even, coarse = 4 * even;
  for (int i = 0; i < 6; ++i) {
    const double middle = std::sqrt(fine * coarse);
    (refined(mesh, middle).triangles.size() >= options.triangles ? fine : coarse) = middle;
  }
  Mesh dense = refined(mesh, fine);
  roughen(dense, options.noise, options.seed);
  return dense;
}

}  // namespace scanworld::sim
