// SPDX-License-Identifier: LGPL-3.0-or-later
#include "stall_watch.hpp"

#include <cmath>

#include "orca/base/portable_math.hpp"

namespace orca::sim {
namespace {

constexpr Duration kStallTime = std::chrono::milliseconds(500);  // from rest, lag and inertia take less
constexpr double kStallShare = 0.1;                              // [1] of the velocity that was asked for

}  // namespace

bool StallWatch::look(const OdometryReading& reading) {
  if (!turned_at_ || !is_slow(reading)) turned_at_ = reading.stamp;
  if (reading.stamp - *turned_at_ < kStallTime) return false;
  turned_at_.reset();
  return true;
}

bool StallWatch::is_slow(const OdometryReading& reading) const {
  const double wanted = portable::hypot(driven_.forward, driven_.left);
  const double driving = portable::hypot(reading.velocity.forward, reading.velocity.left);
  if (wanted > 0.0) return driving < kStallShare * wanted;
  return driven_.turn_rate != 0.0 &&
         std::abs(reading.velocity.turn_rate) < kStallShare * std::abs(driven_.turn_rate);
}

void StallWatch::driven(const Twist2& velocity, TimePoint now) {
  if (velocity == Twist2{} || driven_ == Twist2{}) turned_at_ = now;
  driven_ = velocity;
}

}  // namespace orca::sim
