// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/time.hpp"

namespace orca::host {

/// What a run is like at one moment, for people. A plain value.
struct RunGlance {
  /// A component or hardware that does not work as it should, or not yet.
  struct Unwell {
    std::string name;   ///< As in the graph.
    std::string state;  ///< "WORK_FAILED", "SUSPENDED", "Fault", ...
  };
  /// A place to which a component says that it drives.
  struct Goal {
    std::string name;
    double distance = 0.0;  ///< [m] in the plane, from the last pose that this component has received.
  };

  Duration time{0};            ///< Since the start, on the run's clock [s].
  bool is_virtual = false;     ///< Whether that clock is the simulation's.
  std::size_t working = 0;     ///< Number of components in WORK.
  std::vector<Unwell> unwell;  ///< In the order of the graph.
  std::vector<Goal> goals;     ///< By the names of the components.
  std::string last_alarm;      ///< "avoid FAILED: work() failed: ..."; empty: none yet.
};

/// A view of a run from outside. It changes nothing in the run.
///
/// Thread contract: any thread that is no strand of the run, at a human rate.
class RunView {
 public:
  RunView() = default;
  virtual ~RunView() = default;
  RunView(const RunView&) = delete;
  RunView& operator=(const RunView&) = delete;

  [[nodiscard]] virtual RunGlance look() const = 0;
};

}  // namespace orca::host
