// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "members/conductor.hpp"
#include "members/member.hpp"
#include "orca/base/result.hpp"

namespace orca::supervisor {

/// Processes that were started together and come up together, step by step. One that ends meanwhile is left out.
///
/// Thread contract: the supervisor's thread. Every function that waits returns false if nothing more will happen: none of
/// them runs any more, or all is to end.
class Company {
 public:
  /// What it needs of the run.
  struct Place {
    Conductor& conductor;
    std::function<bool()> is_over;  ///< Returns whether all is to end.
    /// Takes that a process cannot come up, and ends it or everything.
    std::function<void(Member&, const Error&)> refused;
  };

  /// @param members  just started.
  Company(Place place, const Members& members);

  /// Returns those that still run.
  [[nodiscard]] Members present() const;
  [[nodiscard]] bool has(const Member& member) const;

  /// Sends an order to each, and waits until all have obeyed.
  bool ask_all(const std::function<Order(const Member&)>& order) const;
  /// Sends an order to one, and waits until it has obeyed, or has ended because it refused.
  bool ask(Member& member, Order order) const;
  /// Waits until something is so.
  bool wait(const std::function<bool()>& is_so) const;

 private:
  [[nodiscard]] bool is_over() const;
  bool take(Member& member, const PendingAnswer& pending) const;

  const Place place_;
  std::vector<std::pair<Member*, std::uint64_t>> members_;  // and which start of theirs this is
};

}  // namespace orca::supervisor
