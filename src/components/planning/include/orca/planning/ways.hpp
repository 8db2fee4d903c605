// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "orca/geometry/vec2.hpp"
#include "orca/navigation/known_map.hpp"
#include "orca/navigation/occupancy_map.hpp"

namespace orca::planning {

/// The opening of a door.
struct Doorway {
  double direction = 0.0;  ///< [rad] that leads through it; the opposite one does too.
  double width = 0.0;      ///< [m]
};

/// A named place of a topological map (thesis 8.3: GoalPoint, Door).
struct WayPoint {
  std::string name;
  Vec2 place;                     ///< [m] The middle of the opening, for a door.
  std::optional<Doorway> door{};  ///< Nothing: it is no door.
  /// The rooms that it is in. A door has one behind it and one to which its direction leads; a place has the same twice.
  std::array<std::string, 2> rooms{};
};

/// A leg from one place to another that robots drive without passing a door. At a door it leads off on one side, and who comes by it goes
/// on by a leg on the other side.
struct WayLeg {
  std::size_t from = 0;  ///< Index of a WayPoint.
  std::size_t to = 0;
  double cost = 0.0;     ///< [m] that a robot drives.
  bool one_way = false;  ///< Whether it leads from `from` to `to` only.
  std::size_t from_side =
      0;  ///< Side of the door that it begins at: 1 where its direction points, 0 behind; 0 for a place.
  std::size_t to_side = 0;  ///< Likewise for the door that it leads to.
};

/// Returns the side of a point on which a room lies: of a door 1 where its direction points, otherwise 0.
[[nodiscard]] std::size_t side_of(const WayPoint& point, std::string_view room);

/// A topological map: places, doors and the legs between them. A plain value.
struct Ways {
  std::string name;
  std::vector<WayPoint> points;
  std::vector<WayLeg> legs;

  /// Returns the index of the point of that name.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view point) const;
};

/// A way through a topological map.
struct FoundWay {
  std::vector<std::size_t> points;  ///< In the order in which they are passed.
  std::vector<double> costs;        ///< For getting to each of them from the one before, or from the start.
  double cost = 0.0;                ///< In all, up to the goal.
};

/// The costs of driving besides the legs. Numbers may be infinite: then no way leads there.
struct WayTolls {
  /// From the start to each side of each point, without passing another one: 2 * point + side. Only side 0 of a place counts.
  std::span<const double> from_start;
  std::span<const double> to_goal;  ///< From each side of each point to the goal, likewise.
  std::span<const double> points;   ///< For passing each point, in addition.
  std::span<const double> legs;     ///< For each leg, in addition, in either direction.
};

/// Finds the cheapest way from a start to a goal that need not be points of the map. Among equally cheap ways it takes the one with
/// fewer points; the result depends on nothing but the arguments.
/// @return nothing if no way leads there.
/// @pre  the spans have two numbers for each point, one for each point, and one for each leg; no number is negative; costs of legs are more than 0.
/// @thread  pure function; any thread.
/// @source  Dijkstra, "A note on two problems in connexion with graphs", Numerische Mathematik 1, 1959.
[[nodiscard]] std::optional<FoundWay> cheapest_way(const Ways& ways, const WayTolls& tolls);

/// Returns what driving costs from a place to each side of each point, as WayTolls has it, by the lengths of ways through the free cells of a map that pass no door;
/// infinite where none leads. A door that the place is in counts as passed. Ways keep 0.15 m off what is occupied, except within
/// 0.4 m of the place.
/// @param place [m]  in the frame of the grid, as the points are.
/// @thread  pure function; any thread.
[[nodiscard]] std::vector<double> costs_from(const nav::FloorGrid& grid, const Ways& ways, Vec2 place);

/// The part of a doorway that a scan has looked at.
struct DoorView {
  int through = 0;      ///< Beams that lead through it.
  int stopped = 0;      ///< Beams that end in it: at a leaf, or at somebody who stands there.
  double extent = 0.0;  ///< [m] across the doorway, from the first of these beams to the last.

  /// Returns whether the door is open; nothing if too little of it was seen.
  /// @param width [m]  of the opening.
  [[nodiscard]] std::optional<bool> is_open(double width) const;
};

/// Looks at the middle of a doorway, 0.7 of its width, with the beams of a scan. Beams that cross it at more than 60 degrees from its axis do not count: they end at the jambs or
/// at an open leaf.
/// @param door  a point with a door, in the frame of the beams.
/// @thread  pure function; any thread.
[[nodiscard]] DoorView look_at(const WayPoint& door, std::span<const nav::Beam> beams);

}  // namespace orca::planning
