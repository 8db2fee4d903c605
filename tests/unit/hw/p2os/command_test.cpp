// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "hex_bytes.hpp"
#include "orca/base/random.hpp"
#include "orca/hw/p2os/command.hpp"

using namespace orca::hw;
using orca::Twist2;
using p2os::Command;
using p2os::WheelSteps;
using test::Bytes;
using test::hex;
using Argument = p2os::ReceivedCommand::Argument;

namespace {

std::string sent(const p2os::Packet& packet) { return test::text_of(packet.view()); }

p2os::ReceivedCommand received(const std::string& packet) {
  REQUIRE(p2os::look(hex(packet)).kind == framing::Finding::Kind::frame);
  static Bytes bytes;  // what is returned refers to it
  bytes = hex(packet);
  return p2os::decode_command(p2os::body_of(bytes)).value();
}

const p2os::Model& p2dx() { return p2os::choose_model("p2dx").model; }

constexpr double kDegrees = std::numbers::pi / 180.0;
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEST_CASE("the handshake is three packets of a number", "[hw][p2os]") {
  CHECK(sent(p2os::sync(0)) == "FA FB 03 00 00 00");
  CHECK(sent(p2os::sync(1)) == "FA FB 03 01 00 01");
  CHECK(sent(p2os::sync(2)) == "FA FB 03 02 00 02");
}

TEST_CASE("commands without an argument are a number", "[hw][p2os]") {
  CHECK(sent(encode(Command::pulse)) == "FA FB 03 00 00 00");
  CHECK(sent(encode(Command::open)) == "FA FB 03 01 00 01");
  CHECK(sent(encode(Command::close)) == "FA FB 03 02 00 02");
  CHECK(sent(encode(Command::seto)) == "FA FB 03 07 00 07");
  CHECK(sent(encode(Command::stop)) == "FA FB 03 1D 00 1D");
  CHECK(sent(encode(Command::estop)) == "FA FB 03 37 00 37");
}

TEST_CASE("integers are sent as a type for the sign and a magnitude", "[hw][p2os]") {
  CHECK(sent(encode(Command::open, 1)) == "FA FB 06 01 3B 01 00 02 3B");
  CHECK(sent(encode(Command::enable, 1)) == "FA FB 06 04 3B 01 00 05 3B");
  CHECK(sent(encode(Command::enable, 0)) == "FA FB 06 04 3B 00 00 04 3B");
  CHECK(sent(encode(Command::seta, 300)) == "FA FB 06 05 3B 2C 01 31 3C");
  CHECK(sent(encode(Command::seta, -300)) == "FA FB 06 05 1B 2C 01 31 1C");
  CHECK(sent(encode(Command::setv, 500)) == "FA FB 06 06 3B F4 01 FA 3C");
  CHECK(sent(encode(Command::vel, 200)) == "FA FB 06 0B 3B C8 00 D3 3B");
  CHECK(sent(encode(Command::vel, -200)) == "FA FB 06 0B 1B C8 00 D3 1B");
  CHECK(sent(encode(Command::rvel, 30)) == "FA FB 06 15 3B 1E 00 33 3B");
  CHECK(sent(encode(Command::rvel, -30)) == "FA FB 06 15 1B 1E 00 33 1B");
  CHECK(sent(encode(Command::head, 90)) == "FA FB 06 0C 3B 5A 00 66 3B");
  CHECK(sent(encode(Command::dhead, -45)) == "FA FB 06 0D 1B 2D 00 3A 1B");
  CHECK(sent(encode(Command::sonar, 1)) == "FA FB 06 1C 3B 01 00 1D 3B");
  CHECK(sent(encode(Command::sonar, 0)) == "FA FB 06 1C 3B 00 00 1C 3B");
  CHECK(sent(encode(Command::config, 1)) == "FA FB 06 12 3B 01 00 13 3B");
  CHECK(sent(encode(Command::hostbaud, 2)) == "FA FB 06 32 3B 02 00 34 3B");
  CHECK(sent(encode(Command::bumpstall, 3)) == "FA FB 06 2C 3B 03 00 2F 3B");
  CHECK(sent(encode(Command::setra, 100)) == "FA FB 06 17 3B 64 00 7B 3B");
}

TEST_CASE("lists of bytes are sent behind their length", "[hw][p2os]") {
  CHECK(sent(encode(Command::polling, hex("01 02 03")).value()) == "FA FB 08 03 2B 03 01 02 03 08 2F");
}

TEST_CASE("a list that no controller would take is refused with what to do", "[hw][p2os]") {
  CHECK(encode(Command::tty2, Bytes(190)).value().size() == 198);
  const auto refused = encode(Command::tty2, Bytes(191));
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == orca::Code::invalid_argument);
  CHECK(refused.error().message ==
        "a command with 191 bytes; the robot takes at most 190; send them in parts");
}

