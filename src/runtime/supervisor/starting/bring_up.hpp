// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <functional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "members/member.hpp"
#include "orca/base/result.hpp"

namespace orca::supervisor {

inline constexpr Duration kStartLimit = 15s;  ///< For processes that are started together to come up.

/// The steps by which a set of processes comes up together: each is set up and built, opens its hardware, then their
/// components are configured one after the other, whichever process they are in, then all gates open.
///
/// Thread contract: the supervisor's thread.
class BringUp {
 public:
  struct Plan {
    std::vector<Member*> members;  ///< Just started.
    /// Components of these members in the order in which they are configured, with their member.
    std::deque<std::pair<Member*, std::string>> components;
  };
  /// What the bring-up waits for besides its members. Each is asked again in go_on() until it returns true; one that is
  /// empty always does.
  struct Consent {
    std::function<bool(const std::string& component)> to_configure{};
    std::function<bool()> to_begin{};
  };
  /// Takes the outcome: ok(), or the error of a member.
  using Done = std::function<void(const Status&, Member*)>;

  /// @param built  called when all members are built, before any hardware is opened.
  BringUp(Plan plan, Consent consent, std::function<void()> built, Done done);

  /// Begins with these orders, one for each member in the plan's order.
  void begin(std::vector<Setup> setups);

  /// Goes on if a consent is there that was missing. Call it often.
  void go_on();

  /// Goes on without a member, whose process has ended.
  void lose(Member& member);

  /// Returns whether nothing more will happen.
  [[nodiscard]] bool is_over() const { return is_over_ || plan_.members.empty(); }

 private:
  using Step = void (BringUp::*)();

  void ask_all(const std::function<Order()>& order, Step next);
  void ask(Member& member, Order order);
  void build();
  void open_hardware();
  void configure_next();
  void open_gates();
  void take_answer(Member& member, const Status& outcome);

  Plan plan_;
  const Consent consent_;
  const std::function<void()> built_;
  const Done done_;
  std::set<Member*> awaited_;  // who has not answered yet
  Step next_ = nullptr;        // when all have
  bool is_over_ = false;
};

}  // namespace orca::supervisor
