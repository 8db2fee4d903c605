// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/avoidance/echo_memory.hpp"

#include <catch2/catch.hpp>
#include <utility>

using namespace orca::avoid;
using orca::Pose2;

namespace {

constexpr EchoMemory::Limits kMemoryLimits{4.0, 0.25, 0.15, 0.8};
constexpr Pose2 kStill{};

}  // namespace

TEST_CASE("a single echo is forgotten after a moment", "[avoidance][memory]") {
  EchoMemory memory;
  memory.hear({0.5, 0.0}, kMemoryLimits);
  memory.advance(kStill, 0.2, kMemoryLimits);
  CHECK(memory.echoes().size() == 1);
  memory.advance(kStill, 0.1, kMemoryLimits);
  CHECK(memory.echoes().empty());
}

TEST_CASE("an echo that was heard twice is kept for seconds and moves with the robot",
          "[avoidance][memory]") {
  EchoMemory memory;
  memory.hear({0.5, 0.0}, kMemoryLimits);
  memory.hear({0.51, 0.0}, kMemoryLimits);
  REQUIRE(memory.echoes().size() == 1);
  memory.advance({0.2, 0.0, 0.0}, 3.9, kMemoryLimits);
  REQUIRE(memory.echoes().size() == 1);
  CHECK(memory.echoes()[0].x == Approx(0.31));
  memory.advance(kStill, 0.2, kMemoryLimits);
  CHECK(memory.echoes().empty());
}

TEST_CASE("echoes along a wall confirm each other and all stay", "[avoidance][memory]") {
  EchoMemory memory;
  for (int i = 0; i < 4; ++i) memory.hear({0.1 * i, 0.4}, kMemoryLimits);
  memory.advance(kStill, 1.0, kMemoryLimits);
  CHECK(memory.echoes().size() == 4);
}

TEST_CASE("an echo from far away is not kept, however often it is heard", "[avoidance][memory]") {
  EchoMemory memory;
  for (int i = 0; i < 3; ++i) memory.hear({2.0, 0.0}, kMemoryLimits);
  memory.advance(kStill, 0.3, kMemoryLimits);
  CHECK(memory.echoes().empty());
}

TEST_CASE("the memory is bounded: the oldest echo makes room", "[avoidance][memory]") {
  EchoMemory memory;
  for (int i = 0; i < 1000; ++i) memory.hear({0.2 * i, 0.0}, kMemoryLimits);
  CHECK(memory.echoes().size() == 256);
  CHECK(memory.echoes().back().x == Approx(0.2 * 999));
}

TEST_CASE("what one sensor has heard is not confirmed, moved or forgotten by another one",
          "[avoidance][memory]") {
  EchoMemory::Limits other = kMemoryLimits;
  other.sensor = 1;
  EchoMemory memory;
  memory.hear({0.5, 0.0}, kMemoryLimits);
  memory.hear({0.51, 0.0}, other);
  REQUIRE(memory.echoes().size() == 2);
  memory.forget_if(1, [](orca::Vec2) { return true; });
  REQUIRE(memory.echoes().size() == 1);
  CHECK(memory.echoes()[0].x == Approx(0.5));
  memory.advance(kStill, 0.3, kMemoryLimits);
  CHECK(memory.echoes().empty());
}

TEST_CASE("each sensor has room for as many echoes as if it were alone", "[avoidance][memory]") {
  EchoMemory::Limits other = kMemoryLimits;
  other.sensor = 1;
  EchoMemory memory;
  memory.hear({0.0, 0.5}, other);
  for (int i = 0; i < 1000; ++i) memory.hear({0.2 * i, 0.0}, kMemoryLimits);
  CHECK(memory.echoes().size() == 257);
  CHECK(memory.echoes()[0].y == Approx(0.5));
}

TEST_CASE("an echo is certain when it was just heard, and less and less until it is forgotten",
          "[avoidance][memory]") {
  EchoMemory memory;
  memory.hear({0.5, 0.0}, kMemoryLimits);
  CHECK(memory.certainty(0, kMemoryLimits) == 1.0);
  memory.advance(kStill, 0.1, kMemoryLimits);
  CHECK(memory.certainty(0, kMemoryLimits) == Approx(1.0 - 0.1 / 0.25));
  memory.hear({0.5, 0.0}, kMemoryLimits);
  CHECK(memory.certainty(0, kMemoryLimits) == 1.0);
  memory.advance(kStill, 1.0, kMemoryLimits);
  CHECK(memory.certainty(0, kMemoryLimits) == Approx(1.0 - 1.0 / 4.0));
}

TEST_CASE("where echoes are not kept at all, those of this moment are certain", "[avoidance][memory]") {
  constexpr EchoMemory::Limits kNone{0.0, 0.0, 0.15, 0.8};
  EchoMemory memory;
  memory.hear({0.5, 0.0}, kNone);
  CHECK(memory.certainty(0, kNone) == 1.0);
  memory.advance(kStill, 0.01, kNone);
  CHECK(memory.echoes().empty());
}

TEST_CASE("how near two echoes must be to be one is a limit of the memory", "[avoidance][memory]") {
  for (const auto& [no_news, count] : {std::pair{0.04, 1U}, {0.01, 2U}}) {
    EchoMemory::Limits limits;
    limits.single_time = 1.0;
    limits.no_news = no_news;
    EchoMemory memory;
    memory.hear({0.5, 0.2}, limits);
    memory.hear({0.5, 0.22}, limits);
    CHECK(memory.echoes().size() == count);
    CHECK(memory.echoes().back() == orca::Vec2{0.5, 0.22});
  }
}
