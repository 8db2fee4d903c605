// SPDX-License-Identifier: GPL-3.0-or-later
// How a CollisionMonitor hears who comes from beside.
#include "collision_monitor/flanks.hpp"

#include <catch2/catch.hpp>
#include <numbers>
#include <vector>

using namespace orca;
using namespace orca::gate;

namespace {

constexpr double kRound = 0.32;  // [s]
constexpr double kHalfTurn = std::numbers::pi;

// A sonar that looks to the left of a robot at rest in the origin, and hears one range each round.
std::vector<Passer> heard(const std::vector<double>& ranges, bool known = false) {
  Flanks flanks;
  double time = 1.0;
  for (const double range : ranges) {
    time += kRound;
    flanks.hear("ring", {7, time, range, 5.0, {0.0, 0.15, 0.5 * kHalfTurn}}, known);
  }
  return flanks.comers(time, {});
}

}  // namespace

TEST_CASE("an echo that comes nearer twice in a row is somebody who comes", "[gate][people]") {
  CHECK(heard({2.0, 1.6}).empty());
  const auto comers = heard({2.0, 1.6, 1.2});
  REQUIRE(comers.size() == 1);
  CHECK(comers[0].place.x == Approx(0.0).margin(1e-9));
  CHECK(comers[0].place.y == Approx(1.35));
  CHECK(comers[0].velocity.y == Approx(-0.4 / kRound));
}

TEST_CASE("what stays, leaves, jumps, or is far away is nobody who comes", "[gate][people]") {
  CHECK(heard({1.0, 1.0, 1.0, 1.0}).empty());
  CHECK(heard({1.0, 1.2, 1.4, 1.6}).empty());
  CHECK(heard({2.4, 1.2, 1.2, 0.3}).empty());
  CHECK(heard({4.0, 3.6, 3.2, 2.8}).empty());
  CHECK(heard({2.4, 2.2, 2.0}).empty());
}

TEST_CASE("what a laser shows as well is no news", "[gate][people]") {
  CHECK(heard({2.0, 1.6, 1.2}, true).empty());
}

TEST_CASE("a wall beside a robot that drives past it, or turns to it, stays where it is", "[gate][people]") {
  Flanks flanks;
  for (int i = 0; i < 10; ++i) {
    const double time = kRound * i;
    // It drives along a wall, to which it comes nearer by its own motion.
    const Pose2 X_OR{0.5 * time, 0.2 * time, 0.0};
    flanks.hear("ring", {7, time, 1.5 - 0.2 * time, 5.0, X_OR * Pose2{0.0, 0.0, 0.5 * kHalfTurn}}, false);
    CHECK(flanks.comers(time, X_OR).empty());
  }
}

TEST_CASE("who was heard some time ago counts no more", "[gate][people]") {
  Flanks flanks;
  double time = 0.0;
  for (const double range : {2.0, 1.6, 1.2}) flanks.hear("ring", {7, time += kRound, range, 5.0, {}}, false);
  CHECK(flanks.comers(time, {}).size() == 1);
  CHECK(flanks.comers(time + Flanks::kFresh + 0.01, {}).empty());
  flanks.clear();
  CHECK(flanks.comers(time, {}).empty());
}
