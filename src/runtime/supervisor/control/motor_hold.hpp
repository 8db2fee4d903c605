// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "control/reply.hpp"
#include "run/ledger.hpp"
#include "run/member.hpp"

namespace orca::supervisor {

/// The emergency stop of a system: stops all motors, in whatever process they are, and holds them until an operator
/// releases them. The order goes over the control channels, so no link that carries objects can delay it. A process that
/// comes up meanwhile is held before it opens its hardware.
///
/// Thread contract: the supervisor's thread.
class MotorHold {
 public:
  /// @param members  all; outlives the object, as the ledger does, which keeps the alarm.
  MotorHold(const std::vector<Member*>& members, Ledger& ledger) : members_(members), ledger_(ledger) {}

  /// Stops all motors, and raises the alarm ESTOP. The answer ends when they are held in all processes.
  /// @param reply  null: nobody asks.
  void stop(const ReplyPtr& reply);
  /// Lets them obey commands again. Nothing moves before the next command.
  void release(const ReplyPtr& reply);

  /// Notes that a process has ended, by itself, with others, or to begin anew. When it comes up again, its devices are held until
  /// release(): a robot whose odometry, and with it what goals mean, has begun anew must not go on by itself.
  void distrust(const Member& member) { lost_.insert(member.name()); }
  /// Holds the motors of a process that has just been built, if all are held, or if it was lost.
  void take_in(Member& member);

  /// Goes on with a stop that an operator has ordered an earlier supervisor.
  void recall();

  [[nodiscard]] bool holds() const { return holds_; }

 private:
  void ask_all(const ReplyPtr& reply, const std::function<Order()>& make) const;

  const std::vector<Member*>& members_;
  Ledger& ledger_;
  bool holds_ = false;
  std::set<std::string> lost_;  // processes, by name
};

}  // namespace orca::supervisor
