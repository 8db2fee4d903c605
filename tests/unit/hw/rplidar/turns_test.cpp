// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/rplidar/turns.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

using namespace orca;
using namespace orca::hw::rplidar;
using namespace std::chrono_literals;

namespace {

constexpr double kNoEchoAtAll = std::numeric_limits<double>::infinity();
constexpr double kDegreeOfTurn = std::numbers::pi / 180.0;

/// A scanner whose points are 1 m away unless a test says more, and who collects them.
struct TurningScanner {
  explicit TurningScanner(std::size_t beams) : collector(beams) {}

  /// Adds a point at an angle [deg], counted clockwise from ahead as the scanner does.
  void see(double degrees, std::optional<double> range = 1.0, Duration after = 500us) {
    now += after;
    Point point;
    point.angle = counter_clockwise(degrees);
    point.range = range;
    if (const Turn* const turn = collector.add(point, now)) turns.push_back(*turn);
  }
  /// Adds points as a head sends them that corrects the angles of points with echo, and only those.
  void see_corrected(double degrees, std::optional<double> range) {
    const double earlier = range ? std::atan(0.0218 * (*range - 0.1555) / (0.1555 * *range)) : 0.0;
    see(degrees - earlier / kDegreeOfTurn, range);
  }
  /// Adds points from one angle to before another, a degree apart.
  void sweep(int from, int to, std::optional<double> range = 1.0) {
    for (int degrees = from; degrees < to; ++degrees) see(degrees, range);
  }

  TurnCollector collector;
  TimePoint now{1s};
  std::vector<Turn> turns;
};

}  // namespace

TEST_CASE("a turn begins behind, goes clockwise and has its middle beam ahead", "[hw][rplidar]") {
  TurningScanner scanner(8);  // at 180, 135, 90, 45, 0, -45, -90, -135 deg
  scanner.sweep(170, 180);
  for (int turn = 0; turn < 2; ++turn)
    for (int degrees = 180; degrees < 540; ++degrees) {
      const double to_left = -wrapped(degrees * kDegreeOfTurn) / kDegreeOfTurn;
      scanner.see(degrees, 100.0 + to_left);
    }
  REQUIRE(scanner.turns.size() == 1);
  const std::vector<double>& ranges = scanner.turns[0].ranges;
  REQUIRE(ranges.size() == 8);
  // Each is the shortest range, which is that of the rightmost point.
  CHECK(ranges[4] == Approx(100.0 - 22.0).margin(0.6));
  CHECK(ranges[2] == Approx(190.0 - 22.0).margin(0.6));
  CHECK(ranges[6] == Approx(10.0 - 22.0).margin(0.6));
}

TEST_CASE("a turn has the time of its first point, and lasts until the first of the next one",
          "[hw][rplidar]") {
  TurningScanner scanner(360);
  scanner.sweep(0, 180);
  const TimePoint begin = scanner.now + 500us;
  scanner.sweep(180, 540);
  CHECK(scanner.turns.empty());
  scanner.see(540);
  REQUIRE(scanner.turns.size() == 1);
  CHECK(scanner.turns[0].stamp == begin);
  CHECK(scanner.turns[0].period == 180ms);
  CHECK(scanner.collector.incomplete() == 0);
}

TEST_CASE("a part of a turn before the first whole one is no turn", "[hw][rplidar]") {
  TurningScanner scanner(360);
  scanner.sweep(100, 181);
  CHECK(scanner.turns.empty());
}

TEST_CASE("the nearest point of a beam counts, and a beam whose points have no echo is infinite",
          "[hw][rplidar]") {
  TurningScanner scanner(36);
  scanner.sweep(170, 355);
  scanner.see(355, std::nullopt);
  scanner.see(356, 3.0);
  scanner.see(357, 2.0);
  scanner.see(358, 2.5);
  scanner.sweep(359, 365, std::nullopt);
  scanner.sweep(365, 375, std::nullopt);
  scanner.sweep(375, 546);
  REQUIRE(scanner.turns.size() == 1);
  CHECK(scanner.turns[0].ranges[18] == 2.0);
  CHECK(scanner.turns[0].ranges[19] == kNoEchoAtAll);
  CHECK(scanner.turns[0].ranges[20] == 1.0);
}

TEST_CASE("a beam without a point has the shorter range beside it", "[hw][rplidar]") {
  TurningScanner scanner(360);
  scanner.sweep(170, 360);
  scanner.see(361, 4.0);  // beam 180 is ahead, 181 to the right of it; no point at 0 deg
  scanner.see(365, 2.0);
  scanner.sweep(366, 541, 3.0);
  REQUIRE(scanner.turns.size() == 1);
  const std::vector<double>& ranges = scanner.turns[0].ranges;
  CHECK(ranges[179] == 1.0);
  CHECK(ranges[180] == 1.0);
  CHECK(ranges[181] == 4.0);
  CHECK(ranges[182] == 2.0);
  CHECK(ranges[184] == 2.0);
  CHECK(ranges[186] == 3.0);
}

