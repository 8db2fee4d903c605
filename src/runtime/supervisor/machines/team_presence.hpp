// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>

#include "machines/messenger.hpp"
#include "machines/team_directory.hpp"
#include "members/reply.hpp"

namespace orca::supervisor {

/// This system in its team: says that it is there and what it offers, hears who else is, and reports that in the log. The run depends on
/// nobody of the team.
///
/// Thread contract: the supervisor's thread.
class TeamPresence {
 public:
  /// @param graph  with a team.
  /// @param start  of a host process.
  TeamPresence(const graph::Graph& graph, HostStart start);

  /// Goes on with what another graph offers and hears.
  void go_over(const graph::Team& team) { directory_.go_over(team); }
  /// Hears the others, and says what this system has to say.
  void turn(Moment now);
  /// Says that this system leaves. Call it until it returns true: nothing is left.
  [[nodiscard]] bool take_leave(Moment now);

  /// A line for each system of the team, this one first: since when it is there, and what it offers.
  void show(Reply& reply) const;
  /// Returns the process that speaks with the others, to be polled.
  [[nodiscard]] Member& member() { return messenger_.member(); }

 private:
  void say(bool leaves, Moment now);

  const std::string team_;
  TeamDirectory directory_;
  Messenger messenger_;
  const Moment begun_ = Moment::clock::now();
  std::uint64_t seq_ = 0;
  Moment say_at_{};  // when to repeat
  int farewells_ = 0;
};

}  // namespace orca::supervisor
