// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "keys.hpp"

namespace orca::teleop {

/// Which axes and which button count. Axes as the driver numbers them: to the left and up are negative.
struct JoystickMap {
  std::uint8_t forward_axis = 1;
  std::uint8_t left_axis = 0;
  std::uint8_t dead_man_button = 0;
  double dead_zone = 0.05;  ///< [1] of the way of an axis; less is none.
};

/// A joystick as Linux tells of it: an event for each change. While its dead-man button is not held it is at
/// rest.
///
/// Thread contract: not synchronised.
/// @source  Linux kernel, Documentation/input/joydev/joystick-api.rst: struct js_event is time (4 bytes),
///          value (signed, 2 bytes), type (1 byte; 1 button, 2 axis, 0x80 added for the first state), number.
class Joystick {
 public:
  /// Bytes as read from the device; events may come in parts.
  void take(std::string_view bytes);
  /// The device has gone.
  void release() { *this = {}; }

  [[nodiscard]] Stick stick(const JoystickMap& map) const;

 private:
  static constexpr std::size_t kEventBytes = 8;
  void take_event();

  std::array<unsigned char, kEventBytes> event_{};
  std::size_t filled_ = 0;
  std::array<std::int16_t, 256> axes_{};
  std::array<bool, 256> buttons_{};
};

}  // namespace orca::teleop
