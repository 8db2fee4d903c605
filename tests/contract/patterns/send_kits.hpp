// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "link_kits.hpp"

namespace orca::test {

struct Sender : Peer {
  explicit Sender(Executive& executive, const std::string& name = "sender") : Peer(executive, name) {}
  SendProxy<MotionCommand> out{*this, "out"};
};

/// Takes motion commands; refuses number 13 and throws at number 14.
struct Taker : Peer {
  explicit Taker(Executive& executive, std::uint32_t depth = 4)
      : Peer(executive, "taker"), in(*this, "in", &Taker::on_command, {.depth = depth}) {}

  Status on_command(const ObjectPtr<MotionCommand>& command) {
    if (number_of(command) == 13) return fail(Code::invalid_argument, "thirteen is refused");
    if (number_of(command) == 14) throw std::runtime_error("fourteen is too much");
    taken.push_back(number_of(command));
    return ok();
  }

  [[nodiscard]] IntakeCounters counters() const {
    return static_cast<SendServerEndpoint&>(endpoint("in")).counters();
  }

  std::vector<int> taken;  // touched by the strand only
  SendServer<MotionCommand> in;
};

template <class Kit>
struct Line {
  explicit Line(Kit& kit, std::uint32_t depth = 4) : sender(kit.executive), taker(kit.executive, depth) {
    kit.connect(sender.endpoint("out"), taker.endpoint("in"));
  }
  Line(Kit& kit, const QueuePolicy& policy) : sender(kit.executive), taker(kit.executive) {
    kit.connect(sender.endpoint("out"), taker.endpoint("in"), policy);
  }
  Sender sender;
  Taker taker;
};

}  // namespace orca::test
