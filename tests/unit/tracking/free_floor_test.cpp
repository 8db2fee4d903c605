// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/tracking/free_floor.hpp"

#include <catch2/catch.hpp>
#include <vector>

using namespace orca;
using orca::tracking::FreeFloor;

namespace {

// Beams side by side along x, one each 5 cm, to something that stands at that x [m] there.
std::vector<nav::Beam> curtain(double reach, bool echo = true) {
  std::vector<nav::Beam> beams;
  for (double y = -1.0; y < 1.0; y += 0.05) beams.push_back({{0.0, y}, {reach, y}, echo});
  return beams;
}

}  // namespace

TEST_CASE("floor is free that two scans have looked through, for a while", "[tracking]") {
  FreeFloor floor;
  floor.see(curtain(4.0), 0.0);
  CHECK_FALSE(floor.was_free({2.0, 0.0}, 0.0));
  floor.see(curtain(4.0), 0.1);
  CHECK(floor.was_free({2.0, 0.0}, 0.1));
  CHECK(floor.is_seen_free({2.0, 0.0}));
  CHECK(floor.was_free({2.0, 0.0}, 1.0));
  CHECK_FALSE(floor.was_free({2.0, 0.0}, 0.1 + FreeFloor::kLately + 0.01));
}

TEST_CASE("neither what is seen nor what lies beside or behind it is free", "[tracking]") {
  FreeFloor floor;
  for (const double time : {0.0, 0.1, 0.2}) floor.see(curtain(3.0), time);
  for (const double x : {2.85, 3.0, 3.1, 5.0}) {
    CHECK_FALSE(floor.was_free({x, 0.0}, 0.2));
    CHECK_FALSE(floor.is_seen_free({x, 0.0}));
  }
  CHECK(floor.was_free({2.5, 0.0}, 0.2));
}

TEST_CASE("beams without echo make floor open and not free", "[tracking]") {
  FreeFloor floor;
  for (const double time : {0.0, 0.1}) floor.see(curtain(8.0, false), time);
  CHECK_FALSE(floor.was_free({4.0, 0.0}, 0.1));
  CHECK(floor.was_open({4.0, 0.0}, 0.1));
}

TEST_CASE("a single beam without echo among others has met something that it does not show", "[tracking]") {
  FreeFloor floor;
  for (const double time : {0.0, 0.1}) {
    std::vector<nav::Beam> scan = curtain(3.0);
    scan[20] = {{0.0, 0.0}, {8.0, 0.0}, false};
    floor.see(scan, time);
  }
  CHECK_FALSE(floor.was_open({4.0, 0.0}, 0.1));
}

TEST_CASE("a wall along which beams graze until no echo comes back is not open farther on", "[tracking]") {
  FreeFloor floor;
  for (const double time : {0.0, 0.1}) {
    std::vector<nav::Beam> scan;
    for (int i = 90; i >= 0; --i) {  // from the left to straight on, beside a wall at y = 1 m
      const Vec2 ahead = direction(i * 0.0174533);
      const double range = ahead.y > 0.0 ? 1.0 / ahead.y : 100.0;
      scan.push_back(range < 4.0 ? nav::Beam{{}, range * ahead, true} : nav::Beam{{}, 8.0 * ahead, false});
    }
    floor.see(scan, time);
  }
  CHECK_FALSE(floor.was_open({5.5, 1.0}, 0.1));
  CHECK(floor.was_open({5.5, 0.2}, 0.1));
}

TEST_CASE("a place far away takes the memory of another, and does not inherit what was known of it",
          "[tracking]") {
  FreeFloor floor;
  const double far = FreeFloor::kSide * FreeFloor::kCells;
  for (const double time : {0.0, 0.1}) floor.see(curtain(4.0), time);
  CHECK_FALSE(floor.was_free({2.0 + far, 0.0}, 0.1));
}
