// SPDX-License-Identifier: LGPL-3.0-or-later
#include "colours.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

namespace orca::host {
namespace {

// None of them is near those of readings and marks.
constexpr Colour kChosen[] = {{0.55, 0.15, 0.65}, {0.85, 0.42, 0.0}, {0.0, 0.6, 0.65},  {0.5, 0.32, 0.1},
                              {0.95, 0.45, 0.7},  {0.5, 0.62, 0.05}, {0.4, 0.45, 0.55}, {0.15, 0.15, 0.45}};

constexpr double kGoldenRatio = 0.618033988749895;  // multiples of it are spread evenly over the hues
constexpr double kBrightness = 0.75;
constexpr double kSaturation = 0.8;

// Returns how much of a primary colour there is in a hue (1: all the way round), `offset` after red.
double share(double hue, double offset) {
  const double k = std::fmod(6.0 * hue + offset, 6.0);
  return kBrightness * (1.0 - kSaturation * std::clamp(std::min(k, 4.0 - k), 0.0, 1.0));
}

}  // namespace

Colour robot_colour(std::size_t number) {
  if (number < std::size(kChosen)) return kChosen[number];
  const double hue = std::fmod(kGoldenRatio * static_cast<double>(number), 1.0);
  return {share(hue, 5.0), share(hue, 3.0), share(hue, 1.0)};
}

}  // namespace orca::host
