// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/hw/endpoints.hpp"
#include "orca/hw/file_param.hpp"
#include "orca/idl/hardware.hpp"

namespace orca::hw {

/// A driver's own figures of its base, which hold where neither the graph nor the robot's file gives others.
struct OwnFigures {
  std::string name;                        ///< Of the robot, one word.
  double max_speed = 0.5;                  ///< [m/s]
  double max_turn_rate = 1.5;              ///< [rad/s]
  std::optional<double> most_speed{};      ///< [m/s] The largest max_speed that the base can take.
  std::optional<double> most_turn_rate{};  ///< [rad/s] The largest max_turn_rate likewise.
  double steer_gain = 0.5;                 ///< [1/s]
  double big_turn_angle = 1.0;             ///< [rad]
  double big_turn_speed = 0.1;             ///< [m/s]
  idl::DriveType type = idl::DIFFERENTIAL;
  std::optional<std::size_t> sonars{};  ///< How many it has, if all robots of the driver have as many.
  std::optional<double>
      fixed_track{};  ///< [m] Between its wheels, if it is that of all robots of the driver.
};

/// The parameters that drivers of bases have in common: the robot's file, its name and its limits.
///
/// Thread contract: the container's strand.
class BaseParams {
 public:
  BaseParams(HardwareContainer& owner, const OwnFigures& own);

  /// Reads the robot's file, if one is named, and takes its figures. To be called in prepare().
  /// @return what is wrong with the file, and warnings.
  [[nodiscard]] std::vector<HardwareFault> read();
  /// Tells that this base can be asked for less than others of the driver. To be called before read().
  /// @param speed, turn_rate  [m/s, rad/s] 0: not known.
  void limit(double speed, double turn_rate);
  /// As RobotFileParam::give(), with nothing to do without a file.
  [[nodiscard]] std::vector<HardwareFault> give(FileParam<double>& param, double robots::Drive::*figure,
                                                const std::string& attribute) const;

  [[nodiscard]] DriveLimits limits() const;
  [[nodiscard]] const std::string& name() const { return *name_; }
  [[nodiscard]] const RobotFileParam& file() const { return file_; }
  /// Returns the number of sonars of the file's robot; 0: it has none, or there is no file.
  [[nodiscard]] std::size_t sonars() const;

  /// Adds what the file knows of the robot: maker, size, and what it says of drive and sonars that the driver does not.
  /// @param robot  with one drive.
  void complete(idl::Robot& robot) const;

 private:
  [[nodiscard]] std::vector<HardwareFault> wrong_kind() const;
  [[nodiscard]] std::vector<HardwareFault> wrong_track() const;
  [[nodiscard]] std::vector<HardwareFault> wrong_sonars() const;

  OwnFigures own_;
  RobotFileParam file_;
  FileParam<std::string> name_;
  FileParam<double> max_speed_;
  FileParam<double> max_turn_rate_;
  FileParam<double> steer_gain_;
};

}  // namespace orca::hw
