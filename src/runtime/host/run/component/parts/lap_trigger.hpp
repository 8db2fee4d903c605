// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "port_set.hpp"

namespace orca::host {

/// The trigger that starts the laps of one component: the last lap's end, a period, or objects on its ports.
///
/// Thread contract: the component's strand.
class LapTrigger {
 public:
  /// @errors  invalid_argument if one of the trigger's ports is no PushProxy of the component.
  Status choose(const Trigger& trigger, const PortSet& ports);

  /// Notes that the laps begin now, with the first one at once if a period starts them.
  void begin(TimePoint now);
  /// Returns whether a lap is due. Of objects on several ports that are to be of one moment, those that are
  /// too old to match any other are dropped.
  [[nodiscard]] bool is_due(TimePoint now);
  /// Returns whether a lap is due although the present one is not over. It never is if nothing but the last lap's end starts laps.
  [[nodiscard]] bool is_overdue(TimePoint now) {
    return trigger_.kind != Trigger::Kind::free_running && is_due(now);
  }
  /// Notes that a lap begins now. Missed laps are not made up for.
  void lap_begins(TimePoint now);
  /// Returns when the next lap is due; kForever if no time starts it.
  [[nodiscard]] TimePoint next() const;
  /// Returns the time between two laps as far as it is known in advance [s]; 0: not known.
  [[nodiscard]] Duration period() const;

 private:
  [[nodiscard]] bool has_objects() const;
  [[nodiscard]] std::optional<Duration> announced() const;

  Trigger trigger_;
  std::vector<PushClientEndpoint*> ports_;  // of a trigger that waits for ports
  TimePoint next_{};
};

}  // namespace orca::host
