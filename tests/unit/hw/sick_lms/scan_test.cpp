// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "laser_bytes.hpp"
#include "orca/hw/sick_lms/scan.hpp"

using namespace orca::hw;
using namespace orca::hw::sick_lms;
using test::HeldReply;
using test::hex;
using Ranges = std::vector<double>;

namespace {

constexpr double kDegreesOfScan = std::numbers::pi / 180.0;

Scan scan_of(const test::Bytes& telegram, const ScanFormat& format) {
  const HeldReply held(telegram);
  Scan scan;
  const orca::Status status = parse_scan(held.reply, format, scan);
  REQUIRE(status.ok());
  return scan;
}

// The error for a payload that its sender has closed with a good check word.
orca::Error error_of(const std::string& payload, const ScanFormat& format = {}) {
  const HeldReply held(test::from_laser(hex(payload)));
  Scan scan;
  const orca::Status status = parse_scan(held.reply, format, scan);
  REQUIRE_FALSE(status.ok());
  return status.error();
}

void check_ranges(const Scan& scan, const Ranges& expected) {
  REQUIRE(scan.ranges.size() == expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) CHECK(scan.ranges[i] == Approx(expected[i]));
}

}  // namespace

TEST_CASE("a scan in millimetres is read in metres", "[hw][sick]") {
  const Scan scan =
      scan_of(hex("02 80 0E 00 B0 05 40 E8 03 D0 07 B8 0B A0 0F 88 13 10 F6 F2"), {.measuring_mode = 6});
  check_ranges(scan, {1.0, 2.0, 3.0, 4.0, 5.0});
  CHECK(scan.first_beam == 0);
  CHECK_FALSE(scan.quarter.has_value());
  CHECK(scan.status.byte == 0x10);
  CHECK(scan.reflectivity.empty());
}

TEST_CASE("a scan in centimetres has flags above its distances, and codes for no return", "[hw][sick]") {
  const Scan scan = scan_of(hex("02 80 0A 00 B0 03 00 64 00 FF 1F 2C 21 10 73 03"), {.measuring_mode = 0});
  REQUIRE(scan.ranges.size() == 3);
  CHECK(scan.ranges[0] == Approx(1.0));
  CHECK(std::isinf(scan.ranges[1]));
  CHECK(scan.ranges[2] == Approx(3.0));
  CHECK(scan.flags == std::vector<std::uint8_t>{0, 0, 1});  // field A
}

TEST_CASE("a part of the beams says which they are", "[hw][sick]") {
  const Scan scan =
      scan_of(hex("02 80 0E 00 B7 01 00 03 00 03 40 E8 03 D0 07 B8 0B 10 F8 00"), {.measuring_mode = 6});
  check_ranges(scan, {1.0, 2.0, 3.0});
  CHECK(scan.first_beam == 0);
  const Scan middle = scan_of(test::from_laser(hex("B7 5B 00 5B 00 01 40 E8 03 10")), {.measuring_mode = 6});
  CHECK(middle.first_beam == 90);
  CHECK(angle_of(middle, 0, {180, 100}) == 0.0);
}

TEST_CASE("decimetres are read too", "[hw][sick]") {
  check_ranges(scan_of(test::from_laser(hex("B0 01 80 2A 00 10")), {}), {4.2});
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
    const Scan scan = scan_of(telegram, {.measuring_mode = 6});
    REQUIRE(scan.ranges.size() == row.beams);
    CHECK(scan.ranges.back() == Approx(0.257));
  }
}

TEST_CASE("partial scans give the place of their beams, which are a degree apart", "[hw][sick]") {
  // Count 2, part 3, partial, millimetres: 02 + 3 << 11 + 2000 + 4000 = 7802.
  const Scan scan = scan_of(test::from_laser(hex("B0 02 78 E8 03 D0 07 10")), {.measuring_mode = 6});
  CHECK(scan.quarter == 3U);
  CHECK(angle_of(scan, 0, {100, 25}) == Approx(-49.25 * kDegreesOfScan));
  CHECK(angle_of(scan, 1, {100, 25}) == Approx(-48.25 * kDegreesOfScan));
}

TEST_CASE("the bits of a partial scan's number mean nothing without the bit for partial scans",
          "[hw][sick]") {
  CHECK_FALSE(scan_of(test::from_laser(hex("B0 01 58 E8 03 10")), {.measuring_mode = 6}).quarter.has_value());
}

