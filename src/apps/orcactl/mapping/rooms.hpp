// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "orca/base/result.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/navigation/known_map.hpp"

namespace orca::orcactl::mapping {

/// A part of the floor that narrow passages separate from others.
struct Room {
  Vec2 middle;        ///< [m] The place that is farthest from all walls.
  double area = 0.0;  ///< [m2]
};

/// A narrow passage between two rooms: a door, as far as a map shows doors.
struct Passage {
  Vec2 middle;                         ///< [m]
  double direction = 0.0;              ///< [rad] that leads through it, from the first room into the second.
  double width = 0.0;                  ///< [m]
  std::array<std::size_t, 2> rooms{};  ///< Indices of the rooms.
};

/// A way through a room from one passage to another.
struct RoomLeg {
  std::size_t from = 0;  ///< Index of a passage.
  std::size_t to = 0;    ///< Likewise.
  std::size_t room = 0;
  double length =
      0.0;  ///< [m] of the shortest way that keeps 0.15 m off walls, at least that of the straight line.
};

/// The rooms of a map and the passages between them. A plain value.
struct Division {
  std::vector<Room> rooms;
  std::vector<Passage> passages;
  std::vector<RoomLeg> legs;
};

/// Divides the free floor of a map into rooms. They meet where the floor is narrowest, at passages from 0.5 m to 1.3 m wide. Rooms have
/// more than 1 m2 where a circle of 1.3 m fits. What stands free and is at most 2.5 m long is furniture, and makes no passages.
/// @errors  invalid_argument if the map has 2^24 cells or more.
/// @source  Watershed of the distance from walls: Beucher and Lantuéjoul, "Use of Watersheds in Contour Detection", 1979.
/// @thread  pure function; any thread.
[[nodiscard]] Result<Division> divide(const nav::FloorGrid& map);

/// Returns a division as a topological map (README of RouteServer) that people complete by hand: rooms and doors have numbers as names.
/// @param X_WM  frame of the division, in that of the goals.
/// @param name  of the map.
/// @pre  name is one that files of ways take.
/// @thread  pure function; any thread.
[[nodiscard]] std::string ways_text(const Division& division, const Pose2& X_WM, const std::string& name);

}  // namespace orca::orcactl::mapping
