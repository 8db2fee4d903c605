// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "laser_bytes.hpp"
#include "orca/base/random.hpp"
#include "orca/hw/sick_lms/telegram.hpp"

using namespace orca::hw;
using test::Bytes;
using test::hex;
using Telegrams = std::vector<std::string>;

namespace {

const std::string kModeOk = "02 80 03 00 A0 00 10 16 0A";
const std::string kFiveValues = "02 80 0E 00 B0 05 40 E8 03 D0 07 B8 0B A0 0F 88 13 10 F6 F2";

Telegrams from_laser_in(const Bytes& bytes) { return test::frames_in(sick_lms::kFromLaser, bytes); }

}  // namespace

TEST_CASE("a telegram has its payload between header and check word", "[hw][sick]") {
  CHECK(test::text_of(sick_lms::payload_of(hex(kModeOk))) == "A0 00 10");
  CHECK(test::text_of(sick_lms::make_request(hex("31")).view()) == "02 00 01 00 31 15 12");
}

TEST_CASE("a lone 06 is an acknowledgement, and what is glued to it a telegram", "[hw][sick]") {
  CHECK(from_laser_in(hex("06 " + kModeOk)) == Telegrams{"06", kModeOk});
  CHECK(sick_lms::heard(hex("06")) == sick_lms::Heard::ack);
  CHECK(sick_lms::heard(hex("15")) == sick_lms::Heard::nak);
  CHECK(sick_lms::heard(hex(kModeOk)) == sick_lms::Heard::telegram);
}

TEST_CASE("06 and 15 inside a telegram are data", "[hw][sick]") {
  const Bytes telegram = test::from_laser(hex("B0 02 40 06 15 15 06 10"));
  CHECK(from_laser_in(telegram) == Telegrams{test::text_of(telegram)});
}

TEST_CASE("a lone 06 among garbage is given with the number of bytes skipped before it", "[hw][sick]") {
  framing::Scanner scanner(sick_lms::kFromLaser);
  std::vector<std::uint64_t> skipped;
  scanner.feed(hex("06 33 44 06"), [&](const framing::Frame& frame) { skipped.push_back(frame.skipped); });
  CHECK(skipped == std::vector<std::uint64_t>{0, 2});
}

TEST_CASE("a telegram from a laser is found one byte at a time", "[hw][sick]") {
  test::FrameList list(sick_lms::kFromLaser);
  for (const std::uint8_t byte : hex(kFiveValues)) {
    CHECK(list.frames().empty());
    list.hear({byte});
  }
  CHECK(list.frames() == Telegrams{kFiveValues});
}

TEST_CASE("02 alone begins no telegram", "[hw][sick]") {
  CHECK(from_laser_in(hex("02 02 00 01 02 " + kModeOk)) == Telegrams{kModeOk});
}

TEST_CASE("02 80 inside a telegram whose beginning was not heard does not hide the next one", "[hw][sick]") {
  // The inner 02 80 has a possible length, 0010, and is refuted by its check word.
  CHECK(from_laser_in(hex("80 0E 00 B0 05 40 02 80 10 00 B8 0B A0 0F 88 13 10 F6 F2 " + kModeOk + " " +
                          kModeOk)) == Telegrams{kModeOk, kModeOk});
}

TEST_CASE("lengths that no telegram has are no beginning", "[hw][sick]") {
  for (const std::string length : {"00 00", "01 00", "2D 03", "FF FF"}) {  // 032D is 813
    INFO(length);
    CHECK(from_laser_in(hex("02 80 " + length + " " + kModeOk)) == Telegrams{kModeOk});
  }
}

TEST_CASE("a telegram of the longest payload is found", "[hw][sick]") {
  Bytes payload(sick_lms::kLongestPayload, 0x02);
  payload[0] = 0xB0;
  CHECK(from_laser_in(test::from_laser(payload)).size() == 1);
  CHECK(test::from_laser(payload).size() == sick_lms::kLongestTelegram);
}

TEST_CASE("a telegram to a laser with a bad check word is not accepted", "[hw][sick]") {
  test::FrameList list(sick_lms::kFromHost);
  list.hear(hex("02 00 02 00 20 24 34 09"));
  CHECK(list.frames().empty());
  CHECK(list.statistics().bad_checksums == 1);
  list.hear(hex("02 00 02 00 20 24 34 08"));
  CHECK(list.frames() == Telegrams{"02 00 02 00 20 24 34 08"});
}

TEST_CASE("a telegram in the other direction is none", "[hw][sick]") {
  CHECK(test::frames_in(sick_lms::kFromHost, hex(kModeOk)).empty());
  CHECK(from_laser_in(hex("02 00 01 00 31 12 12")).empty());
}

TEST_CASE("one flipped bit anywhere in a telegram makes it no telegram", "[hw][sick]") {
  const Bytes whole = hex(kFiveValues);
  for (std::size_t bit = 0; bit < 8 * whole.size(); ++bit) {
    Bytes flipped = whole;
    flipped[bit / 8] ^= static_cast<std::uint8_t>(1U << (bit % 8));
    INFO(bit);
    const auto found = sick_lms::look_from_laser(flipped);
    CHECK((found.kind != framing::Finding::Kind::frame || found.size == 1));  // 02 may become a lone 06
  }
}

TEST_CASE("any payload comes out of its telegram as it went in", "[hw][sick]") {
  orca::RandomStream random(1, "test", "sick telegrams");
  for (int round = 0; round < 500; ++round) {
    Bytes payload(1 + random() % sick_lms::kLongestPayload);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random() & 0xFF);
    const sick_lms::Telegram telegram = sick_lms::make_request(payload);
    REQUIRE(sick_lms::look_from_host(telegram.view()).kind == framing::Finding::Kind::frame);
    CHECK(test::text_of(sick_lms::payload_of(telegram.view())) == test::text_of(payload));
  }
}
