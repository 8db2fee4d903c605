// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/geometry/twist2.hpp"

namespace orca {

/// Plain shapes to draw, in the world frame [m] unless a member says otherwise: x to the right, y up. A
/// Drawable adds the world and the robots; the host adds what they reported.
///
/// A plain value.
struct Scene {
  struct Line {
    Vec2 a;
    Vec2 b;
  };
  /// One reading of a sonar.
  struct Cone {
    Pose2 X_RS;  ///< Of the sonar, in the robot's frame.
    double half_lobe_rad = 0.0;
    double range_m = 0.0;
    bool echo = false;  ///< False: nothing came back.
  };
  /// One scan of a laser, in the robot's frame.
  struct Scan {
    Vec2 at;
    std::vector<Vec2> ends;  ///< Of the beams, in their order.
  };
  /// The motion and the readings of a robot at one time.
  struct Moment {
    TimePoint time;  ///< Of the run's clock.
    Pose2 pose;
    double speed = 0.0;      ///< [m/s] Ahead.
    double turn_rate = 0.0;  ///< [rad/s] Counter-clockwise.
    std::vector<Cone> sonar;
    std::vector<Scan> lasers;
  };
  /// Where a robot really was, and how near to something that it could touch.
  struct Step {
    TimePoint time;  ///< Of the run's clock.
    Pose2 pose;
    Twist2 velocity;           ///< In the robot's frame.
    double clearance_m = 0.0;  ///< From its outline; at most kFar, 0 or less where it touches.
  };
  /// A robot came nearer than kNear to a person who walks about.
  struct Encounter {
    TimePoint begin;  ///< Of the run's clock.
    std::string person;
    double gap_m = 0.0;         ///< Least distance between the two; 0 if they touched.
    double robot_speed = 0.0;   ///< [m/s] When they were that near; just before they touched.
    double person_speed = 0.0;  ///< [m/s] The same of the person.
    bool touched = false;
  };
  static constexpr double kNear = 0.3;  ///< [m] Where an encounter begins; it ends 5 cm farther away.
  static constexpr double kFar = 2.0;   ///< [m] How far Step::clearance_m looks.
  struct Robot {
    std::string name;
    Pose2 pose;
    double radius_m = 0.0;
    std::vector<Line> outline;    ///< Of its plan, in its own frame; empty: a circle.
    std::vector<Vec2> track;      ///< Where it has been, oldest first.
    std::vector<Moment> moments;  ///< Oldest first.
    std::vector<Step> motion;     ///< Evenly spaced, oldest first; only after Drawable::keep_motion().
    std::vector<Encounter> encounters{};  ///< Oldest first; only after Drawable::keep_motion().
  };
  struct Mark {
    std::string label;
    Vec2 position;
    TimePoint time;       ///< Of the run's clock.
    std::string robot{};  ///< Name of the robot that it is about; empty: not known.
  };
  /// A place of the world that has a name.
  struct Place {
    std::string name;
    Vec2 position;
  };

  TimePoint start;  ///< Of the run: times are shown from here.
  std::vector<Line> walls;
  std::vector<Place> places;
  std::vector<Robot> robots;
  std::size_t people = 0;      ///< Who walk about in the world.
  std::vector<Mark> arrivals;  ///< Where a robot said it had arrived.
  std::vector<Mark> contacts;  ///< Where a robot touched something.
};

}  // namespace orca
