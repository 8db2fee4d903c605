// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace orca::nav {

/// The exact Euclidean distance transform of a grid, with buffers that are kept from call to call.
///
/// Thread contract: one thread at a time.
/// @source  Meijster, Roerdink and Hesselink, "A General Algorithm for Computing Distance Transforms in Linear Time", in
///          Mathematical Morphology and its Applications to Image and Signal Processing, Kluwer 2000.
class DistanceTransform {
 public:
  /// Squared distance of cells from which no obstacle is within reach.
  static constexpr std::int32_t kFar = INT32_MAX;

  /// Computes for each cell the squared distance to the nearest obstacle, in cells between the middles.
  /// @param obstacles  not 0: an obstacle; row by row.
  /// @param reach  [cells] beyond which the exact distance does not matter: then the result is any number above its square.
  /// @return squared distances, row by row, valid until the next call.
  /// @pre  obstacles.size() = columns * rows; 0 < reach < 30000.
  std::span<const std::int32_t> operator()(std::span<const std::uint8_t> obstacles, int columns, int rows,
                                           int reach);

 private:
  void measure_columns(std::span<const std::uint8_t> obstacles, int columns, int rows, int reach);
  void measure_row(int row, int columns, int reach);

  std::vector<std::int32_t> squared_;
  std::vector<std::int32_t> along_;  // distance within the column, squared by measure_row()
  std::vector<std::int32_t> place_;  // of the parabolas of the lower envelope
  std::vector<std::int32_t> begin_;  // of the part where each is lowest
};

}  // namespace orca::nav
