// SPDX-License-Identifier: LGPL-3.0-or-later
#include "p2os_gripper.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace orca::emulators {
namespace {

constexpr int kMostCarrySteps = 255;
constexpr Duration kCarryStep = 20ms;

constexpr int kGripper = 33;
constexpr int kGripperval = 36;
constexpr int kPacketRequest = 37;
constexpr std::uint8_t kPacket = 0xE0;

enum class GripperAction {
  open = 1,
  close = 2,
  stop = 3,
  up = 4,
  down = 5,
  stop_lift = 6,
  store = 7,
  deploy = 8,
  halt = 15,
  carry = 17
};

unsigned bit(bool value, int number) { return (value ? 1U : 0U) << number; }

}  // namespace

bool P2osGripper::take(int number, int value, TimePoint now) {
  const bool is_time = std::exchange(awaits_time_, false);
  if (number == kPacketRequest) {
    packets_ = value;
    return true;
  }
  if (number != kGripper && number != kGripperval) return false;
  if (locked_) return true;
  if (number == kGripper) {
    act(value);
  } else if (is_time) {
    carry(value, now);
  }
  return true;
}

void P2osGripper::act(int action) {
  switch (static_cast<GripperAction>(action)) {
    case GripperAction::open: return body_.move_gripper(GripperMove::open);
    case GripperAction::close: return body_.move_gripper(GripperMove::close);
    case GripperAction::stop: return body_.move_gripper(GripperMove::stop);
    case GripperAction::up: return move_lift(GripperMove::up);
    case GripperAction::down: return move_lift(GripperMove::down);
    case GripperAction::stop_lift: return move_lift(GripperMove::stop_lift);
    case GripperAction::store: body_.move_gripper(GripperMove::close); return move_lift(GripperMove::up);
    case GripperAction::deploy: body_.move_gripper(GripperMove::open); return move_lift(GripperMove::down);
    case GripperAction::halt: return halt();
    case GripperAction::carry: awaits_time_ = true; return;
    default: return;
  }
}

void P2osGripper::move_lift(GripperMove move) {
  carry_end_.reset();
  body_.move_gripper(move);
}

void P2osGripper::carry(int steps, TimePoint now) {
  if (steps == 0) return;
  move_lift(steps > 0 ? GripperMove::up : GripperMove::down);
  carry_end_ = now + std::min(std::abs(steps), kMostCarrySteps) * kCarryStep;
}

void P2osGripper::halt() {
  awaits_time_ = false;
  body_.move_gripper(GripperMove::stop);
  move_lift(GripperMove::stop_lift);
}

void P2osGripper::forget_host() {
  halt();
  packets_ = 0;
}

// The grasp time is 0: closing ends as soon as both paddles are touched.
std::optional<std::vector<std::uint8_t>> P2osGripper::take_packet() {
  if (packets_ <= 0) return std::nullopt;
  if (packets_ == 1) packets_ = 0;
  return std::vector<std::uint8_t>{kPacket, static_cast<std::uint8_t>(kind()), digital_in(), 0};
}

void P2osGripper::lock(bool locked) {
  locked_ = locked;
  if (locked) halt();
}

void P2osGripper::advance(TimePoint now) {
  if (carry_end_ && now >= *carry_end_) move_lift(GripperMove::stop_lift);
}

std::uint8_t P2osGripper::state() const {
  const std::optional<GripperLook> look = body_.gripper();
  if (!look) return 0;
  return static_cast<std::uint8_t>(bit(look->open, 0) | bit(look->closed, 1) | bit(look->paddles_move, 2) |
                                   bit(look->up, 4) | bit(look->down, 5) | bit(look->lift_moves, 6));
}

// Beams are 1 when they are interrupted; switches are 0 when they are pressed: those at the open end of the paddles, at either
// end of the lift, and on the paddles.
std::uint8_t P2osGripper::digital_in() const {
  const std::optional<GripperLook> look = body_.gripper();
  if (!look) return 0;
  return static_cast<std::uint8_t>(bit(!look->open, 0) | bit(!look->up && !look->down, 1) |
                                   bit(look->outer_beam, 2) | bit(look->inner_beam, 3) |
                                   bit(!look->left_contact, 4) | bit(!look->right_contact, 5));
}

}  // namespace orca::emulators
