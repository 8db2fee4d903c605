// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <utility>

#include "orca/component.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/idl/navigation.hpp"

namespace orca::planner {

/// The port by which a plan leads another behaviour, which drives in the planner's stead.
///
/// Thread contract: as the component that owns it.
class Lead {
 public:
  explicit Lead(Component& owner)
      : port_(owner, "AheadPush",
              {.text = "The place on its path that is look_ahead_time ahead, once per lap while a path leads "
                       "on: for an avoid behaviour that drives in its stead."}) {}

  /// Names the place to drive to, in the frame of the goals. Within `reach_radius` [m] of it the other behaviour leaves
  /// coming to rest to the planner; 0: it is only passed.
  void name(Vec2 place, double reach_radius) {
    if (port_.subscriber_count() == 0) return;
    auto point = port_.loan();
    point->coordinate().point().x(place.x);
    point->coordinate().point().y(place.y);
    point->reach_radius().distance(reach_radius);
    point->via(reach_radius == 0.0);
    port_.push(std::move(point));
  }

 private:
  PushServer<idl::GoalPoint> port_;
};

}  // namespace orca::planner
