// SPDX-License-Identifier: GPL-3.0-or-later
// A laser scan becomes echoes: the scan replaces the remembered echoes in its field of view.
#include "orca/avoidance/scan.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "orca/avoidance/advice.hpp"
#include "orca/base/random.hpp"

using namespace orca::avoid;
using std::numbers::pi;

namespace {

constexpr EchoMemory::Limits kKeep{4.0, 4.0, 0.15, 0.8};
constexpr double kSector = pi / 36;
constexpr double kMaxRange = 8.0;
const Limits kLimits{.robot_radius = 0.2,
                     .margin = 0.1,
                     .side_distance = 0.0,
                     .safe_distance = 0.8,
                     .stop_distance = 0.15,
                     .max_speed = 0.4};

// Half a turn ahead in steps of a degree, as laser scanners of that time had it.
Scan scan_of(const std::vector<double>& ranges, const orca::Pose2& mount = {}) {
  return {ranges, 0.05, kMaxRange, -pi / 2, pi / 180, mount};
}

std::vector<double> nothing() { return std::vector<double>(181, kMaxRange); }

// Ranges of a wall across the way, `ahead` [m] from the sensor, `half_width` [m] to both sides.
std::vector<double> scan_of_wall(double ahead, double half_width) {
  std::vector<double> ranges = nothing();
  for (std::size_t i = 0; i < ranges.size(); ++i) {
    const double angle = -pi / 2 + static_cast<double>(i) * pi / 180;
    if (std::cos(angle) > 0.01 && std::abs(ahead * std::tan(angle)) <= half_width)
      ranges[i] = ahead / std::cos(angle);
  }
  return ranges;
}

EchoMemory memory_of(const std::vector<double>& ranges, const orca::Pose2& mount = {}) {
  EchoMemory memory;
  see(scan_of(ranges, mount), {.sector = kSector, .range = 2.0}, kKeep, memory);
  return memory;
}

}  // namespace

TEST_CASE("a scan that sees nothing leaves nothing to avoid", "[avoidance][laser]") {
  CHECK(memory_of(nothing()).echoes().empty());
  CHECK_FALSE(avoid(memory_of(nothing()).echoes(), {}, kLimits).needed);
  CHECK(memory_of({}).echoes().empty());
}

TEST_CASE("the end of a beam follows from range, mount and angle", "[avoidance][laser]") {
  std::vector<double> ranges = nothing();
  ranges[90] = 1.0;
  const EchoMemory ahead = memory_of(ranges, {0.1, 0.0, 0.0});
  REQUIRE(ahead.echoes().size() == 1);
  CHECK(ahead.echoes()[0].x == Approx(1.1));
  CHECK(ahead.echoes()[0].y == Approx(0.0).margin(1e-9));
  const EchoMemory aside = memory_of(ranges, {0.0, 0.2, pi / 2});
  REQUIRE(aside.echoes().size() == 1);
  CHECK(aside.echoes()[0].x == Approx(0.0).margin(1e-9));
  CHECK(aside.echoes()[0].y == Approx(1.2));
}

TEST_CASE("a reading below the shortest range counts as something at the sensor itself",
          "[avoidance][laser]") {
  std::vector<double> ranges = nothing();
  ranges[90] = 0.01;
  const EchoMemory memory = memory_of(ranges, {0.1, 0.0, 0.0});
  REQUIRE(memory.echoes().size() == 1);
  CHECK(memory.echoes()[0].x == Approx(0.1));
}

TEST_CASE("a reading that is not a number, or too far away to matter, is no echo", "[avoidance][laser]") {
  std::vector<double> ranges = nothing();
  ranges[80] = std::nan("");
  ranges[90] = 2.5;
  ranges[100] = -1.0;
  CHECK(memory_of(ranges).echoes().size() == 1);  // the negative one counts as too near to tell
}

TEST_CASE("only the nearest reading in a sector is kept, so a scan costs no more than a ring of sonars",
          "[avoidance][laser]") {
  orca::RandomStream random(1, "test", "scan");
  for (int i = 0; i < 200; ++i) {
    std::vector<double> ranges = nothing();
    double nearest = kMaxRange;
    for (double& range : ranges) {
      range = random.uniform(0.3, 1.9);
      nearest = std::min(nearest, range);
    }
    const EchoMemory memory = memory_of(ranges);
    CHECK(memory.echoes().size() <= 37);
    double kept = kMaxRange;
    for (const orca::Vec2& echo : memory.echoes()) kept = std::min(kept, std::hypot(echo.x, echo.y));
    CHECK(kept < nearest + 0.04);  // neighbours nearer to each other than that are one echo
  }
}

