// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "port_set.hpp"

namespace orca::host {

/// The trigger that starts the laps of one component: the last lap's end, a period, or an object on a port.
///
/// Thread contract: the component's strand.
class LapTrigger {
 public:
  /// @errors  invalid_argument if the trigger's port is no PushProxy of the component.
  Status choose(const Trigger& trigger, const PortSet& ports);

  /// Makes the first lap due now.
  void begin(TimePoint now) { next_ = now; }
  [[nodiscard]] bool is_due(TimePoint now) const;
  /// Notes that a lap begins now. Missed laps are not made up for.
  void lap_begins(TimePoint now);
  /// Returns when the next lap is due; kForever if no time starts it.
  [[nodiscard]] TimePoint next() const;

 private:
  Trigger trigger_;
  PushClientEndpoint* port_ = nullptr;  // Trigger::Kind::on_port only
  TimePoint next_{};
};

}  // namespace orca::host
