// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "orca/base/descriptor.hpp"
#include "orca/batch/difference.hpp"
#include "running/process.hpp"

namespace orca::batch {

/// A run in a process of its own whose deliveries can be read while it goes on. It waits while nobody reads.
///
/// Thread contract: as RunProcess.
class TracedRun {
 public:
  /// @param elsewhere  in other circumstances.
  /// @errors  unavailable if no process can be started.
  static Result<TracedRun> start(const RunAgain& run, bool elsewhere);

  /// Reads the next delivery; nothing if there are no more.
  /// @errors  failed_precondition if `give_up` said so; deadline_exceeded if the run hangs.
  Result<std::optional<Delivery>> next(const std::function<bool()>& give_up);

  /// Returns its outcome. @pre  next() has returned nothing.
  [[nodiscard]] Outcome outcome();

 private:
  TracedRun(RunProcess process, Descriptor trace) : process_(std::move(process)), trace_(std::move(trace)) {}

  [[nodiscard]] std::optional<std::string> take_line();
  void read_more();
  [[nodiscard]] Status wait(const std::function<bool()>& give_up);

  RunProcess process_;
  Descriptor trace_;
  std::string text_;       // of the trace, from begin_ on not handed out yet
  std::size_t begin_ = 0;  // of the next line in text_
  bool trace_ended_ = false;
  bool has_ended_ = false;
};

}  // namespace orca::batch
