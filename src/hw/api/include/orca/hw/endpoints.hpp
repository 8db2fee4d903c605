// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/geometry/usual_figures.hpp"
#include "orca/hw/obstruction.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/object.hpp"

namespace orca::hw {

/// The origin of a sensor endpoint's readings: the robot's own senses, or the simulator's knowledge of the
/// truth.
enum class Source { sensor, truth };

/// One kind of reading that a hardware container delivers, whatever its type (thesis 10.2, Fig. 10.5). The
/// server that wraps the container turns it into a Push and a Query port named after the object type and, where several
/// devices deliver that type, the device.
///
/// Thread contract: publish() from the container's strand; the rest from any strand.
class SensorEndpoint {
 public:
  /// A function that pushes the reading on and returns the object that it sealed.
  using Sink = std::function<ObjectRef(ObjectLoan)>;

  /// @param device  its name, where the container has several sensors of this type and source; empty: it has only this one.
  ///                Letters, digits and _, since names of ports begin with it.
  SensorEndpoint(const ObjectType& type, Duration period, Source source, std::string device)
      : type_(type), period_(period), source_(source), device_(std::move(device)) {}
  SensorEndpoint(const SensorEndpoint&) = delete;
  SensorEndpoint& operator=(const SensorEndpoint&) = delete;

  [[nodiscard]] const ObjectType& type() const { return type_; }
  /// Returns the time between two readings [s]; subscribers may ask for multiples of it.
  [[nodiscard]] Duration period() const { return period_; }
  [[nodiscard]] Source source() const { return source_; }
  /// Returns the name of its device among several that deliver this type; empty: it is the only one.
  [[nodiscard]] const std::string& device() const { return device_; }
  /// Returns what the names of its ports begin with: LaserRangeReadings; of several: rear_LaserRangeReadings.
  [[nodiscard]] std::string port_stem() const;

  /// Sets where readings go for `owner`, which has at most one sink; null removes it. Several servers may
  /// wrap one sensor: each gets its own object.
  void set_sink(const void* owner, Sink sink);

  /// Returns the last reading since the hardware was started, or null.
  [[nodiscard]] ObjectRef latest() const;
  /// Forgets the last reading. Called when the hardware stops, so that nobody takes an old reading for a new
  /// one.
  void forget();

 protected:
  void publish_loan(ObjectLoan reading);

 private:
  const ObjectType& type_;
  const Duration period_;
  const Source source_;
  const std::string device_;
  mutable std::mutex mutex_;
  std::vector<std::pair<const void*, Sink>> sinks_;  // in the order in which they came
  ObjectRef latest_;
};

/// A sensor endpoint that delivers objects of type T.
template <class T>
class SensorHW final : public SensorEndpoint {
 public:
  explicit SensorHW(Duration period, Source source = Source::sensor, std::string device = "")
      : SensorEndpoint(object_type<T>(), period, source, std::move(device)) {}

  [[nodiscard]] Loan<T> loan() const { return make_object<T>(); }
  void publish(Loan<T> reading) { publish_loan(std::move(reading)); }
};

/// The limits of a base (thesis appendix A, `<drive>`).
struct DriveLimits {
  double max_speed = 0.0;               ///< [m/s]
  double max_turn_rate = 0.0;           ///< [rad/s]
  double steer_gain = kUsualSteerGain;  ///< [1/s] turn rate per radian of direction asked for.
  double big_turn_angle =
      0.0;  ///< [rad] at larger directions the base drives at most `big_turn_speed`; 0: no such limit.
  double big_turn_speed = 0.0;              ///< [m/s]
  idl::DriveType type = idl::DIFFERENTIAL;  ///< Only a holonomic base takes velocities with a sideways part.
};

/// Returns the velocity that a base with these limits makes of a crisp command: 0 for a FULLSTOP.
/// @thread  pure function; any thread.
[[nodiscard]] Twist2 twist_of(const idl::MotionCommand& command, const DriveLimits& limits);
/// Returns the same of a command for a base that can move sideways. A velocity beyond the limits keeps its direction.
[[nodiscard]] Twist2 twist_of(const idl::HolonomicVelocity& velocity, const DriveLimits& limits);

/// A crisp set-point for the motors of a base of any kind.
struct DriveSetpoint {
  Twist2 velocity{};  ///< Of the robot frame; to the left only if the base is holonomic.
  /// Whether the base is to stop as hard as it can, with its emergency stop if it has one. Only with a velocity of 0.
  bool at_once = false;
  /// Returns whether the base is to stand.
  [[nodiscard]] bool stands() const { return velocity == Twist2{}; }
  /// Returns what stops the base at once. A base that stands is told nothing new.
  [[nodiscard]] DriveSetpoint stopped() const { return {.at_once = at_once || !stands()}; }
  friend bool operator==(const DriveSetpoint&, const DriveSetpoint&) = default;
};

/// The motion endpoint of a container (thesis 10.2, Fig. 10.6). It takes crisp commands, keeps them within
/// the limits, and lets no command live longer than `max_command_age`. When the driver reports that the base has met
/// something, the base stands until a command asks for another direction. While it is held, it refuses every command to move. A FULLSTOP, a command that has become too old,
/// halt() and an obstruction stop the base as hard as it can; a speed of 0 is a command like others.
///
/// Thread contract: command() from any strand; the rest from the container's, if nothing else is said.
class MotionHW {
 public:
  /// The refusal of a HolonomicVelocity by a base of another kind.
  static constexpr const char* kNotSideways =
      "this base cannot move sideways; send it a MotionCommand, not a HolonomicVelocity";