TEST_CASE("of what is near the body the sides are kept, too, and of what is far only the nearest points",
          "[avoidance][laser]") {
  // A post of 15 cm beside the robot's way; its right side is 23 mm to the right of its nearest point in that sector.
  const auto post_at = [](double away) {
    std::vector<double> ranges = nothing();
    for (std::size_t i = 0; i < ranges.size(); ++i) {
      const double angle = -pi / 2 + static_cast<double>(i) * pi / 180;
      const double aside = away * std::sin(angle);
      if (std::cos(angle) > 0.0 && std::abs(aside) < 0.075)
        ranges[i] = away * std::cos(angle) - std::sqrt(0.075 * 0.075 - aside * aside);
    }
    return ranges;
  };
  const auto farthest_right = [&](const std::vector<double>& ranges, double near) {
    EchoMemory memory;
    EchoMemory::Limits keep = kKeep;
    keep.no_news = 0.01;
    see(scan_of(ranges), {.sector = kSector, .range = 2.0, .near = near, .fine = pi / 120}, keep, memory);
    double right = 0.0;
    for (const orca::Vec2& echo : memory.echoes()) right = std::min(right, echo.y);
    return right;
  };
  CHECK(farthest_right(post_at(0.4), 0.5) == Approx(-0.068).margin(0.005));
  CHECK(farthest_right(post_at(0.4), 0.0) > farthest_right(post_at(0.4), 0.5) + 0.01);
  CHECK(farthest_right(post_at(1.0), 0.5) == farthest_right(post_at(1.0), 0.0));
}

TEST_CASE("a scan forgets echoes that it no longer sees in its field of view, and keeps those behind",
          "[avoidance][laser]") {
  EchoMemory memory = memory_of(scan_of_wall(0.6, 0.3));
  memory.hear({-0.5, 0.0}, kKeep);
  see(scan_of(nothing()), {.sector = kSector, .range = 2.0}, kKeep, memory);
  REQUIRE(memory.echoes().size() == 1);
  CHECK(memory.echoes()[0].x == Approx(-0.5));
}

TEST_CASE("in front of a wall that a scan sees the robot slows down and turns away", "[avoidance][laser]") {
  double last_speed = kLimits.max_speed;
  for (double ahead = 1.0; ahead > 0.35; ahead -= 0.05) {
    const EchoMemory memory = memory_of(scan_of_wall(ahead, 0.4));
    const Advice advice = avoid(memory.echoes(), {.last_direction = 0.1}, kLimits);
    REQUIRE(advice.needed);
    CHECK(advice.speed <= last_speed);
    last_speed = advice.speed;
  }
  CHECK(avoid(memory_of(scan_of_wall(0.6, 0.4)).echoes(), {.last_direction = 0.1}, kLimits).direction > 0.3);
  CHECK(last_speed == 0.0);
}

TEST_CASE("a memory of hidden echoes loses those that the beams reach, and keeps those behind what they meet",
          "[avoidance][laser]") {
  EchoMemory::Limits keep = kKeep;
  keep.hidden = true;
  std::vector<double> ranges = nothing();
  for (std::size_t i = 85; i <= 95; ++i) ranges[i] = 1.0;
  EchoMemory memory;
  const orca::Vec2 behind{1.3, 0.0};
  memory.hear(behind, keep);
  memory.hear({0.7, 0.7}, keep);
  see(scan_of(ranges), {.sector = kSector, .range = 2.0}, keep, memory);
  const auto remembers = [&](orca::Vec2 place) {
    return std::ranges::any_of(memory.echoes(), [&](orca::Vec2 echo) { return norm(echo - place) < 0.01; });
  };
  CHECK(remembers(behind));
  CHECK_FALSE(remembers({0.7, 0.7}));
  see(scan_of(nothing()), {.sector = kSector, .range = 2.0}, keep, memory);
  CHECK(memory.echoes().empty());
}

TEST_CASE("where all beams point one way, none is beside another that could hide an echo",
          "[avoidance][laser]") {
  EchoMemory::Limits keep = kKeep;
  keep.hidden = true;
  EchoMemory memory;
  memory.hear({1.3, 0.0}, keep);
  const std::vector<double> ranges{1.0, 1.0};
  see({ranges, 0.05, kMaxRange, 0.0, 0.0, {}}, {.sector = kSector, .range = 2.0}, keep, memory);
  CHECK(std::ranges::none_of(memory.echoes(), [](orca::Vec2 echo) { return echo.x > 1.1; }));
}

TEST_CASE("a laser that looks over something leaves what another one sees of it", "[avoidance][laser]") {
  EchoMemory::Limits low = kKeep;
  low.sensor = 1;
  constexpr Detail kDetail{.sector = kSector, .range = 2.0};
  EchoMemory memory;
  see(scan_of(scan_of_wall(0.6, 0.3)), kDetail, low, memory);
  const std::size_t seen = memory.echoes().size();
  REQUIRE(seen > 0);
  see(scan_of(nothing()), kDetail, kKeep, memory);
  CHECK(memory.echoes().size() == seen);
  CHECK(avoid(memory.echoes(), {}, kLimits).needed);
  see(scan_of(nothing()), kDetail, low, memory);
  CHECK(memory.echoes().empty());
}
