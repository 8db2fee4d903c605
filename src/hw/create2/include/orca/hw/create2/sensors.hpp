// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "orca/base/result.hpp"

namespace orca::hw::create2 {

/// Numbers of packets that drivers ask for, out of 7 to 58.
inline constexpr std::uint8_t kPacketBumpsAndDrops = 7;
inline constexpr std::uint8_t kPacketChargingState = 21;
inline constexpr std::uint8_t kPacketVoltage = 22;
inline constexpr std::uint8_t kPacketCharge = 25;
inline constexpr std::uint8_t kPacketCapacity = 26;
inline constexpr std::uint8_t kPacketMode = 35;
inline constexpr std::uint8_t kPacketLeftCounts = 43;
inline constexpr std::uint8_t kPacketRightCounts = 44;

/// Groups of packets, which are sent one after the other.
inline constexpr std::uint8_t kGroup0 = 0;           ///< 7 to 26
inline constexpr std::uint8_t kGroup1 = 1;           ///< 7 to 16
inline constexpr std::uint8_t kGroup2 = 2;           ///< 17 to 20
inline constexpr std::uint8_t kGroup3 = 3;           ///< 21 to 26
inline constexpr std::uint8_t kGroup4 = 4;           ///< 27 to 34
inline constexpr std::uint8_t kGroup5 = 5;           ///< 35 to 42
inline constexpr std::uint8_t kGroup6 = 6;           ///< 7 to 42
inline constexpr std::uint8_t kGroupAll = 100;       ///< 7 to 58
inline constexpr std::uint8_t kGroupNew = 101;       ///< 43 to 58
inline constexpr std::uint8_t kGroupLight = 106;     ///< 46 to 51
inline constexpr std::uint8_t kGroupCurrents = 107;  ///< 54 to 58

/// Returns the number of data bytes of a packet or a group; nothing if there is none with this number.
[[nodiscard]] std::optional<std::size_t> data_size(std::uint8_t packet);

/// Packet 7.
struct BumpsAndDrops {
  bool bump_left = false;   ///< The bumper touches something.
  bool bump_right = false;  ///< Both: in front.
  bool drop_left = false;   ///< The wheel hangs: the robot was lifted or has driven over an edge.
  bool drop_right = false;
  friend bool operator==(const BumpsAndDrops&, const BumpsAndDrops&) = default;
};

/// Packet 14: motors that draw too much current.
struct Overcurrents {
  bool left_wheel = false;
  bool right_wheel = false;
  bool main_brush = false;
  bool side_brush = false;
  friend bool operator==(const Overcurrents&, const Overcurrents&) = default;
};

/// Packet 21.
enum class ChargingState : std::uint8_t {
  not_charging = 0,
  reconditioning = 1,
  full = 2,  ///< Charging with full current.
  trickle = 3,
  waiting = 4,
  fault = 5,
};

/// Packet 34: chargers that are connected and have power.
struct ChargingSources {
  bool internal = false;   ///< The plug at the robot.
  bool home_base = false;  ///< The dock.
  friend bool operator==(const ChargingSources&, const ChargingSources&) = default;
};

/// Packet 35.
enum class Mode : std::uint8_t { off = 0, passive = 1, safe = 2, full = 3 };

/// Packet 58: the front wheel, which turns when the robot moves forward.
struct Stasis {
  bool toggling = false;  ///< It turns.
  bool disabled = false;  ///< Its sensor is dirty.
  friend bool operator==(const Stasis&, const Stasis&) = default;
};

/// The latest readings of a robot; what was never sent is nothing. Packets 16, 32 and 33 have no meaning.
///
/// A plain value in SI units.
struct Sensors {
  std::optional<BumpsAndDrops> bumps_and_drops{};
  std::optional<bool> wall{};                    ///< Of the sensor on the right side.
  std::array<std::optional<bool>, 4> cliffs{};   ///< No floor at the left, front left, front right, right.
  std::optional<bool> virtual_wall{};            ///< The beam of a virtual wall is seen.
  std::optional<Overcurrents> overcurrents{};    ///< Motors that draw too much current.
  std::optional<std::uint8_t> dirt{};            ///< 0 to 255.
  std::optional<std::uint8_t> infrared_omni{};   ///< Character that the receiver on top sees; 0: none.
  std::optional<std::uint8_t> infrared_left{};   ///< Of the left receiver.
  std::optional<std::uint8_t> infrared_right{};  ///< Of the right receiver.
  /// Bits 0 clean, 1 spot, 2 dock, 3 minute, 4 hour, 5 day, 6 schedule, 7 clock.
  std::optional<std::uint8_t> buttons{};
  std::optional<double> distance{};  ///< [m] since it was last sent. Wrong before firmware 3.3.0.
  std::optional<double> angle{};  ///< [rad] since it was last sent, positive to the left, in whole degrees.
  std::optional<ChargingState> charging_state{};  ///< Values that have no name occur.
  std::optional<double> voltage{};                ///< [V] of the battery.
  std::optional<double> current{};             ///< [A] into the battery; negative while the robot runs on it.
  std::optional<double> temperature{};         ///< [degrees Celsius] of the battery.
  std::optional<double> charge{};              ///< [C] in the battery: 3.6 times the mAh that are sent.
  std::optional<double> capacity{};            ///< [C] of the full battery, as the robot guesses.
  std::optional<std::uint16_t> wall_signal{};  ///< 0 to 1023.
  std::array<std::optional<std::uint16_t>, 4> cliff_signals{};  ///< 0 to 4095; the order is that of `cliffs`.
  std::optional<ChargingSources> charging_sources{};            ///< Chargers with power.
  std::optional<Mode> mode{};                                   ///< Values that have no name occur.
  std::optional<std::uint8_t> song{};                           ///< The song that is chosen.
  std::optional<bool> song_playing{};                           ///< It is heard.
  std::optional<std::uint8_t> stream_packets{};                 ///< Number of packets in the stream.
  std::optional<double> requested_speed{};                      ///< [m/s] that drive() has asked for.
  std::optional<double> requested_radius{};     ///< [m] that drive() has asked for; infinite: straight on.
  std::optional<double> requested_right{};      ///< [m/s] that drive_wheels() has asked for.
  std::optional<double> requested_left{};       ///< [m/s] that drive_wheels() has asked for.
  std::optional<std::uint16_t> left_counts{};   ///< Encoder of the wheel, for EncoderOdometry.
  std::optional<std::uint16_t> right_counts{};  ///< Encoder of the wheel, for EncoderOdometry.
  std::optional<std::uint8_t> light_bumper{};   ///< Obstacles close by: bits 0 to 5, as `light_signals`.
  /// 0 to 4095; left, front left, centre left, centre right, front right, right.
  std::array<std::optional<std::uint16_t>, 6> light_signals{};
  std::optional<double> left_motor_current{};   ///< [A]
  std::optional<double> right_motor_current{};  ///< [A]
  std::optional<double> main_brush_current{};   ///< [A]
  std::optional<double> side_brush_current{};   ///< [A]
  std::optional<Stasis> stasis{};               ///< State of the front wheel.
  friend bool operator==(const Sensors&, const Sensors&) = default;

  /// Takes the answer to ask_packet().
  /// @errors  invalid_argument if there is no such packet; data_loss if the data have another size. Nothing is changed
  ///          then.
  Status apply(std::uint8_t packet, std::span<const std::uint8_t> data);

  /// Takes the answer to ask_list().
  /// @errors  as those of apply().
  Status apply_list(std::span<const std::uint8_t> packets, std::span<const std::uint8_t> data);

  /// Takes the packets of a frame of a stream.
  /// @param body  body_of() the frame.
  /// @errors  as those of apply(); of a frame that a scanner with kProtocol has found there are none.
  Status apply_body(std::span<const std::uint8_t> body);
};

/// Returns how full the battery is, 0 to 1; nothing if charge or capacity are not known, or the capacity is 0.
[[nodiscard]] std::optional<double> state_of_charge(const Sensors& sensors);

}  // namespace orca::hw::create2
