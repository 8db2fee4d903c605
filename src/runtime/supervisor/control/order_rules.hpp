// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <sys/socket.h>
#include <sys/types.h>

#include <chrono>
#include <map>
#include <string>
#include <vector>

#include "members/reply.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/access.hpp"
#include "orca/supervisor/control.hpp"

namespace orca::supervisor {

/// Returns what somebody needs to ask this. A command that is not known needs most.
/// @thread  any.
[[nodiscard]] Access access_for(const Ask& ask);

/// Returns whether it orders something, so that it is kept who did. Whoever opens a line to a port in order to talk to it does: what is
/// said there, the supervisor does not hear.
/// @thread  any.
[[nodiscard]] bool is_order(const Ask& ask);

/// Answers which role each order takes, a line for each.
/// @param orders  each as on a command line, in one word: "alarms ack".
void show_roles(const std::vector<std::string>& orders, Reply& reply);

/// Writes who has ordered what, and what came of it, to the log: one line for each order, by kAuditName.
///
/// Thread contract: one thread.
class Audit {
 public:
  static constexpr const char* kAuditName = "audit";
  static constexpr int kMostNoted = 5;  ///< Refusals of one user in a second.

  /// Learns the names of this user and of root. Those of others may be with a server, which can be slow, so they are not asked for.
  Audit();

  /// Describes an order and who gives it: "user anna (1000), orcactl[4711], at 2026-11-27T12:00:00Z: set avoid.speed 0.2". One that
  /// came by a page: "user orca (998), orcaview[4712], by page as change, at ...".
  /// @param asker  as the system knows it.
  [[nodiscard]] std::string describe(const Ask& ask, const ucred& asker) const;
  /// Checks that somebody may ask this. What is refused is noted, of each user at most kMostNoted times in a second.
  /// @errors  failed_precondition, with the role that it takes and how it is given.
  [[nodiscard]] Status allow(const Ask& ask, const Asker& asker, Access access);
  /// Notes the outcome of an order: ": done", or its error.
  static void note(const std::string& order, const Status& outcome);

 private:
  [[nodiscard]] bool is_worth_a_line(uid_t user);

  std::map<uid_t, std::string> names_;
  struct Refusals {
    std::chrono::steady_clock::time_point second{};  // its beginning
    int noted = 0;                                   // since then
  };
  std::map<uid_t, Refusals> refusals_;
};

}  // namespace orca::supervisor
