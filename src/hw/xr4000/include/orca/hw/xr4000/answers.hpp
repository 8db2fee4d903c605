// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/xr4000/base.hpp"
#include "orca/hw/xr4000/frame.hpp"

/// Answers of the agent. Each begins with what the N_* function returned; if that is not 0, nothing else need follow.
namespace orca::hw::xr4000 {

/// What an N_* function returned. Others than these come too.
enum class Returned : std::int8_t {
  ok = 0,
  axes_not_ready = -10,
};

/// Returns the value of a return code for people: "-6 (connection failed)".
[[nodiscard]] std::string text_of(Returned returned);

/// Returns what the function returned for which an answer stands.
/// @errors  data_loss if the answer is empty.
[[nodiscard]] Result<Returned> returned_of(const Message& answer);

/// Who answers.
struct Agent {
  std::uint8_t version = 0;     ///< Of its protocol.
  std::uint8_t robot_type = 0;  ///< 'x': XR4000; 'n': Nomad 200.
};

/// Bits of the axes' status; 0: they are ready. There may be others, which do not keep them from moving.
inline constexpr std::uint8_t kEmergencyStop = 1;
inline constexpr std::uint8_t kJoystick = 2;  ///< Somebody drives it.
inline constexpr std::uint8_t kMotionError = 4;

/// Where the robot is, and what its axes do.
///
/// A plain value in the library's units.
struct State {
  std::uint8_t status = 0;  ///< Bits, as above.
  std::uint32_t time = 0;   ///< [ms] clock of the robot; it wraps after 49 days.
  Axes integrator{};        ///< [mm, mrad] pose from where it was zeroed.
  Axes speeds{};            ///< [mm/s, mrad/s] of the axes, in the robot frame.
};

using SonarReadings = std::array<std::optional<std::uint16_t>, kSonars>;  ///< [mm] by number; none: no echo.
using InfraredReadings = std::array<std::uint16_t, kSonars>;  ///< As the library counts, by number.

/// What touches a switch.
enum class Touch : std::uint8_t { none = 0, low = 1, high = 2 };

inline constexpr std::size_t kSwitchesOfEvenSets = 12;
inline constexpr std::size_t kSwitchesOfOddSets = 8;
inline constexpr std::size_t kSwitches = 3 * (kSwitchesOfEvenSets + kSwitchesOfOddSets);

/// A bumper switch: the set and its place there.
struct Switch {
  std::size_t set = 0;
  std::size_t number = 0;
  friend bool operator==(const Switch&, const Switch&) = default;
};
/// Returns which switch has that index in BumperReadings. @pre  index < kSwitches
[[nodiscard]] Switch switch_at(std::size_t index);

using BumperReadings = std::array<Touch, kSwitches>;   ///< Set after set.
using BatteryReadings = std::array<std::uint16_t, 4>;  ///< As the library counts, by channel.

/// Read an answer.
/// @errors  invalid_argument if it answers another request; unavailable with the return code if the function has failed;
/// data_loss if it is not as long as it must be, or holds what does not exist.
[[nodiscard]] Result<Agent> parse_hello(const Message& answer);
[[nodiscard]] Result<State> parse_state(const Message& answer);
[[nodiscard]] Result<SonarReadings> parse_sonars(const Message& answer);
[[nodiscard]] Result<InfraredReadings> parse_infrared(const Message& answer);
[[nodiscard]] Result<BumperReadings> parse_bumpers(const Message& answer);
[[nodiscard]] Result<BatteryReadings> parse_batteries(const Message& answer);

}  // namespace orca::hw::xr4000
