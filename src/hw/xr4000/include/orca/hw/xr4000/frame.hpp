// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "orca/hw/framing/scanner.hpp"
#include "orca/hw/framing/short_list.hpp"

/// Orca's own protocol to an agent on the computer of a Nomad XR4000, which calls the functions of the robot's client library
/// (N_*): bytes to values and back, without clock and I/O. The agent only answers, one answer to each request. All functions
/// are pure; any thread.
/// @source  docs/hardware/xr4000.md
namespace orca::hw::xr4000 {

inline constexpr std::size_t kLongestPayload = 128;                ///< [bytes]
inline constexpr std::size_t kLongestFrame = kLongestPayload + 7;  ///< [bytes]
inline constexpr std::uint8_t kVersion = 1;                        ///< Of the protocol.
inline constexpr std::uint8_t kAnswerBit = 0x80;                   ///< In the type of an answer.

/// A whole frame, ready to be sent.
using Frame = framing::FrameBytes<kLongestFrame>;

/// What a frame asks for. Its answer has the same type with kAnswerBit.
enum class Type : std::uint8_t {
  hello = 1,               ///< Version of the agent's protocol and type of the robot.
  get_state = 2,           ///< N_GetIntegratedConfiguration, N_GetAxes, N_GetTimer.
  set_axes = 3,            ///< N_SetAxes
  reset_motion_timer = 4,  ///< N_ResetMotionTimer
  set_timer = 5,           ///< N_SetTimer
  set_integrator = 6,      ///< N_SetIntegratedConfiguration
  get_sonar = 7,           ///< N_GetSonar
  get_infrared = 8,        ///< N_GetInfrared
  get_bumper = 9,          ///< N_GetBumper
  get_battery = 10,        ///< N_GetBattery
};

/// A frame taken apart. It refers to the bytes of the frame.
struct Message {
  Type type = Type::hello;  ///< Without kAnswerBit; may be one that is not listed.
  bool is_answer = false;
  std::span<const std::uint8_t> payload{};
};

/// Recognises a frame at the first of these bytes: 58 52, length, type, payload, CRC.
[[nodiscard]] framing::Finding look(std::span<const std::uint8_t> bytes);

/// The framing of both directions, for a framing::Scanner. When an answer has timed out, call its give_up().
inline constexpr framing::Protocol kProtocol{.look = look, .longest = kLongestFrame};

/// Returns the frame around a payload.
/// @pre  The payload has at most kLongestPayload bytes.
[[nodiscard]] Frame make_frame(const Message& message);

/// @pre  `frame` is one that a scanner with kProtocol has found.
[[nodiscard]] Message message_of(std::span<const std::uint8_t> frame);

}  // namespace orca::hw::xr4000
