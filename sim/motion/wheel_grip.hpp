// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <btBulletDynamicsCommon.h>

#include "orca/geometry/vec2.hpp"

namespace orca::sim::detail {

// What the wheels of a base want, and how hard they push for it. They brake harder than they drive: a motor that is
// turned from outside holds until the wheels slide.
struct Grip {
  Vec2 velocity;                // [m/s] Of the base, in the world's axes.
  double turn = 0.0;            // [rad/s]
  double heading = 0.0;         // [rad] Direction in which the wheels roll.
  double drives = 0.0;          // [N] Most that the motors push with.
  double turns = 0.0;           // [N m] Most that they turn with.
  double slides = 0.0;          // [N] Until the wheels slide on the floor, in any direction.
  double skids = 0.0;           // [N m] Until they do when the base is turned.
  bool rolls_sideways = false;  // The wheels drive across their heading, too.
};

// The wheels as a constraint of Bullet on one body: they hold its velocity to what they want, along, across and
// round, each with a limited force. So what touches the base moves it only as far as the wheels give way.
class WheelGrip final : public btTypedConstraint {
 public:
  // @param seconds  duration of the step to solve.
  WheelGrip(btRigidBody& base, const Grip& grip, double seconds)
      : btTypedConstraint(D6_CONSTRAINT_TYPE, base), grip_(grip), seconds_(seconds) {}

  void getInfo1(btConstraintInfo1* info) override;
  void getInfo2(btConstraintInfo2* info) override;
  void setParam(int /*number*/, btScalar /*value*/, int /*axis*/) override {}
  [[nodiscard]] btScalar getParam(int /*number*/, int /*axis*/) const override { return 0.0; }

 private:
  Grip grip_;
  double seconds_;
};

}  // namespace orca::sim::detail
