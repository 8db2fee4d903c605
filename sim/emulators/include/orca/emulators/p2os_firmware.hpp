// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/hw/framing/scanner.hpp"

namespace orca::emulators {

/// The body of a robot, as its controller drives and senses it. The simulator is one; a test may have a simpler one.
///
/// Thread contract: the firmware's.
class Body {
 public:
  virtual ~Body() = default;
  /// Gives the wheels a velocity, from now on. @param velocity  `left` is 0.
  virtual void drive(const Twist2& velocity) = 0;
  /// Returns where the wheels say that the robot is, from where it was at the start.
  [[nodiscard]] virtual Pose2 odometry() const = 0;
  /// Returns the velocity of the wheels.
  [[nodiscard]] virtual Twist2 velocity() const = 0;
  /// Returns the distance that a sonar hears [m]; nothing if it hears no echo.
  [[nodiscard]] virtual std::optional<double> sonar(int number) const = 0;
  /// Returns the pressed bumpers, a bit each: front in the low byte, rear in the high byte.
  [[nodiscard]] virtual std::uint16_t bumpers() const { return 0; }
  [[nodiscard]] virtual bool is_stalled() const { return false; }
};

struct P2osSettings {
  std::string name = "Orca_Emu";
  std::string robot_class = "Pioneer";
  std::string subclass = "p2dx";
  double distance_unit = 0.00084;  ///< [m] a count of the odometry.
  double range_unit = 0.000268;    ///< [m] a count of a sonar range.
  double half_track = 1.0 / 5.6;   ///< [m] half the distance of the wheels.
  int sonars = 16;
  Duration cycle = 100ms;     ///< [s] between two information packets.
  Duration watchdog = 2s;     ///< [s] without a command until the robot stops.
  std::uint32_t baud = 9600;  ///< After power-on.
};

/// The controller of a Pioneer at the other end of the line: it answers the handshake, sends information packets, drives the body
/// as it is commanded, and stops it when no command has come for the time of its watchdog. It is written from the protocol's
/// description, not from Orca's driver, and shares only the search for frames and the checksum with that.
///
/// A line that the host has set to another rate carries no command either way. What is sent takes its time at the rate.
///
/// Thread contract: not synchronised.
/// @source  Pioneer 2 operations manual, "Client commands" and "Server information packet".
class P2osFirmware {
 public:
  /// @param body  outlives the object.
  explicit P2osFirmware(Body& body, P2osSettings settings = {});

  /// Takes what the host has sent.
  /// @param baud  rate that the host has set; 0: it has none, as with TCP.
  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now);
  /// Goes on until now.
  /// @return the bytes that have left the line by now.
  std::vector<std::uint8_t> advance(TimePoint now);

  /// Switches the controller off and on: motors without power, connection closed, rate as at first.
  void reset();
  /// Presses or releases the emergency button. The motors lose their power and do not get it back by themselves.
  void press_button(bool pressed);

  [[nodiscard]] bool has_power() const { return power_; }
  [[nodiscard]] bool is_open() const { return open_; }
  /// Returns how often the watchdog has stopped the robot.
  [[nodiscard]] int watchdog_stops() const { return watchdog_stops_; }
  /// Returns the numbers of all commands that came while the connection was open.
  [[nodiscard]] const std::vector<int>& commands() const { return commands_; }

 private:
  struct Waiting {
    std::uint8_t byte;
    TimePoint leaves;
  };

  void obey(std::span<const std::uint8_t> body, TimePoint now);
  void shake_hands(int number, TimePoint now);
  void carry_out(int number, int value);
  void stop();
  void drive();
  void send(std::vector<std::uint8_t> body, TimePoint now);
  void send_information(TimePoint now);
  [[nodiscard]] std::vector<std::uint8_t> echoes();
  [[nodiscard]] double byte_time() const { return 10.0 / baud_; }

  Body& body_;
  const P2osSettings settings_;
  hw::framing::Scanner scanner_;
  std::uint32_t baud_;
  std::uint32_t host_baud_ = 0;
  std::deque<Waiting> line_;
  int syncs_ = 0;  // steps of the handshake that were taken
  bool open_ = false;
  bool power_ = false;
  bool button_ = false;
  bool sonar_ = false;
  bool fed_ = false;  // the watchdog, since it bit
  int next_sonar_ = 0;
  Twist2 wanted_{};
  TimePoint last_command_{};
  TimePoint next_information_{};
  int watchdog_stops_ = 0;
  std::vector<int> commands_;
};

}  // namespace orca::emulators
