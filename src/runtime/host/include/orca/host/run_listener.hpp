// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

#include "orca/base/log.hpp"
#include "orca/base/time.hpp"
#include "orca/host/run_result.hpp"
#include "orca/host/run_view.hpp"
#include "orca/idl/object.hpp"

namespace orca::host {

/// The application's observer of a run. It stands outside the graph: it has no queue, and what it receives
/// does not count in the trace hash.
///
/// Thread contract: one call after the other, but from any strand or thread. No call may block or use the
/// run.
class RunListener {
 public:
  RunListener() = default;
  virtual ~RunListener() = default;
  RunListener(const RunListener&) = delete;
  RunListener& operator=(const RunListener&) = delete;

  /// Reports the start of the run; the first call.
  /// @param now  time of the run's clock, which all stamps refer to.
  virtual void started(TimePoint /*now*/) {}
  /// Reports which robots there are and which components serve them, before anything moves.
  virtual void robots(const RobotNames& /*robots*/) {}
  /// Reports that all components and hardware are constructed, if RunOptions::looks_on.
  /// @param view  may be used until ended() or abandon() returns.
  virtual void built(const RunView& /*view*/) {}
  /// Reports that a component has pushed an Arrived, once for each object, however many components take it or pass it on.
  virtual void arrived(const idl::Arrived& /*arrived*/) {}
  /// Reports that a component has pushed a GoalFailed, likewise.
  virtual void goal_failed(const idl::GoalFailed& /*failed*/) {}
  /// Reports that a robot touched something.
  virtual void contact(const idl::Contact& /*contact*/) {}
  virtual void alarm(const idl::Alarm& /*alarm*/) {}
  /// Reports that a port has sent an object of another mission than the one before. Objects without a mission do not count.
  virtual void mission_step(const std::string& /*port*/, const ObjectRef& /*object*/) {}
  /// Reports a line that a component or a hardware container wrote to the log.
  virtual void logged(log::Level /*level*/, std::string_view /*who*/, std::string_view /*text*/) {}

  /// Reports the end of the run. Only the destructors of components and hardware are still to come.
  virtual void ended(const RunResult& /*result*/) {}

  /// Reports the result when some strands do not end, and ends the process without unwinding. The strands may
  /// still run, so nothing that they use can be destroyed.
  [[noreturn]] virtual void abandon(const RunResult& result) = 0;
};

}  // namespace orca::host
