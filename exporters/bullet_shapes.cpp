// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
#include "bullet_shapes.h"

#include <BulletCollision/CollisionDispatch/btInternalEdgeUtility.h>

#include <algorithm>

namespace scanworld {

btTransform bullet_transform(const Vec3& position, const Eigen::Quaterniond& rotation) {
  return btTransform(
      btQuaternion(static_cast<btScalar>(rotation.x()), static_cast<btScalar>(rotation.y()),
                   static_cast<btScalar>(rotation.z()), static_cast<btScalar>(rotation.w())),
      bullet_vector(position));
}

std::unique_ptr<btCollisionShape> bullet_shape(const ExportBody& body) {
  if (const auto* box = std::get_if<BoxShape>(&body.shape))
    return std::make_unique<btBoxShape>(bullet_vector(box->size / 2));
  if (const auto* cylinder = std::get_if<CylinderShape>(&body.shape))
    return std::make_unique<btCylinderShapeZ>(
        bullet_vector({cylinder->radius, cylinder->radius, cylinder->height / 2}));
  auto hull = std::make_unique<btConvexHullShape>();
  for (const Vec3& v : std::get<ConvexShape>(body.shape).mesh.vertices)
    hull->addPoint(bullet_vector(v), false);
  hull->setMargin(0);
  hull->recalcLocalAabb();
  return hull;
}

BulletMesh::BulletMesh(const Mesh& mesh, bool internal_edges) {
  vertices.reserve(3 * mesh.vertices.size()), corners.reserve(3 * mesh.triangles.size());
  for (const Vec3& v : mesh.vertices)
    for (int k = 0; k < 3; ++k) vertices.push_back(static_cast<float>(v[k]));
  for (const auto& t : mesh.triangles) corners.insert(corners.end(), t.begin(), t.end());
  for (std::size_t from = 0; from < mesh.triangles.size(); from += kMostBulletTriangles) {
    btIndexedMesh part;
    part.m_numTriangles =
        static_cast<int>(std::min(kMostBulletTriangles, mesh.triangles.size() - from));
    part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(corners.data() + 3 * from);
    part.m_triangleIndexStride = 3 * sizeof(int);
    part.m_numVertices = static_cast<int>(mesh.vertices.size());
    part.m_vertexBase = reinterpret_cast<const unsigned char*>(vertices.data());
    part.m_vertexStride = 3 * sizeof(float);
    part.m_vertexType = PHY_FLOAT;
    arrays.addIndexedMesh(part, PHY_INTEGER);
  }
  shape = std::make_unique<btBvhTriangleMeshShape>(&arrays, true);
  if (internal_edges) btGenerateInternalEdgeInfo(shape.get(), &edges);
}

}  // namespace scanworld
