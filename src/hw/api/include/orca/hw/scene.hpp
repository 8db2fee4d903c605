// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

namespace orca {

/// What there is to draw: plain shapes in the world frame [m], x to the right, y up.
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
  struct Robot {
    std::string name;
    Point position;
    double heading_rad = 0.0;
    double radius_m = 0.0;
    std::vector<Point> track;  ///< Where it has been, oldest first.
  };
  struct Mark {
    std::string label;
    Point position;
  };

  std::vector<Line> walls;
  std::vector<Robot> robots;
  std::vector<Mark> arrivals;  ///< Where a robot said it had arrived.
  std::vector<Mark> contacts;  ///< Where a robot touched something.
};

}  // namespace orca
