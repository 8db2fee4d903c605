// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "orca/emulators/body.hpp"

namespace orca::emulators {

/// The layout of a laser's values, as its configuration has it.
struct LmsValues {
  std::uint8_t measuring_mode = 0;
  std::uint8_t unit = 0;  ///< 0: cm, 1: mm, 2: 10 cm.
};

/// The beams of a telegram, counted from 1 at the right.
struct LmsBeams {
  unsigned angle = 180;      ///< [deg]
  unsigned resolution = 50;  ///< [1/100 deg]
  unsigned first = 1;
  unsigned last = 1;
};

/// Returns the bits of a value that hold its distance; 0: the laser has no such measuring mode.
/// @thread  pure function, as all of this file.
[[nodiscard]] unsigned distance_mask(std::uint8_t measuring_mode);

/// Appends the number of values with their unit, and the values: each beam shows what the nearest beam of the mirror shows.
void add_values(std::vector<std::uint8_t>& payload, const MirrorTurn& turn, const LmsBeams& beams,
                LmsValues values);

/// Appends a number, its low byte first.
void append_u16(std::vector<std::uint8_t>& payload, unsigned value);

}  // namespace orca::emulators
