// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/create2/command.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "orca/hw/create2/sensors.hpp"

namespace orca::hw::create2 {

namespace {

constexpr unsigned kDrive = 137;
constexpr unsigned kSensors = 142;
constexpr unsigned kDriveDirect = 145;
constexpr unsigned kDrivePwm = 146;
constexpr unsigned kStream = 148;
constexpr unsigned kQueryList = 149;
constexpr unsigned kToggleStream = 150;

constexpr int kStraight = -32768;  // radius
constexpr int kMaxRadius = 2000;   // [mm]
constexpr int kMinRadius = 2;      // [mm] 1 means to turn in place

// Rounded and limited; 0 for what is not a number.
int whole(double value, int most) {
  if (std::isnan(value)) return 0;
  return static_cast<int>(std::lround(std::clamp(value, -1.0 * most, 1.0 * most)));
}

int millimetres(double metres, int most) { return whole(1000.0 * metres, most); }
int speed_of_wheel(double speed) { return millimetres(speed, 500); }

void append_big_endian(Command& command, int value) {
  const auto bits = static_cast<unsigned>(value);
  command.u8(bits >> 8).u8(bits);
}

Command of_two_numbers(unsigned opcode, int first, int second) {
  Command command;
  command.u8(opcode);
  append_big_endian(command, first);
  append_big_endian(command, second);
  return command;
}

// Each packet comes after its number, and 3 bytes are around them.
Result<std::size_t> longest_answer(std::span<const std::uint8_t> packets) {
  std::size_t size = 3;
  for (const std::uint8_t packet : packets) {
    const auto data = data_size(packet);
    if (!data)
      return fail(Code::invalid_argument, "sensor packet " + std::to_string(packet) +
                                              " does not exist; packets are 0 to 58, 100, 101, 106 and 107");
    size += 1 + *data;
  }
  return size;
}

Result<Command> of_list(unsigned opcode, std::span<const std::uint8_t> packets) {
  if (packets.empty())
    return fail(Code::invalid_argument, "the list of sensor packets is empty; name at least one");
  const auto size = longest_answer(packets);
  if (!size) return size.error();
  if (*size > kLongestAnswer)
    return fail(Code::invalid_argument, "the sensor packets would make a frame of " + std::to_string(*size) +
                                            " bytes, but the line carries 172 every 15 ms; ask for fewer");
  Command command;
  command.u8(opcode).u8(static_cast<unsigned>(packets.size()));
  command.append(packets);
  return command;
}

Command toggle_stream(unsigned state) {
  Command command;
  command.u8(kToggleStream).u8(state);
  return command;
}

}  // namespace

Command encode(Order order) {
  Command command;
  command.u8(static_cast<unsigned>(order));
  return command;
}

Command drive(double speed, double radius) {
  if (std::isnan(radius)) return of_two_numbers(kDrive, 0, 0);
  int radius_mm = kStraight;
  if (!std::isinf(radius)) {
    const int size = std::max(std::abs(millimetres(radius, kMaxRadius)), kMinRadius);
    radius_mm = radius < 0.0 ? -size : size;
  }
  return of_two_numbers(kDrive, speed_of_wheel(speed), radius_mm);
}

Command turn_in_place(double wheel_speed) {
  const int speed = speed_of_wheel(wheel_speed);
  return of_two_numbers(kDrive, std::abs(speed), speed < 0 ? -1 : 1);
}

WheelSpeeds wheel_speeds(const Twist2& twist) {
  if (!is_finite(twist)) return {};
  const double difference = twist.turn_rate * kWheelBase / 2.0;
  const WheelSpeeds wished{twist.forward - difference, twist.forward + difference};
  const double fastest = std::max(std::abs(wished.left), std::abs(wished.right));
  if (!std::isfinite(fastest)) return {};
  if (fastest <= kMaxWheelSpeed) return wished;
  return {wished.left * (kMaxWheelSpeed / fastest), wished.right * (kMaxWheelSpeed / fastest)};
}

// The right wheel comes first.
Command drive_wheels(WheelSpeeds speeds) {
  return of_two_numbers(kDriveDirect, speed_of_wheel(speeds.right), speed_of_wheel(speeds.left));
}

Command drive_pwm(double left, double right) {
  return of_two_numbers(kDrivePwm, whole(255.0 * right, 255), whole(255.0 * left, 255));
}

Result<Command> ask_packet(std::uint8_t packet) {
  const auto size = longest_answer({&packet, 1});
  if (!size) return size.error();
  Command command;
  command.u8(kSensors).u8(packet);
  return command;
}

Result<Command> ask_list(std::span<const std::uint8_t> packets) { return of_list(kQueryList, packets); }

Result<Command> stream(std::span<const std::uint8_t> packets) { return of_list(kStream, packets); }

Command pause_stream() { return toggle_stream(0); }

Command resume_stream() { return toggle_stream(1); }

}  // namespace orca::hw::create2
