// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "members/member.hpp"
#include "orca/idl/machines.hpp"
#include "orca/supervisor/host_start.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// The host process that speaks with the other machines, since the supervisor itself opens no network socket. It is started
/// again whenever it has ended or answers no more: whoever breaks it from the network breaks nothing else.
///
/// Thread contract: the supervisor's thread.
class Messenger {
 public:
  using Heard = std::function<void(const idl::MachineState&)>;

  /// @param meet   what the process is told.
  /// @param heard  takes what other machines say, and this one.
  Messenger(HostStart start, Meet meet, Heard heard);

  /// Starts the process if it does not run, and takes what it has heard.
  void turn(Moment now);
  /// Says something to all other machines. While the process does not run it is lost.
  void say(const idl::MachineState& state, Moment now);
  /// Ends the process for good.
  void end(Moment now);

  /// Returns since when the process can speak; nothing if it cannot.
  [[nodiscard]] std::optional<Moment> speaks_since() const { return speaks_since_; }
  /// Returns the process, to be polled.
  [[nodiscard]] Member& member() { return member_; }

 private:
  void start(Moment now);
  [[nodiscard]] Status take(const Report& report) const;
  void report_end(const ExitReason& reason, Moment now);

  const HostStart start_;
  const Meet meet_;
  const Heard heard_;
  Member member_;
  Moment start_at_{};     // not before
  Moment answered_at_{};  // the last sign of life
  std::optional<Moment> speaks_since_;
  std::string last_error_;
  bool ends_ = false;
};

}  // namespace orca::supervisor
