// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <functional>
#include <set>
#include <string>
#include <vector>

#include "members/ledger.hpp"
#include "members/member.hpp"
#include "orca/base/result.hpp"

namespace orca::supervisor {

/// The emergency stop of a machine: stops all motors, in whatever process they are, and holds them until an operator
/// releases them. The order goes over the control channels, so no link that carries objects can delay it. A process that
/// comes up meanwhile is held before it opens its hardware.
///
/// Thread contract: the supervisor's thread.
class MotorHold {
 public:
  /// @param members  all; outlives the object, as the ledger does, which keeps the alarm.
  MotorHold(const std::vector<Member*>& members, Ledger& ledger) : members_(members), ledger_(ledger) {}

  /// Takes what has become of an order, when all processes have answered or ended.
  using Done = std::function<void(const Status&)>;

  /// Stops all motors, and raises the alarm ESTOP.
  void stop(Done done);
  /// Lets them obey commands again. Nothing moves before the next command.
  /// @param done  gets failed_precondition if nothing was held.
  void release(Done done);

  /// Notes that a process has ended, by itself, with others, or to begin anew. When it comes up again, its devices are held until
  /// release(): a robot whose odometry, and with it what goals mean, has begun anew must not go on by itself.
  void distrust(const Member& member) { lost_.insert(member.name()); }
  /// Holds the motors of a process that has just been built, if all are held, or if it was lost.
  void take_in(Member& member);

  /// Goes on with a stop that an operator has ordered an earlier supervisor.
  void recall();

  [[nodiscard]] bool holds() const { return holds_; }

 private:
  const std::vector<Member*>& members_;
  Ledger& ledger_;
  bool holds_ = false;
  std::set<std::string> lost_;  // processes, by name
};

}  // namespace orca::supervisor
