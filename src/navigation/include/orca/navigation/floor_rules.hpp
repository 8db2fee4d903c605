// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "orca/geometry/pose2.hpp"
#include "orca/navigation/lattice.hpp"

namespace orca::nav {

/// A rectangle of the floor in which a rule holds.
struct FloorZone {
  enum class Kind : std::uint8_t {
    keep_out,  ///< Nobody drives in; who is there may leave.
    slow,      ///< At most `speed` is driven.
    lane,      ///< Ways lead along here if that is no detour of more than twice the length.
  };
  Kind kind = Kind::keep_out;
  std::string name;
  Pose2 middle;              ///< of the rectangle; its x axis is that of a lane.
  double half_length = 0.0;  ///< [m] along x.
  double half_width = 0.0;   ///< [m]
  double speed = 0.0;        ///< [m/s] largest, of a slow zone.
  bool one_way = false;      ///< A lane that is not driven against its x axis.

  [[nodiscard]] bool holds(Vec2 place) const;
};

/// Returns the bit of the direction of a step that is nearest to a direction, as in GridSearch and forbidden().
[[nodiscard]] std::uint8_t direction_bit(Vec2 direction);

/// The rules of a floor that no sensor sees, for planners and drivers.
///
/// A plain value; its const functions may be called from any thread.
class FloorRules {
 public:
  FloorRules() = default;
  explicit FloorRules(std::vector<FloorZone> zones) : zones_(std::move(zones)) {}

  [[nodiscard]] bool empty() const { return zones_.empty(); }
  [[nodiscard]] const std::vector<FloorZone>& zones() const { return zones_; }
  /// Returns the same rules in another frame.
  /// @param X_AB  the frame of this object's zones in the other one.
  [[nodiscard]] FloorRules in(const Pose2& X_AB) const;
  /// Returns the largest speed [m/s] allowed at a place; nothing if there is no limit.
  [[nodiscard]] std::optional<double> speed_at(Vec2 place) const;

  /// Changes the costs of cells: those to keep out of are closed, or dear if the robot is in their zone; a metre in a slow zone costs as much
  /// as the way that takes as long at 0.5 m/s; beside lanes, if there are any, a metre costs twice as much.
  /// @param costs  of each cell, for GridSearch.
  void apply(const Lattice& lattice, Vec2 robot, std::span<std::uint16_t> costs) const;
  /// Returns for each cell the directions in which no step may lead, as bits; none if all may.
  [[nodiscard]] std::vector<std::uint8_t> forbidden(const Lattice& lattice) const;

 private:
  std::vector<FloorZone> zones_;
};

}  // namespace orca::nav
