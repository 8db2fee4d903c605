// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "members/member.hpp"
#include "orca/idl/object_type.hpp"
#include "orca/supervisor/host_start.hpp"
#include "orca/supervisor/moment.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// The host process that speaks with the other machines, or with a team, since the supervisor itself opens no network socket. It is started
/// again whenever it has ended or answers no more: whoever breaks it from the network breaks nothing else.
///
/// Thread contract: the supervisor's thread.
class Messenger {
 public:
  /// Anybody on the network can say anything.
  using Heard = std::function<void(std::span<const std::byte> state)>;

  /// @param whom   it speaks with, for people.
  /// @param meet   what the process is told.
  /// @param heard  takes what others say, and this one: encoded as XCDR1.
  Messenger(HostStart start, std::string whom, Meet meet, Heard heard);

  /// Starts the process if it does not run, and takes what it has heard.
  void turn(Moment now);
  /// Says something to all others. While the process does not run it is lost.
  /// @param state  of the type of Meet.
  template <class State>
  void say(const State& state, Moment now) {
    std::vector<std::byte> bytes;
    object_type<State>().serialize(&state, bytes);
    say(std::move(bytes), now);
  }
  /// Ends the process for good.
  void end(Moment now);

  /// Returns since when the process can speak; nothing if it cannot.
  [[nodiscard]] std::optional<Moment> speaks_since() const { return speaks_since_; }
  /// Returns the process, to be polled.
  [[nodiscard]] Member& member() { return member_; }

 private:
  void start(Moment now);
  void say(std::vector<std::byte> state, Moment now);
  [[nodiscard]] Status take(const Report& report) const;
  void report_end(const ExitReason& reason, Moment now);

  const HostStart start_;
  const std::string whom_;
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
