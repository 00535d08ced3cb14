// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Solids and meshes as Bullet's shapes, to be written to a file or simulated with.
#pragma once

#include <btBulletDynamicsCommon.h>

#include <memory>
#include <vector>

#include "bodies.h"

namespace scanworld {

inline btVector3 bullet_vector(const Vec3& v) {
  return {static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()), static_cast<btScalar>(v.z())};
}

btTransform bullet_transform(const Vec3& position, const Eigen::Quaterniond& rotation);

// A body's shape. A hull's margin is zero, else it would be that much larger.
std::unique_ptr<btCollisionShape> bullet_shape(const ExportBody& body);

// A quantized tree has 21 bits for the number of a triangle in its part; more crash.
constexpr std::size_t kMostBulletTriangles = (1u << 21) - 1;

// Triangles with their tree, in as many parts as it takes. Bullet refers to the arrays, so they
// live together.
struct BulletMesh {
  std::vector<float> vertices;
  std::vector<int> corners;
  btTriangleIndexVertexArray arrays;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
  btTriangleInfoMap edges;

  // With internal edges, contacts there can be put right (btInternalEdgeUtility).
  BulletMesh(const Mesh& mesh, bool internal_edges);
};

}  // namespace scanworld
