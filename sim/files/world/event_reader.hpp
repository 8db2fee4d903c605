// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "orca/sim/event.hpp"
#include "orca/sim/world_model.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::sim::detail {

// Reads what happens in a world, and reports the errors in it.
class EventReader {
 public:
  explicit EventReader(xml::Reporter& reporter) : reporter_(reporter) {}

  // Returns whether an obstacle stands in the world for a part of the time.
  static bool is_visitor(const xml::Attributes& element);
  // @param shape  plan, in its own frame.
  void visitor(const xml::Attributes& element, Shape shape, const Pose2& X_WO, double height);
  void move(const xml::Attributes& element);
  void kidnap(const xml::Attributes& element);
  void outage(const xml::Attributes& element);
  void drain(const xml::Attributes& element);
  void open(const xml::Attributes& element) { turn(element, true); }
  void shut(const xml::Attributes& element) { turn(element, false); }

  // Returns what was read, after a look whether it fits together.
  // @param doors  of the world.
  Events take(const std::vector<Door>& doors);

 private:
  void turn(const xml::Attributes& element, bool opens);
  void check(const Move& move, const xml::Position& position);
  void check(const DoorTurn& turn, const std::vector<Door>& doors, const xml::Position& position);

  xml::Reporter& reporter_;
  Events events_;
  std::vector<xml::Position> move_positions_;
  std::vector<xml::Position> turn_positions_;
  xml::Position last_visitor_;
};

}  // namespace orca::sim::detail
