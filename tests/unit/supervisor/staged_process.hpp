// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <sys/eventfd.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "channel/samples.hpp"
#include "members/member.hpp"

namespace orca::test {

/// A process that the test plays: it has a control channel, and no program. So it starts, answers and ends when the test
/// says so.
class StagedProcess {
 public:
  explicit StagedProcess(std::string name, std::size_t index = 0)
      : own_(std::in_place, graph::ProcessNode{.name = std::move(name)}, index, index), member_(*own_) {}
  /// Plays for a member of others.
  explicit StagedProcess(supervisor::Member& member) : member_(member) {}

  [[nodiscard]] supervisor::Member& member() const { return member_; }

  void start(supervisor::Member::Phase phase = supervisor::Member::Phase::coming_up) {
    supervisor::SocketPair pair = std::move(supervisor::make_socket_pair()).value();
    here_.emplace(std::move(pair.host));
    Descriptor has_ended(eventfd(1, EFD_CLOEXEC));  // nobody waits for it
    member_.adopt(supervisor::HostProcess::adopt(
        {member_.name(), -1, std::move(has_ended), null_device(), std::move(pair.supervisor)}));
    member_.enter(phase);
  }
  void end() { member_.forget(); }

  /// Returns the next order, if there is one that has not been returned yet.
  std::optional<supervisor::Order> hear() {
    auto message = here_->receive();
    if (!message || !message->has_value()) return std::nullopt;
    request_ = (*message)->request;
    return std::move(supervisor::decode_order(std::move(**message))).value();
  }
  /// Returns whether it has got such an order since the last call of hear().
  template <typename Wanted>
  bool hears() {
    const std::optional<supervisor::Order> order = hear();
    return order && std::holds_alternative<Wanted>(*order);
  }
  /// Returns whether somebody waits for an answer to the order that was heard last.
  [[nodiscard]] bool is_asked() const { return request_ != 0; }
  /// Answers the order that was heard last.
  void answer(const Status& outcome = ok()) { member_.take_answer(request_, {outcome}); }

 private:
  std::optional<supervisor::Member> own_;
  supervisor::Member& member_;
  std::optional<supervisor::Channel> here_;
  std::uint64_t request_ = 0;
};

}  // namespace orca::test
