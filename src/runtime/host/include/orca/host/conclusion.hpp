// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "orca/base/log.hpp"
#include "orca/base/result.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/component_report.hpp"
#include "orca/host/run_result.hpp"

namespace orca::host {

/// How a run ends, and why. The policy is the same in one process and in several. What is worth a line goes to the log.
///
/// Thread contract: one thread; has_come_up() from any.
class Conclusion {
 public:
  /// Takes a line for the log, and for whoever listens to the run.
  using Say = std::function<void(log::Level, const std::string& who, const std::string& text)>;

  /// @param graph     outlives the object.
  /// @param log_name  name in the log for what concerns the run as a whole.
  Conclusion(const graph::Graph& graph, Reports reports, std::string log_name, Say say = log::write)
      : graph_(graph), reports_(std::move(reports)), log_name_(std::move(log_name)), say_(std::move(say)) {}

  [[nodiscard]] bool is_over() const { return is_over_; }
  /// Returns whether the components that the graph names in `ends` have ended the run, well or not. Then the others still
  /// need a moment to come to rest.
  [[nodiscard]] bool has_closing_phase() const { return by_components_; }
  [[nodiscard]] bool has_failed() const { return error_.has_value(); }

  /// Notes that everything has come up.
  void came_up() { came_up_ = true; }
  [[nodiscard]] bool has_come_up() const { return came_up_; }

  /// Sets a function that learns of each end of the run, and why if it fails.
  void on_end(std::function<void(RunOutcome, const std::string& why)> told) { told_ = std::move(told); }

  /// Ends the run.
  /// @param status  the reason if it fails.
  void conclude(RunOutcome outcome, const Status& status);
  /// Ends the run because something has failed: before everything has come up, it has not started.
  void fail_with(const Error& error);
  /// Does the same, and reports the error.
  void report_failure(const Error& error);
  /// Ends the run because of an error while everything came up.
  void refuse_start(const Error& error);
  /// Ends the run because a stop was requested.
  /// @param signal  the signal that did, if it is not one for that purpose.
  void stop(const std::string& signal);
  /// Ends the run because its time limit was reached.
  void run_out_of_time();
  /// Ends the run if the components that the graph names in `ends` have come to an end.
  /// @param everywhere  takes whether they have here, and returns whether they have on all machines; empty: there is no other.
  void look_at_ends(const std::function<bool(bool is_done_here)>& everywhere = {});

  /// Makes the run a failure if a component has ended in WORK_FAILED that the graph does not allow to.
  void judge();
  /// Makes the run a failure that has ended well so far, because of what was found while it was taken down. A run that
  /// never came up is none.
  void fail_late(const Error& error);

  void fill(RunResult& result) const;

 private:
  const graph::Graph& graph_;
  const Reports reports_;
  const std::string log_name_;
  const Say say_;
  std::atomic<bool> came_up_{false};
  bool is_over_ = false;
  bool by_components_ = false;  // those of `ends` have ended the run
  RunOutcome outcome_ = RunOutcome::finished;
  std::optional<Error> error_;
  std::function<void(RunOutcome, const std::string& why)> told_;
};

}  // namespace orca::host
