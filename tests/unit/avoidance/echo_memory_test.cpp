// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/avoidance/echo_memory.hpp"

#include <catch2/catch.hpp>
#include <numbers>

using namespace orca::avoid;

namespace {

constexpr double kQuarter = std::numbers::pi / 2;
constexpr EchoMemory::Limits kLimits{4.0, 0.25, 0.15, 0.8};
constexpr Motion kStill{};

}  // namespace

TEST_CASE("what is ahead comes nearer as the robot drives on", "[avoidance][memory]") {
  const Echo echo = seen_after({1.0, 0.2}, {0.3, 0.0, 0.0});
  CHECK(echo.x == Approx(0.7));
  CHECK(echo.y == Approx(0.2));
}

TEST_CASE("what is ahead lies to the right after a quarter turn to the left", "[avoidance][memory]") {
  const Echo echo = seen_after({1.0, 0.0}, {0.0, 0.0, kQuarter});
  CHECK(echo.x == Approx(0.0).margin(1e-12));
  CHECK(echo.y == Approx(-1.0));
}

TEST_CASE("an even drive is an arc, and backwards in time it leads back", "[avoidance][memory]") {
  const Motion quarter_circle = arc(kQuarter, kQuarter, 1.0);
  CHECK(quarter_circle.x == Approx(1.0));
  CHECK(quarter_circle.y == Approx(1.0));
  CHECK(quarter_circle.yaw == Approx(kQuarter));
  const Motion straight = arc(0.5, 0.0, 2.0);
  CHECK(straight.x == Approx(1.0));
  CHECK(straight.y == 0.0);
  const Motion back = arc(0.5, 0.0, -2.0);
  CHECK(back.x == Approx(-1.0));
}

TEST_CASE("the motion between two poses is given in the frame of the first", "[avoidance][memory]") {
  const Motion motion = between({1.0, 1.0, kQuarter}, {1.0, 3.0, -std::numbers::pi + 0.1});
  CHECK(motion.x == Approx(2.0));
  CHECK(motion.y == Approx(0.0).margin(1e-12));
  CHECK(motion.yaw == Approx(kQuarter + 0.1));
}

TEST_CASE("a single echo is forgotten after a moment", "[avoidance][memory]") {
  EchoMemory memory;
  memory.hear({0.5, 0.0}, kLimits);
  memory.advance(kStill, 0.2, kLimits);
  CHECK(memory.echoes().size() == 1);
  memory.advance(kStill, 0.1, kLimits);
  CHECK(memory.echoes().empty());
}

TEST_CASE("an echo that was heard twice is kept for seconds and moves with the robot",
          "[avoidance][memory]") {
  EchoMemory memory;
  memory.hear({0.5, 0.0}, kLimits);
  memory.hear({0.51, 0.0}, kLimits);
  REQUIRE(memory.echoes().size() == 1);
  memory.advance({0.2, 0.0, 0.0}, 3.9, kLimits);
  REQUIRE(memory.echoes().size() == 1);
  CHECK(memory.echoes()[0].x == Approx(0.31));
  memory.advance(kStill, 0.2, kLimits);
  CHECK(memory.echoes().empty());
}

TEST_CASE("echoes along a wall confirm each other and all stay", "[avoidance][memory]") {
  EchoMemory memory;
  for (int i = 0; i < 4; ++i) memory.hear({0.1 * i, 0.4}, kLimits);
  memory.advance(kStill, 1.0, kLimits);
  CHECK(memory.echoes().size() == 4);
}

TEST_CASE("an echo from far away is not kept, however often it is heard", "[avoidance][memory]") {
  EchoMemory memory;
  for (int i = 0; i < 3; ++i) memory.hear({2.0, 0.0}, kLimits);
  memory.advance(kStill, 0.3, kLimits);
  CHECK(memory.echoes().empty());
}

TEST_CASE("the memory is bounded: the oldest echo makes room", "[avoidance][memory]") {
  EchoMemory memory;
  for (int i = 0; i < 1000; ++i) memory.hear({0.2 * i, 0.0}, kLimits);
  CHECK(memory.echoes().size() == 256);
  CHECK(memory.echoes().back().x == Approx(0.2 * 999));
}
