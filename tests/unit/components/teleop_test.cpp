// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cstring>
#include <string>

#include "orca/base/random.hpp"
#include "teleop/joystick.hpp"
#include "teleop/keys.hpp"

using namespace orca::teleop;

namespace {

constexpr double kDeadMan = 0.3;

Stick after(const std::string& bytes, double since = 0.0) {
  Keys keys;
  keys.take(bytes, 10.0);
  return keys.stick(10.0 + since, kDeadMan);
}

std::string event(std::int16_t value, unsigned char type, unsigned char number) {
  std::string bytes(8, '\0');
  std::memcpy(&bytes[4], &value, sizeof value);
  bytes[6] = static_cast<char>(type);
  bytes[7] = static_cast<char>(number);
  return bytes;
}

constexpr unsigned char kButton = 1;
constexpr unsigned char kAxis = 2;

}  // namespace

TEST_CASE("arrows and letters of either case drive", "[components][teleop]") {
  for (const char* key : {"\x1b[A", "\x1bOA", "w", "W"}) CHECK(after(key) == Stick{1.0, 0.0});
  for (const char* key : {"\x1b[B", "\x1bOB", "s", "S"}) CHECK(after(key) == Stick{-1.0, 0.0});
  for (const char* key : {"\x1b[D", "\x1bOD", "a", "A"}) CHECK(after(key) == Stick{0.0, 1.0});
  for (const char* key : {"\x1b[C", "\x1bOC", "d", "D"}) CHECK(after(key) == Stick{0.0, -1.0});
}

TEST_CASE("forward and a turn can be held by alternating keys, and the last of two opposite keys counts",
          "[components][teleop]") {
  CHECK(after("wa") == Stick{1.0, 1.0});
  CHECK(after("ws") == Stick{-1.0, 0.0});
}

TEST_CASE("a key counts for the dead-man time, and the space bar ends it at once", "[components][teleop]") {
  CHECK(after("w", 0.29) == Stick{1.0, 0.0});
  CHECK(after("w", 0.31) == Stick{});
  CHECK(after("wa ") == Stick{});
  Keys keys;
  keys.take("w", 1.0);
  keys.take("w", 1.2);
  CHECK(keys.stick(1.45, kDeadMan) == Stick{1.0, 0.0});
}

TEST_CASE("an arrow key that comes byte by byte is understood", "[components][teleop]") {
  Keys keys;
  for (const char* byte : {"\x1b", "[", "A"}) keys.take(byte, 1.0);
  CHECK(keys.stick(1.0, kDeadMan) == Stick{1.0, 0.0});
}

TEST_CASE("keys without a meaning, and escape sequences of other keys, do nothing", "[components][teleop]") {
  for (const char* bytes : {"x", "1", "\x1b[H", "\x1b[5~", "\n", "\t", "\xc3\xa4"}) {
    CAPTURE(bytes);
    Keys keys;
    keys.take(bytes, 1.0);
    CHECK(keys.stick(1.0, kDeadMan) == Stick{});
    CHECK_FALSE(keys.quit());
  }
}

TEST_CASE("Q ends teleop, whatever keys came before", "[components][teleop]") {
  for (const char* bytes : {"q", "Q", "wwwq"}) {
    Keys keys;
    keys.take(bytes, 1.0);
    CHECK(keys.quit());
  }
}

TEST_CASE("no input moves a stick beyond its ends", "[components][teleop]") {
  orca::RandomStream random(1, "test", "keys");
  Keys keys;
  Joystick joystick;
  for (int i = 0; i < 20000; ++i) {
    const std::string byte(1, static_cast<char>(random() % 256));
    keys.take(byte, i * 0.01);
    joystick.take(byte);
    for (const Stick& stick : {keys.stick(i * 0.01, kDeadMan), joystick.stick({})}) {
      REQUIRE(std::abs(stick.forward) <= 1.0);
      REQUIRE(std::abs(stick.left) <= 1.0);
    }
  }
}

TEST_CASE("a joystick drives while its dead-man button is held, and stands when it is let go",
          "[components][teleop]") {
  Joystick joystick;
  joystick.take(event(-32767, kAxis, 1) + event(16384, kAxis, 0));
  CHECK(joystick.stick({}) == Stick{});
  joystick.take(event(1, kButton, 0));
  CHECK(joystick.stick({}).forward == 1.0);
  CHECK(joystick.stick({}).left == Approx(-0.5).margin(1e-4));
  joystick.take(event(0, kButton, 0));
  CHECK(joystick.stick({}) == Stick{});
}

TEST_CASE("a joystick's first states count like later ones, other axes and buttons do not",
          "[components][teleop]") {
  Joystick joystick;
  joystick.take(event(1, kButton | 0x80, 0) + event(-32767, kAxis | 0x80, 1) + event(32767, kAxis, 4) +
                event(1, kButton, 7));
  CHECK(joystick.stick({}) == Stick{1.0, 0.0});
  CHECK(joystick.stick({.forward_axis = 4}) == Stick{-1.0, 0.0});
  CHECK(joystick.stick({.dead_man_button = 6}) == Stick{});
}

TEST_CASE("a joystick is at rest even if its axes tremble, and after it was unplugged",
          "[components][teleop]") {
  Joystick joystick;
  joystick.take(event(1, kButton, 0) + event(900, kAxis, 1) + event(-900, kAxis, 0));
  CHECK(joystick.stick({}) == Stick{});
  joystick.take(event(-20000, kAxis, 1));
  CHECK(joystick.stick({}).forward > 0.5);
  joystick.release();
  CHECK(joystick.stick({}) == Stick{});
}

TEST_CASE("a joystick event may come in parts", "[components][teleop]") {
  Joystick joystick;
  for (const char byte : event(1, kButton, 0) + event(-32767, kAxis, 1)) joystick.take(std::string(1, byte));
  CHECK(joystick.stick({}) == Stick{1.0, 0.0});
}