  MotionHW(const DriveLimits& limits, Duration max_command_age);

  /// Checks whether any base can carry out the command.
  /// @errors  invalid_argument for DONTCARE (fuse first), and those of check_command().
  [[nodiscard]] static Status check(const idl::MotionCommand& command);

  /// Takes a command, to be carried out at the container's next turn.
  /// @errors  those of check(); unavailable, with the reason, if the base must not move so now: it then stands.
  Status command(const idl::MotionCommand& command, TimePoint now);

  /// Takes a velocity, to be carried out at the container's next turn. A velocity beyond the limits keeps its
  /// direction.
  /// @errors  failed_precondition unless the base is holonomic, and as above.
  Status command(const idl::HolonomicVelocity& velocity, TimePoint now);

  /// Returns the set-point that holds now. The base stands when the last command is older than
  /// max_command_age.
  [[nodiscard]] DriveSetpoint due(TimePoint now);

  /// Makes the base stand from now on until the next command.
  void halt();

  /// Stops the base at once. Until let_go() it refuses all commands to move; an emergency stop. The base
  /// still stands after let_go(), until the next command.
  /// @param reason  for people, as the error of a refused command gives it: "emergency stop".
  /// @thread  any, as let_go().
  void hold(const std::string& reason);
  /// Does the same by order of the process, which tells people of it itself.
  void hold_by_order(const std::string& reason);
  /// Returns whether it was held.
  bool let_go();
  /// Returns why the base is held without an order; nothing if it is not: a person is to be told.
  /// @thread  any.
  [[nodiscard]] std::optional<std::string> own_hold() const;

  /// Reports that the base has met something, or by `stall` that its motors are stalled. If it is moving it stands until a command
  /// asks for another direction.
  /// @param reason  for people, e.g. "it touched a wall".
  void obstruct(const std::string& reason, Hindrance by = Hindrance::touch);
  /// Reports which bumpers are pressed now. A base that moves towards one is obstructed, and no command moves it there.
  void press(const std::vector<Obstruction::Pressed>& bumpers);
  /// Returns why the base is hindered, as Obstruction::take_hindrance().
  /// @thread  any.
  [[nodiscard]] std::optional<std::string> take_hindrance(Hindrance by);

  /// Returns the mission of the command that came last, even if the base stands since; 0: none. What happens to
  /// the base meanwhile happens in that mission.
  /// @thread  any.
  [[nodiscard]] std::uint64_t mission() const;
  /// Forgets the mission: the use of the base has ended.
  void end_mission();

  /// Returns when the present command becomes too old; kForever when the base stands.
  [[nodiscard]] TimePoint expiry() const;
  /// Returns when the last command was taken, also one to stand.
  [[nodiscard]] TimePoint last_command() const;

  [[nodiscard]] const DriveLimits& limits() const { return limits_; }
  [[nodiscard]] Duration max_command_age() const { return max_command_age_; }
  /// Returns how often a command became too old while the base was moving.
  [[nodiscard]] std::uint64_t expired_count() const;

 private:
  Status move(const DriveSetpoint& wanted, std::uint64_t mission, TimePoint now);
  void stand();
  [[nodiscard]] Status check_held() const;

  const DriveLimits limits_;
  const Duration max_command_age_;
  mutable std::mutex mutex_;
  DriveSetpoint setpoint_;
  Obstruction obstruction_;
  TimePoint received_{};
  std::uint64_t mission_ = 0;
  std::uint64_t expired_ = 0;
  std::optional<std::string> held_;      // why, while it is held
  std::optional<std::string> own_hold_;  // the same, but for orders
};

}  // namespace orca::hw
