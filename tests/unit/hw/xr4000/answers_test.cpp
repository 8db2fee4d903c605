// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/hw/xr4000/answers.hpp"
#include "orca/hw/xr4000/request.hpp"
#include "xr4000_bytes.hpp"

using namespace orca;
using namespace orca::hw::test;
using namespace orca::hw::xr4000;
using namespace std::chrono_literals;
using Catch::Contains;

TEST_CASE("an XR4000's agent says its version and its robot", "[hw][xr4000]") {
  const HeldXrMessage answer(kXrHelloAnswer);
  const auto agent = parse_hello(answer.message);
  REQUIRE(agent);
  CHECK(agent->version == 1);
  CHECK(agent->robot_type == 'x');
}

TEST_CASE("an XR4000's state is status, clock, integrator and speeds", "[hw][xr4000]") {
  const HeldXrMessage answer(kXrStateAnswer);
  const auto state = parse_state(answer.message);
  REQUIRE(state);
  CHECK(state->status == 0);
  CHECK(state->time == 123456);
  CHECK(state->integrator == Axes{-500, 1250, 785});
  CHECK(state->speeds == Axes{-100, 300, -50});
}

TEST_CASE("an XR4000's sonars are read set after set, with those that hear nothing", "[hw][xr4000]") {
  const HeldXrMessage answer(kXrSonarAnswer);
  const auto sonars = parse_sonars(answer.message);
  REQUIRE(sonars);
  for (std::size_t i = 0; i < 47; ++i) CHECK((*sonars)[i] == 508 + 25 * i);
  CHECK_FALSE((*sonars)[47]);
}

TEST_CASE("an XR4000's infrared sensors are read as they count", "[hw][xr4000]") {
  const HeldXrMessage answer(kXrInfraredAnswer);
  const auto infrared = parse_infrared(answer.message);
  REQUIRE(infrared);
  for (std::size_t i = 0; i < 48; ++i) CHECK((*infrared)[i] == i);
}

TEST_CASE("an XR4000 has 60 bumper switches, twelve in each even set and eight in each odd one",
          "[hw][xr4000]") {
  CHECK(switch_at(0) == Switch{0, 0});
  CHECK(switch_at(11) == Switch{0, 11});
  CHECK(switch_at(12) == Switch{1, 0});
  CHECK(switch_at(19) == Switch{1, 7});
  CHECK(switch_at(20) == Switch{2, 0});
  CHECK(switch_at(59) == Switch{5, 7});
  const HeldXrMessage answer(kXrBumperAnswer);
  const auto bumpers = parse_bumpers(answer.message);
  REQUIRE(bumpers);
  for (std::size_t i = 0; i < kSwitches; ++i) {
    const Touch expected = i == 3 ? Touch::low : i == 59 ? Touch::high : Touch::none;
    CHECK((*bumpers)[i] == expected);
  }
}

TEST_CASE("a bumper switch that reads what there is not is refused", "[hw][xr4000]") {
  Bytes payload(61);
  payload[5] = 3;
  const auto bumpers = parse_bumpers({Type::get_bumper, true, payload});
  REQUIRE_FALSE(bumpers);
  CHECK(bumpers.error().code == Code::data_loss);
  CHECK_THAT(bumpers.error().message, Contains("a bumper switch with the reading 3"));
}

TEST_CASE("an XR4000's battery has four channels", "[hw][xr4000]") {
  const HeldXrMessage answer(kXrBatteryAnswer);
  const auto batteries = parse_batteries(answer.message);
  REQUIRE(batteries);
  CHECK(*batteries == BatteryReadings{480, 481, 0, 65535});
}

TEST_CASE("an answer that says that the library has failed is an error that names the code", "[hw][xr4000]") {
  const HeldXrMessage answer("58 52 01 00 82 FA DB C1");  // -6
  const auto state = parse_state(answer.message);
  REQUIRE_FALSE(state);
  CHECK(state.error().code == Code::unavailable);
  CHECK_THAT(state.error().message, Contains("-6 (connection failed)"));
  CHECK(text_of(Returned::ok) == "0 (ok)");
  CHECK(text_of(Returned::axes_not_ready) == "-10 (axes not ready)");
  CHECK(text_of(static_cast<Returned>(-16)) == "-16 (connection exists)");
  CHECK(text_of(static_cast<Returned>(-17)) == "-17");
  CHECK(text_of(static_cast<Returned>(1)) == "1");
}

TEST_CASE("answers that are cut short, empty, of another request or none are refused", "[hw][xr4000]") {
  const HeldXrMessage answer(kXrStateAnswer);
  Message message = answer.message;
  for (std::size_t size = 1; size < message.payload.size(); ++size) {
    message.payload = answer.message.payload.first(size);
    CHECK(parse_state(message).error().code == Code::data_loss);
  }
  message.payload = {};
  CHECK(parse_state(message).error().code == Code::data_loss);
  CHECK(returned_of(message).error().code == Code::data_loss);
  CHECK(parse_sonars(answer.message).error().code == Code::invalid_argument);
  const HeldXrMessage request(kXrGetState);
  CHECK(parse_state(request.message).error().code == Code::invalid_argument);
}

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
