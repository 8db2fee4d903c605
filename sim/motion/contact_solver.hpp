// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include <cstddef>
#include <deque>
#include <memory>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "wheel_grip.hpp"

namespace orca::sim::detail {

// The velocities of bodies that touch, solved by Bullet: what touches does not come closer, rubs, and is held by
// wheels. One object solves one moment; it keeps nothing of earlier ones, so a moment's result depends on itself alone.
class ContactSolver {
 public:
  // @param seconds  how long the velocities are to hold: forces act so long, and a gap is closed in that time at most.
  // @param friction  coefficient of what touches.
  ContactSolver(double seconds, double friction);
  ~ContactSolver();
  ContactSolver(const ContactSolver&) = delete;
  ContactSolver& operator=(const ContactSolver&) = delete;

  struct Motion {
    Pose2 pose;
    Vec2 velocity;      // [m/s]
    double turn = 0.0;  // [rad/s]
  };
  // Adds a body that moves as what touches it and its wheels let it. @return  its number.
  std::size_t add_base(const Motion& motion, double mass, double yaw_inertia, const Grip& grip);
  // Adds a body that moves as it does, whatever touches it.
  std::size_t add_carried(const Motion& motion);
  // What stands still, in the place of a body's number.
  static constexpr std::size_t kGround = static_cast<std::size_t>(-1);

  // @param normal    unit vector from the other body to the one.
  // @param distance  [m] by which the two may come closer; negative: they are to come apart.
  void add_contact(std::size_t one, std::size_t other, Vec2 place, Vec2 normal, double distance);

  void solve();
  [[nodiscard]] Vec2 velocity(std::size_t body) const;
  [[nodiscard]] double turn(std::size_t body) const;

 private:
  std::size_t add(const Motion& motion, double mass, double yaw_inertia);

  double seconds_;
  double friction_;
  btSphereShape shape_{1.0};  // Bullet wants one; what touches comes from add_contact().
  btRigidBody ground_;
  std::deque<btRigidBody> bodies_;
  std::deque<WheelGrip> grips_;
  std::deque<btPersistentManifold> contacts_;
};

}  // namespace orca::sim::detail
