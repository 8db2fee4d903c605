// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>

#include "orca/base/random.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/sim/caster.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/realism.hpp"
#include "orca/sim/robot_model.hpp"
#include "tick_span.hpp"

namespace orca::sim::detail {

// A ring of infrared sensors. Each measures the distance to the closest thing in its narrow beam, with an
// error that grows with the distance.
class InfraredModel {
 public:
  InfraredModel(InfraredRing ring, const ErrorLevels& errors, RandomStream random, TimePoint start);

  // Measures the round that is due in the span, if one is.
  void run(const Caster& caster, std::size_t own_body, const TickSpan& span);

  // Returns the round that was measured in the last run(), if one was.
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
