// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <optional>

#include "component_settings.hpp"
#include "lap_trigger.hpp"
#include "orca/base/strand.hpp"
#include "orca/host/planned_failure.hpp"
#include "run/reporting/run_context.hpp"

namespace orca::host {

/// Makes one component fail as the run's options ask for.
///
/// Thread contract: begin() once, from any thread; the rest on the component's strand.
class FailureInjector {
 public:
  /// All are those of the component, and outlive this object.
  FailureInjector(RunContext& run, const ComponentSettings& settings, Strand& strand, const LapTrigger& laps)
      : run_(run), settings_(settings), strand_(strand), laps_(laps) {}

  /// Starts to count the time.
  void begin();
  /// Returns whether the component is to do nothing now.
  [[nodiscard]] bool is_silent();
  /// To be called inside each lap and handler, before the component's own code: throws, hangs or waits.
  /// @errors  std::runtime_error on purpose; Interrupted while it waits.
  void act();

 private:
  [[nodiscard]] bool has_begun(Failure failure);

  RunContext& run_;
  const ComponentSettings& settings_;
  Strand& strand_;
  const LapTrigger& laps_;
  std::atomic<TimePoint> begins_{kForever};  // handlers may look at it before the components begin to work
  bool told_ = false;
};

}  // namespace orca::host
