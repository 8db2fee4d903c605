// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "laser_bytes.hpp"
#include "orca/base/random.hpp"
#include "orca/hw/sick_lms/scan.hpp"

using namespace orca::hw;
using namespace orca::hw::sick_lms;
using test::HeldReply;
using test::hex;
using Ranges = std::vector<double>;
using test::Bytes;

namespace {

orca::Status read(const test::Bytes& telegram, std::uint8_t measuring_mode, Ranges& ranges) {
  const HeldReply held(telegram);
  return parse_scan(held.reply, measuring_mode, ranges);
}

Ranges ranges_of(const test::Bytes& telegram, std::uint8_t measuring_mode) {
  Ranges ranges;
  REQUIRE(read(telegram, measuring_mode, ranges).ok());
  return ranges;
}

// The error for a payload that its sender has closed with a good check word.
orca::Error error_of(const std::string& payload, std::uint8_t measuring_mode = 0) {
  Ranges ranges;
  const orca::Status status = read(test::from_laser(hex(payload)), measuring_mode, ranges);
  REQUIRE_FALSE(status.ok());
  return status.error();
}

void check_ranges(const Ranges& ranges, const Ranges& expected) {
  REQUIRE(ranges.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(ranges[i] == Approx(expected[i]));
}

void put_u16(Bytes& bytes, unsigned value) {
  bytes.push_back(static_cast<std::uint8_t>(value & 0xFF));
  bytes.push_back(static_cast<std::uint8_t>(value >> 8));
}

// A whole scan as an LMS sends it: in mm, one value of 15 bits per beam.
Bytes payload_of_scan(const std::vector<unsigned>& millimetres) {
  Bytes payload{0xB0};
  put_u16(payload, static_cast<unsigned>(millimetres.size()) | 0x4000U);
  for (const unsigned value : millimetres) put_u16(payload, value);
  payload.push_back(0x10);
  return payload;
}

}  // namespace

TEST_CASE("a scan in millimetres is read in metres", "[hw][sick]") {
  check_ranges(ranges_of(hex("02 80 0E 00 B0 05 40 E8 03 D0 07 B8 0B A0 0F 88 13 10 F6 F2"), 6),
               {1.0, 2.0, 3.0, 4.0, 5.0});
}

TEST_CASE("a scan in centimetres has flags above its distances, and codes for no return", "[hw][sick]") {
  const Ranges ranges = ranges_of(hex("02 80 0A 00 B0 03 00 64 00 FF 1F 2C 21 10 73 03"), 0);
  REQUIRE(ranges.size() == 3);
  CHECK(ranges[0] == Approx(1.0));
  CHECK(std::isinf(ranges[1]));
  CHECK(ranges[2] == Approx(3.0));
}

TEST_CASE("measuring modes have the masks of the telegram listing, and all others are unknown",
          "[hw][sick]") {
  const std::map<int, int> masks{{0x00, 0x1FFF}, {0x01, 0x1FFF}, {0x02, 0x1FFF}, {0x03, 0x3FFF},
                                 {0x04, 0x3FFF}, {0x05, 0x7FFF}, {0x06, 0x7FFF}, {0x0F, 0xFFFF}};
  for (int mode = 0; mode < 256; ++mode) {
    INFO(mode);
    const auto mask = distance_mask(static_cast<std::uint8_t>(mode));
    CHECK(mask.has_value() == masks.contains(mode));
    if (mask) CHECK(*mask == masks.at(mode));
  }
}

TEST_CASE("the codes at the end of each range mean that nothing came back", "[hw][sick]") {
  const auto [mode, value, is_echo] = GENERATE(table<int, int, bool>({{0, 0x1FFF, false},
                                                                      {0, 0x1FF7, false},
                                                                      {0, 0x1FF6, true},
                                                                      {0, 0, true},
                                                                      {3, 0x3FF7, false},
                                                                      {3, 0x1FFF, true},
                                                                      {6, 0x7FF7, false},
                                                                      {6, 32000, true},
                                                                      {6, 0x83E8, true},
                                                                      {0x0F, 0x7FFF, false},
                                                                      {0x0F, 32000, true}}));
  INFO(mode << " " << value);
  const test::Bytes payload{
      0xB0, 1, 0x40, static_cast<std::uint8_t>(value & 0xFF), static_cast<std::uint8_t>(value >> 8), 0x10};
  const Ranges ranges = ranges_of(test::from_laser(payload), static_cast<std::uint8_t>(mode));
  CHECK(std::isfinite(ranges.at(0)) == is_echo);
}

TEST_CASE("decimetres are read too", "[hw][sick]") {
  check_ranges(ranges_of(test::from_laser(hex("B0 01 80 2A 00 10")), 0), {4.2});
}

TEST_CASE("whole scans have the lengths and count words of the telegram listing", "[hw][sick]") {
  struct Row {
    std::size_t beams;
    std::string count_word, header;
  };
  for (const Row& row : std::vector<Row>{
           {361, "69 41", "02 80 D6 02"}, {181, "B5 40", "02 80 6E 01"}, {401, "91 41", "02 80 26 03"}}) {
    const auto telegram = test::from_laser(
        test::joined({hex("B0 " + row.count_word), test::Bytes(2 * row.beams, 0x01), hex("10")}));
    CHECK(test::text_of(telegram).starts_with(row.header));
    const Ranges ranges = ranges_of(telegram, 6);
    REQUIRE(ranges.size() == row.beams);
    CHECK(ranges.back() == Approx(0.257));
  }
}

TEST_CASE("a scan that is shorter than it says is refused with both figures", "[hw][sick]") {
  const orca::Error error = error_of("B0 03 40 E8 03 D0 07 10");
  CHECK(error.code == orca::Code::data_loss);
  CHECK(error.message == "a scan of 3 values does not fit into 6 bytes of data; it is not used");
}

TEST_CASE("a scan of an unknown measuring mode is refused with those that are known", "[hw][sick]") {
  const orca::Error error = error_of("B0 01 40 E8 03 10", 7);
  CHECK(error.code == orca::Code::unimplemented);
  CHECK(error.message == "measuring mode 7 of the laser is unknown; set one of 0 to 6 or 15");
}

TEST_CASE("a reply that is no scan is refused", "[hw][sick]") {
  CHECK(error_of("A0 00 10").code == orca::Code::invalid_argument);
}

TEST_CASE("ranges that are used again keep nothing of the scan before, but its memory", "[hw][sick]") {
  Ranges ranges = ranges_of(test::from_laser(hex("B0 02 40 E8 03 D0 07 10")), 6);
  const double* const memory = ranges.data();
  CHECK(read(test::from_laser(hex("B0 01 40 E8 03 11")), 0x0F, ranges).ok());
  check_ranges(ranges, {1.0});
  CHECK(ranges.data() == memory);
}

TEST_CASE("any distances come out of a scan as they went in", "[hw][sick]") {
  orca::RandomStream random(1, "test", "sick scans");
  std::vector<double> ranges;
  for (int round = 0; round < 300; ++round) {
    std::vector<unsigned> sent(beams(kVariants[random() % kVariants.size()]));
    for (auto& value : sent) value = static_cast<unsigned>(random() % 0x8000);
    const test::HeldReply held(test::from_laser(payload_of_scan(sent)));
    REQUIRE(parse_scan(held.reply, 6, ranges).ok());
    REQUIRE(ranges.size() == sent.size());
    int wrong = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const bool is_echo = std::isfinite(ranges[i]);
      wrong += is_echo != (sent[i] < 0x7FF7) ||
               (is_echo && std::lround(1000 * ranges[i]) != static_cast<long>(sent[i]));
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("scans between torn ones are found, and the first one at the latest with the second",
          "[hw][sick]") {
  orca::RandomStream random(2, "test", "sick scans");
  for (int round = 0; round < 200; ++round) {
    std::vector<unsigned> sent(361);
    for (auto& value : sent) value = static_cast<unsigned>(random() % 0x0300);  // many bytes of 02 and 06
    const Bytes telegram = test::from_laser(payload_of_scan(sent));
    const Bytes torn(telegram.begin() + 1 + static_cast<std::ptrdiff_t>(random() % 700), telegram.end());
    test::FrameList list(kFromLaser);
    list.hear(torn);
    list.hear(telegram);
    list.hear(telegram);
    const auto whole = std::ranges::count(list.frames(), test::text_of(telegram));
    CHECK(whole == 2);
  }
}

TEST_CASE("any bytes of a scan's code give a scan or an error", "[hw][sick]") {
  orca::RandomStream random(3, "test", "sick scans");
  int read = 0;
  std::vector<double> ranges;
  for (int round = 0; round < 5000; ++round) {
    Bytes payload(2 + random() % 811);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random() & 0xFF);
    payload[0] = 0xB0;
    const auto reply = parse_reply(payload).value();
    if (!parse_scan(reply, static_cast<std::uint8_t>(random() % 8), ranges).ok()) continue;
    ++read;
    CHECK(2 * ranges.size() <= payload.size());
  }
  CHECK(read > 200);
}
