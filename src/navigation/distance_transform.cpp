// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/navigation/distance_transform.hpp"

#include <algorithm>
#include <cstddef>

namespace orca::nav {
namespace {

// Returns the quotient rounded down. @pre divisor > 0.
constexpr std::int32_t floor_division(std::int32_t number, std::int32_t divisor) {
  const std::int32_t quotient = number / divisor;
  return quotient - ((number % divisor != 0 && number < 0) ? 1 : 0);
}

}  // namespace

std::span<const std::int32_t> DistanceTransform::operator()(std::span<const std::uint8_t> obstacles,
                                                            int columns, int rows, int reach) {
  squared_.resize(obstacles.size());
  along_.resize(obstacles.size());
  place_.resize(static_cast<std::size_t>(columns));
  begin_.resize(static_cast<std::size_t>(columns));
  measure_columns(obstacles, columns, rows, reach);
  for (int row = 0; row < rows; ++row) measure_row(row, columns, reach);
  return squared_;
}

// Sweeps all columns at once, row by row, as the memory lies.
void DistanceTransform::measure_columns(std::span<const std::uint8_t> obstacles, int columns, int rows,
                                        int reach) {
  const std::int32_t none = reach + 1;
  const auto width = static_cast<std::size_t>(columns);
  for (std::size_t i = 0; i < obstacles.size(); ++i) {
    const std::int32_t above = i < width ? none : std::min(along_[i - width] + 1, none);
    along_[i] = obstacles[i] != 0 ? 0 : above;
  }
  for (std::size_t i = obstacles.size() - std::min(obstacles.size(), width); rows > 1 && i-- > 0;)
    along_[i] = std::min(along_[i], along_[i + width] + 1);
}

// Finds the lower envelope of the parabolas (x - column)^2 + along^2 of the columns that have something within reach.
void DistanceTransform::measure_row(int row, int columns, int reach) {
  const std::size_t first = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns);
  const std::int32_t* along = along_.data() + first;
  std::int32_t* squared = squared_.data() + first;
  int count = 0;
  for (std::int32_t x = 0; x < columns; ++x) {
    if (along[x] > reach) continue;
    const std::int32_t height = along[x] * along[x] + x * x;
    std::int32_t begin = 0;
    while (count > 0) {
      const std::int32_t other = place_[static_cast<std::size_t>(count - 1)];
      // From the next whole number after the intersection on, the new one is lower.
      begin = floor_division(height - along[other] * along[other] - other * other, 2 * (x - other)) + 1;
      if (begin > begin_[static_cast<std::size_t>(count - 1)]) break;
      --count;
      begin = 0;
    }
    if (begin >= columns) continue;
    place_[static_cast<std::size_t>(count)] = x;
    begin_[static_cast<std::size_t>(count)] = begin;
    ++count;
  }
  if (count == 0) return std::fill(squared, squared + columns, kFar);
  for (std::int32_t x = columns - 1, i = count - 1; x >= 0; --x) {
    const std::int32_t off = x - place_[static_cast<std::size_t>(i)];
    const std::int32_t up = along[place_[static_cast<std::size_t>(i)]];
    squared[x] = off * off + up * up;
    if (x == begin_[static_cast<std::size_t>(i)] && i > 0) --i;
  }
}

}  // namespace orca::nav
