// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/obstruction.hpp"

#include <algorithm>
#include <utility>

namespace orca::hw {
namespace {

// [m/s] A velocity along a wall or on the spot is no velocity towards it, whatever the rounding.
constexpr double kTowards = 1e-6;

Vec2 translation(const Twist2& velocity) { return {velocity.forward, velocity.left}; }

std::string text_of(const Obstruction::Pressed& bumper) {
  return "its bumper \"" + bumper.name + "\" is pressed";
}

}  // namespace

void Obstruction::meet(const Twist2& velocity, const std::string& reason, Hindrance by) {
  if (velocity == Twist2{}) return;
  met_while_ = velocity;
  reason_ = reason;
  met_by_ = by;
  felt_[static_cast<std::size_t>(by)] = reason;
}

void Obstruction::press(std::vector<Pressed> bumpers) {
  pressed_ = std::move(bumpers);
  if (!pressed_.empty()) felt_[static_cast<std::size_t>(Hindrance::touch)] = text_of(pressed_.front());
}

std::optional<std::string> Obstruction::take_hindrance(Hindrance by) {
  std::optional<std::string> felt = std::exchange(felt_[static_cast<std::size_t>(by)], std::nullopt);
  if (by == Hindrance::touch && !pressed_.empty()) return text_of(pressed_.front());
  if (met_while_ && met_by_ == by) return reason_;
  return felt;
}

// A base that only turned when it was stalled goes on when it only turns the same way: one that backs off may turn as it does.
bool Obstruction::goes_on(const Twist2& velocity) const {
  if (translation(*met_while_) == Vec2{})
    return translation(velocity) == Vec2{} && velocity.turn_rate * met_while_->turn_rate > 0.0;
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
  return text_of(*pressed);
}

}  // namespace orca::hw
