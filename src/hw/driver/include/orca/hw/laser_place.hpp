// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/component/host.hpp"
#include "orca/component/param.hpp"
#include "orca/geometry/error_guess.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/robot_file/devices.hpp"

namespace orca::hw {

/// Where a laser on a line of its own sits: as its parameters say, or as the robot's file does.
///
/// Thread contract: the driver's.
class LaserPlace {
 public:
  /// @param owner      the driver, which declares the parameters.
  /// @param direction  what of the laser looks ahead, for people: "its middle beam".
  template <class Owner>
  LaserPlace(Owner& owner, const std::string& direction)
      : file_(owner, "robot", "",
              {.file = true,
               .text =
                   "The robot's file, which the simulator reads, too: where the laser sits is in it. Empty: "
                   "the parameters say it."}),
        mount_(owner, "mount", "",
               {.text = "Name of the laser in the robot's file; empty: that has only one."}),
        x_(owner, "x", 0.0, {.unit = "m", .text = "Where it sits on the robot: ahead of the middle."}),
        y_(owner, "y", 0.0, {.unit = "m", .text = "To the left of the middle."}),
        z_(owner, "z", 0.0, {.unit = "m", .text = "Height of its beams above the floor."}),
        yaw_(owner, "yaw", 0.0,
             {.unit = "rad", .text = "Direction of " + direction + ", 0 ahead, positive to the left."}),
        upside_down_(owner, "upside_down", false, {.text = "Whether it hangs upside down."}) {}

  /// Finds out where it sits. To be called in prepare().
  /// @return what is wrong with the parameters or the file.
  [[nodiscard]] std::vector<HardwareFault> read();

  /// Returns its place in the robot frame.
  [[nodiscard]] const Pose2& place() const { return place_; }
  /// Returns the height of its beams above the floor [m].
  [[nodiscard]] double height() const { return height_; }
  /// Returns the factor on its angles: -1 if it hangs upside down, else 1.
  [[nodiscard]] double sense() const { return sense_; }
  /// Returns whether readings in a direction are left out, because the robot's file says that the laser sees the robot itself there.
  /// @param angle  [rad] in the sensor frame of a level laser, as in its scans.
  [[nodiscard]] bool ignores(double angle) const { return laser_.ignores(angle); }
  /// Returns how wrong its ranges are, as far as the robot's file guesses it.
  [[nodiscard]] const RangeErrorGuess& errors() const { return errors_; }

 private:
  void read_file(std::vector<HardwareFault>& faults);

  Param<std::string> file_;
  Param<std::string> mount_;
  Param<double> x_;
  Param<double> y_;
  Param<double> z_;
  Param<double> yaw_;
  Param<bool> upside_down_;
  Pose2 place_;
  double height_ = 0.0;
  double sense_ = 1.0;
  RangeErrorGuess errors_;
  robot_file::LaserScanner laser_;  // of the robot's file
};

}  // namespace orca::hw
