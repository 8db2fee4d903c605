// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "orca/geometry/angle.hpp"
#include "turret_sweep/sweep.hpp"

using orca::turret::next_angle;

namespace {

constexpr double kLead = 0.5 * std::numbers::pi;
constexpr orca::Twist2 kDrives{0.3, 0.0, 0.0};

}  // namespace

TEST_CASE("while the robot drives, turns or slides, its turret is pointed ahead of itself",
          "[components][turret_sweep]") {
  for (const orca::Twist2 twist :
       {kDrives, -1.0 * kDrives, orca::Twist2{0.0, 0.3, 0.0}, orca::Twist2{0.0, 0.0, -0.5}}) {
    CHECK(next_angle(twist, 0.2, kLead) == Approx(0.2 + kLead));
    CHECK(next_angle(twist, 0.2, -kLead) == Approx(0.2 - kLead));
  }
}

TEST_CASE("the turret of a robot that rests is pointed ahead, and of any with a lead of 0",
          "[components][turret_sweep]") {
  CHECK(next_angle({}, 1.0, kLead) == 0.0);
  CHECK(next_angle({0.005, 0.0, 0.01}, 1.0, kLead) == 0.0);  // the noise of wheels that stand
  CHECK(next_angle(kDrives, 1.0, 0.0) == 0.0);
}

TEST_CASE("a turret that turns the shorter way goes round and round, to the side of its lead",
          "[components][turret_sweep]") {
  constexpr double kStep = 0.05;  // [rad] in a lap
  const double lead = GENERATE(kLead, -kLead);
  double angle = 0.0;
  double turned = 0.0;
  for (int lap = 0; lap < 1000; ++lap) {
    const double wanted = next_angle(kDrives, angle, lead);
    REQUIRE(std::fabs(wanted) <= std::numbers::pi);
    const double step = std::copysign(kStep, orca::wrapped(wanted - angle));
    turned += step;
    angle = orca::wrapped(angle + step);
  }
  CHECK(turned == Approx(std::copysign(1000 * kStep, lead)));
}
