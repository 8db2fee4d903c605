// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "alarm_relay.hpp"
#include "mission_book.hpp"
#include "orca/base/mutex.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/graph/graph.hpp"
#include "orca/host/alarm.hpp"
#include "orca/host/alarm_store.hpp"
#include "orca/host/component_report.hpp"
#include "orca/host/run_listener.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/run_view.hpp"
#include "orca/supervisor/log_name.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// Everything that the host processes have reported, and what the supervisor itself has to say. It passes each on to the
/// listener and keeps it for the result.
///
/// Thread contract: look() from any thread, the rest from the supervisor's.
class Ledger final : public host::RunView {
 public:
  /// @param start  time of the run's clock, which all stamps refer to.
  /// @param log_name  name in the log for what concerns the run as a whole.
  /// @param clock  that of the run.
  Ledger(const graph::Graph& graph, host::RunListener& listener, TimePoint start,
         std::string log_name = kLogName, std::function<TimePoint()> clock = steady_now);

  /// Takes a report of a host process.
  /// @errors  data_loss if it cannot be: the process is not to be trusted any more.
  Status take(const Report& report, const std::string& process);

  /// Notes that all components of a process are gone with it.
  void lose(const std::string& process, const std::string& why);

  /// Takes reports of a component that comes now. Those of one that has gone are still taken.
  void expect(const std::string& component);
  /// Goes on with the components that the graph has now.
  void go_over();

  /// Raises an alarm of the supervisor itself, and writes it to the log.
  /// @param process  that the alarm is about; empty: not one alone.
  /// @param source   what else it is about, such as a machine; empty: nothing.
  void raise(host::AlarmKind kind, const std::string& process, const std::string& text,
             const std::string& source = "");
  /// Reports that the reason for an alarm of the supervisor itself is gone. It is kept until somebody acknowledges it. If
  /// there is no such alarm, nothing happens.
  /// @param text  what is so now, for people.
  void settle(host::AlarmKind kind, const std::string& source, const std::string& text);
  /// The same for all alarms of a kind, whatever else they are about. @return whether there was any.
  bool settle_all(host::AlarmKind kind, const std::string& text);
  /// Returns whether there is such an alarm of the supervisor itself whose reason is not gone.
  [[nodiscard]] bool is_active(host::AlarmKind kind, const std::string& source) const;

  /// Takes an alarm, raised or settled.
  /// @param process   that it is about; empty: not one alone.
  /// @param reporter  process that knows it already; empty: none.
  void note(idl::Alarm alarm, const std::string& process, const std::string& reporter);

  /// Returns the alarms of all processes and of the supervisor that nobody has acknowledged yet, by number. They outlive
  /// their sources.
  [[nodiscard]] const std::vector<host::KeptAlarm>& alarms() const { return alarms_.kept(); }
  [[nodiscard]] const MissionBook& missions() const { return missions_; }
  /// Returns the time of the run's clock, which all stamps refer to.
  [[nodiscard]] TimePoint start() const { return start_; }
  /// Takes an alarm out.
  /// @errors  not_found; failed_precondition for an emergency stop that is not released.
  Status acknowledge(std::uint64_t alarm);
  /// Tells of what happens to alarms from now on.
  /// @param members  outlive the object.
  void relay_to(const std::vector<Member*>& members) { relay_.emplace(members); }

  /// Forgets that a component has failed, because it begins anew.
  void pardon(const std::string& component);

  /// Reports which robots there are, by their hardware, once all processes are built, and again if there are others.
  void introduce();

  [[nodiscard]] host::Reports reports() const;
  /// Returns what the connections of all processes carried; nothing unless each has told it.
  [[nodiscard]] std::optional<host::RunCounters> counters() const;
  /// Returns why an output could not be written; nothing if all could.
  [[nodiscard]] const std::optional<Error>& output_error() const { return output_error_; }
  /// Returns whether a component of a process has a client, as far as its state tells.
  [[nodiscard]] bool is_in_use(const std::string& process) const;
  /// Returns whether all processes are at rest.
  [[nodiscard]] bool at_rest() const { return restless_.empty(); }

  [[nodiscard]] host::RunGlance look() const override;
  /// Fills in everything that has been reported.
  void fill(host::RunResult& result) const;

 private:
  // Keeps alarms that were raised, and told to everybody, before this supervisor came.
  Status recall(const Standing& standing);
  void recall(const idl::Alarm& alarm, const std::string& process);
  void settle_holds_of(const std::string& process, const std::string& why);
  Status take_change(const StateChange& change);
  Status take_figures(const Report& report, const std::string& process);
  Status take_object(const Report& report, const std::string& process);

  const graph::Graph& graph_;
  host::RunListener& listener_;
  const TimePoint start_;
  const std::string log_name_;
  const std::function<TimePoint()> clock_;
  std::map<std::string, std::string> robots_by_hardware_;
  std::set<std::string> restless_;  // processes
  host::RobotNames robots_;
  bool are_introduced_ = false;
  host::AlarmStore alarms_;
  MissionBook missions_{start_};
  std::optional<AlarmRelay> relay_;
  std::map<std::string, Tally> tallies_;  // by process
  std::optional<Error> output_error_;

  mutable Mutex mutex_;
  std::vector<std::string> names_ ORCA_GUARDED_BY(mutex_);  // of the graph's components
  std::map<std::string, host::ComponentReport> components_ ORCA_GUARDED_BY(mutex_);
  std::map<std::string, Glance> glances_ ORCA_GUARDED_BY(mutex_);  // by process
  host::RunResult so_far_ ORCA_GUARDED_BY(mutex_);
};

}  // namespace orca::supervisor
