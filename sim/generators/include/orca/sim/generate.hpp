// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <variant>

#include "orca/base/result.hpp"
#include "orca/sim/world_model.hpp"

namespace orca::sim {

/// Fields of cylinders like those of the BARN benchmark, in its frame: 30 x 30 cells of 0.15 m, x in
/// [-4.5, 0], y in [5.1, 9.6], filled at random and smoothed, with a free strip before it and one behind it.
/// Unlike BARN's they are closed all round. Values that are not given are drawn anew in each attempt at a
/// world with a way through it, so dense fields are rarer than thin ones.
struct BarnField {
  std::optional<double> fill{};  ///< Share of the cells filled at first; drawn from 0.15, 0.2, 0.25, 0.3.
  std::optional<std::size_t> rounds{};  ///< Number of smoothing rounds; drawn from 2 to 4.
};

/// A hall with a U of walls across the straight way from start to goal, open towards the start. The places of
/// start and goal across the hall are drawn, and so are changes of the U's width and depth (up to 20 %).
struct UTrap {
  double width = 2.0;   ///< [m] Inner width of the U.
  double depth = 2.0;   ///< [m] Inner depth of the U.
  double beside = 1.5;  ///< [m] Width of the free way on either side of the U.
};

/// A hall divided by walls with one door each. The place of each door in its wall is drawn.
struct NarrowDoors {
  double door = 0.8;      ///< [m] Width of each door.
  std::size_t walls = 3;  ///< Number of walls.
  double spacing = 3.0;   ///< [m] Distance from wall to wall.
  double width = 6.0;     ///< [m] Width of the hall.
};

/// A corridor with right-angled bends. The length of each leg and the direction of each bend are drawn.
struct Corridor {
  double width = 1.5;     ///< [m] Clear width.
  std::size_t legs = 7;   ///< Number of straight pieces.
  double shortest = 3.5;  ///< [m] Least length of a leg, on the centre line.
  double longest = 6.0;   ///< [m] Greatest length of a leg, on the centre line.
};

/// A floor with a corridor and rooms on either side. The rooms' widths, the places of their doors, the
/// furniture, and the room with the goal are drawn. The world also has the places "room_1" and so on, in the
/// rooms' middles.
struct OfficeFloor {
  std::size_t rooms = 3;      ///< Number of rooms on each side.
  double door = 0.95;         ///< [m] Width of each door.
  double corridor = 2.0;      ///< [m] Clear width.
  std::size_t furniture = 3;  ///< Number of pieces in each room.
};

using Family = std::variant<BarnField, UTrap, NarrowDoors, Corridor, OfficeFloor>;

/// Returns the world number `seed` of a family, with the places "start" and "goal". A round robot of `radius`
/// can get from its start to each of its places. A draw without such ways is discarded for the next, at most
/// 100 times.
///
/// The same values give the same world on every machine, because the draw uses only integers and basic
/// arithmetic.
///
/// @param radius [m]  > 0.
/// @errors  invalid_argument: a value that no such world can have. unavailable: 100 draws without a way.
[[nodiscard]] Result<WorldModel> generate(const Family& family, std::uint64_t seed, double radius = 0.3);

}  // namespace orca::sim
