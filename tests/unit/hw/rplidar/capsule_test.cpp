// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/rplidar/capsule.hpp"

#include <catch2/catch.hpp>

#include <numbers>

#include "hex_bytes.hpp"
#include "orca/base/random.hpp"
#include "rplidar_bytes.hpp"

using namespace orca::hw::rplidar;
using orca::RandomStream;
using orca::hw::test::FrameList;
using orca::hw::test::hex;
using orca::hw::test::joined;
using CapsuleBytes = std::vector<std::uint8_t>;

namespace {

// Start at 90 deg = 5760 / 64. The first cabin: 1000 mm with 3 / 8 deg, 2000 mm with 49 / 8 deg; all others nothing.
// 1000 * 4 + 0 = 0FA0; 2000 * 4 + 3 = 1F43; the low parts of the corrections are 3 and 1.
// Exclusive or: 80 ^ 16 ^ A0 ^ 0F ^ 43 ^ 1F ^ 13 = 76.
CapsuleBytes example_capsule() {
  CapsuleBytes bytes = hex("A6 57 80 16 A0 0F 43 1F 13");
  bytes.resize(kCapsuleSize);
  return bytes;
}

Capsule random_capsule(RandomStream& random) {
  Capsule capsule{.is_first = random.chance(0.5), .start = static_cast<std::uint16_t>(random() % 23040)};
  for (auto& sample : capsule.samples)
    sample = {static_cast<std::uint16_t>(random() % 16384), static_cast<std::uint8_t>(random() % 64)};
  return capsule;
}

// A capsule of points at 1 m, starting there.
Capsule at_degrees(double degrees, bool is_first = false) {
  Capsule capsule{.is_first = is_first, .start = static_cast<std::uint16_t>(64.0 * degrees)};
  capsule.samples.fill({1000, 0});
  return capsule;
}

double in_degrees(double radians) { return radians * 180.0 / std::numbers::pi; }

}  // namespace

TEST_CASE("a capsule is read bit by bit", "[hw][rplidar]") {
  const Capsule capsule = parse_capsule(example_capsule());
  CHECK_FALSE(capsule.is_first);
  CHECK(capsule.start == 5760);
  CHECK(capsule.samples[0] == Capsule::Sample{1000, 3});
  CHECK(capsule.samples[1] == Capsule::Sample{2000, 49});
  CHECK(capsule.samples[2] == Capsule::Sample{});
  const auto encoded = encode_capsule(capsule);
  CHECK(CapsuleBytes(encoded.begin(), encoded.end()) == example_capsule());
}

TEST_CASE("the first capsule has a mark in its start angle", "[hw][rplidar]") {
  CapsuleBytes bytes = example_capsule();
  bytes[3] = 0x96;
  CHECK(parse_capsule(bytes).is_first);
  CHECK(parse_capsule(bytes).start == 5760);
}

