// SPDX-License-Identifier: LGPL-3.0-or-later
#include "diagram.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "orca/base/portable_math.hpp"
#include "orca/geometry/angle.hpp"

namespace orca::nd {
namespace {

constexpr double kNothing = std::numeric_limits<double>::infinity();

struct Bearing {
  Vec2 place;
  double angle;  // [rad]
};

std::size_t wrapped_sector(long k) {
  const long n = static_cast<long>(kSectors);
  return static_cast<std::size_t>((k % n + n) % n);
}

// Fills the sectors whose middle a surface between two echoes crosses.
void fill_between(const Bearing& one, const Bearing& other, Depths& depths) {
  const double angle = wrapped(other.angle - one.angle);
  const double right = angle >= 0.0 ? one.angle : other.angle;
  const Vec2 along = other.place - one.place;
  const double off = cross(one.place, along);
  const long last = std::lround(std::floor((right + std::abs(angle)) / kSector));
  for (long k = std::lround(std::ceil(right / kSector)); k <= last; ++k) {
    const std::size_t sector = wrapped_sector(k);
    const double across = cross(direction(direction_of(sector)), along);
    if (across != 0.0) depths[sector] = std::min(depths[sector], std::abs(off / across));
  }
}

// Two depths of infinity differ by what is not a number, which is more than nothing.
bool is_gap(double one, double other, double jump) { return std::abs(one - other) > jump; }

std::vector<std::size_t> gaps(const Depths& depths, double jump) {
  std::vector<std::size_t> found;  // each to the left of that sector
  for (std::size_t k = 0; k < kSectors; ++k)
    if (is_gap(depths[k], depths[left_of(k, 1)], jump)) found.push_back(k);
  return found;
}

}  // namespace

double direction_of(std::size_t sector) {
  const auto k = static_cast<double>(sector);
  return sector <= kSectors / 2 ? k * kSector : -(static_cast<double>(kSectors) - k) * kSector;
}

std::size_t sector_of(double direction) { return wrapped_sector(std::lround(direction / kSector)); }

Depths depths(std::span<const Vec2> echoes, double joined) {
  Depths depths;
  depths.fill(kNothing);
  std::vector<Bearing> bearings;
  for (const Vec2 echo : echoes) {
    bearings.push_back({echo, portable::atan2(echo.y, echo.x)});
    double& depth = depths[sector_of(bearings.back().angle)];
    depth = std::min(depth, norm(echo));
  }
  for (std::size_t i = 0; i < bearings.size(); ++i) {
    for (std::size_t j = i + 1; j < bearings.size(); ++j) {
      const Vec2 apart = bearings[j].place - bearings[i].place;
      if (dot(apart, apart) < joined * joined) fill_between(bearings[i], bearings[j], depths);
    }
  }
  return depths;
}

double Region::middle() const {
  return wrapped(direction_of(right) + 0.5 * kSector * static_cast<double>(width - 1));
}

std::vector<Region> regions(const Depths& depths, double jump) {
  const std::vector<std::size_t> borders = gaps(depths, jump);
  if (borders.empty())
    return std::isinf(depths[0]) ? std::vector<Region>{{0, kSectors}} : std::vector<Region>{};
  std::vector<Region> found;
  for (std::size_t i = 0; i < borders.size(); ++i) {
    const std::size_t right = left_of(borders[i], 1);
    const std::size_t left = borders[(i + 1) % borders.size()];
    const Region region{right, (left + kSectors - right) % kSectors + 1, depths[borders[i]] < depths[right],
                        depths[left_of(left, 1)] < depths[left]};
    if (region.rises_right || region.rises_left) found.push_back(region);
  }
  return found;
}

}  // namespace orca::nd
