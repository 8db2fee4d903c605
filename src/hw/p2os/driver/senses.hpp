// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/hw/base_odometry.hpp"
#include "orca/hw/base_senses.hpp"
#include "orca/hw/p2os/model.hpp"
#include "orca/hw/p2os/sip.hpp"

namespace orca::hw::p2os {

/// What a Pioneer senses of itself and around it, as endpoints: odometry, sonars, battery, and bumpers and a gripper if it has
/// them.
///
/// Thread contract: not synchronised; the container's strand.
class Senses {
 public:
  /// What a robot has besides what its model says.
  struct Extras {
    std::vector<double> bumpers;  ///< [rad] Directions in which they face, in any order.
    double bumper_radius = 0.0;   ///< [m] Where they sit, from the middle.
    bool has_gripper = false;
  };
  /// Returns the bumpers that the model usually has.
  /// @source  AriaCoda, ArBumpers: they share an arc of 135 degrees in front, and one in the rear.
  [[nodiscard]] static std::vector<double> usual_bumpers(const Model& model);

  Senses(const Model& model, const Extras& extras, const SenseTraits& traits);

  [[nodiscard]] std::vector<SensorEndpoint*> endpoints();
  /// Returns the description of the sonars; nothing if there are none.
  [[nodiscard]] std::optional<idl::SonarRing> describe_sonars() const;

  /// Begins anew with a robot, whose counts have units of their own. The pose goes on from where it was.
  void connect(const Model& units);

  /// Takes a packet.
  /// @param stamp  when the robot sent it.
  void take(const Sip& sip, TimePoint stamp);
  /// Publishes what the last packet told. @pre  take() was called.
  void publish();

  /// Returns the bumpers that are pressed, for MotionHW::press().
  [[nodiscard]] std::vector<Obstruction::Pressed> pressed() const { return bumpers_.pressed(); }
  /// Returns the units that connect() was given.
  [[nodiscard]] const Model& units() const { return *units_; }

 private:
  void publish_odometry();
  void publish_battery();
  void publish_gripper();

  // Where the controller tells of a bumper.
  struct Bit {
    bool is_front;
    unsigned number;
  };
  void add_bumpers(std::vector<double> directions);
  void find_sonars();

  const Model& model_;
  const Model* units_;
  const bool has_gripper_;
  BaseOdometry odometry_;
  BaseSonars sonars_;                // that are there
  std::vector<std::size_t> places_;  // of each that the controller counts, among them
  BaseBumpers bumpers_;
  std::vector<Bit> bits_;  // of each
  SensorHW<idl::Battery> battery_;
  SensorHW<idl::GripperState> gripper_;

  CountedPose counted_{Sip::kCoordinates};
  Sip sip_;  // the last one
  TimePoint stamp_{};
};

}  // namespace orca::hw::p2os
