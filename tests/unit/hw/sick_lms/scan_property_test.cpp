// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cmath>
#include <vector>

#include "laser_bytes.hpp"
#include "orca/base/random.hpp"
#include "orca/hw/sick_lms/scan.hpp"

using namespace orca::hw;
using namespace orca::hw::sick_lms;
using test::Bytes;

namespace {

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

TEST_CASE("any distances come out of a scan as they went in", "[hw][sick]") {
  orca::RandomStream random(1, "test", "sick scans");
  Scan scan;
  for (int round = 0; round < 300; ++round) {
    std::vector<unsigned> sent(beams(kVariants[random() % kVariants.size()]));
    for (auto& value : sent) value = static_cast<unsigned>(random() % 0x8000);
    const test::HeldReply held(test::from_laser(payload_of_scan(sent)));
    REQUIRE(parse_scan(held.reply, {.measuring_mode = 6}, scan).ok());
    REQUIRE(scan.ranges.size() == sent.size());
    int wrong = 0;
    for (std::size_t i = 0; i < sent.size(); ++i) {
      const bool is_echo = std::isfinite(scan.ranges[i]);
      wrong += is_echo != (sent[i] < 0x7FF7) ||
               (is_echo && std::lround(1000 * scan.ranges[i]) != static_cast<long>(sent[i]));
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
  Scan scan;
  for (int round = 0; round < 5000; ++round) {
    Bytes payload(2 + random() % 811);
    for (auto& byte : payload) byte = static_cast<std::uint8_t>(random() & 0xFF);
    payload[0] = std::vector<std::uint8_t>{0xB0, 0xB7, 0xF5}[random() % 3];
    const auto reply = parse_reply(payload).value();
    const ScanFormat format{.measuring_mode = static_cast<std::uint8_t>(random() % 8)};
    if (!parse_scan(reply, format, scan).ok()) continue;
    ++read;
    CHECK(2 * scan.ranges.size() <= payload.size());
  }
  CHECK(read > 200);
}
