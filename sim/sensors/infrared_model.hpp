// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/base/random.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/sensors.hpp"
#include "tick_span.hpp"

namespace orca::sim::detail {

// A ring of infrared sensors: each tells the closest thing in its narrow beam, the less exactly the farther
// it is.
class InfraredModel {
 public:
  InfraredModel(InfraredRing ring, const ErrorLevels& errors, RandomStream random, TimePoint start);

  void run(const Caster& caster, std::size_t own_body, const TickSpan& span);

  // The round that was measured in the last run(), if one was.
  [[nodiscard]] const std::optional<InfraredScan>& completed() const { return completed_; }

 private:
  [[nodiscard]] double closest(const Caster& caster, std::size_t own_body, const Pose2& X_WS) const;
  [[nodiscard]] double measured(double range);

  InfraredRing ring_;
  ErrorLevels errors_;
  RandomStream random_;
  TimePoint due_;
  std::optional<InfraredScan> completed_;
};

}  // namespace orca::sim::detail
