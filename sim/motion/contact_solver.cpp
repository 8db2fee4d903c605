// SPDX-License-Identifier: LGPL-3.0-or-later
#include "contact_solver.hpp"

#include "orca/base/portable_math.hpp"

namespace orca::sim::detail {
namespace {

// Enough for a base between two walls; the solver ends earlier as soon as nothing changes any more.
constexpr int kRounds = 200;
constexpr double kUnchanged = 1e-24;  // Square of an impulse [N2 s2].

btVector3 flat_vector(Vec2 v) { return {v.x, v.y, 0.0}; }

btTransform upright_transform(const Pose2& pose) {
  const auto [cosine, sine] = portable::cos_sin(pose.yaw);
  return btTransform(btMatrix3x3(cosine, -sine, 0, sine, cosine, 0, 0, 0, 1), btVector3(pose.x, pose.y, 0));
}

btContactSolverInfo settings(double seconds) {
  btContactSolverInfo info;
  info.m_timeStep = seconds;
  info.m_numIterations = kRounds;
  info.m_leastSquaresResidualThreshold = kUnchanged;
  info.m_splitImpulse = false;
  info.m_solverMode = SOLVER_ENABLE_FRICTION_DIRECTION_CACHING;
  return info;
}

}  // namespace

ContactSolver::ContactSolver(double seconds, double friction)
    : seconds_(seconds), friction_(friction), ground_(0.0, nullptr, &shape_) {}
ContactSolver::~ContactSolver() = default;

std::size_t ContactSolver::add(const Motion& motion, double mass, double yaw_inertia) {
  // Only the inertia about z matters: the body cannot tilt.
  const btVector3 inertia(yaw_inertia, yaw_inertia, yaw_inertia);
  btRigidBody::btRigidBodyConstructionInfo info(mass, nullptr, &shape_, inertia);
  info.m_startWorldTransform = upright_transform(motion.pose);
  btRigidBody& body = bodies_.emplace_back(info);
  body.setLinearFactor(btVector3(1, 1, 0));
  body.setAngularFactor(btVector3(0, 0, 1));
  body.setLinearVelocity(flat_vector(motion.velocity));
  body.setAngularVelocity(btVector3(0, 0, motion.turn));
  return bodies_.size() - 1;
}

std::size_t ContactSolver::add_base(const Motion& motion, double mass, double yaw_inertia, const Grip& grip) {
  const std::size_t number = add(motion, mass, yaw_inertia);
  grips_.emplace_back(bodies_[number], grip, seconds_);
  return number;
}

std::size_t ContactSolver::add_carried(const Motion& motion) {
  const std::size_t number = add(motion, 0.0, 0.0);
  btRigidBody& body = bodies_[number];
  body.setCollisionFlags(body.getCollisionFlags() | btCollisionObject::CF_KINEMATIC_OBJECT);
  return number;
}

void ContactSolver::add_contact(std::size_t one, std::size_t other, Vec2 place, Vec2 normal,
                                double distance) {
  const btRigidBody& of_other = other == kGround ? ground_ : bodies_[other];
  btPersistentManifold& manifold =
      contacts_.emplace_back(&bodies_[one], &of_other, 0, BT_LARGE_FLOAT, BT_LARGE_FLOAT);
  btManifoldPoint point(btVector3(0, 0, 0), btVector3(0, 0, 0), flat_vector(normal), distance);
  point.m_positionWorldOnA = point.m_positionWorldOnB = flat_vector(place);
  point.m_combinedFriction = friction_;
  point.m_lateralFrictionDir1 = flat_vector({-normal.y, normal.x});
  point.m_contactPointFlags |= BT_CONTACT_FLAG_LATERAL_FRICTION_INITIALIZED;
  manifold.addManifoldPoint(point);
}

void ContactSolver::solve() {
  std::vector<btCollisionObject*> bodies;
  for (btRigidBody& body : bodies_) bodies.push_back(&body);
  std::vector<btPersistentManifold*> contacts;
  for (btPersistentManifold& contact : contacts_) contacts.push_back(&contact);
  std::vector<btTypedConstraint*> grips;
  for (WheelGrip& grip : grips_) grips.push_back(&grip);
  const auto count = [](const auto& list) { return static_cast<int>(list.size()); };
  btSequentialImpulseConstraintSolver solver;
  solver.solveGroup(bodies.data(), count(bodies), contacts.data(), count(contacts), grips.data(),
                    count(grips), settings(seconds_), nullptr, nullptr);
}

Vec2 ContactSolver::velocity(std::size_t body) const {
  const btVector3& v = bodies_[body].getLinearVelocity();
  return {v.x(), v.y()};
}

double ContactSolver::turn(std::size_t body) const { return bodies_[body].getAngularVelocity().z(); }

}  // namespace orca::sim::detail