TEST_CASE("integers beyond 16 bits are limited and never wrap to the other sign", "[hw][p2os]") {
  CHECK(sent(encode(Command::vel, -40000)) == sent(encode(Command::vel, -32768)));
  CHECK(sent(encode(Command::digout, 70000)) == sent(encode(Command::digout, 65535)));
  CHECK(test::text_of(p2os::body_of(encode(Command::digout, 65535).view())) == "1E 3B FF FF");
}

TEST_CASE("speeds and turn rates are sent in mm/s and deg/s", "[hw][p2os]") {
  CHECK(sent(p2os::encode_speed(0.2)) == "FA FB 06 0B 3B C8 00 D3 3B");
  CHECK(sent(p2os::encode_speed(-0.1999)) == "FA FB 06 0B 1B C8 00 D3 1B");
  CHECK(sent(p2os::encode_turn_rate(30.4 * kDegrees)) == "FA FB 06 15 3B 1E 00 33 3B");
  CHECK(sent(p2os::encode_turn_rate(-30 * kDegrees)) == "FA FB 06 15 1B 1E 00 33 1B");
}

TEST_CASE("a speed that is no number stops the robot, and one beyond 16 bits keeps its sign", "[hw][p2os]") {
  CHECK(sent(p2os::encode_speed(kNan)) == sent(encode(Command::vel, 0)));
  CHECK(sent(p2os::encode_turn_rate(-std::numeric_limits<double>::infinity())) ==
        sent(encode(Command::rvel, 0)));
  CHECK(sent(p2os::encode_speed(1e9)) == sent(encode(Command::vel, 32767)));
  CHECK(sent(p2os::encode_speed(-1e9)) == sent(encode(Command::vel, -32767)));
}

TEST_CASE("both wheels are packed into one integer, the right one in its low byte", "[hw][p2os]") {
  CHECK(sent(p2os::encode_wheels({.left = 9, .right = 10})) == "FA FB 06 20 3B 0A 09 2A 44");
}

TEST_CASE("a negative right wheel does not borrow from the left one", "[hw][p2os]") {
  // 09 F6 as 16 bits; a sender that computes 256 * 9 - 10 would send 08 F6.
  CHECK(test::text_of(p2os::body_of(p2os::encode_wheels({.left = 9, .right = -10}).view())) == "20 3B F6 09");
  // FF05 is -251.
  CHECK(test::text_of(p2os::body_of(p2os::encode_wheels({.left = -1, .right = 5}).view())) == "20 1B FB 00");
}

TEST_CASE("wheel steps come back from any sender's integer", "[hw][p2os]") {
  CHECK(p2os::wheel_steps_of(0x090A) == WheelSteps{9, 10});
  CHECK(p2os::wheel_steps_of(0xFF05) == WheelSteps{-1, 5});  // raw bytes under the type of positive integers
  CHECK(p2os::wheel_steps_of(-251) == WheelSteps{-1, 5});
}

TEST_CASE("all pairs of wheel steps survive the way to the robot", "[hw][p2os]") {
  int wrong = 0;
  for (int left = -126; left <= 126; ++left) {
    for (int right = -126; right <= 126; ++right) {
      const p2os::Packet packet = p2os::encode_wheels({left, right});
      const auto command = p2os::decode_command(p2os::body_of(packet.view())).value();
      wrong += p2os::wheel_steps_of(command.value) != WheelSteps{left, right};
    }
  }
  CHECK(wrong == 0);
}

TEST_CASE("wheel steps beyond what a byte holds are limited", "[hw][p2os]") {
  CHECK(sent(p2os::encode_wheels({300, -300})) == sent(p2os::encode_wheels({126, -126})));
}

