// SPDX-License-Identifier: LGPL-3.0-or-later
#include "points.hpp"

#include <utility>

namespace orca::command {
namespace {

Loan<idl::GoalPoint> point_at(const Place& place) {
  if (!place.door) return make_object<idl::GoalPoint>();
  auto door = make_object<idl::Door>();
  door->orientation().orientation().yaw(place.door->direction);
  door->door_width().distance(place.door->width);
  door->passable(true);
  return door;
}

}  // namespace

Loan<idl::GoalPoint> point_of(const Route& route, const Place& place, const Demands& demands) {
  Loan<idl::GoalPoint> point = point_at(place);
  point->name() = route.name;
  point->coordinate().point().x(place.x);
  point->coordinate().point().y(place.y);
  point->coordinate().point().z(place.z);
  point->via(demands.via);
  point->reach_radius().distance(demands.radius);
  point->use_orientation(!demands.via && route.use_orientation);
  if (!place.door) point->orientation().orientation().yaw(route.orientation);
  point->reach_angle(demands.angle);
  point->time_limit(demands.time_limit);
  return point;
}

}  // namespace orca::command