TEST_CASE("indices behind the values are read where the laser is set to send them", "[hw][sick]") {
  const auto telegram = test::from_laser(hex("B0 01 40 E8 03 07 09 10"));
  const Scan both =
      scan_of(telegram, {.measuring_mode = 6, .has_real_time_index = true, .has_telegram_index = true});
  CHECK(both.real_time_index == 7);
  CHECK(both.telegram_index == 9);
  const Scan none = scan_of(telegram, {.measuring_mode = 6});
  CHECK_FALSE(none.real_time_index.has_value());
  CHECK_FALSE(none.telegram_index.has_value());
}

TEST_CASE("a mode without flags uses all bits, and one for reflectivity gives no ranges", "[hw][sick]") {
  const auto telegram = test::from_laser(hex("B0 01 40 00 7D 10"));
  const Scan immediate = scan_of(telegram, {.measuring_mode = 0x0F});
  check_ranges(immediate, {32.0});
  CHECK(immediate.flags.empty());
  const Scan reflectivity = scan_of(telegram, {.measuring_mode = 0x3F});
  CHECK(reflectivity.ranges.empty());
  CHECK(reflectivity.reflectivity == std::vector<std::uint16_t>{0x7D00});
}

TEST_CASE("a scan with reflectivity has pairs of distance and reflectivity", "[hw][sick]") {
  const Scan scan = scan_of(test::from_laser(hex("F5 01 00 02 00 03 00 02 40 E8 03 34 12 FF 7F 08 00 10")),
                            {.measuring_mode = 6});
  REQUIRE(scan.ranges.size() == 2);
  CHECK(scan.first_beam == 1);
  CHECK(scan.ranges[0] == Approx(1.0));
  CHECK(std::isinf(scan.ranges[1]));
  CHECK(scan.reflectivity == std::vector<std::uint16_t>{0x1234, 8});
}

TEST_CASE("a scan with reflectivity in several parts is refused with what to do", "[hw][sick]") {
  const orca::Error error = error_of("F5 02 00 01 00 01 00 01 40 E8 03 34 12 10");
  CHECK(error.code == orca::Code::unimplemented);
  CHECK(error.message == "a scan with reflectivity in 2 parts; ask the laser for one part");
}

TEST_CASE("a scan that is shorter than it says is refused with both figures", "[hw][sick]") {
  const orca::Error error = error_of("B0 03 40 E8 03 D0 07 10");
  CHECK(error.code == orca::Code::data_loss);
  CHECK(error.message == "a scan of 3 values does not fit into 6 bytes of data; it is not used");
  CHECK(error_of("F5 01 00 01 00 02 00 02 40 E8 03 34 12 D0 07 10").code == orca::Code::data_loss);
}

TEST_CASE("a part of the beams whose ends do not fit its values is refused", "[hw][sick]") {
  CHECK(error_of("B7 01 00 04 00 03 40 E8 03 D0 07 B8 0B 10").message ==
        "a scan of a range of 4 beams has 3 values; it is not used");
  CHECK(error_of("B7 00 00 02 00 03 40 E8 03 D0 07 B8 0B 10").code == orca::Code::data_loss);
  CHECK(error_of("B7 05 00 03 00 03 40 E8 03 D0 07 B8 0B 10").code == orca::Code::data_loss);
}

TEST_CASE("a scan of an unknown measuring mode is refused with those that are known", "[hw][sick]") {
  const orca::Error error = error_of("B0 01 40 E8 03 10", {.measuring_mode = 7});
  CHECK(error.code == orca::Code::unimplemented);
  CHECK(error.message == "measuring mode 7 of the laser is unknown; set one of 0 to 6, 15 or 63");
}

TEST_CASE("a reply that is no scan is refused", "[hw][sick]") {
  CHECK(error_of("A0 00 10").code == orca::Code::invalid_argument);
}

TEST_CASE("a scan that is used again keeps nothing of the one before, but its memory", "[hw][sick]") {
  Scan scan = scan_of(test::from_laser(hex("B7 02 00 03 00 02 78 E8 03 D0 07 07 10")),
                      {.measuring_mode = 1, .has_real_time_index = true});
  const double* const memory = scan.ranges.data();
  const HeldReply next(test::from_laser(hex("B0 01 40 E8 03 11")));
  CHECK(parse_scan(next.reply, {.measuring_mode = 0x0F}, scan).ok());
  CHECK(scan.first_beam == 0);
  CHECK_FALSE(scan.quarter.has_value());
  CHECK_FALSE(scan.real_time_index.has_value());
  CHECK(scan.flags.empty());
  CHECK(scan.status.byte == 0x11);
  check_ranges(scan, {1.0});
  CHECK(scan.ranges.data() == memory);
}
