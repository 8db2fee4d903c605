// SPDX-License-Identifier: GPL-3.0-or-later
// A beam whose spot lies on the edge of a near obstacle in front of a far wall.
#include <catch2/catch.hpp>

#include "laser.hpp"
#include "sensors/laser_model.hpp"

using namespace orca::sim;
using namespace orca::sim::test;

namespace {

constexpr double kNear = 2.0;
constexpr double kFar = 3.0;
constexpr double kThin = 1e-4;  // So thin that the beam does not meet its side.
constexpr double kHalfSpot = 0.25 * kDegree;

// Returns the reading of the beam straight ahead if the near box ends at this angle from it and lies to its
// right.
double ahead_of_edge(double edge, double far = kFar) {
  LaserScanner laser = lms200();
  laser.divergence = 2.0 * kHalfSpot;
  const double top = kNear * std::tan(edge);
  const WorldModel world{"edge",
                         {{"near", Box{{kNear + 0.5 * kThin, top - 2.0, 0}, {0.5 * kThin, 2.0}}, 2.5},
                          {"far", Box{{far + 0.1, 0, 0}, {0.1, 20}}, 2.5}},
                         {}};
  const Caster caster(world);
  ErrorLevels errors;
  errors.mixed_pixels = true;
  detail::LaserModel model(laser, {}, errors, orca::RandomStream(1, "dewey", "laser"), {});
  const orca::TimePoint end = orca::TimePoint{} + laser.period;
  model.run(caster, static_cast<std::size_t>(-1), {{}, end, {}, {}});
  return model.completed().value().ranges[90];
}

}  // namespace

TEST_CASE("a spot on an edge reads as the mean of both depths, weighted by their shares", "[sim][laser]") {
  for (const double part : {-0.9, -0.5, -0.1, 0.1, 0.3, 0.7, 0.95}) {
    const double near_share = 0.5 * (1.0 + part);
    CAPTURE(part);
    // The halvings find the edge to 1/4096 of half the spot; beside it, the far wall is met obliquely.
    CHECK(ahead_of_edge(part * kHalfSpot) ==
          Approx(near_share * kNear + (1.0 - near_share) * kFar).margin(0.001));
  }
}

TEST_CASE("a spot on one surface reads its distance", "[sim][laser]") {
  CHECK(ahead_of_edge(1.1 * kHalfSpot) == Approx(kNear).margin(1e-9));
  CHECK(ahead_of_edge(-1.1 * kHalfSpot) == Approx(kFar).margin(1e-9));
}

TEST_CASE("a spot half on a surface and half in the void reads the surface", "[sim][laser]") {
  CHECK(ahead_of_edge(0.2 * kHalfSpot, 20.0) == Approx(kNear).margin(1e-9));
}
