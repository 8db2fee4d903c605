// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/base/time.hpp"
#include "orca/geometry/error_guess.hpp"
#include "orca/geometry/objects/odometry.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"
#include "orca/hw/endpoints.hpp"
#include "orca/idl/sensing.hpp"

namespace orca::hw {

/// What a base does for what its controller counts: figures that somebody has measured (orcactl calibrate). These: it is as the controller says. A plain value.
struct Calibration {
  double distance = 1.0;        ///< Way driven over way counted.
  double turn = 1.0;            ///< Angle turned over angle counted.
  double turn_per_metre = 0.0;  ///< [rad/m] Angle turned besides, over the way counted: of unlike wheels.

  /// Returns what the controller is to be told for a velocity of the base.
  [[nodiscard]] Twist2 to_controller(const Twist2& real) const {
    const double forward = real.forward / distance;
    return {forward, real.left / distance, (real.turn_rate - turn_per_metre * forward) / turn};
  }
  /// Returns the velocity of the base for what the controller tells.
  [[nodiscard]] Twist2 to_base(const Twist2& counted) const {
    return {distance * counted.forward, distance * counted.left,
            turn * counted.turn_rate + turn_per_metre * counted.forward};
  }
  friend bool operator==(const Calibration&, const Calibration&) = default;
};

/// What is known of a base's own senses beside what its controller says. A plain value.
struct SenseTraits {
  Calibration calibration{};
  std::optional<OdometryUncertainty> odometry{};  ///< Nothing: how wrong it is is not known.
  RangeErrorGuess sonars{};
};

/// The pose of a base whose controller counts its coordinates and says its heading. It begins at 0. Counts wrap, and both begin anew
/// when the controller does, so only their differences count.
///
/// Thread contract: not synchronised.
class CountedPose {
 public:
  /// @param turn  counts after which a coordinate begins anew, a power of 2. A step of half of it or more is one back.
  explicit CountedPose(int turn) : turn_(turn) {}

  /// Takes a reading. The first one, and the first after forget(), moves nothing.
  /// @param x, y     counts, in the controller's frame. @param unit [m]  of a count.
  /// @param heading  [rad] in the controller's frame.
  void take(int x, int y, double unit, double heading);
  /// Makes the next reading a new reference: after the connection was opened again. The pose goes on from where it was.
  void forget() { last_.reset(); }
  /// Returns the pose in the frame of the odometry.
  [[nodiscard]] const Pose2& pose() const { return pose_; }

 private:
  struct Counts {
    int x = 0;
    int y = 0;
  };
  [[nodiscard]] int step(int from, int to) const;

  const int turn_;
  std::optional<Counts> last_;
  double offset_ = 0.0;  // [rad] from the controller's heading to that of the pose
  Pose2 pose_;
};

/// The odometry of a base, as its clients get it from what its controller counts.
///
/// Thread contract: not synchronised; the container's strand.
class BaseOdometry {
 public:
  /// @param period  from reading to reading [s].
  explicit BaseOdometry(Duration period, const SenseTraits& traits = {})
      : endpoint_(period), calibration_(traits.calibration), uncertainty_(traits.odometry) {}

  [[nodiscard]] SensorEndpoint& endpoint() { return endpoint_; }

  /// Passes a reading on.
  /// @param pose      as the controller counts it, without jumps, from 0 at first. Without calibration it is passed on as it is. What was
  ///                  driven since the last reading is taken for a small piece of an arc.
  /// @param velocity  as the controller tells it.
  void publish(const Pose2& pose, const Twist2& velocity, TimePoint stamp);

 private:
  [[nodiscard]] Pose2 calibrated(const Pose2& counted);

  SensorHW<idl::Odometry> endpoint_;
  const Calibration calibration_;
  std::optional<OdometryUncertainty> uncertainty_;
  Pose2 counted_;  // the last one
  Pose2 pose_;     // calibrated
};

}  // namespace orca::hw
