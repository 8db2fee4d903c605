// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/hw/xr4000/odometry.hpp"

using namespace orca;
using namespace orca::hw::xr4000;

TEST_CASE("an XR4000's pose begins at 0, wherever its integrator is", "[hw][xr4000]") {
  IntegratorOdometry odometry;
  odometry.add({1000, -2000, 1571});
  CHECK(odometry.pose().x == Approx(0.0).margin(1e-12));
  CHECK(odometry.pose().y == Approx(0.0).margin(1e-12));
  CHECK(odometry.pose().yaw == Approx(0.0).margin(1e-12));
}

TEST_CASE("an XR4000's pose follows its integrator, in the frame in which it began", "[hw][xr4000]") {
  IntegratorOdometry odometry;
  odometry.add({0, 0, 0});
  odometry.add({-500, 1250, 785});
  CHECK(odometry.pose().x == Approx(1.25));
  CHECK(odometry.pose().y == Approx(0.5));
  CHECK(odometry.pose().yaw == Approx(0.785));
  IntegratorOdometry turned;  // It looks along the integrator's -x axis, which is to the left.
  turned.add({0, 0, 1571});
  turned.add({-1000, 0, 1571});
  CHECK(turned.pose().x == Approx(1.0).margin(1e-6));
  CHECK(turned.pose().y == Approx(0.0).margin(1e-3));
}

TEST_CASE("an XR4000's pose goes on from where it was when the integrator begins anew", "[hw][xr4000]") {
  IntegratorOdometry odometry;
  odometry.add({0, 0, 0});
  odometry.add({0, 700, 0});
  odometry.forget();
  odometry.add({5000, 5000, 3000});
  CHECK(odometry.pose().x == Approx(0.7));
  CHECK(odometry.pose().y == Approx(0.0).margin(1e-12));
  CHECK(odometry.pose().yaw == Approx(0.0).margin(1e-12));
}
