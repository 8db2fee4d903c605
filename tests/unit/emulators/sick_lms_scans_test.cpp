// SPDX-License-Identifier: GPL-3.0-or-later
// The scans of the emulated laser: what they hold, and when they come.
#include <catch2/catch.hpp>

#include <limits>
#include <numbers>

#include "laser_desk.hpp"

using namespace orca;
using namespace orca::emulators;
using namespace orca::emulators::test;

namespace {

constexpr double kDegreeOfMirror = std::numbers::pi / 180.0;

SickLmsSettings with_one_degree() {
  SickLmsSettings settings;
  settings.resolution = 100;
  settings.measuring_mode = 6;
  settings.unit = 1;
  return settings;
}

// Beams a degree apart over 180 degrees, all of one range.
void show_wall(StillMirror& mirror, double range) {
  mirror.first_angle = -90.0 * kDegreeOfMirror;
  mirror.step = kDegreeOfMirror;
  mirror.ranges.assign(181, range);
}

}  // namespace

TEST_CASE("a part of the beams is sent with the numbers of its ends, counted from 1 at the right",
          "[emulators]") {
  ReadyDesk desk(with_one_degree());
  show_wall(desk.mirror, 5.0);
  desk.mirror.ranges[0] = 1.0;
  desk.mirror.ranges[1] = 2.0;
  desk.mirror.ranges[2] = 3.0;
  // Beams 1 to 3.
  const std::string sent = desk.ask("02 00 06 00 20 27 01 00 03 00 7E BE", 200ms);
  CHECK(sent.starts_with(
      "06 02 80 03 00 A0 00 10 16 0A 02 80 0E 00 B7 01 00 03 00 03 40 E8 03 D0 07 B8 0B 10 F8 00"));
}

TEST_CASE("181 beams in millimetres are announced as B5 40, and the telegram has 372 bytes", "[emulators]") {
  ReadyDesk desk(with_one_degree());
  show_wall(desk.mirror, 1.0);
  const Bytes sent = hex(desk.ask("02 00 02 00 20 24 34 08"));
  REQUIRE(sent.size() > 10 + 372);
  CHECK(text_of(std::span(sent).subspan(10, 9)) == "02 80 6E 01 B0 B5 40 E8 03");
  CHECK(text_of(std::span(sent).subspan(10 + 372, 7)) == "02 80 6E 01 B0 B5 40");
}

TEST_CASE("one scan comes on request, and no more", "[emulators]") {
  ReadyDesk desk(with_one_degree());
  show_wall(desk.mirror, 1.0);
  const Bytes sent = hex(desk.ask("02 00 02 00 30 01 31 18", 2s));
  REQUIRE(sent.size() == 1 + 372);
  CHECK(text_of(std::span(sent).first(9)) == "06 02 80 6E 01 B0 B5 40 E8");
}

TEST_CASE("a beam without echo, and one that is too far for the measuring mode, have values of their own",
          "[emulators]") {
  SickLmsSettings settings = with_one_degree();
  settings.measuring_mode = 0;
  settings.unit = 0;
  ReadyDesk desk(settings);
  show_wall(desk.mirror, 3.0);
  desk.mirror.ranges[0] = std::numeric_limits<double>::infinity();
  desk.mirror.ranges[1] = 100.0;
  const Bytes sent = hex(desk.ask("02 00 02 00 30 01 31 18", 2s));
  REQUIRE(sent.size() == 1 + 372);
  CHECK(text_of(std::span(sent).subspan(5, 9)) == "B0 B5 00 FF 1F F7 1F 2C 01");
}

TEST_CASE("each beam shows the nearest beam of the mirror, and nothing beyond its last one", "[emulators]") {
  ReadyDesk desk(with_one_degree());
  desk.mirror.first_angle = -89.0 * kDegreeOfMirror;
  desk.mirror.step = 2.0 * kDegreeOfMirror;
  desk.mirror.ranges = {1.0, 2.0};
  const Bytes sent = hex(desk.ask("02 00 02 00 30 01 31 18", 2s));
  REQUIRE(sent.size() == 1 + 372);
  CHECK(text_of(std::span(sent).subspan(10, 2)) == "E8 03");  // -89 deg
  CHECK(text_of(std::span(sent).subspan(14, 2)) == "D0 07");  // -87 deg
  CHECK(text_of(std::span(sent).subspan(18, 2)) == "FF 7F");  // -85 deg
}

TEST_CASE("scans come as fast as line and mirror allow; what is measured while one is sent is left out",
          "[emulators]") {
  struct Case {
    std::uint32_t baud;
    unsigned resolution;
    int least, most;  // scans in 10 s
  };
  // A scan takes 97 ms of the line at 38400 baud and 387 ms at 9600, and a turn of the mirror 13.3 ms.
  const auto [baud, resolution, least, most] =
      GENERATE(Case{9600, 100, 24, 26}, Case{38400, 100, 92, 104}, Case{500000, 100, 740, 750},
               Case{500000, 50, 370, 375});
  SickLmsSettings settings = with_one_degree();
  settings.baud = baud;
  settings.resolution = resolution;
  ReadyDesk desk(settings);
  desk.baud = baud;
  show_wall(desk.mirror, 1.0);
  (void)desk.ask("02 00 02 00 20 24 34 08", 10s);
  CHECK(desk.laser.scans() >= least);
  CHECK(desk.laser.scans() <= most);
}

TEST_CASE("an answer comes behind the scan that is on its way, and the stream ends with mode 25",
          "[emulators]") {
  ReadyDesk desk(with_one_degree());
  show_wall(desk.mirror, 1.0);
  const Bytes before = hex(desk.ask("02 00 02 00 20 24 34 08", 200ms));
  const Bytes rest = hex(desk.ask("02 00 02 00 20 25 35 08", 2s));
  // Acknowledgement and answer, a whole scan, and the same again.
  CHECK(before.size() + rest.size() == 10 + 372 + 10);
  CHECK(text_of(std::span(rest).last(10)) == "06 02 80 03 00 A0 00 10 16 0A");
}

TEST_CASE("the variant does not change while scans are sent", "[emulators]") {
  ReadyDesk desk(with_one_degree());
  (void)desk.ask("02 00 02 00 20 24 34 08");
  CHECK(desk.ask("02 00 05 00 3B B4 00 32 00 3B 1F").starts_with("06 02 80 07 00 BB 00 B4 00 64 00 10"));
}

TEST_CASE("the status byte ends each telegram", "[emulators]") {
  ReadyDesk desk;
  desk.laser.set_status(0x90);
  const Bytes answer = hex(desk.ask("02 00 01 00 32 16 12"));
  REQUIRE(answer.size() == 9);
  CHECK(text_of(std::span(answer).subspan(1, 6)) == "02 80 02 00 B2 90");
}
