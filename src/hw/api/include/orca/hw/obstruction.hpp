// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "orca/geometry/twist2.hpp"
#include "orca/geometry/vec2.hpp"

namespace orca::hw {

/// The sense by which a base notices that it cannot go on.
enum class Hindrance : std::uint8_t {
  touch,  ///< A bumper, or a touch that it feels otherwise.
  stall   ///< Its motors do not turn although they should.
};

/// What a base has met, and which commands must therefore not be carried out: those that go on in the direction in which
/// it met something, and those towards a bumper that is pressed.
///
/// Thread contract: none of its own.
class Obstruction {
 public:
  /// A bumper switch that something touches.
  struct Pressed {
    Vec2 outwards;     ///< Direction from the robot to what touches it, robot frame, of length 1.
    std::string name;  ///< For people: "front left".
  };

  /// Notes that the base met something, or was stalled, while it moved so. A standing base notes nothing.
  void meet(const Twist2& velocity, const std::string& reason, Hindrance by = Hindrance::touch);

  /// Replaces the bumpers that are pressed now.
  void press(std::vector<Pressed> bumpers);

  /// Returns why the base must not move so; nothing if it may. A velocity that leads another way than the one on which it
  /// met something ends that obstruction.
  [[nodiscard]] std::optional<std::string> against(const Twist2& velocity);

  /// Returns why the base is hindered, or was since the last call with this sense; nothing: it is not. It is hindered by what it has met until it moves
  /// another way, and by a bumper as long as that is pressed.
  [[nodiscard]] std::optional<std::string> take_hindrance(Hindrance by);

 private:
  [[nodiscard]] bool goes_on(const Twist2& velocity) const;

  std::vector<Pressed> pressed_;
  std::optional<Twist2> met_while_;
  std::string reason_;
  Hindrance met_by_ = Hindrance::touch;
  std::array<std::optional<std::string>, 2> felt_;  // by sense: since somebody has asked
};

}  // namespace orca::hw
