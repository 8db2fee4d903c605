// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "orca/base/time.hpp"
#include "orca/emulators/body.hpp"

namespace orca::emulators {

/// What a Pioneer's controller does with a gripper at its user ports: it moves paddles and lift, ends a lift's carry after
/// its time, and tells their state in two bytes of an information packet.
///
/// Thread contract: not synchronised.
/// @source  Pioneer Gripper manual, "AROS Gripper client command set", "Gripper state byte" and "User I/O DIGIN bits".
class P2osGripper {
 public:
  static constexpr unsigned kKind = 1;  ///< In the configuration; 0: no gripper.

  /// @param body  outlives the object.
  explicit P2osGripper(Body& body) : body_(body) {}

  /// Carries out a command if it is one of the gripper. It must see all others too: the time of a carry is the next command
  /// behind it, or none.
  /// @return  whether it was one of the gripper.
  bool take(int number, int value, TimePoint now);
  /// Stops paddles and lift.
  void halt();
  /// Stops both; the next host must ask for packets anew.
  void forget_host();
  /// Stops both and lets no command move them, or lets commands move them again.
  void lock(bool locked);
  /// Stops the lift at the end of a carry.
  void advance(TimePoint now);

  /// Each of these is 0 if the body has no gripper.
  [[nodiscard]] std::uint8_t state() const;
  [[nodiscard]] std::uint8_t digital_in() const;
  [[nodiscard]] unsigned kind() const { return body_.gripper() ? kKind : 0; }

  /// Returns the body of the gripper's own packet, if the host has asked for one, or for one with each server information packet. Where
  /// there is no gripper, it says so.
  std::optional<std::vector<std::uint8_t>> take_packet();

 private:
  void act(int action);
  void move_lift(GripperMove move);
  void carry(int steps, TimePoint now);

  Body& body_;
  bool locked_ = false;
  int packets_ = 0;           // that the host awaits: none, one, or more
  bool awaits_time_ = false;  // of a carry
  std::optional<TimePoint> carry_end_;
};

}  // namespace orca::emulators
