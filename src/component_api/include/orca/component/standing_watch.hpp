// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>

#include "orca/component/host.hpp"

namespace orca {

/// The watch over a robot that stands although it is to drive. It reports the cause in the log once the robot has stood for 2 s, at
/// most once a minute, and nothing while the robot drives or is about to.
///
/// Thread contract: as the component.
class StandingWatch {
 public:
  /// @param host  of the component; it must outlive this.
  explicit StandingWatch(const PluginHost& host) : host_(host) {}

  /// Takes note of whether the robot stands; called once a lap.
  /// @param why  returns the cause, for people; empty if there is none to be reported.
  template <class Why>
  void look(bool stands, Why why) {
    const TimePoint now = host_.now();
    if (!stands || !since_) since_ = now;
    if (now - *since_ < 2s || (said_at_ && now - *said_at_ < 60s)) return;
    const std::string cause = why();
    if (cause.empty()) return;
    said_at_ = now;
    host_.write_log(log::Level::warning, "the robot stands: " + cause);
  }
  /// Starts again: the robot was not to drive.
  void reset() { since_.reset(); }

 private:
  const PluginHost& host_;
  std::optional<TimePoint> since_;
  std::optional<TimePoint> said_at_;
};

}  // namespace orca
