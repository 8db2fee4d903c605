// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/xr4000/answers.hpp"

#include <string_view>

#include "orca/hw/framing/byte_reader.hpp"

namespace orca::hw::xr4000 {
namespace {

using framing::ByteReader;

constexpr std::uint16_t kNothing = 0xFFFF;  // LONG_MAX in the library
constexpr std::array<std::string_view, 17> kReturnTexts{"ok",
                                                        "unknown error",
                                                        "missing argument",
                                                        "invalid argument",
                                                        "no such command",
                                                        "robot not found",
                                                        "connection failed",
                                                        "abnormal position",
                                                        "time-out",
                                                        "wrong operating system",
                                                        "axes not ready",
                                                        "no memory",
                                                        "unsupported",
                                                        "sensor not ready",
                                                        "device not found",
                                                        "uninitialised",
                                                        "connection exists"};

// Returns a reader of what follows the return code of an answer.
Result<ByteReader> fields_of(const Message& answer, Type type, std::size_t size) {
  if (!answer.is_answer || answer.type != type)
    return fail(Code::invalid_argument, "it answers another request");
  const Result<Returned> returned = returned_of(answer);
  if (!returned) return returned.error();
  if (*returned != Returned::ok)
    return fail(Code::unavailable, "the robot's library has returned " + text_of(*returned));
  if (answer.payload.size() != 1 + size)
    return fail(Code::data_loss, "an answer with " + std::to_string(answer.payload.size()) +
                                     " bytes instead of " + std::to_string(1 + size) +
                                     "; do agent and driver have one version?");
  return ByteReader(answer.payload.subspan(1));
}

Axes axes_from(ByteReader& fields) {
  Axes axes;
  axes.x = fields.s32();
  axes.y = fields.s32();
  axes.rotation = fields.s32();
  return axes;
}

}  // namespace

std::string text_of(Returned returned) {
  const int code = static_cast<int>(returned);
  const bool is_known = code <= 0 && -code < static_cast<int>(kReturnTexts.size());
  return std::to_string(code) +
         (is_known ? " (" + std::string(kReturnTexts[static_cast<std::size_t>(-code)]) + ")" : "");
}

Result<Returned> returned_of(const Message& answer) {
  if (answer.payload.empty()) return fail(Code::data_loss, "an answer without a return code");
  return static_cast<Returned>(ByteReader(answer.payload).s8());
}

Result<Agent> parse_hello(const Message& answer) {
  Result<ByteReader> fields = fields_of(answer, Type::hello, 2);
  if (!fields) return fields.error();
  Agent agent;
  agent.version = fields->u8();
  agent.robot_type = fields->u8();
  return agent;
}

Result<State> parse_state(const Message& answer) {
  Result<ByteReader> fields = fields_of(answer, Type::get_state, 29);
  if (!fields) return fields.error();
  State state;
  state.status = fields->u8();
  state.time = fields->u32();
  state.integrator = axes_from(*fields);
  state.speeds = axes_from(*fields);
  return state;
}

Result<SonarReadings> parse_sonars(const Message& answer) {
  Result<ByteReader> fields = fields_of(answer, Type::get_sonar, 2 * kSonars);
  if (!fields) return fields.error();
  SonarReadings readings;
  for (auto& reading : readings) {
    const std::uint16_t range = fields->u16();
    if (range != kNothing) reading = range;
  }
  return readings;
}

Result<InfraredReadings> parse_infrared(const Message& answer) {
  Result<ByteReader> fields = fields_of(answer, Type::get_infrared, 2 * kSonars);
  if (!fields) return fields.error();
  InfraredReadings readings{};
  for (std::uint16_t& reading : readings) reading = fields->u16();
  return readings;
}

Result<BumperReadings> parse_bumpers(const Message& answer) {
  Result<ByteReader> fields = fields_of(answer, Type::get_bumper, kSwitches);
  if (!fields) return fields.error();
  BumperReadings readings{};
  for (Touch& reading : readings) {
    const std::uint8_t touch = fields->u8();
    if (touch > static_cast<std::uint8_t>(Touch::high))
      return fail(Code::data_loss, "a bumper switch with the reading " + std::to_string(touch) +
                                       "; there are 0 (nothing), 1 (low) and 2 (high)");
    reading = static_cast<Touch>(touch);
  }
  return readings;
}

Result<BatteryReadings> parse_batteries(const Message& answer) {
  Result<ByteReader> fields = fields_of(answer, Type::get_battery, 8);
  if (!fields) return fields.error();
  BatteryReadings readings{};
  for (std::uint16_t& reading : readings) reading = fields->u16();
  return readings;
}

Switch switch_at(std::size_t index) {
  constexpr std::size_t kOfDoor = kSwitchesOfEvenSets + kSwitchesOfOddSets;
  const std::size_t even = 2 * (index / kOfDoor);
  const std::size_t rest = index % kOfDoor;
  if (rest < kSwitchesOfEvenSets) return {even, rest};
  return {even + 1, rest - kSwitchesOfEvenSets};
}

}  // namespace orca::hw::xr4000
