// SPDX-License-Identifier: LGPL-3.0-or-later
#include "bullet_shapes.hpp"

#include <BulletCollision/CollisionShapes/btEmptyShape.h>

namespace orca::sim::detail {
namespace {

btVector3 vector(const Vec3& p) { return {p.x, p.y, p.z}; }

void make_shape_of_mesh(OwnedShape& owned) {
  owned.shape = std::make_unique<btBvhTriangleMeshShape>(owned.mesh.get(), true);
  owned.shape->setMargin(0);
}

// Returns the boundary as upright rectangles of two triangles each. The shape is hollow, which does no harm,
// because robots start outside.
OwnedShape extruded(const Outline& outline, double bottom, double top) {
  OwnedShape owned;
  if (outline.edges.empty()) {  // Bullet crashes when it builds a tree over no triangles.
    owned.shape = std::make_unique<btEmptyShape>();
    return owned;
  }
  owned.mesh = std::make_unique<btTriangleMesh>();
  for (const Segment& e : outline.edges) {
    const btVector3 a(e.a.x, e.a.y, bottom);
    const btVector3 b(e.b.x, e.b.y, bottom);
    const btVector3 up(0, 0, top - bottom);
    owned.mesh->addTriangle(a, b, b + up);
    owned.mesh->addTriangle(a, b + up, a + up);
  }
  make_shape_of_mesh(owned);
  return owned;
}

OwnedShape triangles_of(const Mesh& mesh) {
  OwnedShape owned;
  owned.mesh = std::make_unique<btTriangleMesh>();
  for (const Triangle& t : mesh.triangles) owned.mesh->addTriangle(vector(t[0]), vector(t[1]), vector(t[2]));
  make_shape_of_mesh(owned);
  return owned;
}

std::unique_ptr<btCollisionShape> hull_shape(const Part::Hull& hull) {
  auto shape = std::make_unique<btConvexHullShape>();
  for (const Vec3& p : hull.corners) shape->addPoint(vector(p), false);
  shape->recalcLocalAabb();
  shape->setMargin(0);
  return shape;
}

std::unique_ptr<btCollisionShape> part_shape(const Part& part) {
  if (const auto* block = std::get_if<Part::Block>(&part.form))
    return std::make_unique<btBoxShape>(btVector3(0.5 * block->x, 0.5 * block->y, 0.5 * block->z));
  if (const auto* c = std::get_if<Part::Cylinder>(&part.form))
    return std::make_unique<btCylinderShapeZ>(btVector3(c->radius, c->radius, 0.5 * c->length));
  if (const auto* hull = std::get_if<Part::Hull>(&part.form)) return hull_shape(*hull);
  return std::make_unique<btSphereShape>(std::get<Part::Ball>(part.form).radius);
}

}  // namespace

btTransform upright(const Pose2& pose, double z) {
  return btTransform(btQuaternion(btVector3(0, 0, 1), pose.yaw), btVector3(pose.x, pose.y, z));
}

OwnedShape obstacle_shape(const Obstacle& obstacle, btTransform& X) {
  const double half_height = 0.5 * (obstacle.height - obstacle.bottom);
  const double middle = 0.5 * (obstacle.height + obstacle.bottom);
  OwnedShape owned;
  if (obstacle.mesh != nullptr) {
    X = btTransform::getIdentity();
    owned = triangles_of(*obstacle.mesh);
  } else if (const auto* box = std::get_if<Box>(&obstacle.shape)) {
    X = upright(box->pose, middle);
    owned.shape = std::make_unique<btBoxShape>(btVector3(box->half.x, box->half.y, half_height));
  } else if (const auto* circle = std::get_if<Circle>(&obstacle.shape)) {
    X = upright({circle->center.x, circle->center.y, 0.0}, middle);
    owned.shape = std::make_unique<btCylinderShapeZ>(btVector3(circle->radius, circle->radius, half_height));
  } else {
    X = btTransform::getIdentity();
    owned = extruded(std::get<Outline>(obstacle.shape), obstacle.bottom, obstacle.height);
  }
  return owned;
}

OwnedShape robot_shape(const RobotModel& model) {
  OwnedShape owned;
  auto compound = std::make_unique<btCompoundShape>();
  for (const Part& part : model.parts) {
    const Pose3& X = part.X_BP;
    owned.children.push_back(part_shape(part));
    compound->addChildShape(btTransform(btQuaternion(X.qx, X.qy, X.qz, X.qw), btVector3(X.x, X.y, X.z)),
                            owned.children.back().get());
  }
  owned.shape = std::move(compound);
  return owned;
}

}  // namespace orca::sim::detail
