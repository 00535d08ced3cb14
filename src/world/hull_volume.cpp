// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "hull_volume.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace scanworld {

namespace {

// A triangle of the hull, counter-clockwise seen from outside.
struct Face {
  std::array<int, 3> corners;
  Vec3 normal;  // twice the area long
};

class Hull {
 public:
  explicit Hull(const std::vector<Vec3>& points) : points_(points) {}

  // Starts from a tetrahedron; false where there is none.
  bool start() {
    const auto farthest = [&](auto measure) {
      int best = 0;
      for (int i = 1; i < static_cast<int>(points_.size()); ++i)
        if (measure(at(i)) > measure(at(best))) best = i;
      return best;
    };
    const int a = 0;
    const int b = farthest([&](const Vec3& p) { return (p - at(a)).squaredNorm(); });
    const Vec3 ab = at(b) - at(a);
    const int c = farthest([&](const Vec3& p) { return ab.cross(p - at(a)).squaredNorm(); });
    const Vec3 normal = ab.cross(at(c) - at(a));
    const int d = farthest([&](const Vec3& p) { return std::abs(normal.dot(p - at(a))); });
    const double volume = normal.dot(at(d) - at(a));
    least_ = 1e-10 * std::pow(ab.norm(), 3);
    if (!(std::abs(volume) > least_)) return false;
    const bool is_below = volume < 0;  // d is on the side that abc is clockwise seen from
    add(a, is_below ? b : c, is_below ? c : b);
    add(a, is_below ? d : b, is_below ? b : d);
    add(b, is_below ? d : c, is_below ? c : d);
    add(c, is_below ? d : a, is_below ? a : d);
    return true;
  }

  // Takes away the faces that a point sees, and joins it to their border.
  void grow(int point) {
    border_.clear();
    std::size_t kept = 0;
    for (const Face& face : faces_) {
      if (face.normal.dot(at(point) - at(face.corners[0])) <= least_) {
        faces_[kept++] = face;
        continue;
      }
      for (std::size_t k = 0; k < 3; ++k)
        cross_border({face.corners[k], face.corners[(k + 1) % 3]});
    }
    faces_.resize(kept);
    for (const auto& [from, to] : border_) add(from, to, point);
  }

  double volume() const {
    double sum = 0;
    for (const Face& face : faces_) sum += face.normal.dot(at(face.corners[0]) - at(0)) / 6;
    return sum;
  }

 private:
  const Vec3& at(int i) const { return points_[static_cast<std::size_t>(i)]; }
  void add(int a, int b, int c) {
    faces_.push_back({{a, b, c}, (at(b) - at(a)).cross(at(c) - at(a))});
  }
  // An edge that is walked both ways is none of the border.
  void cross_border(const std::pair<int, int>& edge) {
    const auto twin = std::find(border_.begin(), border_.end(), std::pair(edge.second, edge.first));
    if (twin == border_.end())
      border_.push_back(edge);
    else
      *twin = border_.back(), border_.pop_back();
  }

  const std::vector<Vec3>& points_;
  std::vector<Face> faces_;
  std::vector<std::pair<int, int>> border_;
  double least_ = 0;  // [m3] what is flatter than this is flat
};

}  // namespace

double hull_volume(const std::vector<Vec3>& points) {
  if (points.size() < 4) return 0;
  Hull hull(points);
  if (!hull.start()) return 0;
  for (int i = 0; i < static_cast<int>(points.size()); ++i) hull.grow(i);
  return hull.volume();
}

}  // namespace scanworld
