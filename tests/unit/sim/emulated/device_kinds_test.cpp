// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "device_kinds.hpp"

using namespace orca;
using namespace orca::sim;
using Catch::Contains;

TEST_CASE("a list of devices names the kind, the model and the line of each", "[emulated]") {
  const auto devices = read_devices("p2os pioneer;\n  p2os:p3dx second-robot_2 ; ");
  REQUIRE(devices);
  REQUIRE(devices->size() == 2);
  CHECK((*devices)[0].kind == "p2os");
  CHECK((*devices)[0].model.empty());
  CHECK((*devices)[0].place == "pioneer");
  CHECK((*devices)[1].kind == "p2os");
  CHECK((*devices)[1].model == "p3dx");
  CHECK((*devices)[1].place == "second-robot_2");
}

TEST_CASE("a device may listen in the network instead", "[emulated]") {
  const auto devices = read_devices("player listen:6665; p2os listen:0.0.0.0:8101");
  REQUIRE(devices);
  CHECK((*devices)[0].place == "listen:6665");
  CHECK((*devices)[1].place == "listen:0.0.0.0:8101");
}

TEST_CASE("what is no list of devices is refused with what is wrong", "[emulated]") {
  const auto refusal = [](const char* text) {
    const auto devices = read_devices(text);
    REQUIRE_FALSE(devices);
    CHECK(devices.error().code == Code::invalid_argument);
    return devices.error().message;
  };
  CHECK_THAT(refusal(""), Contains("no device is named; lines are a list such as \"p2os pioneer;"));
  CHECK_THAT(refusal(" ; "), Contains("no device is named"));
  CHECK_THAT(refusal("p2os"), Contains("\"p2os\" is no kind and name"));
  CHECK_THAT(refusal("p2os a b"), Contains("\"p2os a b\" is no kind and name"));
  CHECK_THAT(refusal("p2os ../x"), Contains("\"../x\" is no name of a line: letters, digits, _ and -"));
  CHECK_THAT(refusal("player listen:high"), Contains("\"high\" is no port; ports are 1 to 65535"));
  CHECK_THAT(refusal("p2os a; p2os a"), Contains("two lines have the name \"a\""));
}

TEST_CASE("a device of an unknown kind or model is refused with those that there are", "[emulated]") {
  const RobotModel robot;
  WorldBody body(robot, {.wheels = [](const Twist2&) {}});
  CHECK(make_firmware({"p2os", "", "x"}, body));
  CHECK(make_firmware({"p2os", "p2pb", "x"}, body));
  for (const char* const kind : {"create2", "nomad_scout", "rplidar", "sick_lms"}) {
    CAPTURE(kind);
    CHECK(make_firmware({kind, "", "x"}, body));
    CHECK_FALSE(make_firmware({kind, "p2dx", "x"}, body));
  }
  const auto kind = make_firmware({"p2oz", "", "x"}, body);
  REQUIRE_FALSE(kind);
  CHECK_THAT(kind.error().message,
             Contains("there is no emulation of \"p2oz\"; kinds: ") && Contains("did you mean \"p2os\"?"));
  const auto model = make_firmware({"p2os", "p2dy", "x"}, body);
  REQUIRE_FALSE(model);
  CHECK_THAT(model.error().message, Contains("there is no model \"p2dy\" of p2os; models: p2dx"));
}
