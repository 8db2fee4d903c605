// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "control/motor_hold.hpp"
#include "machines/motors_accord.hpp"
#include "members/reply.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/moment.hpp"

namespace orca::supervisor {

/// The emergency stop of a whole system, on however many machines it runs. An order that is given on one of them is carried
/// out on all, and whoever gave it is told which machines have confirmed it.
///
/// Thread contract: the supervisor's thread.
class SystemHold {
 public:
  /// @param motors  those of this machine; outlives the object.
  explicit SystemHold(MotorHold& motors) : motors_(motors) {}

  /// Agrees with other machines from now on.
  /// @param accord  outlives the object.
  void join(MotorsAccord& accord) { accord_ = &accord; }

  /// Stops all motors of the system, or releases them. The answer ends when all machines have obeyed, or one has not within
  /// a while, which is an error that names it.
  /// @param reply  null: nobody asks.
  void order(bool holds, const ReplyPtr& reply);
  /// Goes on with a stop that an operator has ordered an earlier supervisor.
  void recall();
  /// Carries out what other machines have ordered, and answers whoever waits for them. Call it whenever one was heard.
  void turn(Moment now);

 private:
  // Somebody who waits until all machines have confirmed an order.
  struct Waiting {
    std::uint64_t order = 0;
    Moment until{};
    ReplyPtr reply;
  };

  void carry_out();
  [[nodiscard]] bool is_answered(const Waiting& waiting, Moment now) const;

  MotorHold& motors_;
  MotorsAccord* accord_ = nullptr;  // null: there is no other machine
  std::vector<Waiting> waiting_;
};

}  // namespace orca::supervisor
