// SPDX-License-Identifier: LGPL-3.0-or-later
#include "physics.hpp"

#include <algorithm>
#include <cstdlib>
#include <new>
#include <utility>

#include "bullet_shapes.hpp"

namespace orca::sim::detail {
namespace {

constexpr double kFriction = 0.4;

struct Body {
  OwnedShape shape;
  std::unique_ptr<btRigidBody> body;
  // [rad] Stored separately, because Bullet's rotation loses some bits in each step.
  double yaw = 0.0;
};

// A kinematic thing, and the place of Bullet's shape in its frame.
struct Mover {
  Body body;
  btTransform offset;
};

// Returns the kind of a Bullet body, which is stored in its second user index.
Kind kind_of(const btCollisionObject& body) { return static_cast<Kind>(body.getUserIndex2()); }

Body make_body(OwnedShape shape, double mass, const btVector3& inertia, const btTransform& X) {
  Body made{std::move(shape), nullptr};
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, made.shape.shape.get(), inertia);
  info.m_startWorldTransform = X;
  info.m_friction = kFriction;
  made.body = std::make_unique<btRigidBody>(info);
  return made;
}

Pair pair_of(const btCollisionObject& robot, const btCollisionObject& other) {
  return {static_cast<std::size_t>(robot.getUserIndex()), kind_of(other),
          static_cast<std::size_t>(other.getUserIndex())};
}

void note(std::map<Pair, double>& pairs, const Pair& pair, double distance) {
  const auto [found, is_new] = pairs.emplace(pair, distance);
  if (!is_new) found->second = std::min(found->second, distance);
}

}  // namespace

namespace {

// Bullet uses what it gets without a look.
void* allocate(std::size_t size) {
  void* const memory = std::malloc(size);
  return memory != nullptr ? memory : throw std::bad_alloc();
}

// Bullet's own functions are malloc() and free(), so it does not matter what was allocated before.
void report_lack_of_memory() { btAlignedAllocSetCustom(allocate, std::free); }

}  // namespace

struct Physics::Impl {
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btDiscreteDynamicsWorld world{&dispatcher, &broadphase, &solver, &configuration};
  std::vector<Body> obstacles;
  std::vector<Body> robots;
  std::vector<Mover> movers;  // One without a body was removed.

  void insert(std::vector<Body>& list, Body body, Kind kind) {
    enter(*body.body, list.size(), kind);
    list.push_back(std::move(body));
  }
  void enter(btRigidBody& body, std::size_t number, Kind kind) {
    body.setUserIndex(static_cast<int>(number));
    body.setUserIndex2(static_cast<int>(kind));
    world.addRigidBody(&body);
  }
};

Physics::Physics(const WorldModel& world) : impl_((report_lack_of_memory(), std::make_unique<Impl>())) {
  impl_->world.setGravity(btVector3(0, 0, 0));
  // Standing things do not move, so their bounding boxes need no update in each step.
  impl_->world.setForceUpdateAllAabbs(false);
  for (const Obstacle& o : world.obstacles) {
    btTransform X;
    OwnedShape shape = obstacle_shape(o, X);
    impl_->insert(impl_->obstacles, make_body(std::move(shape), 0, btVector3(0, 0, 0), X), Kind::obstacle);
  }
}

Physics::~Physics() {
  for (auto* list : {&impl_->robots, &impl_->obstacles})
    for (const Body& b : *list) impl_->world.removeRigidBody(b.body.get());
  for (std::size_t i = 0; i < impl_->movers.size(); ++i) remove_mover(i);
}

std::size_t Physics::add_robot(const RobotModel& model, const Pose2& X_WB) {
  // Only the inertia about z matters: the body cannot tilt.
  const btVector3 inertia(model.yaw_inertia, model.yaw_inertia, model.yaw_inertia);
  Body robot = make_body(robot_shape(model), model.mass, inertia, upright(X_WB, 0));
  robot.yaw = X_WB.yaw;
  robot.body->setLinearFactor(btVector3(1, 1, 0));
  robot.body->setAngularFactor(btVector3(0, 0, 1));
  robot.body->setActivationState(DISABLE_DEACTIVATION);
  impl_->insert(impl_->robots, std::move(robot), Kind::robot);
  return impl_->robots.size() - 1;
}