TEST_CASE("a capsule is recognised by its marks and its checksum", "[hw][rplidar]") {
  using Kind = orca::hw::framing::Finding::Kind;
  const CapsuleBytes good = example_capsule();
  CHECK(look_at_capsule(good).kind == Kind::frame);
  CHECK(look_at_capsule(good).size == 84);
  CHECK(look_at_capsule(std::span(good).first(83)).kind == Kind::need_more);
  CHECK(look_at_capsule(std::span(good).first(1)).kind == Kind::need_more);
  CHECK(look_at_capsule(hex("A6 A6")).kind == Kind::nothing);
  CHECK(look_at_capsule(hex("56")).kind == Kind::nothing);
  for (std::size_t bit = 0; bit < 84 * 8; ++bit) {
    CapsuleBytes wrong = good;
    wrong[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    CHECK(look_at_capsule(wrong).kind != Kind::frame);
  }
}

TEST_CASE("capsules are found behind garbage and behind a broken one", "[hw][rplidar]") {
  const CapsuleBytes good = example_capsule();
  CapsuleBytes broken = good;
  broken[50] ^= 0x10;
  FrameList list(kCapsuleProtocol);
  list.hear(joined({{0xA5, 0x5A, 0xA0}, good, broken, good, good}));
  CHECK(list.frames().size() == 3);
  CHECK(list.statistics().skipped_bytes == 3 + 84);
}

TEST_CASE("what is written as a capsule is read again", "[hw][rplidar]") {
  RandomStream random(1, "test", "capsule");
  for (int round = 0; round < 500; ++round) {
    const Capsule capsule = random_capsule(random);
    const auto bytes = encode_capsule(capsule);
    CHECK(look_at_capsule(bytes).kind == orca::hw::framing::Finding::Kind::frame);
    CHECK(parse_capsule(bytes) == capsule);
  }
}

TEST_CASE("the points of a capsule lie between its start and that of the next", "[hw][rplidar]") {
  CapsulePoints capsules;
  CHECK_FALSE(capsules.add(parse_capsule(example_capsule())).has_value());
  const auto points = capsules.add(at_degrees(106.0));
  REQUIRE(points.has_value());
  CHECK(in_degrees((*points)[0].angle) == Approx(-(90.0 - 0.375)));
  CHECK((*points)[0].range == 1.0);
  CHECK_FALSE((*points)[0].quality.has_value());
  CHECK(in_degrees((*points)[1].angle) == Approx(-(90.5 - 6.125)));
  CHECK((*points)[1].range == 2.0);
  CHECK(in_degrees((*points)[31].angle) == Approx(-105.5));
  CHECK_FALSE((*points)[31].range.has_value());
}

TEST_CASE("a capsule across a whole turn begins a scan with the first point behind it", "[hw][rplidar]") {
  CapsulePoints capsules;
  capsules.add(at_degrees(356.0));
  const auto points = capsules.add(at_degrees(4.0)).value();
  for (std::size_t k = 0; k < kCapsulePoints; ++k) CHECK(points[k].begins_scan == (k == 16));
  CHECK(in_degrees(points[0].angle) == Approx(4.0));
  CHECK(in_degrees(points[15].angle) == Approx(0.25));
  CHECK(points[16].angle == 0.0);
  CHECK(in_degrees(points[31].angle) == Approx(-3.75));
}

TEST_CASE("a scan that begins with a capsule is marked at its first point", "[hw][rplidar]") {
  CapsulePoints capsules;
  capsules.add(at_degrees(344.0));
  const auto before = capsules.add(at_degrees(0.0)).value();
  for (const Point& point : before) CHECK_FALSE(point.begins_scan);
  const auto points = capsules.add(at_degrees(16.0)).value();
  for (std::size_t k = 0; k < kCapsulePoints; ++k) CHECK(points[k].begins_scan == (k == 0));
}

TEST_CASE("each turn begins once, at any speed", "[hw][rplidar]") {
  RandomStream random(2, "test", "capsule");
  CapsulePoints capsules;
  double way = 0.0;
  int beginnings = 0;
  double last_start = 0.0;
  while (way < 360.0 * 100) {
    last_start = way;
    if (const auto points = capsules.add(at_degrees(way - 360.0 * static_cast<int>(way / 360.0))))
      for (const Point& point : *points) beginnings += point.begins_scan ? 1 : 0;
    way += random.uniform(5.0, 30.0);
  }
  CHECK(last_start >= 360.0 * 99);
  CHECK(beginnings == 99);
}

TEST_CASE("after the first capsule of a scan, or a lost one, the one before is forgotten", "[hw][rplidar]") {
  CapsulePoints capsules;
  capsules.add(at_degrees(10.0));
  CHECK_FALSE(capsules.add(at_degrees(20.0, true)).has_value());
  CHECK(capsules.add(at_degrees(30.0)).has_value());
  capsules.forget();
  CHECK_FALSE(capsules.add(at_degrees(60.0)).has_value());
  CHECK(in_degrees(capsules.add(at_degrees(70.0)).value()[0].angle) == Approx(-60.0));
}

TEST_CASE("a turn that ended before the first capsule of a scan does not begin this scan", "[hw][rplidar]") {
  CapsulePoints capsules;
  capsules.add(at_degrees(344.0));
  CHECK(capsules.add(at_degrees(0.0)).has_value());  // the next point would begin a scan
  capsules.add(at_degrees(100.0, true));
  const auto points = capsules.add(at_degrees(116.0)).value();
  for (const Point& point : points) CHECK_FALSE(point.begins_scan);
}

TEST_CASE("a start angle of more than a turn does no harm", "[hw][rplidar]") {
  CapsulePoints capsules;
  capsules.add(Capsule{.start = 32767});
  const auto points = capsules.add(Capsule{.start = 23041}).value();
  for (const Point& point : points) {
    CHECK(point.angle <= std::numbers::pi);
    CHECK(point.angle > -std::numbers::pi);
  }
}
