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
  /// What is remembered of scans.
  struct Memory {
    bool hidden =
        false;  ///< What a scan cannot see because it lies behind something else: a body that turns may touch it.
    bool shapes =
        false;  ///< The shape of what is near, not only its nearest points: a body turns its corners past it.
    double time =
        4.0;  ///< [s] The default for how long. A laser invents no echoes: one that it saw once counts for as long as others.
  };
  explicit LaserAvoider(ComponentHost& host) : LaserAvoider(host, Memory()) {}
  LaserAvoider(ComponentHost& host, Memory memory);

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

  Memory remembers_;
  Param<bool> squeeze_;
  Param<double> robot_length_;
  Param<double> robot_width_;
  PushProxy<idl::LaserRangeReadings> laser_{*this, "laser", {.text = "Scans of the laser."}};
};

}  // namespace orca::avoid
