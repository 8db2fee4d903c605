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

struct Xr4000Settings {
  std::uint32_t baud = 115200;  ///< Of the agent's serial line.
  Duration timeout{0};     ///< [s] Timer.Timeout after power-on; 0: the axes never go limp. Not documented.
  Duration power_up = 2s;  ///< [s] from power-on until the agent listens.
  std::uint8_t robot_type = 'x';  ///< As the library tells it.
  std::uint8_t version = 1;       ///< Of the agent's protocol.
  int bumper_count = 12;          ///< Bits of Body::bumpers(), evenly around the robot.
  std::array<std::uint16_t, 4> batteries{480, 480, 480, 480};  ///< Raw channels.
};

/// A Nomad XR4000 with its agent at the other end of the line. It answers each request once, changes the speeds of its axes no
/// faster than their accelerations, and lets the axes go limp when its motion timer has not been reset for the time-out.
///
/// Axes whose status is not ready refuse N_SetAxes. Limp axes hold a speed of 0 here, because a body does not roll out; the next
/// N_SetAxes ends that, but only resets feed the timer. Of the modes there are none, velocity and stop. Sensor i of set s is
/// Body::sonar(8 s + i), and infrared sensors see nothing. A switch that is touched is one of the lower set of its door. The
/// sonars are read from the body when they are asked for.
///
/// Thread contract: not synchronised.
/// @source  docs/hardware/xr4000.md; CARMEN, src/base/xr4000_base, for limits, frames and return codes.
class Xr4000Firmware final : public Firmware {
 public:
  /// @param body  outlives the object. It is switched on since long ago.
  explicit Xr4000Firmware(Body& body, const Xr4000Settings& settings = {});

  void take(std::span<const std::uint8_t> bytes, std::uint32_t baud, TimePoint now) override;
  std::vector<std::uint8_t> advance(TimePoint now) override;
  /// The axes are limp then; integrator and clock begin at 0.
  void reset(TimePoint now) override;

  /// Sets bits of the axes' status: 1 emergency stop, 2 joystick, 4 motion error. Axes that are not ready stop.
  void set_status(std::uint8_t bits);
  /// Lets every call of the library, but N_SetAxes, return that; 0: as ever.
  void fail_with(int returned) { failure_ = returned; }

  /// Returns whether the axes have power: not after power-on and when they have gone limp.
  [[nodiscard]] bool has_power() const { return power_; }
  /// Returns Timer.Timeout [s].
  [[nodiscard]] Duration timeout() const { return timeout_; }
  /// Returns how often the axes have gone limp.
  [[nodiscard]] int limp_stops() const { return limp_stops_; }
  /// Returns the types of all requests that came, in their order.
  [[nodiscard]] const std::vector<int>& requests() const { return requests_; }

 private:
  struct Axis {
    double speed = 0.0;         // [mm/s, mrad/s] now
    double wanted = 0.0;        // [mm/s, mrad/s]
    double acceleration = 0.0;  // [mm/s^2, mrad/s^2]
  };

  void obey(std::span<const std::uint8_t> frame, TimePoint now);
  int carry_out(int type, std::span<const std::uint8_t> payload, TimePoint now);
  int set_axes(std::span<const std::uint8_t> payload);
  void add_readings(int type, std::vector<std::uint8_t>& answer, TimePoint now) const;
  void add_state(std::vector<std::uint8_t>& answer, TimePoint now) const;
  void add_sonars(std::vector<std::uint8_t>& answer) const;
  void add_bumpers(std::vector<std::uint8_t>& answer) const;
  void switch_on(TimePoint now);
  void accelerate(TimePoint now);
  void watch(TimePoint now);
  void go_limp();
  void drive();
  void define(const Pose2& pose);
  [[nodiscard]] Pose2 pose() const;
  [[nodiscard]] std::uint32_t clock(TimePoint now) const;
  void send(int type, const std::vector<std::uint8_t>& payload, TimePoint now);

  Body& body_;
  const Xr4000Settings settings_;
  hw::framing::Scanner scanner_;
  std::uint32_t host_baud_ = 0;
  OutgoingLine line_;
  std::optional<TimePoint> on_since_;  // none: nothing has happened yet
  TimePoint last_byte_{};
  TimePoint moved_at_{};  // the speeds are those of then
  TimePoint fed_at_{};
  Duration timeout_{};
  std::array<Axis, 3> axes_{};  // x, y, rotation
  bool power_ = false;
  int limp_stops_ = 0;
  std::uint8_t status_ = 0;
  int failure_ = 0;
  Pose2 defined_{};     // what the pose is
  Pose2 defined_at_{};  // where the body's odometry says this
  std::vector<int> requests_;
};

}  // namespace orca::emulators
