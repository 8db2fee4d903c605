// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <map>
#include <mutex>
#include <set>
#include <string>

#include "orca/graph/graph.hpp"
#include "orca/host/alarm.hpp"
#include "orca/host/component_report.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/run_view.hpp"
#include "orca/host/verdict.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// Everything that the host processes have reported, and what the supervisor itself has to say. It passes each on to the
/// listener and keeps it for the result.
///
/// Thread contract: look() from any thread, the rest from the supervisor's.
class Ledger final : public host::RunView {
 public:
  /// @param start  time of the run's clock, which all stamps refer to.
  Ledger(const graph::Graph& graph, host::RunListener& listener, TimePoint start);

  /// Takes a report of a host process.
  /// @errors  data_loss if it cannot be: the process is not to be trusted any more.
  Status take(const Report& report, const std::string& process);

  /// Notes that all components of a process are gone with it.
  void lose(const std::string& process, const std::string& why);

  /// Raises an alarm of the supervisor itself, and writes it to the log.
  void raise(host::AlarmKind kind, const std::string& component, const std::string& text);

  /// Reports which robots there are, by their hardware, once all processes are built.
  void introduce();

  [[nodiscard]] host::Reports reports() const;
  /// Returns whether all processes are at rest.
  [[nodiscard]] bool at_rest() const { return restless_.empty(); }

  [[nodiscard]] host::RunGlance look() const override;
  /// Fills in everything that has been reported.
  void fill(host::RunResult& result) const;

 private:
  Status take_change(const StateChange& change);
  Status take_object(const Report& report);
  void note(idl::Alarm alarm);

  const graph::Graph& graph_;
  host::RunListener& listener_;
  const TimePoint start_;
  std::map<std::string, std::string> robots_by_hardware_;
  std::set<std::string> restless_;  // processes
  host::RobotNames robots_;

  mutable std::mutex mutex_;
  // Below: guarded by mutex_.
  std::map<std::string, host::ComponentReport> components_;
  host::RunResult so_far_;
};

}  // namespace orca::supervisor
