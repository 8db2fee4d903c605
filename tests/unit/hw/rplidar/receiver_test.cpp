// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/rplidar/receiver.hpp"

#include <catch2/catch.hpp>

#include <numbers>

#include "hex_bytes.hpp"
#include "rplidar_bytes.hpp"

using namespace orca::hw::rplidar;
using orca::hw::test::hex;
using orca::hw::test::joined;
using ReceivedBytes = std::vector<std::uint8_t>;

namespace {

const ReceivedBytes kHealthAnswer = hex("A5 5A 03 00 00 00 06 01 02 00");
const ReceivedBytes kScanAnswer = hex("A5 5A 05 00 00 40 81");
const ReceivedBytes kExpressAnswer = hex("A5 5A 54 00 00 40 82");

struct ReceiverEar {
  void hear(std::span<const std::uint8_t> bytes) {
    receiver.feed(bytes, [this](const Event& event) { events.push_back(event); });
  }
  Receiver receiver;
  std::vector<Event> events;
};

// Nodes from 0 deg in steps of 1 deg, at 1 m.
ReceivedBytes some_nodes(int count) {
  ReceivedBytes stream;
  for (int i = 0; i < count; ++i) {
    const auto bytes = encode_node({.begins_scan = i == 0,
                                    .quality = 10,
                                    .angle = static_cast<std::uint16_t>(64 * i),
                                    .distance = 4000});
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
  return stream;
}

// Capsules from 0 deg in steps of 16 deg.
ReceivedBytes some_capsules(int count) {
  ReceivedBytes stream;
  for (int i = 0; i < count; ++i) {
    const auto bytes = encode_capsule({.is_first = i == 0, .start = static_cast<std::uint16_t>(1024 * i)});
    stream.insert(stream.end(), bytes.begin(), bytes.end());
  }
  return stream;
}

std::size_t points_among(const std::vector<Event>& events) {
  std::size_t count = 0;
  for (const Event& event : events) count += std::holds_alternative<Point>(event) ? 1 : 0;
  return count;
}

}  // namespace

TEST_CASE("an answer is read behind the text of a reset, byte by byte", "[hw][rplidar]") {
  const std::string text = "RP LIDAR System.\r\nFirmware Ver 1.29\r\nHW Ver 7\r\n";
  ReceiverEar ear;
  ear.hear(ReceivedBytes(text.begin(), text.end()));
  for (const std::uint8_t byte : kHealthAnswer) ear.hear({&byte, 1});
  CHECK(ear.events == std::vector<Event>{Health{Health::State::warning, 2}});
  CHECK(ear.receiver.skipped_bytes() == text.size());
}

TEST_CASE("answers one after the other are all read", "[hw][rplidar]") {
  ReceiverEar ear;
  ear.hear(joined({hex("A5 5A 14 00 00 00 04 18 1D 01 07 00 00 00 00 00 00 00 00 00 00 00 00 00 00 00 01"),
                   kHealthAnswer, hex("A5 5A 04 00 00 00 15 F4 01 FA 00")}));
  REQUIRE(ear.events.size() == 3);
  CHECK(std::get<DeviceInfo>(ear.events[0]).firmware_minor == 29);
  CHECK(std::get<DeviceInfo>(ear.events[0]).serial[15] == 1);
  CHECK(std::get<Health>(ear.events[1]).error == 2);
  CHECK(std::get<SampleRates>(ear.events[2]).scan == Approx(500e-6));
}

TEST_CASE("a scan gives a point for each node but the last", "[hw][rplidar]") {
  ReceiverEar ear;
  ear.hear(joined({kScanAnswer, some_nodes(20)}));
  REQUIRE(ear.events.size() == 20);
  CHECK(ear.events[0] == Event{ScanStarted{DataType::nodes}});
  const auto& first = std::get<Point>(ear.events[1]);
  CHECK(first.begins_scan);
  CHECK(first.range == 1.0);
  CHECK(std::get<Point>(ear.events[19]).angle == Approx(-18.0 * std::numbers::pi / 180.0));
  CHECK(ear.receiver.scan_statistics().frames == 19);
}

TEST_CASE("an express scan gives the points of all capsules but the last", "[hw][rplidar]") {
  ReceiverEar ear;
  ear.hear(joined({kExpressAnswer, some_capsules(3)}));
  CHECK(ear.events[0] == Event{ScanStarted{DataType::capsules}});
  CHECK(points_among(ear.events) == 64);
  CHECK(ear.receiver.scan_statistics().frames == 3);
}

TEST_CASE("points are not drawn out over a broken capsule", "[hw][rplidar]") {
  ReceivedBytes stream = some_capsules(6);
  stream[2 * 84 + 40] ^= 0x01;
  ReceiverEar ear;
  ear.hear(joined({kExpressAnswer, stream}));
  CHECK(points_among(ear.events) == 32 * 3);  // between 0 and 1, 3 and 4, 4 and 5
  CHECK(ear.receiver.scan_statistics().bad_checksums == 1);
}

TEST_CASE("after a stop the rest of the scan is skipped and the next answer is read", "[hw][rplidar]") {
  ReceiverEar ear;
  ear.hear(joined({kScanAnswer, some_nodes(20)}));
  ear.events.clear();
  ear.receiver.expect_answer();
  ear.hear(joined({some_nodes(10), kHealthAnswer}));
  CHECK(ear.events == std::vector<Event>{Health{Health::State::warning, 2}});
  CHECK(ear.receiver.skipped_bytes() == 50);
}

TEST_CASE("a second scan does not begin with what was left of the first", "[hw][rplidar]") {
  ReceiverEar ear;
  const ReceivedBytes capsules = some_capsules(3);
  ear.hear(joined({kExpressAnswer, capsules}));
  ear.receiver.expect_answer();
  ear.events.clear();
  const auto later = encode_capsule({.start = 9000});
  ear.hear(joined({kExpressAnswer, ReceivedBytes(later.begin(), later.end())}));
  CHECK(points_among(ear.events) == 0);
  CHECK(ear.receiver.scan_statistics().frames == 1);
}

TEST_CASE("an answer that is cut by the next request is given up", "[hw][rplidar]") {
  ReceiverEar ear;
  ear.hear(hex("A5 5A 03 00 00 00 06 01"));
  ear.receiver.expect_answer();
  ear.hear(kHealthAnswer);
  CHECK(ear.events == std::vector<Event>{Health{Health::State::warning, 2}});
  CHECK(ear.receiver.skipped_bytes() == 0);
}
