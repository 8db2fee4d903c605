// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "members/conductor.hpp"
#include "orca/base/result.hpp"
#include "orca/supervisor/vocabulary.hpp"

namespace orca::supervisor {

/// A change to a component, and the way back.
struct ThereAndBack {
  Order go;
  Order back;
};

/// What a joint order means for one component.
struct JointStep {
  std::string component;
  /// Returns the orders for the component as it is at that moment; nothing if it is to be left alone.
  /// @errors  why it cannot obey as it is: it has refused.
  std::function<Result<std::optional<ThereAndBack>>()> make;
  /// Takes that the component has obeyed: true after the change, false after the way back.
  std::function<void(bool has_gone)> obeyed;
  /// Whether an order that was not obeyed in time may be obeyed later.
  bool may_obey_late = true;
};

/// Orders that concern several components, in whatever processes: all of them obey, or none. The components change one
/// after the other, each between two of its laps. If one refuses, those that have changed go back, the last one first.
/// Joint orders wait for each other, so none sees another one half done.
///
/// A component that may obey late and has not obeyed in time gets the order to go back too: it obeys both in turn.
///
/// Thread contract: the supervisor's thread.
class JointOrders {
 public:
  /// Sends an order to a component, and waits until it has obeyed or refused.
  using Sender = std::function<Status(const std::string& component, Order order)>;

  /// @param conductor  outlives the object.
  JointOrders(Conductor& conductor, Sender sender) : conductor_(conductor), sender_(std::move(sender)) {}

  /// Carries out the steps in this order, once all earlier joint orders have ended. A job of the conductor waits for that.
  /// @errors  the reason of the component that has refused, with its name and those of components that could not go back.
  Status carry_out(const std::vector<JointStep>& steps);

 private:
  class Joint;

  Conductor& conductor_;
  const Sender sender_;
  std::uint64_t begun_ = 0;  // how many have been
  std::uint64_t ended_ = 0;
};

}  // namespace orca::supervisor
