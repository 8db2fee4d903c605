// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "keys.hpp"

namespace orca::teleop {

/// The axes and the button that drive, with the numbers of the kernel driver. Left and up are negative.
struct JoystickMap {
  std::uint8_t forward_axis = 1;
  std::uint8_t left_axis = 0;
  std::uint8_t dead_man_button = 0;
  double dead_zone = 0.05;  ///< [1] share of an axis's range; smaller values count as 0.
};

/// A joystick as Linux reports it, by an event for each change. It is at rest while its dead-man button is
/// not held.
///
/// Thread contract: not synchronised.
/// @source  Linux kernel, Documentation/input/joydev/joystick-api.rst: struct js_event is time (4 bytes),
///          value (signed, 2 bytes), type (1 byte; 1 button, 2 axis, 0x80 added for the first state), number.
class Joystick {
 public:
  /// Takes bytes as read from the device; events may come in parts.
  void take(std::string_view bytes);
  /// Puts everything at rest, because the device has gone.
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
