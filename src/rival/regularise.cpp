// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "regularise.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace scanworld::rival {

namespace {

double noise_of(const Cluster& cluster, const Scale& scale) {
  constexpr double kLeast = 0.25;  // [noise]
  return noise_of(cluster, kLeast * scale.noise_at(cluster.fit.centroid));
}

// How far surfaces of its extent are off their planes by themselves [m].
double bend_of(const Cluster& cluster, const Scale& scale) {
  return scale.flatness.bend_at(extent_of(cluster.fit));
}

// Whether a cluster may have this normal: its points lie hardly worse. What is bent does not tell
// its plane better by more points.
bool may_turn(const Cluster& cluster, const Vec3& normal, const Scale& scale,
              const RegulariseOptions& options) {
  const double n = cluster.moments.n, noise = noise_of(cluster, scale),
               bend = bend_of(cluster, scale);
  const double rise =
      (normal.dot(cluster.moments.covariance() * normal) - cluster.fit.variance[0]) /
      (noise * noise / n + bend * bend);
  const double tilt =
      std::sqrt(std::max(0.0, 1 - std::pow(normal.dot(cluster.fit.plane.normal), 2)));
  const double half_length = std::sqrt(3 * cluster.fit.variance[2]);
  return rise < options.max_rise &&
         tilt * half_length < options.max_shift + 3 * noise / std::sqrt(n) + bend;
}

// The cluster with this normal through its centroid.
void turn(Cluster& cluster, const Vec3& normal) {
  const Vec3 facing = normal.dot(cluster.fit.plane.normal) < 0 ? Vec3(-normal) : normal;
  cluster.fit.plane = plane_through(cluster.fit.centroid, facing);
  cluster.fit.variance[0] = cluster.moments.mean_square(cluster.fit.plane);
}

// Clusters with one direction, and the sum of their scatters, which tells it best.
struct Direction {
  Vec3 normal;
  Mat3 scatter = Mat3::Zero();
  std::vector<std::size_t> members;

  void add(std::size_t k, const Cluster& cluster) {
    members.push_back(k);
    scatter += cluster.moments.n * cluster.moments.covariance();
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(scatter);
    const Vec3 found = solver.eigenvectors().col(0);
    normal = found.dot(normal) < 0 ? Vec3(-found) : found;
  }
};

// Groups clusters by direction, those of most points first.
std::vector<Direction> find_directions(const std::vector<Cluster>& clusters,
                                       const std::vector<std::size_t>& order,
                                       const RegulariseOptions& options) {
  std::vector<Direction> directions;
  for (std::size_t k : order) {
    const Vec3& normal = clusters[k].fit.plane.normal;
    const auto same = std::find_if(directions.begin(), directions.end(), [&](const Direction& d) {
      return std::abs(d.normal.dot(normal)) > std::cos(options.max_angle);
    });
    Direction& direction =
        same != directions.end() ? *same : directions.emplace_back(Direction{.normal = normal});
    direction.add(k, clusters[k]);
  }
  return directions;
}

// Makes directions that are nearly at right angles to a better one square to it.
void square_up(std::vector<Direction>& directions, const RegulariseOptions& options) {
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t k = 0; k < i; ++k) {
      const double cosine = directions[i].normal.dot(directions[k].normal);
      if (std::abs(cosine) < std::sin(options.max_angle))
        directions[i].normal = (directions[i].normal - cosine * directions[k].normal).normalized();
    }
}

