// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/contract.hpp"
#include "orca/base/result.hpp"
#include "orca/base/time.hpp"
#include "port_set.hpp"

namespace orca::host {

/// What starts the laps of one component: the end of the lap before, a period, or an object on a port.
///
/// Thread contract: the component's strand.
class LapTrigger {
 public:
  /// @errors  invalid_argument if it is to be a port that is no PushProxy of the component.
  Status choose(const Trigger& trigger, const PortSet& ports);

  /// Makes the first lap due now.
  void begin(TimePoint now) { next_ = now; }
  [[nodiscard]] bool is_due(TimePoint now) const;
  /// Notes that a lap begins now. Laps that were missed are not made up for.
  void lap_begins(TimePoint now);
  /// When the next lap is due; kForever if that is not a matter of time.
  [[nodiscard]] TimePoint next() const;

 private:
  Trigger trigger_;
  PushClientEndpoint* port_ = nullptr;  // Trigger::Kind::on_port only
  TimePoint next_{};
};

}  // namespace orca::host
