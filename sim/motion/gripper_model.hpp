// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <bit>
#include <optional>

#include "orca/base/hash.hpp"
#include "orca/sim/readings.hpp"
#include "orca/sim/robot_model.hpp"

namespace orca::sim::detail {

// The paddles and the lift of a gripper. Each moves at constant speed to the end that it was ordered to, and stops there.
// Closing paddles stop at what is between them, and hold it. At first the paddles are open and the lift is down.
class GripperModel {
 public:
  explicit GripperModel(const Gripper& gripper) : gripper_(gripper) {}

  // Replaces the parts of the former order about which `order` says something.
  void order(const GripperOrder& order) {
    if (order.paddles != Paddles::stay) paddles_ = order.paddles;
    if (order.lift != Lift::stay) to_ = order.lift;
    settle();
  }

  // Moves for a tick of `seconds`.
  // @param width  [m] of what stands between the paddles, at most gap(); nothing if nothing does.
  // @return  whether the paddles have begun to hold it.
  bool step(double seconds, std::optional<double> width) {
    if (to_ == Lift::up) lift_ += share_of(seconds, gripper_.lift_time);
    if (to_ == Lift::down) lift_ -= share_of(seconds, gripper_.lift_time);
    if (paddles_ == Paddles::open) opening_ += share_of(seconds, gripper_.paddle_time);
    if (paddles_ == Paddles::close) opening_ -= share_of(seconds, gripper_.paddle_time);
    const bool grips = width && paddles_ == Paddles::close && gap() <= *width;
    if (grips) {
      opening_ = *width / gripper_.opening;
      holds_ = true;
    }
    settle();
    return grips;
  }

  // Returns whether paddles that hold something are ordered to open. Then call let_go() or refuse() before step().
  [[nodiscard]] bool wants_to_let_go() const { return holds_ && paddles_ == Paddles::open; }
  void let_go() { holds_ = false; }
  // Ends the order to open.
  void refuse() { paddles_ = Paddles::halt; }

  [[nodiscard]] double opening() const { return opening_; }                 // Share, 0 to 1.
  [[nodiscard]] double lift() const { return lift_; }                       // Share, 0 to 1.
  [[nodiscard]] double gap() const { return opening_ * gripper_.opening; }  // [m]
  [[nodiscard]] bool paddles_move() const { return paddles_ == Paddles::open || paddles_ == Paddles::close; }
  [[nodiscard]] bool lift_moves() const { return to_ == Lift::up || to_ == Lift::down; }
  [[nodiscard]] bool holds() const { return holds_; }
  // Returns whether what stands on the floor is between the paddles, not below them.
  [[nodiscard]] bool is_low() const { return lift_ < 0.5; }

  void add_to(Fnv1a& hash) const {
    for (const double value : {opening_, lift_}) hash.add_u64(std::bit_cast<std::uint64_t>(value));
    for (const int value : {static_cast<int>(paddles_), static_cast<int>(to_), holds_ ? 1 : 0})
      hash.add_u64(static_cast<std::uint64_t>(value));
  }

 private:
  static double share_of(double seconds, Duration whole) { return seconds / to_seconds(whole); }

  // Ends what has arrived. A share is a sum, and as far from 0 or 1 as its roundings.
  void settle() {
    constexpr double kRounding = 1e-9;
    if (opening_ < kRounding) opening_ = 0.0;
    if (opening_ > 1.0 - kRounding) opening_ = 1.0;
    if (lift_ < kRounding) lift_ = 0.0;
    if (lift_ > 1.0 - kRounding) lift_ = 1.0;
    if (paddles_ == Paddles::close && (opening_ == 0.0 || holds_)) paddles_ = Paddles::halt;
    if (paddles_ == Paddles::open && opening_ == 1.0 && !holds_) paddles_ = Paddles::halt;
    if ((to_ == Lift::up && lift_ == 1.0) || (to_ == Lift::down && lift_ == 0.0)) to_ = Lift::halt;
  }

  Gripper gripper_;
  double opening_ = 1.0;
  double lift_ = 0.0;
  Paddles paddles_ = Paddles::halt;
  Lift to_ = Lift::halt;
  bool holds_ = false;
};

}  // namespace orca::sim::detail
