// SPDX-License-Identifier: LGPL-3.0-or-later
#include "histogram.hpp"

#include <algorithm>
#include <cmath>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"

namespace orca::vfh {
namespace {

constexpr double kPi = std::numbers::pi;

double distance(const Cell& cell) { return portable::hypot(cell.place.x, cell.place.y); }
double bearing(const Cell& cell) { return portable::atan2(cell.place.y, cell.place.x); }

std::size_t sector(long k) {
  const long n = static_cast<long>(kSectors);
  return static_cast<std::size_t>((k % n + n) % n);
}

// Directions relative to the robot's heading that its arcs leave free: phi_r and phi_l of the paper.
struct Reach {
  double right = -kPi;  // [rad]
  double left = kPi;    // [rad]
  // Straight behind can be reached by either turn.
  [[nodiscard]] bool holds(double aside) const {
    return (aside >= right && aside <= left) || aside - 2.0 * kPi >= right;
  }
};

// Equations 8 to 10. A cell on the right can only be in the way of an arc to the right, likewise on the left.
Reach reach(std::span<const Cell> cells, const Surroundings& around, const Motion& motion) {
  const Vec2 to_left = motion.radius * direction(motion.heading + 0.5 * kPi);
  const double too_near = motion.radius + around.radius;
  Reach free;
  for (const Cell& cell : cells) {
    if (magnitude(cell, around) <= 0.0) continue;
    const double aside = wrapped(bearing(cell) - motion.heading);
    const auto in_the_way = [&](Vec2 centre) { return norm(cell.place - centre) < too_near; };
    if (aside <= 0.0 && in_the_way(-1.0 * to_left)) free.right = std::max(free.right, aside);
    if (aside >= 0.0 && in_the_way(to_left)) free.left = std::min(free.left, aside);
  }
  return free;
}

}  // namespace

double apart(double one, double other) { return std::abs(wrapped(one - other)); }

double magnitude(const Cell& cell, const Surroundings& around) {
  const double d = distance(cell) / around.window;
  if (d > 1.0) return 0.0;
  const double b = around.near_weight - 1.0;  // per square of the window
  return cell.certainty * cell.certainty * (around.near_weight - b * d * d);
}

double enlargement(double distance, double radius) {
  return distance <= radius ? 0.5 * kPi : portable::asin(radius / distance);
}

Densities primary_histogram(std::span<const Cell> cells, const Surroundings& around) {
  Densities densities{};
  for (const Cell& cell : cells) {
    const double m = magnitude(cell, around);
    const double beta = bearing(cell);
    const double gamma = enlargement(distance(cell), around.radius);
    const long last = std::lround(std::floor((beta + gamma) / kSector));
    for (long k = std::lround(std::ceil((beta - gamma) / kSector)); k <= last; ++k) densities[sector(k)] += m;
  }
  return densities;
}

Blocked binary_histogram(const Densities& densities, const Blocked& before, const Thresholds& thresholds) {
  Blocked blocked = before;
  for (std::size_t k = 0; k < kSectors; ++k) {
    if (densities[k] > thresholds.high) blocked.set(k);
    if (densities[k] < thresholds.low) blocked.reset(k);
  }
  return blocked;
}

Blocked masked_histogram(const Blocked& binary, std::span<const Cell> cells, const Surroundings& around,
                         const Motion& motion) {
  if (motion.radius <= 0.0) return binary;
  const Reach free = reach(cells, around, motion);
  Blocked blocked = binary;
  for (std::size_t k = 0; k < kSectors; ++k) {
    const double aside = wrapped(static_cast<double>(k) * kSector - motion.heading);
    if (!free.holds(aside)) blocked.set(k);
  }
  return blocked;
}

}  // namespace orca::vfh
