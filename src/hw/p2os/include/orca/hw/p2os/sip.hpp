// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "orca/base/result.hpp"
#include "orca/geometry/vec2.hpp"
#include "orca/hw/framing/short_list.hpp"
#include "orca/hw/p2os/model.hpp"
#include "orca/hw/p2os/packet.hpp"

namespace orca::hw::p2os {

/// What a sonar has measured since the SIP before.
struct SonarEcho {
  std::uint8_t index = 0;  ///< Counted from 0.
  double range =
      0.0;  ///< [m] A sonar that hears nothing reports the longest range, about 5 m on a Pioneer 2.
  friend bool operator==(const SonarEcho&, const SonarEcho&) = default;
};

/// State of the ports for user devices, as far as a gripper needs it.
struct PortState {
  std::uint8_t digital_in = 0;  ///< A bit per line.
  std::uint8_t gripper = 0;     ///< Bits: 0 paddles open, 1 closed, 2 moving, 4 lift up, 5 down, 6 moving.
};

/// What a driver needs of the fields that newer firmware appends. Each is there only if the packet is long enough.
struct SipTail {
  std::optional<double>
      real_battery_voltage{};  ///< [V] of a robot whose first battery field is scaled to 12 V.
  std::optional<std::uint8_t>
      charge_state{};  ///< 0 not charging, 1 bulk, 2 overcharge, 3 float, 4 balance, 255 unknown.
  std::optional<double> temperature{};  ///< [degC] of the controller; nothing also where it has no sensor.
  std::optional<std::uint8_t> state_of_charge{};  ///< [%]
};

/// What a driver needs of the server information packet, which the robot sends every 100 ms by default.
///
/// A plain value in SI units.
/// @source  Pioneer 2 operations manual, "Standard server information packet".
struct Sip {
  static constexpr std::size_t kMostEchoes = (kLongestBody - 20) / 3;
  static constexpr int kCoordinates = 32768;  ///< Coordinates have 15 bits.

  std::uint16_t x =
      0;  ///< Coordinate of the odometry, in counts of Model::distance_unit, which wrap at kCoordinates.
  std::uint16_t y =
      0;  ///< Coordinate of the odometry, in counts of Model::distance_unit, which wrap at kCoordinates.
  double heading = 0.0;            ///< [rad] in the frame of the odometry, positive to the left, not wrapped.
  double left_speed = 0.0;         ///< [m/s] of the left wheel, forward positive.
  double right_speed = 0.0;        ///< [m/s] of the right wheel, forward positive.
  double battery_voltage = 0.0;    ///< [V] see also SipTail::real_battery_voltage.
  bool left_stall = false;         ///< The left wheel is blocked.
  bool right_stall = false;        ///< The right wheel is blocked.
  std::uint8_t front_bumpers = 0;  ///< Bit 0: the first one.
  std::uint8_t rear_bumpers = 0;   ///< Bit 0: the first one.
  bool motors_enabled = false;     ///< The motors have power.
  bool emergency_stop = false;     ///< The button is pressed.
  std::uint8_t sonar_groups = 0;   ///< Bits 0 to 3: groups of sonars that are on.
  framing::ShortList<SonarEcho, kMostEchoes> echoes{};  ///< New ones only.
  std::optional<PortState> ports{};                     ///< Nothing if the packet ends before them.
  SipTail tail{};
};

/// Returns whether a body is a SIP, by its type.
[[nodiscard]] bool is_sip(std::span<const std::uint8_t> body);

/// Reads a SIP by its length, not by what a model should send: whole groups of fields may be absent at its end.
/// @errors  invalid_argument if it is no SIP; data_loss if it ends before its sonar readings do.
[[nodiscard]] Result<Sip> parse_sip(std::span<const std::uint8_t> body, const Model& model);

}  // namespace orca::hw::p2os
