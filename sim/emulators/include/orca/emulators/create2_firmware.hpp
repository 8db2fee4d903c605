// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/geometry/pose2.hpp"

namespace orca::emulators {

struct Create2Settings {
  double wheel_base = 0.235;       ///< [m] between the wheels.
  double wheel_diameter = 0.072;   ///< [m]
  double counts_per_turn = 508.8;  ///< Of the encoders.
  std::uint32_t baud = 115200;     ///< After power-on; 19200 if a button was held meanwhile.
  Duration power_up = 2s;          ///< [s] from power-on until it listens.
  int mode_offset = 0;             ///< Firmware of some Roombas 600 reports its mode plus 1.
  std::uint16_t voltage = 14800;   ///< [mV] of the battery.
  std::uint16_t charge = 2000;     ///< [mAh] in the battery.
  std::uint16_t capacity = 2500;   ///< [mAh] of the full battery.
  bool heeds_charger =
      true;  ///< A charger ends safe mode, as its manual says. With some firmware it does not.
};

/// The modes of the interface, with their numbers.
enum class Create2Mode : std::uint8_t { off = 0, passive = 1, safe = 2, full = 3 };

/// The controller of an iRobot Create 2 at the other end of the line: it takes commands of one byte and their data, sends streams
/// of sensor packets, answers questions for some, and drives the body in safe and full mode. Safe mode ends, and the wheels
/// stop, when a wheel drops, when there is no floor where it drives to, and at a charger.
///
/// It has no watchdog: without another command the wheels do for ever what they were told. A line that the host has set to
/// another rate carries no command either way. Bits 0 and 1 of Body::bumpers() are the right and the left bumper. Lights,
/// songs, brushes and schedules are taken and change nothing. Cleaning and docking only lead to passive mode.
///
/// Thread contract: not synchronised.
/// @source  "iRobot Create 2 Open Interface (OI) Specification based on the iRobot Roomba 600", 2016.
class Create2Firmware final : public Firmware {
 public:
  /// @param body  outlives the object. It is switched on since long ago, and its interface is off.
  explicit Create2Firmware(Body& body, Create2Settings settings = {});

  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) override;
  std::vector<std::uint8_t> advance(TimePoint now) override;
  /// Its interface is off then, its rate as at first, and its counters begin at 0. It prints a text when it listens.
  void reset(TimePoint now) override;

  /// Connects a charger that has power, or takes it away.
  void connect_charger(bool connected) { charger_ = connected; }

  [[nodiscard]] Create2Mode mode() const { return mode_; }
  /// Returns how often it has left safe mode by itself.
  [[nodiscard]] int safety_stops() const { return safety_stops_; }
  /// Returns the opcodes of all commands that were heard, in their order.
  [[nodiscard]] const std::vector<int>& commands() const { return commands_; }

 private:
  void obey(TimePoint now);
  void carry_out(int opcode, std::span<const std::uint8_t> data, TimePoint now);
  void change_mode(int opcode, TimePoint now);
  void set_wheels(int opcode, std::span<const std::uint8_t> data);
  void drive_arc(int speed, int radius);
  void set_baud(int code);
  void stop();
  void drive();
  void listen(TimePoint now);
  void count();
  void stay_safe();
  [[nodiscard]] bool is_at_cliff() const;
  void send_stream(TimePoint now);
  void answer(std::span<const std::uint8_t> packets, TimePoint now);
  void add_packet(std::vector<std::uint8_t>& bytes, int packet);
  [[nodiscard]] int value_of(int packet);
  [[nodiscard]] int contact_value(int packet) const;
  [[nodiscard]] int battery_value(int packet) const;
  [[nodiscard]] int motor_value(int packet) const;
  void send(std::span<const std::uint8_t> bytes, TimePoint now);

  Body& body_;
  const Create2Settings settings_;
  std::uint32_t baud_;
  std::uint32_t host_baud_ = 0;
  OutgoingLine line_;
  Create2Mode mode_ = Create2Mode::off;
  std::optional<TimePoint> starts_until_;  // after power-on
  std::vector<std::uint8_t> command_;      // whose data may still come
  std::array<int, 2> wheels_{};            // [mm/s] right, left
  std::array<int, 2> arc_{};               // [mm/s], [mm] that DRIVE has asked for
  std::optional<Pose2> last_pose_;         // of the body's odometry
  std::array<double, 2> ways_{};           // [m] right, left, since power-on
  double distance_ = 0.0;                  // [m] since it was asked for
  double angle_ = 0.0;                     // [rad] since it was asked for
  std::vector<std::uint8_t> stream_;       // packets in it
  bool streams_ = false;
  TimePoint next_frame_{};
  bool charger_ = false;
  int safety_stops_ = 0;
  std::vector<int> commands_;
};

}  // namespace orca::emulators
