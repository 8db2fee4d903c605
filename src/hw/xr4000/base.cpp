// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/xr4000/base.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"

namespace orca::hw::xr4000 {
namespace {

struct Place {
  double x;  // [mm] to the right
  double y;  // [mm] ahead
};

// Of the sensors 0 to 7 of sets 0 and 1, 2 and 3, 4 and 5. Both sets of a door have the same places, above each other.
constexpr std::array<Place, kSonars / 2> kPlaces{
    {{238.006, 182.628},   {182.628, 238.006},   {114.805, 277.164},   {39.158, 297.433},
     {-39.158, 297.433},   {-114.805, 277.164},  {-182.628, 238.006},  {-238.006, 182.628},
     {-277.164, 114.805},  {-297.433, 39.158},   {-297.433, -39.158},  {-277.164, -114.805},
     {-238.006, -182.628}, {-182.628, -238.006}, {-114.805, -277.164}, {-39.158, -297.433},
     {39.158, -297.433},   {114.805, -277.164},  {182.628, -238.006},  {238.006, -182.628},
     {277.164, -114.805},  {297.433, -39.158},   {297.433, 39.158},    {277.164, 114.805}}};

constexpr double kMilli = 0.001;

std::int32_t in_thousandths(double value, std::int32_t limit) {
  if (!std::isfinite(value)) return 0;
  return static_cast<std::int32_t>(std::lround(std::clamp(value / kMilli, -1.0 * limit, 1.0 * limit)));
}

}  // namespace

Axes speeds_of(const Twist2& velocity) {
  return {in_thousandths(-velocity.left, kMaxSpeed), in_thousandths(velocity.forward, kMaxSpeed),
          in_thousandths(velocity.turn_rate, kMaxTurnRate)};
}

Twist2 velocity_of(const Axes& speeds) {
  return {kMilli * speeds.y, -kMilli * speeds.x, kMilli * speeds.rotation};
}

Axes accelerations_of(double translation, double turn) {
  const std::int32_t both = std::max(1, in_thousandths(translation, kMaxAcceleration));
  return {both, both, std::max(1, in_thousandths(turn, kMaxTurnAcceleration))};
}

Pose2 pose_of(const Axes& integrator) {
  return {kMilli * integrator.y, -kMilli * integrator.x, wrapped(kMilli * integrator.rotation)};
}

Pose2 sonar_place(std::size_t number) {
  const Place& place = kPlaces[kPerSet * door_of(number / kPerSet) + number % kPerSet];
  const double x = kMilli * place.y;
  const double y = -kMilli * place.x;
  return {x, y, portable::atan2(y, x)};
}

double door_direction(std::size_t door) {
  return wrapped(2.0 * std::numbers::pi / 3.0 * static_cast<double>(door));
}

void IntegratorOdometry::add(const Axes& integrator) {
  const Pose2 counted = pose_of(integrator);
  if (!origin_) origin_ = pose_ * inverse(counted);
  pose_ = *origin_ * counted;
}

}  // namespace orca::hw::xr4000
