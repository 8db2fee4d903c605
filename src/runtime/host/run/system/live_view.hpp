// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "orca/base/executive.hpp"
#include "orca/host/run_view.hpp"
#include "run/reporting/reporter.hpp"
#include "run/reporting/sightings.hpp"
#include "system.hpp"

namespace orca::host {

/// The view of a run that goes on in this process.
///
/// Thread contract: as RunView, from the time when the system is built until it is destroyed.
class LiveView final : public RunView {
 public:
  LiveView(const Executive& executive, TimePoint start, const System& system, const Reporter& reporter)
      : executive_(executive), start_(start), system_(system), reporter_(reporter) {}

  [[nodiscard]] RunGlance look() const override;
  /// Returns what it knows of robots and goals, which the reporter is to fill.
  [[nodiscard]] Sightings& sightings() { return sightings_; }
  [[nodiscard]] const Sightings& sightings() const { return sightings_; }

 private:
  const Executive& executive_;
  const TimePoint start_;
  const System& system_;
  const Reporter& reporter_;
  Sightings sightings_;
};

}  // namespace orca::host
