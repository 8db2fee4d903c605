// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/avoidance/avoider.hpp"

namespace orca::avoid {

/// The common part of avoid behaviours that listen to a laser at a port `laser`. A derived class chooses the
/// direction.
///
/// Thread contract: as every component.
class LaserAvoider : public Avoider {
 protected:
  /// @param keeps_hidden  whether echoes are remembered that a scan cannot see because they lie behind others; whoever
  ///                      turns a body among them may touch the back of what it sees.
  /// @param memory_time   [s] the default: how long echoes are remembered. A laser invents none, so one that it saw once counts for as
  ///                      long as others.
  explicit LaserAvoider(ComponentHost& host, bool keeps_hidden = false, double memory_time = 4.0);

  /// Returns the body that counts as it is, instead of its circle: none, unless the robot is to squeeze through; that which
  /// the base describes; without one, that of the parameters.
  [[nodiscard]] std::optional<Rectangle> body() const;

  /// Returns the limits with the body that counts, if the robot is to squeeze through and its circle finds no way: that which
  /// the base describes; without one, that of the parameters.
  [[nodiscard]] Limits with_body(const EchoMemory& memory, const Situation& situation, Limits limits) const;

 private:
  PushProxyHandle& sensor() override { return laser_; }
  [[nodiscard]] const ObjectType& sensed() const override;
  void listen(EchoMemory& memory) override;

  bool keeps_hidden_;
  Param<bool> squeeze_;
  Param<double> robot_length_;
  Param<double> robot_width_;
  PushProxy<idl::LaserRangeReadings> laser_{*this, "laser", {.text = "Scans of the laser."}};
};

}  // namespace orca::avoid
