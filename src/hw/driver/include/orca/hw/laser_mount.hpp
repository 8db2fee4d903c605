// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/hw/file_param.hpp"

namespace orca::hw {

/// The parameters that drivers of lasers have in common: what the laser is called, and where it sits on the robot. The robot's
/// file says it, or the graph.
///
/// Thread contract: the container's strand.
class LaserMount {
 public:
  /// Which of its beams the parameter `yaw` is about.
  enum class Ahead { middle_beam, angle_0 };

  LaserMount(HardwareContainer& owner, Ahead ahead);

  /// Reads the robot's file, if one is named, and finds the laser in it. To be called in prepare().
  /// @return what is wrong, and warnings.
  [[nodiscard]] std::vector<HardwareFault> read();

  [[nodiscard]] const std::string& name() const { return *name_; }
  /// Returns the pose in the robot's frame of the laser's own, whose x axis is the direction of `ahead`.
  [[nodiscard]] Pose2 pose() const { return {*x_, *y_, *yaw_}; }
  /// Returns the height of its beams above the floor [m].
  [[nodiscard]] double height() const { return *z_; }

 private:
  [[nodiscard]] std::vector<HardwareFault> find(const std::vector<robots::LaserScanner>& lasers);
  void sit(const robots::LaserScanner& laser);

  const Ahead ahead_;
  RobotFileParam file_;
  Param<std::string> mount_;
  FileParam<std::string> name_;
  FileParam<double> x_;
  FileParam<double> y_;
  FileParam<double> z_;
  FileParam<double> yaw_;
};

}  // namespace orca::hw
