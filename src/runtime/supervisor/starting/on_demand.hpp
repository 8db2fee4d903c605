// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>

#include "members/ledger.hpp"
#include "members/member.hpp"
#include "starter.hpp"

namespace orca::supervisor {

/// The processes that are started on demand: who of them is needed, and who is not needed any more.
///
/// A process is needed as soon as a client in another process has written to it. It is not needed any more when for its idle
/// time no client has written and no component has one; then it is asked whether it is still busy with something.
///
/// Thread contract: the supervisor's thread.
class OnDemand {
 public:
  /// Ends a process that nobody needs any more.
  using End = std::function<void(Member&)>;

  /// All of these outlive the object.
  OnDemand(const Members& all, Starter& starter, const Ledger& ledger, End end)
      : all_(all), starter_(starter), ledger_(ledger), end_(std::move(end)) {}

  /// Returns the processes that run from the start. The others are asleep.
  [[nodiscard]] Members put_others_to_sleep() const;

  /// Returns whether a process that is asleep is needed.
  [[nodiscard]] bool is_needed(const Member& member) const;
  /// Lets a process be needed, because an operator wants it.
  void want(const Member& member) { states_[&member].is_wanted = true; }

  /// Looks who is in use, and ends who is not. Call it often.
  void look(Moment now);

  /// Prepares a process that has ended for being needed again. As long as there is no memory for that, it cannot be.
  void fall_asleep(Member& member);

 private:
  struct State {
    bool is_wanted = false;
    bool is_asked = false;      // whether it is busy
    bool lacks_edges = false;   // they are to be renewed
    std::uint64_t traffic = 0;  // at the last look
    Moment last_use{};
  };

  void look_at(Member& member, State& state, Moment now);
  void renew_edges(Member& member, State& state);
  void ask(Member& member, State& state, Moment now);

  const Members& all_;
  Starter& starter_;
  const Ledger& ledger_;
  const End end_;
  std::map<const Member*, State> states_;
};

}  // namespace orca::supervisor
