// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/idl/system.hpp"

namespace orca {

/// Returns why motors of the system are held until a person lets them go, and how; empty: they are not.
/// @param kept  Component::kept_alarms().
/// @thread  pure function, as the next; any thread.
[[nodiscard]] inline std::string why_motors_are_held(const std::vector<idl::Alarm>& kept) {
  const auto stop = std::ranges::find_if(
      kept, [](const idl::Alarm& alarm) { return alarm.kind() == idl::ESTOP && alarm.active(); });
  if (stop == kept.end()) return {};
  return stop->text().empty() ? "the motors are held" : stop->text();
}
/// Returns whether they are.
[[nodiscard]] inline bool are_motors_held(const std::vector<idl::Alarm>& kept) {
  return !why_motors_are_held(kept).empty();
}

/// The time for which motors are held, lap by lap. Nothing that a component waits for comes about meanwhile, so its limits move
/// on by that time.
///
/// Thread contract: as the component.
class HeldTime {
 public:
  /// Returns for how long the motors were held since the last call; zero: they are not held.
  /// @param kept  as of are_motors_held().
  [[nodiscard]] Duration since_last(TimePoint now, const std::vector<idl::Alarm>& kept) {
    const Duration passed = last_ ? now - *last_ : Duration{0};
    last_ = now;
    return are_motors_held(kept) ? passed : Duration{0};
  }

 private:
  std::optional<TimePoint> last_;
};

}  // namespace orca
