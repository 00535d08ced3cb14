// SPDX-FileCopyrightText: 2026 The scanworld authors
// SPDX-License-Identifier: Apache-2.0
//
// Rays against the shapes that a model file names, in Bullet's double precision, for consumers
// whose own engine casts none.
#pragma once

#include <btBulletCollisionCommon.h>

#include <memory>
#include <vector>

#include "consumer.h"

class BulletRays {
 public:
  void add_box(const btTransform& at, const btVector3& size) {
    add(at, std::make_unique<btBoxShape>(size / 2));
  }
  void add_cylinder(const btTransform& at, double radius, double length) {
    add(at, std::make_unique<btCylinderShapeZ>(btVector3(radius, radius, length / 2)));
  }
  // Three corners a triangle.
  void add_triangles(const btTransform& at, const std::vector<btVector3>& corners) {
    meshes_.push_back(std::make_unique<btTriangleMesh>());
    for (std::size_t i = 0; i + 2 < corners.size(); i += 3)
      meshes_.back()->addTriangle(corners[i], corners[i + 1], corners[i + 2]);
    add(at, std::make_unique<btBvhTriangleMeshShape>(meshes_.back().get(), true));
  }

  double cast(const Triple& from, const Triple& direction) const {
    const double far = 1000;
    const btVector3 a(from[0], from[1], from[2]),
        b = a + far * btVector3(direction[0], direction[1], direction[2]);
    btCollisionWorld::ClosestRayResultCallback hit(a, b);
    world_.rayTest(a, b, hit);
    return hit.hasHit() ? far * hit.m_closestHitFraction : -1;
  }

 private:
  void add(const btTransform& at, std::unique_ptr<btCollisionShape> shape) {
    shapes_.push_back(std::move(shape));
    objects_.push_back(std::make_unique<btCollisionObject>());
    objects_.back()->setCollisionShape(shapes_.back().get());
    objects_.back()->setWorldTransform(at);
    world_.addCollisionObject(objects_.back().get());
  }

  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_{&configuration_};
  btDbvtBroadphase broadphase_;
  std::vector<std::unique_ptr<btTriangleMesh>> meshes_;
  std::vector<std::unique_ptr<btCollisionShape>> shapes_;
  std::vector<std::unique_ptr<btCollisionObject>> objects_;
  btCollisionWorld world_{&dispatcher_, &broadphase_, &configuration_};
};
