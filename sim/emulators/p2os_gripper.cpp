// SPDX-License-Identifier: LGPL-3.0-or-later
#include "p2os_gripper.hpp"

#include <initializer_list>

namespace orca::emulators {
namespace {

using Move = GripperMove;

// Bit 0 is the first.
std::uint8_t byte_of(std::initializer_list<bool> bits) {
  unsigned byte = 0;
  unsigned bit = 0;
  for (const bool set : bits) byte |= (set ? 1U : 0U) << bit++;
  return static_cast<std::uint8_t>(byte);
}

void move(Body& body, std::initializer_list<Move> moves) {
  for (const Move one : moves) body.move_gripper(one);
}

}  // namespace

void move_gripper(Body& body, int action) {
  switch (action) {
    case 1: return move(body, {Move::open});
    case 2: return move(body, {Move::close});
    case 3: return move(body, {Move::stop});
    case 4: return move(body, {Move::up});
    case 5: return move(body, {Move::down});
    case 6: return move(body, {Move::stop_lift});
    case 7: return move(body, {Move::close, Move::up});
    case 8: return move(body, {Move::open, Move::down});
    case 15: return halt_gripper(body);
    default: return;
  }
}

void halt_gripper(Body& body) { move(body, {Move::stop, Move::stop_lift}); }

// The inputs of ends and contacts are low when they are made, those of interrupted beams high.
GripperBytes gripper_bytes(const Body& body) {
  const auto look = body.gripper();
  if (!look) return {};
  return {
      byte_of({look->open, look->closed, look->paddles_move, false, look->up, look->down, look->lift_moves}),
      byte_of({!look->open, !(look->up || look->down), look->outer_beam, look->inner_beam,
               !look->left_contact, !look->right_contact})};
}

}  // namespace orca::emulators
