// SPDX-License-Identifier: GPL-3.0-or-later
// What the emulated laser answers, byte for byte as in the worked examples of the LMS2xx telegram listing.
#include <catch2/catch.hpp>

#include "laser_desk.hpp"

using namespace orca;
using namespace orca::emulators;
using namespace orca::emulators::test;

namespace {

const std::string kAccepted = "06 02 80 03 00 A0 00 10 16 0A";
const std::string kRefusal = "06 02 80 03 00 A0 01 10 14 0B";
const std::string kNotUnderstood = "06 02 80 02 00 92 10 7F 33";
const std::string kInstall = "02 00 0A 00 20 00 53 49 43 4B 5F 4C 4D 53 BE C5";
const std::string kZeros27 =
    "00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00";

SickLmsSettings in_millimetres() {
  SickLmsSettings settings;
  settings.measuring_mode = 6;
  settings.unit = 1;
  return settings;
}

}  // namespace

TEST_CASE("an emulated laser announces itself when it has powered up, and hears nothing before",
          "[emulators]") {
  LaserDesk desk;
  CHECK(desk.ask("02 00 01 00 3A 1E 12", 400ms).empty());
  CHECK(text_of(desk.pass(300ms)) ==
        "02 80 16 00 90 4C 4D 53 32 30 30 3B 33 30 31 30 36 3B 56 30 32 2E 33 30 20 10 2B 7C");
}

TEST_CASE("an emulated laser tells its type", "[emulators]") {
  ReadyDesk desk;
  CHECK(desk.ask("02 00 01 00 3A 1E 12") ==
        "06 02 80 16 00 BA 4C 4D 53 32 30 30 3B 33 30 31 30 36 3B 56 30 32 2E 33 30 20 10 89 A3");
}

TEST_CASE("an emulated laser has no errors to tell", "[emulators]") {
  ReadyDesk desk;
  CHECK(desk.ask("02 00 01 00 32 16 12") == "06 02 80 02 00 B2 10 3F 13");
}

TEST_CASE("an emulated laser tells its configuration", "[emulators]") {
  ReadyDesk desk(in_millimetres());
  CHECK(desk.ask("02 00 01 00 74 50 12") ==
        "06 02 80 24 00 F4 00 00 00 00 00 06 01 " + kZeros27 + " 10 4D 8A");
}

TEST_CASE("the status of an emulated laser tells its variant and unit", "[emulators]") {
  ReadyDesk desk(in_millimetres());
  const Bytes status = hex(desk.ask("02 00 01 00 31 15 12"));
  REQUIRE(status.size() == 1 + 4 + 152 + 2);
  const auto byte = [&](std::size_t offset) { return static_cast<int>(status[5 + offset]); };
  CHECK(byte(0) == 0xB1);
  CHECK(byte(8) == 0x25);
  CHECK(byte(102) == 6);
  CHECK((byte(107) == 0xB4 && byte(108) == 0));
  CHECK((byte(109) == 0x32 && byte(110) == 0));
  CHECK(byte(122) == 1);
  CHECK(byte(123) == 1);
}

TEST_CASE("an emulated laser has the five variants of an LMS, and keeps its own if another is asked for",
          "[emulators]") {
  ReadyDesk desk;
  CHECK(desk.ask("02 00 05 00 3B B4 00 64 00 97 49") == "06 02 80 07 00 BB 01 B4 00 64 00 10 5B 30");
  CHECK(desk.ask("02 00 05 00 3B B4 00 32 00 3B 1F") == "06 02 80 07 00 BB 01 B4 00 32 00 10 03 9D");
  CHECK(desk.ask("02 00 05 00 3B 64 00 19 00 E7 72").starts_with("06 02 80 07 00 BB 01 64 00 19 00 10"));
  CHECK(desk.ask("02 00 05 00 3B 64 00 32 00 B1 59").starts_with("06 02 80 07 00 BB 01 64 00 32 00 10"));
  CHECK(desk.ask("02 00 05 00 3B 64 00 64 00 1D 0F").starts_with("06 02 80 07 00 BB 01 64 00 64 00 10"));
  // Resolution 0.
  CHECK(desk.ask("02 00 05 00 3B B4 00 00 00 5F 2D").starts_with("06 02 80 07 00 BB 00 64 00 64 00 10"));
}

TEST_CASE("an emulated laser writes its configuration in installation mode only, which has a password",
          "[emulators]") {
  const std::string write = "02 00 23 00 77 00 00 00 00 00 06 01 " + kZeros27 + " AB 70";
  ReadyDesk desk;
  CHECK(desk.ask(write).starts_with("06 02 80 25 00 F7 00 00 00 00 00 00 00 00 "));
  CHECK(desk.laser.writes() == 0);
  CHECK(desk.ask(kInstall) == kAccepted);
  CHECK(desk.ask(write).starts_with("06 02 80 25 00 F7 01 00 00 00 00 00 06 01 "));
  CHECK(desk.laser.writes() == 1);
  CHECK(desk.laser.configuration()[6] == 1);
}

TEST_CASE("what a short configuration leaves out stays as it is", "[emulators]") {
  ReadyDesk desk;
  CHECK(desk.ask(kInstall) == kAccepted);
  CHECK(desk.ask("02 00 08 00 77 00 00 00 00 00 01 01 CD FA").starts_with("06 02 80 25 00 F7 01 "));
  CHECK(desk.laser.configuration().size() == 34);
  CHECK(desk.laser.configuration()[5] == 1);
}

