// SPDX-License-Identifier: LGPL-3.0-or-later
#include "joystick.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace orca::teleop {
namespace {

constexpr unsigned char kButton = 0x01;
constexpr unsigned char kAxis = 0x02;
constexpr unsigned char kFirstState = 0x80;

double share(std::int16_t value, double dead_zone) {
  const double way = std::clamp(value / 32767.0, -1.0, 1.0);
  return std::abs(way) < dead_zone ? 0.0 : way;
}

}  // namespace

void Joystick::take(std::string_view bytes) {
  for (const char byte : bytes) {
    event_[filled_++] = static_cast<unsigned char>(byte);
    if (filled_ == kEventBytes) take_event();
  }
}

void Joystick::take_event() {
  filled_ = 0;
  std::int16_t value = 0;
  std::memcpy(&value, &event_[4], sizeof value);
  const auto type = static_cast<unsigned char>(event_[6] & ~kFirstState);
  if (type == kAxis) axes_[event_[7]] = value;
  if (type == kButton) buttons_[event_[7]] = value != 0;
}

Stick Joystick::stick(const JoystickMap& map) const {
  if (!buttons_[map.dead_man_button]) return {};
  // Subtracted from 0.0, so that an axis at rest does not give a negative zero.
  return {0.0 - share(axes_[map.forward_axis], map.dead_zone),
          0.0 - share(axes_[map.left_axis], map.dead_zone)};
}

}  // namespace orca::teleop
