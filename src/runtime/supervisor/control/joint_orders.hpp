// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

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
  /// Takes the answer of a component.
  using Answered = std::function<void(const Status&)>;
  /// Sends an order to a component. `answered` is called exactly once, unless the order cannot be sent, or the joint
  /// order has been destroyed.
  /// @errors  the reason why the order cannot be sent.
  using Sender = std::function<Status(const std::string& component, Order order, Answered answered)>;
  /// Takes the end of a joint order: an error names the component that has refused, and those that could not go back.
  using Done = std::function<void(const Status&)>;

  explicit JointOrders(Sender sender);
  ~JointOrders();
  JointOrders(const JointOrders&) = delete;
  JointOrders& operator=(const JointOrders&) = delete;

  /// Carries out the steps in this order, once all earlier joint orders have ended.
  void add(std::vector<JointStep> steps, Done done);

 private:
  class Joint;
  void go_on();

  const Sender sender_;
  std::deque<std::shared_ptr<Joint>> waiting_;  // the first one is being carried out
  bool is_going_on_ = false;
};

}  // namespace orca::supervisor
