// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/hw/xr4000/request.hpp"
#include "xr4000_bytes.hpp"

using namespace orca;
using namespace orca::hw::test;
using namespace orca::hw::xr4000;
using namespace std::chrono_literals;

TEST_CASE("requests to the XR4000's agent are those of the page, byte for byte", "[hw][xr4000]") {
  CHECK(text_of(hello().view()) == kXrHello);
  CHECK(text_of(ask(Type::get_state).view()) == kXrGetState);
  CHECK(text_of(drive({-100, 300, 250}, {500, 500, 2000}).view()) == kXrSetAxes);
  CHECK(text_of(ask(Type::reset_motion_timer).view()) == kXrResetMotionTimer);
  CHECK(text_of(set_timer(500ms).view()) == kXrSetTimer);
  CHECK(text_of(set_integrator({1000, -2000, 1571}).view()) == kXrSetIntegrator);
  CHECK(text_of(ask(Type::get_sonar).view()) == kXrGetSonar);
  CHECK(text_of(ask(Type::get_infrared).view()) == kXrGetInfrared);
  CHECK(text_of(ask(Type::get_bumper).view()) == kXrGetBumper);
  CHECK(text_of(ask(Type::get_battery).view()) == kXrGetBattery);
}

TEST_CASE("a time-out of an XR4000's axes that no field holds is the nearest one", "[hw][xr4000]") {
  CHECK(text_of(message_of(set_timer(0s).view()).payload) == "01 00 00 00");
  CHECK(text_of(message_of(set_timer(-1s).view()).payload) == "01 00 00 00");
  CHECK(text_of(message_of(set_timer(2400h).view()).payload) == "FF FF FF FF");
}
