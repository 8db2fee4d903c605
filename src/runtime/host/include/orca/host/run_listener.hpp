// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <string_view>

#include "orca/base/log.hpp"
#include "orca/base/time.hpp"
#include "orca/host/run_result.hpp"

namespace orca::host {

/// The application's ear in a run. It stands outside the graph: it has no queue, and what it hears takes no
/// part in the trace hash.
///
/// Thread contract: one call after the other, but from any strand or thread. No call may block or use the
/// run.
class RunListener {
 public:
  RunListener() = default;
  virtual ~RunListener() = default;
  RunListener(const RunListener&) = delete;
  RunListener& operator=(const RunListener&) = delete;

  /// The first call.
  /// @param now  of the run's clock, which all stamps refer to.
  virtual void started(TimePoint /*now*/) {}
  /// An Arrived was delivered to a component; once for each, however many take it.
  virtual void arrived(const idl::Arrived& /*arrived*/) {}
  /// A robot touched something.
  virtual void contact(const idl::Contact& /*contact*/) {}
  virtual void alarm(const idl::Alarm& /*alarm*/) {}
  /// A component or a hardware container wrote a line to the log.
  virtual void logged(log::Level /*level*/, std::string_view /*who*/, std::string_view /*text*/) {}

  /// The run is over; only the destructors of components and hardware are still to come.
  virtual void ended(const RunResult& /*result*/) {}

  /// Some strands do not end. They may still run, therefore nothing that they use can be destroyed: reports
  /// the result and ends the process without unwinding.
  [[noreturn]] virtual void abandon(const RunResult& result) = 0;
};

}  // namespace orca::host
