// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/hw/endpoints.hpp"
#include "orca/hw/p2os/config.hpp"
#include "orca/hw/p2os/sip.hpp"

namespace orca::hw::p2os {

/// What people should know of a Pioneer: that it has no watchdog or drives slower than the graph says, that its battery is nearly
/// empty, or that its sonars are off. Each is told when it begins.
///
/// Thread contract: not synchronised; the container's strand.
class Remarks {
 public:
  /// @param has_sonars  whether the robot's sonars are used.
  explicit Remarks(bool has_sonars) : has_sonars_(has_sonars) {}

  /// Takes the settings of the controller. @return as the other take().
  /// @param limits  those of the base here.
  [[nodiscard]] std::vector<std::string> take(const Config& config, const DriveLimits& limits);
  /// Notes that the sonars were told to start.
  void start(TimePoint now);
  /// Takes a packet. @return what is to be told; mostly nothing.
  [[nodiscard]] std::vector<std::string> take(const Sip& sip, TimePoint now);

 private:
  [[nodiscard]] bool has_become_low(double voltage);
  [[nodiscard]] bool have_fallen_silent(const Sip& sip, TimePoint now);

  static constexpr double kUsualLow = 11.0;  // [V] of a battery of 12 V

  const bool has_sonars_;
  double low_battery_ = kUsualLow;
  bool is_low_ = false;
  bool are_off_ = false;
  TimePoint heard_{};  // an echo, or when the sonars were started
};

}  // namespace orca::hw::p2os
