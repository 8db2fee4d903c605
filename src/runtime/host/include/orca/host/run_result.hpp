// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/base/system/recent_times.hpp"
#include "orca/base/time.hpp"
#include "orca/hw/scene.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/system.hpp"
#include "orca/patterns/counters.hpp"
#include "orca/patterns/endpoints/computing.hpp"

namespace orca::host {

/// The robots of a system, and which of its components serves which. A plain value.
struct RobotNames {
  std::vector<std::string> robots;                  ///< Each one word, in the order of the graph.
  std::map<std::string, std::string> by_component;  ///< Only components that serve one robot alone.

  [[nodiscard]] bool several() const { return robots.size() > 1; }
  /// Returns the robot that a component serves; empty: none, or several equally.
  [[nodiscard]] std::string of(const std::string& component) const {
    const auto found = by_component.find(component);
    return found == by_component.end() ? std::string() : found->second;
  }
  friend bool operator==(const RobotNames&, const RobotNames&) = default;
};

/// The way in which a run ended.
enum class RunOutcome {
  finished,     ///< The components that the graph names in `ends` are done.
  time_is_up,   ///< The time limit was reached.
  stopped,      ///< A stop was requested.
  failed,       ///< Something failed: the run, or a component that the graph does not allow to (may_fail).
  not_started,  ///< Not everything came up; all of it was taken down again.
  bad_options   ///< The options contradict each other; nothing was started.
};

/// The counts of what the connections of one run carried until it was taken down. A plain value.
struct RunCounters {
  struct Edge {
    std::string from;  ///< "component.port" of the PushServer.
    std::string to;    ///< "component.port" of the PushProxy.
    EdgeCounters counters;
    /// How old objects were lately when they arrived; none in virtual time, in which it is not measured.
    std::optional<TimeFigures> ages{};
  };
  std::vector<Edge> edges;                         ///< Push connections, in the order of the graph.
  std::map<std::string, RequestCounters> clients;  ///< By "component.port" of the SendProxy or QueryProxy.
  std::map<std::string, IntakeCounters> servers;   ///< By "component.port" of the SendServer or QueryServer.
  /// By component, of those in virtual time whose laps take some. One whose overruns are many of its laps is overloaded.
  std::map<std::string, ComputingCounters> computing;
  /// Processor time of the laps lately, by component; of those in real time whose strands have threads of their own.
  std::map<std::string, TimeFigures> laps;
};

/// The processor time of a component's laps, by the machine's clock: what it is differs each time. A plain value.
struct LapTimes {
  static constexpr std::size_t kQuantiles = 21;  ///< 5 % apart.
  std::uint64_t laps = 0;                        ///< Laps that came to their end.
  double total = 0.0;                            ///< [s] Of all together.
  std::vector<double> quantiles;                 ///< [s] The shortest first, known to 6 %.
};

/// The result of a run. A plain value.
struct RunResult {
  /// How far a robot has driven.
  struct Way {
    std::string robot;    ///< Component that pushes its odometry or poses.
    double length = 0.0;  ///< [m]
  };

  RunOutcome outcome = RunOutcome::finished;
  std::string culprit;         ///< Component or hardware, named as in the graph; empty: none, or several.
  std::optional<Error> error;  ///< The reason, unless the run ended well.
  std::optional<std::uint64_t> trace_hash;  ///< In virtual time only, if the run started.
  TimePoint start;                          ///< Time of the run's clock, which all stamps refer to.
  TimePoint end;                            ///< Time of the same clock at which the taking down began.
  std::vector<idl::Arrived> arrivals;       ///< In the order in which they were pushed.
  std::vector<idl::GoalFailed> failures;    ///< In the order in which they were pushed.
  std::vector<idl::Contact> contacts;       ///< In the order in which they were reported.
  /// Of each localizer at most ten a second, in the order in which they were pushed; only if RunOptions::keeps_motion.
  std::vector<idl::Localization> localizations;
  std::vector<idl::Alarm> alarms;  ///< In the order in which they were raised.
  std::vector<Way> ways;           ///< Only if RunOptions::looks_on.
  std::optional<Scene> scene;      ///< Only if RunOptions::keeps_motion, and all strands have ended.
  RobotNames robots;               ///< None if the system could not be built.
  RunCounters counters;
  /// By component, only if RunOptions::measures_laps, and all strands have ended.
  std::map<std::string, LapTimes> lap_times;
};

}  // namespace orca::host
