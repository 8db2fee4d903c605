// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/emulators/body.hpp"
#include "orca/emulators/firmware.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/hw/framing/scanner.hpp"

namespace orca::emulators {

struct NomadScoutSettings {
  double track = 0.3452;         ///< [m] between the wheels.
  std::uint32_t baud = 38400;    ///< 4800, 9600, 19200 or 38400.
  Duration watchdog{0};          ///< [s] of the motion watchdog after power-on; 0: off. Not documented.
  Duration power_up = 2s;        ///< [s] from power-on until it listens. Not documented.
  Duration zeroing = 1s;         ///< [s] until ZR is answered; the protocol allows 120 s.
  std::uint8_t processor = 200;  ///< Raw voltage: 10.45 V.
  std::uint8_t motors = 210;     ///< Raw voltage: 11.49 V.
};

/// The controller of a Nomad Scout at the other end of the line. It only answers: most commands with its state. It drives the
/// body as it is commanded, fires the sonars one after the other, and stops the wheels when it has heard no command for the
/// time of its watchdog.
///
/// A line that the host has set to another rate carries no command either way. What is sent takes its time at the rate, over
/// TCP none. Accelerations are kept and change nothing: a body has its own. The serial ports that CONF_SER sets are others than
/// the host's. Bit i of the bumpers is bit i of Body::bumpers(). What is not understood is answered by NAK, and half a packet
/// is forgotten after half a second; both are not documented.
///
/// Thread contract: not synchronised.
/// @source  Nomadic Technologies, Nomad host protocol, as the robot's direct client speaks it.
class NomadScoutFirmware final : public Firmware {
 public:
  /// @param body  outlives the object. It is switched on since long ago.
  explicit NomadScoutFirmware(Body& body, NomadScoutSettings settings = {});

  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) override;
  std::vector<std::uint8_t> advance(TimePoint now) override;
  /// Motors are limp then, sonars and watchdog as after power-on, and its position and clock begin at 0.
  void reset(TimePoint now) override;

  /// Returns whether the motors have power: not after power-on and LP, and again with the next command to move or to stop.
  [[nodiscard]] bool has_power() const { return power_; }
  [[nodiscard]] bool fires_sonars() const { return sonar_interval_ > Duration{0} && !sonar_order_.empty(); }
  /// Returns the time of the motion watchdog [s]; 0: off.
  [[nodiscard]] Duration watchdog() const { return watchdog_; }
  /// Returns how often the watchdog has stopped the robot.
  [[nodiscard]] int watchdog_stops() const { return watchdog_stops_; }
  /// Returns the types of all packets that came, in their order.
  [[nodiscard]] const std::vector<int>& commands() const { return commands_; }

 private:
  struct Wheel {
    double speed = 0.0;       // [m/s] that it is told
    TimePoint until{};        // when it has come as far as it is told
    double move_speed = 0.1;  // [m/s] of SP
    double acceleration = 0.0;
  };
  // An answer that is given later.
  struct Promise {
    int type = 0;
    TimePoint until{};
    std::array<bool, 2> stopped{};  // whether it is given when these wheels stand
  };

  void obey(std::span<const std::uint8_t> packet, TimePoint now);
  bool carry_out(int type, std::span<const std::uint8_t> payload, TimePoint now);
  bool set(int type, std::span<const std::uint8_t> payload, TimePoint now);
  bool give_group(int type, TimePoint now);
  void set_axis(std::size_t axis, int mode, int value, TimePoint now);
  void move_by(Wheel& wheel, double distance, TimePoint now);
  void set_sonars(std::span<const std::uint8_t> payload, TimePoint now);
  void stop();
  void drive();
  void switch_on(TimePoint now);
  void restart();
  void end_moves(TimePoint now);
  void watch(TimePoint now);
  void fire(TimePoint now);
  void keep_promises(TimePoint now);
  void define(const Pose2& pose);
  [[nodiscard]] Pose2 pose() const;
  [[nodiscard]] std::vector<std::uint8_t> state(TimePoint now) const;
  [[nodiscard]] std::uint32_t clock(TimePoint now) const;
  void send(int type, const std::vector<std::uint8_t>& payload, TimePoint now);

  Body& body_;
  const NomadScoutSettings settings_;
  hw::framing::Scanner scanner_;
  std::uint32_t host_baud_ = 0;
  OutgoingLine line_;
  std::optional<TimePoint> on_since_;  // none: nothing has happened yet
  TimePoint last_byte_{};
  TimePoint last_command_{};
  Duration watchdog_{};
  bool fed_ = false;  // the watchdog, since it bit
  int watchdog_stops_ = 0;
  bool power_ = false;
  std::array<Wheel, 2> wheels_{};  // right, left
  Pose2 defined_{};                // what the pose is
  Pose2 defined_at_{};             // where the body's odometry says this
  Duration sonar_interval_{};
  std::vector<std::uint8_t> sonar_order_;
  std::size_t next_sonar_ = 0;  // in the order
  TimePoint next_firing_{};
  std::array<std::uint8_t, 16> sonars_{};  // [inches]
  std::vector<Promise> promises_;
  std::vector<int> commands_;
};

}  // namespace orca::emulators