TEST_CASE("a turn in which points were lost is no turn, wherever they were lost", "[hw][rplidar]") {
  const int lost = GENERATE(8, 90, 200, 330);
  const int from = GENERATE(185, 300, 355, 530);
  TurningScanner scanner(360);
  scanner.sweep(170, from);
  scanner.now += 500us * lost;
  scanner.sweep(from + lost, 181 + 4 * 360);
  CAPTURE(lost, from);
  // Four whole turns, less those that the gap lies in.
  const int touched = from + lost > 541 ? 2 : 1;
  CHECK(scanner.turns.size() == static_cast<std::size_t>(4 - touched));
  for (const Turn& turn : scanner.turns) CHECK(turn.period == 180ms);
  CHECK(scanner.collector.incomplete() >= 1);
}

TEST_CASE("a room with openings makes turns, although only angles of points with echo are corrected",
          "[hw][rplidar]") {
  const int sector = GENERATE(15, 30, 45, 90);  // [deg] with echo, and as many without
  const double range = GENERATE(0.5, 4.0, 11.0);
  const int phase = GENERATE(0, 7, 14, 21);
  CAPTURE(sector, range, phase);
  TurningScanner scanner(360);
  const auto echoes = [&](int degrees) { return (degrees + phase) / sector % 2 == 0; };
  for (int degrees = 100; degrees < 190 + 4 * 360; ++degrees)
    scanner.see_corrected(degrees, echoes(degrees) ? std::optional(range) : std::nullopt);
  CHECK(scanner.collector.incomplete() == 0);
  CHECK(scanner.turns.size() == 4);
  for (const Turn& turn : scanner.turns) {
    const auto seen = std::ranges::count(turn.ranges, range);
    CHECK(seen >= 180);                     // no echo is left out,
    CHECK(seen <= 180 + 9 * 180 / sector);  // and what is near is so up to the next point
  }
}

TEST_CASE("what is near in front of what is far makes turns", "[hw][rplidar]") {
  TurningScanner scanner(360);
  for (int degrees = 100; degrees < 190 + 2 * 360; ++degrees)
    scanner.see_corrected(degrees, degrees / 20 % 2 == 0 ? 0.2 : 6.0);
  CHECK(scanner.collector.incomplete() == 0);
  CHECK(scanner.turns.size() == 2);
}

TEST_CASE("points that were lost beside an opening are lost", "[hw][rplidar]") {
  TurningScanner scanner(360);
  for (int degrees = 100; degrees < 190 + 2 * 360; ++degrees) {
    const int in_turn = degrees % 360;
    if (in_turn >= 255 && in_turn < 265) continue;
    scanner.see_corrected(degrees, in_turn < 260 ? std::optional(4.0) : std::nullopt);
  }
  CHECK(scanner.turns.empty());
  CHECK(scanner.collector.incomplete() == 2);
}

TEST_CASE("an echo that its correction moves back across the edge of a turn is not left out",
          "[hw][rplidar]") {
  TurningScanner scanner(360);
  scanner.sweep(100, 181, std::nullopt);
  scanner.see(181, std::nullopt);
  scanner.see(178, 2.0);
  scanner.sweep(182, 541, std::nullopt);
  REQUIRE(scanner.turns.size() == 1);
  CHECK(scanner.turns[0].ranges[358] == 2.0);
}

TEST_CASE("angles that step back a little do not end a turn twice", "[hw][rplidar]") {
  TurningScanner scanner(360);
  scanner.sweep(160, 540);
  scanner.see(541);
  scanner.see(538);
  scanner.see(542);
  scanner.see(537);
  scanner.sweep(543, 903);
  CHECK(scanner.turns.size() == 2);
  for (const Turn& turn : scanner.turns) CHECK(turn.period >= 179ms);
}

TEST_CASE("a scanner that hardly turns makes no turns", "[hw][rplidar]") {
  TurningScanner scanner(36);
  for (int degrees = 100; degrees < 1300; degrees += 3) scanner.see(degrees, 1.0, 20ms);
  CHECK(scanner.turns.empty());
  CHECK(scanner.collector.incomplete() == 3);
}

TEST_CASE("after a restart nothing of the scan before is left", "[hw][rplidar]") {
  TurningScanner scanner(360);
  scanner.sweep(170, 500);
  scanner.collector.restart();
  scanner.sweep(500, 720);
  CHECK(scanner.turns.empty());
  scanner.sweep(720, 901);
  CHECK(scanner.turns.size() == 1);
}
