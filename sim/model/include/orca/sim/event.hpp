// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/shape.hpp"

namespace orca::sim {

/// A kind of sensors of a robot.
enum class SensorKind { sonar, laser, infrared, bumper, odometry, camera };
/// Their names, in the same order.
inline constexpr std::array<std::string_view, 6> kSensorKinds{"sonar",  "laser",    "infrared",
                                                              "bumper", "odometry", "camera"};

/// An obstacle that stands in the world for a part of the time.
struct Visitor {
  std::string name;     ///< Name that contacts report; no other visitor and no walker has it.
  Shape shape;          ///< Its plan, in its own frame.
  double height = 0.0;  ///< [m] Its top above the floor.
  Pose2 X_WO;           ///< Where it comes to.
  Duration comes{0};
  std::optional<Duration> goes{};
};

/// A visitor is moved, at once.
struct Move {
  std::string visitor;
  Duration at{0};
  Pose2 X_WO;
};

/// A robot is carried off and put down elsewhere, at rest. Its odometry notices nothing.
struct Kidnap {
  std::string robot;
  Duration at{0};
  Pose2 X_WB{};
  std::optional<Duration> latest{};  ///< The time is drawn between `at` and this.
  /// [m] The place and the direction are drawn: any free place at least so far away to which there is a way, and where
  /// the robot can turn round. X_WB is not read.
  std::optional<double> away{};
};

/// All sensors of a kind of a robot are silent, or one of them.
struct Outage {
  std::string robot;
  SensorKind sensor = SensorKind::laser;
  Duration from{0};
  std::optional<Duration> until{};
  std::string device{};  ///< Name of the one; empty: all.
};

/// The battery of a robot has another charge, at once.
struct Drain {
  std::string robot;
  Duration at{0};
  double to = 0.0;  ///< Share of a full charge, 0 to 1.
};

/// A door is opened or shut.
struct DoorTurn {
  std::string door;
  bool opens = true;
  Duration at{0};
  std::optional<Duration> latest{};  ///< The time is drawn between `at` and this.
};

/// What happens in a world while it runs, besides people who walk about; times count from its start. What a robot is in the way of
/// happens as soon as it is gone. Plain values.
struct Events {
  std::vector<Visitor> visitors{};
  std::vector<Move> moves{};
  std::vector<Kidnap> kidnaps{};
  std::vector<Outage> outages{};
  std::vector<Drain> drains{};
  std::vector<DoorTurn> turns{};
};

}  // namespace orca::sim
