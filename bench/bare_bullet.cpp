// SPDX-License-Identifier: GPL-3.0-or-later
#include "bare_bullet.hpp"

#include <btBulletCollisionCommon.h>

namespace orca::bench {

using namespace sim;

struct BulletMesh::Impl {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
  btTriangleMesh triangles;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
  btCollisionObject object;
};

BulletMesh::BulletMesh(const WorldModel& world) : impl_(std::make_unique<Impl>()) {
  for (const Obstacle& o : world.obstacles)
    for (const Segment& e : edges_of(o.shape)) {
      const btVector3 a(e.a.x, e.a.y, 0);
      const btVector3 b(e.b.x, e.b.y, 0);
      const btVector3 up(0, 0, o.height);
      impl_->triangles.addTriangle(a, b, b + up);
      impl_->triangles.addTriangle(a, b + up, a + up);
    }
  impl_->shape = std::make_unique<btBvhTriangleMeshShape>(&impl_->triangles, true);
  impl_->shape->setMargin(0);
  impl_->object.setCollisionShape(impl_->shape.get());
  impl_->world.addCollisionObject(&impl_->object);
  impl_->world.updateAabbs();
}

BulletMesh::~BulletMesh() { impl_->world.removeCollisionObject(&impl_->object); }

double BulletMesh::cast(const Ray& ray) const {
  const btVector3 from(ray.origin.x, ray.origin.y, ray.sensor_height);
  const btVector3 to = from + ray.max_range * btVector3(ray.direction.x, ray.direction.y, 0);
  btCollisionWorld::ClosestRayResultCallback nearest(from, to);
  impl_->world.rayTest(from, to, nearest);
  return nearest.m_closestHitFraction * ray.max_range;
}

}  // namespace orca::bench