TEST_CASE("an emulated laser keeps its configuration when its power is interrupted, and nothing else",
          "[emulators]") {
  ReadyDesk desk;
  (void)desk.ask(kInstall);
  (void)desk.ask("02 00 08 00 77 00 00 00 00 00 01 01 CD FA");
  (void)desk.ask("02 00 02 00 20 40 50 08");
  REQUIRE(desk.laser.baud() == 38400);
  desk.laser.reset(desk.now);
  CHECK(text_of(desk.pass(1s)).starts_with("02 80 16 00 90 "));
  CHECK(desk.laser.baud() == 9600);
  CHECK(desk.laser.configuration()[6] == 1);
}

TEST_CASE("another password is refused", "[emulators]") {
  SickLmsSettings settings;
  settings.password = "SICK_PLS";
  ReadyDesk desk(settings);
  CHECK(desk.ask(kInstall) == kRefusal);
}

TEST_CASE("a change of the rate is answered at the old rate, and nothing is understood at the old one then",
          "[emulators]") {
  ReadyDesk desk;
  CHECK(desk.ask("02 00 02 00 20 40 50 08") == kAccepted);
  CHECK(desk.laser.baud() == 38400);
  CHECK(desk.ask("02 00 01 00 32 16 12").empty());
  desk.baud = 38400;
  CHECK(desk.ask("02 00 01 00 32 16 12") == "06 02 80 02 00 B2 10 3F 13");
  CHECK(desk.ask("02 00 02 00 20 48 58 08") == kAccepted);
  desk.baud = 500000;
  CHECK(desk.ask("02 00 02 00 20 41 51 08") == kAccepted);
  desk.baud = 19200;
  CHECK(desk.ask("02 00 02 00 20 42 52 08") == kAccepted);
  CHECK(desk.laser.baud() == 9600);
}

TEST_CASE("a host that changes its rate without waiting for the answer finds the laser at the new one",
          "[emulators]") {
  ReadyDesk desk;
  desk.laser.take(hex("02 00 02 00 20 40 50 08"), 9600, desk.now);
  (void)desk.pass(2ms);
  desk.baud = 38400;
  (void)desk.ask("02 00 01 00 32 16 12", 100ms);  // too early: the answer is still under way at the old rate
  CHECK(desk.ask("02 00 01 00 32 16 12") == "06 02 80 02 00 B2 10 3F 13");
}

TEST_CASE("a rate that the laser cannot have is refused", "[emulators]") {
  SickLmsSettings settings;
  settings.rates = {9600, 38400};
  ReadyDesk desk(settings);
  CHECK(desk.ask("02 00 02 00 20 48 58 08") == kRefusal);
  CHECK(desk.laser.baud() == 9600);
}

TEST_CASE("a telegram with a wrong check word is answered with the lone byte 15, and not obeyed",
          "[emulators]") {
  ReadyDesk desk;
  CHECK(desk.ask("02 00 02 00 20 24 34 09") == "15");
  CHECK_FALSE(desk.laser.sends_scans());
}

TEST_CASE("what an emulated laser does not know it does not accept", "[emulators]") {
  ReadyDesk desk;
  // Command 33 and mode 99; their check words come from another implementation.
  CHECK(desk.ask("02 00 01 00 33 17 12") == kNotUnderstood);
  CHECK(desk.ask("02 00 02 00 20 99 89 08") == kNotUnderstood);
}

TEST_CASE("requests are found in garbage, byte by byte and glued together", "[emulators]") {
  ReadyDesk desk;
  const std::string type = "02 00 01 00 3A 1E 12";
  const std::string errors = "02 00 01 00 32 16 12";
  CHECK(desk.ask("FF 02 02 80 00 " + errors) == "06 02 80 02 00 B2 10 3F 13");
  const std::string both = desk.ask(type + " " + errors);
  CHECK(both.starts_with("06 02 80 16 00 BA"));
  CHECK(both.ends_with("89 A3 06 02 80 02 00 B2 10 3F 13"));
  Bytes answer;
  for (const std::uint8_t byte : hex(errors)) {
    desk.laser.take({&byte, 1}, 9600, desk.now);
    for (const std::uint8_t each : desk.pass(5ms)) answer.push_back(each);
  }
  for (const std::uint8_t each : desk.pass(100ms)) answer.push_back(each);
  CHECK(text_of(answer) == "06 02 80 02 00 B2 10 3F 13");
}

TEST_CASE("a request that was cut short is forgotten after a pause", "[emulators]") {
  ReadyDesk desk;
  CHECK(desk.ask("02 00 2C 01 20").empty());  // 300 bytes should follow
  CHECK(desk.ask("02 00 01 00 32 16 12") == "06 02 80 02 00 B2 10 3F 13");
}

TEST_CASE("a reset is answered, then the laser is gone until it has powered up again", "[emulators]") {
  ReadyDesk desk;
  const std::string answer = desk.ask("02 00 01 00 10 34 12", 400ms);
  CHECK(answer.starts_with("06 02 80 02 00 91 10 "));
  CHECK(hex(answer).size() == 9);
  CHECK(text_of(desk.pass(1s)).starts_with("02 80 16 00 90 "));
}

TEST_CASE("a laser whose setting says so sends no lone bytes", "[emulators]") {
  SickLmsSettings settings;
  settings.acknowledges = false;
  ReadyDesk desk(settings);
  CHECK(desk.ask("02 00 01 00 32 16 12") == "02 80 02 00 B2 10 3F 13");
  CHECK(desk.ask("02 00 02 00 20 24 34 09").empty());
}
