// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/hw/framing/scanner.hpp"

namespace orca::emulators {

class P2osGripper;
class P2osServo;

struct P2osSettings {
  std::string name = "Orca_Emu";
  std::string robot_class = "Pioneer";
  std::string subclass = "p2dx";
  double distance_unit = 0.00084;  ///< [m] a count of the odometry.
  double range_unit = 0.000268;    ///< [m] a count of a sonar range.
  double half_track = 1.0 / 5.6;   ///< [m] half the distance of the wheels.
  int sonars = 16;
  unsigned front_bumpers = 5;
  unsigned rear_bumpers = 5;
  Duration cycle = 100ms;          ///< [s] between two information packets.
  Duration watchdog = 2s;          ///< [s] without a command until the robot stops.
  std::uint32_t baud = 9600;       ///< After power-on.
  bool resets_baud = true;         ///< It has this rate again after CLOSE, and says so.
  std::uint32_t fastest = 115200;  ///< [baud] A faster rate that it is told to take it does not take.
  bool tells_settings = true;      ///< It answers CONFIG; old firmware does not.
  double voltage = 12.7;           ///< [V] of the battery.
  bool has_sonar_power = true;     ///< Its sonars can be switched on.
};

/// Returns the settings of a robot's controller by its subclass; nothing if that is not known here.
/// @source  parameter files of the vendor, as public drivers quote them.
[[nodiscard]] std::optional<P2osSettings> p2os_settings(std::string_view subclass);
/// Returns the subclasses that p2os_settings() knows.
[[nodiscard]] std::vector<std::string> p2os_subclasses();

/// The controller of a Pioneer at the other end of the line: it answers the handshake, sends information packets, drives the body
/// as it is commanded, and stops it when no command has come for the time of its watchdog.
///
/// A line that the host has set to another rate carries no command either way. What is sent takes its time at the rate, which is
/// the configured one again after CLOSE if the settings say so.
///
/// Translation (VEL, MOVE) and rotation (RVEL, ROTATE, HEAD, DHEAD) are independent of each other; VEL2 and STOP are for both. It
/// sets its odometry to 0, tells its configuration, and lets bumpers raise a stall. What has no use for a body without gyros and serial ports of its own is
/// passed over, as are gains and accelerations, which the body has.
///
/// It moves the gripper of a body that has one, tells its state in information packets, and kind 1, which is at the user ports, in
/// its configuration. Paddles and lift are stopped at CLOSE and at a reset, by the watchdog, and by the emergency button, which also
/// lets no command move them while it is pressed: no source says what a controller does then; this is the safe side. Nor is it
/// known whether the motors' power matters to a gripper: here it does not. Passed over are the pressure of the paddles, which
/// the body has, and the packets that tell of a gripper alone. The two bits that tell of its faults are never set.
///
/// Thread contract: not synchronised.
/// @source  Pioneer 2 operations manual, "Client commands" and "Server information packet"; Pioneer Gripper manual.
class P2osFirmware final : public Firmware {
 public:
  /// @param body  outlives the object.
  explicit P2osFirmware(Body& body, P2osSettings settings = {});
  ~P2osFirmware() override;

  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) override;
  std::vector<std::uint8_t> advance(TimePoint now) override;
  /// Motors are without power then, the connection is closed, and the rate is as at first.
  void reset(TimePoint now) override;

  /// Presses or releases the emergency button. The motors lose their power and do not get it back by themselves.
  void press_button(bool pressed);
  /// Takes the motors' power, as the button for the motors on the robot does. A command gives it back.
  void cut_power();

  [[nodiscard]] bool has_power() const { return power_; }
  [[nodiscard]] bool is_open() const { return open_; }
  /// Returns how often the watchdog has stopped the robot.
  [[nodiscard]] int watchdog_stops() const { return watchdog_stops_; }
  /// Returns the numbers of all commands that came while the connection was open.
  [[nodiscard]] const std::vector<int>& commands() const { return commands_; }

 private:
  void obey(std::span<const std::uint8_t> body, TimePoint now);
  void shake_hands(int number, TimePoint now);
  void carry_out(int number, int value, TimePoint now);
  bool set_motion(int number, int value);
  void set_wheels(int value);
  void switch_sonar(int value);
  void set_baud(int code);
  void tell_settings(TimePoint now);
  void stop();
  void close();
  void restart();
  void drive();
  [[nodiscard]] Twist2 wanted();
  void send(std::vector<std::uint8_t> body, TimePoint now);
  void send_information(TimePoint now);
  [[nodiscard]] std::vector<std::uint8_t> echoes();
  [[nodiscard]] Pose2 pose() const;
  [[nodiscard]] bool is_stalled() const;
  [[nodiscard]] double byte_time() const { return 10.0 / baud_; }

  Body& body_;
  const P2osSettings settings_;
  hw::framing::Scanner scanner_;
  std::uint32_t baud_;
  std::uint32_t host_baud_ = 0;
  OutgoingLine line_;
  int syncs_ = 0;  // steps of the handshake that were taken
  bool open_ = false;
  bool power_ = false;
  bool button_ = false;
  bool sonar_ = false;
  bool fed_ = false;  // the watchdog, since it bit
  int next_sonar_ = 0;
  const std::unique_ptr<P2osServo> servo_;
  const std::unique_ptr<P2osGripper> gripper_;
  Pose2 origin_{};         // of its odometry, as the body counts
  int bumpers_stall_ = 0;  // bit 0: those in front, bit 1: those behind
  TimePoint last_command_{};
  TimePoint next_information_{};
  int watchdog_stops_ = 0;
  std::vector<int> commands_;
};

}  // namespace orca::emulators
