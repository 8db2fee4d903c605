// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <vector>

#include "moving_body.hpp"
#include "physics.hpp"

namespace orca::sim::detail {

// A piece of a robot, and a piece of something else that may be in its way.
struct Encounter {
  Pair pair;
  const MovingBody* one = nullptr;    // The robot.
  const MovingBody* other = nullptr;  // Null: it stands still, and its plan is in the world's frame.
  const Rounded* plan = nullptr;      // Of the robot's piece, in the base frame.
  Rounded other_plan;                 // Of the other, in its own frame.
  bool touches = false;               // At the beginning of the present part of the step.

  // Returns the gap after so many seconds, in the frame of the robot then.
  [[nodiscard]] Gap gap(double seconds) const;
  // Adds the places where they are at most `limit` [m] apart now, in the frame of the robot.
  void add_touches(double limit, std::vector<Gap>& found) const;

  // Returns when the gap becomes as small as `target` [m] while both move on evenly; `seconds` if it does not before.
  // If it is smaller already: 0 if it shrinks further. The time is never too late.
  //
  // It is found by conservative advancement (B. Mirtich, "Impulse-based Dynamic Simulation of Rigid Body Systems", PhD
  // thesis, Berkeley 1996, 2.3): along the normal of the gap the bodies cannot close it faster than by their velocities
  // along it, and by the turns of their farthest corners.
  [[nodiscard]] double time_of_gap(double target, double seconds) const;

 private:
  [[nodiscard]] double closing_speed(const Gap& gap, double seconds) const;
};

}  // namespace orca::sim::detail
