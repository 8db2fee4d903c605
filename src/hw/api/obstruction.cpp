// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/obstruction.hpp"

#include <algorithm>

namespace orca::hw {
namespace {

// [m/s] A velocity along a wall or on the spot is no velocity towards it, whatever the rounding.
constexpr double kTowards = 1e-6;

Vec2 translation(const Twist2& velocity) { return {velocity.forward, velocity.left}; }

}  // namespace

void Obstruction::meet(const Twist2& velocity, const std::string& reason) {
  if (velocity == Twist2{}) return;
  met_while_ = velocity;
  reason_ = reason;
}

// A base that only turned when it was stalled goes on when it turns the same way.
bool Obstruction::goes_on(const Twist2& velocity) const {
  if (translation(*met_while_) == Vec2{}) return velocity.turn_rate * met_while_->turn_rate > 0.0;
  return dot(translation(velocity), translation(*met_while_)) > 0.0;
}

std::optional<std::string> Obstruction::against(const Twist2& velocity) {
  if (velocity == Twist2{}) return std::nullopt;
  if (met_while_ && goes_on(velocity)) return reason_;
  met_while_.reset();
  const auto pushes = [&](const Pressed& bumper) {
    return dot(translation(velocity), bumper.outwards) > kTowards;
  };
  const auto pressed = std::find_if(pressed_.begin(), pressed_.end(), pushes);
  if (pressed == pressed_.end()) return std::nullopt;
  return "its bumper \"" + pressed->name + "\" is pressed";
}

}  // namespace orca::hw
