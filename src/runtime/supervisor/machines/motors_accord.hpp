// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "orca/idl/machines.hpp"

namespace orca::supervisor {

/// The emergency stop of a system of several machines, as one of them knows it. An operator gives an order, to stop or to
/// release, on any machine; it gets a number above all that are known, and each machine repeats the latest that it knows
/// until the others have it, too. So a machine that was cut off, or whose deployer was started anew, obeys as soon as it
/// is heard. Of two orders with one number the stop counts.
///
/// Thread contract: not synchronised. It has no clock.
class MotorsAccord {
 public:
  /// An order about all motors of the system.
  struct Order {
    std::uint64_t number = 0;
    bool holds = false;  ///< Else it releases.
  };
  /// What a machine has made of the latest order.
  struct Word {
    std::string machine;
    idl::MotorsOutcome outcome = idl::MOTORS_PENDING;
  };

  /// @param here    name of this machine.
  /// @param others  names of the others.
  MotorsAccord(std::string here, const std::vector<std::string>& others);

  /// Takes an operator's order. @return its number.
  std::uint64_t order(bool holds);
  /// Returns an order that this machine has to carry out, once.
  [[nodiscard]] std::optional<Order> take_order();
  /// Notes what has become of an order on this machine. One that is not the latest any more is left alone.
  void note(std::uint64_t number, idl::MotorsOutcome outcome);

  /// Takes what another machine says.
  /// @param is_gathering  whether this machine does not know all others yet. A stop that it has been given so early is
  ///                      later than what the others tell of the time before, and what they have released then is no
  ///                      reason to let go of anything here.
  void hear(const idl::MachineState& state, bool is_gathering);
  /// Writes what this machine has to say.
  void fill(idl::MachineState& state) const;

  /// Returns the latest order.
  [[nodiscard]] const Order& latest() const { return latest_; }
  /// Returns what all machines have made of it, this one first.
  [[nodiscard]] std::vector<Word> words() const;

 private:
  void take_over(const Order& order);
  void catch_up(const Order& order);

  const std::string here_;
  Order latest_;
  idl::MotorsOutcome outcome_ = idl::MOTORS_OBEYED;
  bool is_new_ = false;                            // and not carried out
  std::map<std::string, idl::MachineState> said_;  // by machine: the last of each
};

}  // namespace orca::supervisor