TEST_CASE("a twist gives the wheels' speeds, the right one being faster in a turn to the left",
          "[hw][p2os]") {
  // 0.2 m/s and 6 deg/s: 200 -/+ 0.10472 / 0.0056 = 181.3 and 218.7 mm/s, in steps of 20 mm/s.
  CHECK(p2os::wheel_steps({.forward = 0.2, .turn_rate = 6 * kDegrees}, p2dx()) == WheelSteps{9, 11});
  CHECK(p2os::wheel_steps({.forward = -0.4}, p2dx()) == WheelSteps{-20, -20});
  CHECK(p2os::wheel_steps({.turn_rate = -1.0}, p2dx()) == WheelSteps{9, -9});
}

TEST_CASE("a twist that is too fast for the wheels keeps its arc", "[hw][p2os]") {
  // 5 m/s and 5 rad/s: 4107.1 and 5892.9 mm/s; the right wheel gets 126 steps, the left one 126 * 4107.1 / 5892.9.
  CHECK(p2os::wheel_steps({.forward = 5.0, .turn_rate = 5.0}, p2dx()) == WheelSteps{88, 126});
  CHECK(p2os::wheel_steps({.forward = kNan}, p2dx()) == WheelSteps{0, 0});
}

TEST_CASE("commands are read with any argument", "[hw][p2os]") {
  CHECK(received("FA FB 03 1D 00 1D").argument == Argument::none);
  CHECK(received("FA FB 03 1D 00 1D").number == 29);
  CHECK(received("FA FB 06 0B 1B C8 00 D3 1B").argument == Argument::integer);
  CHECK(received("FA FB 06 0B 1B C8 00 D3 1B").value == -200);
  CHECK(received("FA FB 06 05 3B 2C 01 31 3C").value == 300);
  CHECK(received("FA FB 08 03 2B 03 01 02 03 08 2F").argument == Argument::bytes);
  CHECK(test::text_of(received("FA FB 08 03 2B 03 01 02 03 08 2F").bytes) == "01 02 03");
}

TEST_CASE("a command whose argument is missing, as public drivers send it, is read without one",
          "[hw][p2os]") {
  const auto seto = received("FA FB 04 07 3B 07 3B");
  CHECK(seto.number == 7);
  CHECK(seto.argument == Argument::cut_short);
  CHECK(seto.value == 0);
}

TEST_CASE("arguments that are cut short are said to be so", "[hw][p2os]") {
  const auto read = [](const Bytes& body) { return p2os::decode_command(body).value(); };
  CHECK(read({0x0B, 0x1B, 0xC8}).argument == Argument::cut_short);
  CHECK(read({0x0B, 0x1B, 0xC8}).value == 0);
  CHECK(read({0x2A, 0x2B}).argument == Argument::cut_short);
  const Bytes list{0x2A, 0x2B, 0x03, 0x41, 0x42};
  CHECK(read(list).argument == Argument::cut_short);
  CHECK(test::text_of(read(list).bytes) == "41 42");
  CHECK(read({0x2A, 0x77, 0x01, 0x02}).argument == Argument::cut_short);
  CHECK_FALSE(p2os::decode_command({}).has_value());
}

TEST_CASE("any integer survives the way to the robot", "[hw][p2os]") {
  int wrong = 0;
  for (int value = -32768; value <= 65535; ++value) {
    const p2os::Packet packet = encode(Command::vel, value);
    const auto command = p2os::decode_command(p2os::body_of(packet.view())).value();
    wrong += command.number != 11 || command.argument != Argument::integer || command.value != value;
  }
  CHECK(wrong == 0);
}

TEST_CASE("any list of bytes survives the way to the robot", "[hw][p2os]") {
  orca::RandomStream random(1, "test", "p2os lists");
  for (int round = 0; round < 500; ++round) {
    Bytes list(random() % (p2os::kLongestArgument + 1));
    for (auto& byte : list) byte = static_cast<std::uint8_t>(random() & 0xFF);
    const p2os::Packet packet = encode(Command::tty3, list).value();
    const auto command = p2os::decode_command(p2os::body_of(packet.view())).value();
    CHECK(command.number == 66);
    CHECK(command.argument == Argument::bytes);
    CHECK(test::text_of(command.bytes) == test::text_of(list));
  }
}
