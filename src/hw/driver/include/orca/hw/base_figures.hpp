// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "orca/component/param.hpp"
#include "orca/hw/base_odometry.hpp"
#include "orca/hw/endpoints.hpp"
#include "orca/hw/robot_figures.hpp"

namespace orca::hw {

/// The parameters of a base of which the robot's file says more: the file, and how far the base goes.
///
/// Thread contract: the driver's.
class BaseFigures {
 public:
  /// @param owner  the driver, which declares the parameters.
  template <class Owner>
  explicit BaseFigures(Owner& owner)
      : file_(
            owner, "robot", "",
            {.file = true,
             .text =
                 "The robot's file, which the simulator reads, too: it limits speeds beside the parameters, "
                 "and says how large the robot is. Empty: what the driver knows of such robots."}),
        distance_scale_(
            owner, "distance_scale", 1.0,
            {.min = 0.5,
             .max = 2.0,
             .text = "Way that the base drives over the way that its odometry tells with 1; measure it over "
                     "some metres, or by orcactl calibrate."}),
        turn_scale_(
            owner, "turn_scale", 1.0,
            {.min = 0.5,
             .max = 2.0,
             .text =
                 "Angle that it turns over the angle that its odometry tells with 1; measure it over some "
                 "turns."}),
        turn_per_metre_(owner, "turn_per_metre", 0.0,
                        {.unit = "rad/m",
                         .min = -0.5,
                         .max = 0.5,
                         .text = "Angle that it turns to the left, per way that its odometry tells with 1, "
                                 "while that tells of none: of unlike wheels."}) {}

  /// The base that a driver drives.
  struct Expected {
    std::string model;  ///< For people: "Pioneer 2-DX".
    idl::DriveType type = idl::DIFFERENTIAL;
    double track = 0.0;  ///< [m] Usual diameter of the circle through its wheels; 0: not known.
  };

  /// Reads the file, if there is one. To be called in prepare().
  /// @return what is wrong with the file, and a warning if its robot has quite another track.
  [[nodiscard]] std::vector<HardwareFault> read(const Expected& expected);

  /// Returns the limits, or those of the file where they are less. How the base steers, gain and big turns, is as the
  /// file says or means by its defaults.
  [[nodiscard]] DriveLimits within(DriveLimits limits) const;
  /// Returns the acceleration [m/s2], or that of the file if it is less.
  [[nodiscard]] double within(double acceleration) const;
  [[nodiscard]] Calibration calibration() const { return {*distance_scale_, *turn_scale_, *turn_per_metre_}; }
  /// Returns the calibration, and how wrong the senses are as far as the file guesses it.
  [[nodiscard]] SenseTraits traits() const;
  /// Returns the file's figures; null: there is no file.
  [[nodiscard]] const RobotFigures* figures() const { return figures_ ? &*figures_ : nullptr; }
  /// Writes into the description how large the robot is, if the file says so.
  void describe(idl::Robot& robot) const;

 private:
  Param<std::string> file_;
  Param<double> distance_scale_;
  Param<double> turn_scale_;
  Param<double> turn_per_metre_;
  std::optional<RobotFigures> figures_;
  idl::DriveType type_ = idl::DIFFERENTIAL;
};

}  // namespace orca::hw