std::size_t Physics::add_mover(const Shape& shape, double height, const Pose2& X_WO) {
  Mover mover;
  OwnedShape owned = obstacle_shape({"", shape, height}, mover.offset);
  mover.body = make_body(std::move(owned), 0, btVector3(0, 0, 0), upright(X_WO, 0) * mover.offset);
  btRigidBody& body = *mover.body.body;
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  body.setActivationState(DISABLE_DEACTIVATION);
  impl_->enter(body, impl_->movers.size(), Kind::mover);
  impl_->movers.push_back(std::move(mover));
  return impl_->movers.size() - 1;
}

void Physics::place_mover(std::size_t mover, const Pose2& X_WO) {
  carry_mover(mover, X_WO);
  btRigidBody& body = *impl_->movers[mover].body.body;
  body.setInterpolationWorldTransform(body.getWorldTransform());
}

// Bullet computes the velocity of a kinematic body from its former pose.
void Physics::carry_mover(std::size_t mover, const Pose2& X_WO) {
  const Mover& m = impl_->movers[mover];
  m.body.body->setWorldTransform(upright(X_WO, 0) * m.offset);
}

void Physics::remove_mover(std::size_t mover) {
  Body& body = impl_->movers[mover].body;
  if (body.body == nullptr) return;
  impl_->world.removeRigidBody(body.body.get());
  body = {};
}

void Physics::set_velocity(std::size_t robot, Vec2 linear, double turn) {
  btRigidBody& body = *impl_->robots[robot].body;
  body.setLinearVelocity(btVector3(linear.x, linear.y, 0));
  body.setAngularVelocity(btVector3(0, 0, turn));
}

void Physics::step(double seconds) {
  impl_->world.stepSimulation(seconds, 0);
  for (Body& r : impl_->robots) {
    r.yaw = wrapped(r.yaw + r.body->getAngularVelocity().z() * seconds);
    const btVector3& p = r.body->getWorldTransform().getOrigin();
    r.body->setCenterOfMassTransform(upright({p.x(), p.y(), r.yaw}, 0));
  }
}

Pose2 Physics::pose(std::size_t robot) const {
  const Body& r = impl_->robots[robot];
  const btVector3& p = r.body->getWorldTransform().getOrigin();
  return {p.x(), p.y(), r.yaw};
}

Standing Physics::standing(const Pair& pair) const {
  const Pose2 robot = pose(pair.robot);
  Pose2 other;  // Stays zero for fixed obstacles, which never move.
  if (pair.kind == Kind::robot) other = pose(pair.other);
  if (pair.kind == Kind::mover && impl_->movers[pair.other].body.body != nullptr) {
    const btTransform& X = impl_->movers[pair.other].body.body->getWorldTransform();
    other = {X.getOrigin().x(), X.getOrigin().y(), std::atan2(X.getBasis()[1].x(), X.getBasis()[0].x())};
  }
  return {robot.position() - other.position(), robot.yaw, other.yaw};
}

std::vector<Touch> Physics::touches(std::size_t robot) const {
  std::vector<Touch> touches;
  const btRigidBody& own = *impl_->robots[robot].body;
  const Pose2 at = pose(robot);
  for (int i = 0; i < impl_->dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *impl_->dispatcher.getManifoldByIndexInternal(i);
    const bool first = m.getBody0() == &own;
    if (!first && m.getBody1() != &own) continue;
    for (int k = 0; k < m.getNumContacts(); ++k) {
      const btManifoldPoint& contact = m.getContactPoint(k);
      const btVector3& p = first ? contact.getPositionWorldOnA() : contact.getPositionWorldOnB();
      touches.push_back({rotated(Vec2{p.x(), p.y()} - at.position(), -at.yaw), contact.getDistance()});
    }
  }
  return touches;
}

std::map<Pair, double> Physics::near_pairs() const {
  std::map<Pair, double> pairs;
  const btDispatcher& dispatcher = impl_->dispatcher;
  for (int i = 0; i < dispatcher.getNumManifolds(); ++i) {
    const btPersistentManifold& m = *impl_->dispatcher.getManifoldByIndexInternal(i);
    const btCollisionObject& a = *m.getBody0();
    const btCollisionObject& b = *m.getBody1();
    for (int k = 0; k < m.getNumContacts(); ++k) {
      const double distance = m.getContactPoint(k).getDistance();
      if (kind_of(a) == Kind::robot) note(pairs, pair_of(a, b), distance);
      if (kind_of(b) == Kind::robot) note(pairs, pair_of(b, a), distance);
    }
  }
  return pairs;
}

}  // namespace orca::sim::detail
