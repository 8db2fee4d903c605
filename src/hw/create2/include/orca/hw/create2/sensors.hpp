// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "orca/geometry/twist2.hpp"
#include "orca/hw/framing/scanner.hpp"

namespace orca::hw::create2 {

/// Number of a packet of sensors, of those that a driver asks for, out of 7 to 58.
enum class Packet : std::uint8_t {
  bumps_and_drops = 7,
  cliff_left = 9,
  cliff_front_left = 10,
  cliff_front_right = 11,
  cliff_right = 12,
  overcurrents = 14,
  charging_state = 21,
  voltage = 22,
  charge = 25,
  capacity = 26,
  charging_sources = 34,
  mode = 35,
  left_counts = 43,
  right_counts = 44,
};

/// Returns the number of data bytes of a packet; nothing if it is none of Packet.
[[nodiscard]] std::optional<std::size_t> data_size(std::uint8_t packet);

/// Packet::bumps_and_drops.
struct BumpsAndDrops {
  bool bump_left = false;   ///< The bumper touches something.
  bool bump_right = false;  ///< Both: in front.
  bool drop_left = false;   ///< The wheel hangs: the robot was lifted or has driven over an edge.
  bool drop_right = false;
  friend bool operator==(const BumpsAndDrops&, const BumpsAndDrops&) = default;
};

/// Packet::charging_state.
enum class ChargingState : std::uint8_t {
  not_charging = 0,
  reconditioning = 1,
  full = 2,  ///< Charging with full current.
  trickle = 3,
  waiting = 4,
  fault = 5,
};

/// Packet::mode.
enum class Mode : std::uint8_t { off = 0, passive = 1, safe = 2, full = 3 };

/// The readings of a robot in one frame; what is not in it is nothing.
///
/// A plain value in SI units.
struct Sensors {
  BumpsAndDrops bumps_and_drops{};
  std::array<bool, 4> cliffs{};                   ///< No floor at the left, front left, front right, right.
  bool is_stalled = false;                        ///< The motor of a wheel draws too much current.
  bool is_at_charger = false;                     ///< A charger with power is connected.
  std::optional<ChargingState> charging_state{};  ///< Values that have no name occur.
  std::optional<double> voltage{};                ///< [V] of the battery.
  std::optional<double> charge{};                 ///< [C] in the battery: 3.6 times the mAh that are sent.
  std::optional<double> capacity{};               ///< [C] of the full battery, as the robot guesses.
  std::optional<Mode> mode{};                     ///< Values that have no name occur.
  std::optional<std::uint16_t> left_counts{};     ///< Encoder of the wheel, for EncoderOdometry.
  std::optional<std::uint16_t> right_counts{};    ///< Encoder of the wheel, for EncoderOdometry.
  friend bool operator==(const Sensors&, const Sensors&) = default;
};

/// Reads the packets of a frame of a stream.
/// @param body  body_of() the frame.
/// @return  nothing if they do not fit into it; those of a frame that a scanner with kProtocol has found do.
[[nodiscard]] std::optional<Sensors> parse_body(std::span<const std::uint8_t> body);

/// Returns how full the battery is, 0 to 1; nothing if charge or capacity are not known, or the capacity is 0.
[[nodiscard]] std::optional<double> state_of_charge(const Sensors& sensors);

inline constexpr std::size_t kLongestFrame =
    258;  ///< [bytes] header, length, body of at most 255 bytes and checksum.

/// Recognises a frame at the first of these bytes: 19, length, packets each after its number, checksum. All bytes
/// together have the sum 0, the header included; in the manual of the first Create it was not. Because the checksum
/// has 8 bits only, the packets must also fit exactly into the length.
[[nodiscard]] framing::Finding look(std::span<const std::uint8_t> bytes);

/// The framing of streams, for a framing::Scanner. Lines of text that the robot prints are passed over.
inline constexpr framing::Protocol kProtocol{.look = look, .longest = kLongestFrame};

/// Returns the packets of a frame, each after its number: parse_body().
/// @pre  `frame` is one that a scanner with kProtocol has found.
[[nodiscard]] std::span<const std::uint8_t> body_of(std::span<const std::uint8_t> frame);

/// Encoder counts of a wheel's turn. This and the diameter are the figures in wide use, but not in every edition of the
/// specification: calibrate a robot by a measured way.
inline constexpr double kCountsPerTurn = 508.8;
inline constexpr double kWheelDiameter = 0.072;  ///< [m]

/// Returns the step from one encoder count to the next, in [-32768, 32767]. Counts have 16 bits and wrap.
[[nodiscard]] int step_of(std::uint16_t previous, std::uint16_t next);

/// Returns the way of a wheel [m] in so many counts.
[[nodiscard]] double wheel_way(int counts);

/// The way of a robot, out of its encoder counts. These wrap after 14.5 m, so only their differences count, and two
/// readings must be less than 7 m apart.
///
/// The encoders cannot sense the direction: the robot takes it from the commands of its motors. So counts are wrong if
/// it is pushed, or coasts while it changes direction (from reports of users alone).
///
/// Thread contract: not synchronised.
class EncoderOdometry {
 public:
  /// Returns how far the robot has come since the last call; nothing at all after the first one.
  Travel2 add(std::uint16_t left, std::uint16_t right);

  /// Makes the next counts a new reference: after the robot was reset, or was not heard for long.
  void forget() { previous_.reset(); }

 private:
  struct Counts {
    std::uint16_t left = 0;
    std::uint16_t right = 0;
  };
  std::optional<Counts> previous_;
};

}  // namespace orca::hw::create2