// Puts parallel clusters that are in one plane, as far as can be told, into one.
void join_offsets(std::vector<Cluster>& clusters, const Direction& direction, const Scale& scale,
                  const RegulariseOptions& options) {
  struct Level {
    double height, weight;
  };
  std::vector<Level> levels;
  std::vector<std::pair<std::size_t, std::size_t>> level_of;
  for (std::size_t k : direction.members) {
    const Plane& plane = clusters[k].fit.plane;
    if (std::abs(plane.normal.dot(direction.normal)) < 1 - 1e-12) continue;  // was not turned
    const double height = direction.normal.dot(clusters[k].fit.centroid);
    const double noise = noise_of(clusters[k], scale);
    const double weight = clusters[k].moments.n / (noise * noise);
    const auto near = std::find_if(levels.begin(), levels.end(), [&](const Level& l) {
      return std::pow(l.height - height, 2) <
             options.max_offset * options.max_offset * (1 / l.weight + 1 / weight);
    });
    const auto at = static_cast<std::size_t>(near - levels.begin());
    if (near == levels.end())
      levels.push_back({height, weight});
    else
      *near = {(near->height * near->weight + height * weight) / (near->weight + weight),
               near->weight + weight};
    level_of.push_back({k, at});
  }
  for (const auto& [k, at] : level_of) {
    Plane& plane = clusters[k].fit.plane;
    plane.offset = plane.normal.dot(direction.normal) < 0 ? levels[at].height : -levels[at].height;
    clusters[k].fit.variance[0] = clusters[k].moments.mean_square(plane);
  }
}

// A box around the plane of a cluster that is about as large as it.
Box3 box_of(const Cluster& cluster) {
  const Vec3 half = (3 * cluster.moments.covariance().diagonal()).cwiseSqrt();
  return {cluster.fit.centroid - half, cluster.fit.centroid + half};
}

// How far a cluster's own plane is off another one, at most, where its points are [m].
double farthest_off(const Cluster& cluster, const Plane& plane) {
  const Vec3& own = cluster.fit.plane.normal;
  const Vec3 tilt = plane.normal - plane.normal.dot(own) * own;
  return std::abs(plane.signed_distance(cluster.fit.centroid)) +
         std::sqrt(3 * std::max(0.0, tilt.dot(cluster.moments.covariance() * tilt)));
}

// Gives clusters the plane of a larger one beside them that they are hardly off.
void close_cracks(std::vector<Cluster>& clusters, const std::vector<std::size_t>& order,
                  const Scale& scale, const RegulariseOptions& options) {
  std::vector<Box3> boxes;
  for (const Cluster& cluster : clusters) boxes.push_back(box_of(cluster));
  std::vector<std::size_t> larger;
  for (std::size_t k : order) {
    Cluster& cluster = clusters[k];
    const Plane* nearest = nullptr;
    const double noise = std::hypot(scale.noise_at(cluster.fit.centroid), bend_of(cluster, scale));
    double least = std::min(options.max_crack, options.max_step * noise);
    for (std::size_t other : larger) {
      const Plane& plane = clusters[other].fit.plane;
      if (std::abs(plane.normal.dot(cluster.fit.plane.normal)) < 0.9 ||
          !grown(boxes[other], options.max_gap).intersects(boxes[k]))
        continue;
      if (const double off = farthest_off(cluster, plane); off < least)
        least = off, nearest = &plane;
    }
    if (nearest == nullptr) {
      larger.push_back(k);
      continue;
    }
    const bool opposed = nearest->normal.dot(cluster.fit.plane.normal) < 0;
    cluster.fit.plane = opposed ? nearest->flipped() : *nearest;
    cluster.fit.variance[0] = cluster.moments.mean_square(cluster.fit.plane);
  }
}

}  // namespace

Clustering regularise(const Scale& scale, Clustering c, const RegulariseOptions& options) {
  std::vector<std::size_t> order(c.clusters.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return c.clusters[a].moments.n > c.clusters[b].moments.n;
  });
  std::vector<Direction> directions = find_directions(c.clusters, order, options);
  std::vector<Direction> squared = directions;
  square_up(squared, options);
  for (std::size_t d = 0; d < directions.size(); ++d) {
    for (std::size_t k : directions[d].members)
      for (const Vec3& normal : {squared[d].normal, directions[d].normal})
        if (may_turn(c.clusters[k], normal, scale, options)) {
          turn(c.clusters[k], normal);
          break;
        }
    join_offsets(c.clusters, squared[d], scale, options);
  }
  close_cracks(c.clusters, order, scale, options);
  return c;
}

}  // namespace scanworld::rival
