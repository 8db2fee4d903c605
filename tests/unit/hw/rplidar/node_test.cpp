// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/rplidar/node.hpp"

#include <catch2/catch.hpp>

#include <numbers>

#include "hex_bytes.hpp"
#include "orca/base/random.hpp"
#include "rplidar_bytes.hpp"

using namespace orca::hw::rplidar;
using orca::hw::test::hex;
using orca::hw::test::text_of;

TEST_CASE("a node that begins a scan is read", "[hw][rplidar]") {
  // Quality 15, start flag; 90 deg = 5760 / 64; 1 m = 4000 / 4 mm.
  const auto node = parse_node(hex("3D 01 2D A0 0F"));
  REQUIRE(node.has_value());
  CHECK(*node == Node{.begins_scan = true, .quality = 15, .angle = 5760, .distance = 4000});
  const Point point = point_of(*node);
  CHECK(point.begins_scan);
  CHECK(point.quality == 15);
  CHECK(*point.range == 1.0);
}

TEST_CASE("a node without an echo has no range", "[hw][rplidar]") {
  // Quality 0, no start flag; 359.984375 deg = 23039 / 64.
  const auto node = parse_node(hex("02 FF B3 00 00"));
  REQUIRE(node.has_value());
  CHECK(*node == Node{.angle = 23039});
  CHECK_FALSE(point_of(*node).range.has_value());
}

TEST_CASE("the scanner counts clockwise, a point counter-clockwise", "[hw][rplidar]") {
  const auto angle = [](int degrees) {
    return point_of(Node{.angle = static_cast<std::uint16_t>(64 * degrees)}).angle;
  };
  CHECK(angle(0) == 0.0);
  CHECK(angle(90) == Approx(-std::numbers::pi / 2.0));
  CHECK(angle(270) == Approx(std::numbers::pi / 2.0));
  CHECK(angle(180) == Approx(std::numbers::pi));
  CHECK(angle(181) == Approx(std::numbers::pi * 179.0 / 180.0));
  CHECK(angle(359) == Approx(std::numbers::pi / 180.0));
}

TEST_CASE("a node whose flags do not fit is none", "[hw][rplidar]") {
  CHECK_FALSE(parse_node(hex("3C 01 2D A0 0F")).has_value());  // neither flag
  CHECK_FALSE(parse_node(hex("3F 01 2D A0 0F")).has_value());  // both
  CHECK_FALSE(parse_node(hex("3D 00 2D A0 0F")).has_value());  // check bit
  CHECK_FALSE(parse_node(hex("3D 01 B4 A0 0F")).has_value());  // 360 deg
  CHECK(parse_node(hex("3D FF B3 A0 0F")).has_value());        // just less
}

TEST_CASE("what is written as a node is read again", "[hw][rplidar]") {
  orca::RandomStream random(1, "test", "node");
  CHECK(text_of(encode_node({.begins_scan = true, .quality = 15, .angle = 5760, .distance = 4000})) ==
        "3D 01 2D A0 0F");
  for (int round = 0; round < 1000; ++round) {
    const Node node{.begins_scan = random.chance(0.5),
                    .quality = static_cast<std::uint8_t>(random() % 64),
                    .angle = static_cast<std::uint16_t>(random() % kWholeTurn),
                    .distance = static_cast<std::uint16_t>(random() % 65536)};
    CHECK(parse_node(encode_node(node)) == node);
  }
}
