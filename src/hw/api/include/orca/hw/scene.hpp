// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/time.hpp"

namespace orca {

/// What there is to draw: plain shapes in the world frame [m], x to the right, y up, unless it says
/// otherwise.
///
/// A plain value.
struct Scene {
  struct Point {
    double x = 0.0;  ///< [m]
    double y = 0.0;  ///< [m]
  };
  struct Line {
    Point a;
    Point b;
  };
  /// One reading of a sonar, in the robot's frame (x ahead, y to the left).
  struct Cone {
    Point at;
    double direction_rad = 0.0;
    double half_lobe_rad = 0.0;
    double range_m = 0.0;
    bool echo = false;  ///< False: nothing came back.
  };
  /// One scan of a laser, in the robot's frame.
  struct Scan {
    Point at;
    std::vector<Point> ends;  ///< Of the beams, in their order.
  };
  /// What a robot did and sensed last at one time.
  struct Moment {
    TimePoint time;  ///< Of the run's clock.
    Point position;
    double heading_rad = 0.0;
    double speed = 0.0;      ///< [m/s] Ahead.
    double turn_rate = 0.0;  ///< [rad/s] Counter-clockwise.
    std::vector<Cone> sonar;
    std::vector<Scan> lasers;
  };
  struct Robot {
    std::string name;
    Point position;
    double heading_rad = 0.0;
    double radius_m = 0.0;
    std::vector<Line> outline;    ///< Of its plan, in its own frame; empty: a circle.
    std::vector<Point> track;     ///< Where it has been, oldest first.
    std::vector<Moment> moments;  ///< Oldest first.
  };
  struct Mark {
    std::string label;
    Point position;
    TimePoint time;  ///< Of the run's clock.
  };

  TimePoint start;  ///< Of the run: times are shown from here.
  std::vector<Line> walls;
  std::vector<Robot> robots;
  std::vector<Mark> arrivals;  ///< Where a robot said it had arrived.
  std::vector<Mark> contacts;  ///< Where a robot touched something.
};

}  // namespace orca
