// SPDX-License-Identifier: GPL-3.0-or-later
// Sonars that hear each other, against closed forms. A sound that has travelled a distance L when it arrives,
// and was sent dt before the listener's own, reads as (L - c dt) / 2.
#include <catch2/catch.hpp>

#include "orca/sim/world.hpp"
#include "scout.hpp"
#include "sensors/sonar_air.hpp"

using namespace orca::sim;
using orca::Pose2;
using namespace orca::sim::test;
using namespace std::chrono_literals;

namespace {

constexpr double kSoundSpeed = 343.0;
constexpr auto kNobody = static_cast<std::size_t>(-1);

detail::Beam ring_beam_at(const Pose2& sensor) {
  return {sensor, detail::Lobe(12.5 * kDegree), 0.15, 6.5, 0.3, kNobody};
}

detail::Echo echo_at(const Caster& caster, const Pose2& sensor) {
  detail::Echo echo;
  detail::listen_for(caster, ring_beam_at(sensor), std::tan(25.0 * kDegree), echo);
  return echo;
}

// Returns the range that the listener reads from another's sound, which was sent `earlier` than its own.
// Nearer echoes of its own sound would hide it and are left out.
std::optional<double> heard_by(const Caster& caster, detail::SonarAir& air, const Pose2& listener,
                               orca::TimePoint now) {
  detail::Echo echo = echo_at(caster, listener);
  const std::uint64_t own = air.send(now, ring_beam_at(listener), echo);
  echo.range.reset();
  detail::Sectors::Search search;
  return air.first_heard(caster, own, echo, search);
}

constexpr orca::TimePoint kNow = orca::TimePoint{} + 1s;

std::optional<double> stray(const WorldModel& world, const Pose2& sender, const Pose2& listener,
                            orca::Duration earlier = 0ms) {
  const Caster caster(world);
  detail::SonarAir air;
  air.send(kNow - earlier, ring_beam_at(sender), echo_at(caster, sender));
  return heard_by(caster, air, listener, kNow);
}

WorldModel wall_at(double distance) {
  return {"wall", {{"wall", Box{{distance + 0.1, 0, 0}, {0.1, 10}}, 2.5}}, {}};
}

constexpr Pose2 kAhead{0, 0, 0};
Pose2 facing(double distance) { return {distance, 0, std::numbers::pi}; }

// A Scout with a single transducer, ahead.
RobotModel one_eared() {
  RobotModel model = scout();
  model.sonars[0].count = 1;
  model.sonars[0].order = {0};
  return model;
}

}  // namespace

TEST_CASE("two sonars that face each other and fire at the same time each read half the distance",
          "[sim][sonar][crosstalk][validation]") {
  CHECK(stray({}, facing(4.0), kAhead).value() == Approx(2.0).margin(1e-9));
}

TEST_CASE("the sound of a facing sonar that fired earlier shortens the reading by half the way it had gone",
          "[sim][sonar][crosstalk][validation]") {
  CHECK(stray({}, facing(8.0), kAhead, 10ms).value() ==
        Approx(0.5 * (8.0 - kSoundSpeed * 0.010)).margin(1e-9));
  CHECK_FALSE(stray({}, facing(8.0), kAhead, 25ms));  // It has passed before the listener fires.
}

TEST_CASE("a neighbour's sound reflected by a wall comes as if from its mirror image",
          "[sim][sonar][crosstalk][validation]") {
  const Pose2 neighbour{0, 0.4, 0};
  const double way = std::hypot(2.0 * 3.0, 0.4);
  CHECK(stray(wall_at(3.0), neighbour, kAhead).value() == Approx(0.5 * way).margin(1e-9));
  CHECK(stray(wall_at(3.0), neighbour, kAhead, 10ms).value() ==
        Approx(0.5 * (way - kSoundSpeed * 0.010)).margin(1e-9));
}

TEST_CASE("a post reflects a neighbour's sound", "[sim][sonar][crosstalk]") {
  const WorldModel post{"post", {{"post", Circle{{3.0, 0.0}, 0.2}, 2.5}}, {}};
  // Both are equally far from the post, so the point of the post between them reflects the sound.
  const double one_way = std::hypot(2.8, 0.2);
  CHECK(stray(post, {0, 0.2, 0}, {0, -0.2, 0}).value() == Approx(one_way).margin(1e-9));
}

TEST_CASE("sound is reflected by a body that has moved on since, and not by one that came later",
          "[sim][sonar][crosstalk]") {
  Caster caster(WorldModel{});
  const Pose2 neighbour{0, 0.4, 0};
  const auto crate = [](double distance) { return Box{{distance + 0.1, 0, 0}, {0.1, 1.0}}; };
  const std::size_t first = caster.add_body({crate(3.0), 0.0, 1.0});
  detail::SonarAir air;
  air.send(kNow - 10ms, ring_beam_at(neighbour), echo_at(caster, neighbour));
  caster.move_body(first, crate(3.02));
  const double way = std::hypot(2.0 * 3.02, 0.4);
  CHECK(heard_by(caster, air, kAhead, kNow).value() ==
        Approx(0.5 * (way - kSoundSpeed * 0.010)).margin(1e-9));
  caster.remove_body(first);
  caster.add_body({crate(3.02), 0.0, 1.0});
  CHECK_FALSE(heard_by(caster, air, kAhead, kNow));
}

TEST_CASE("a thin post reflects sound wherever both beams hold it, and nowhere else",
          "[sim][sonar][crosstalk]") {
  const WorldModel thin{"thin", {{"post", Circle{{3.0, 0.0}, 0.02}, 2.5}}, {}};
  const double rim = 3.0 * std::tan(12.5 * kDegree);  // [m] From the axis to the rim of a lobe, at the post.
  for (int i = 0; i <= 50; ++i) {
    CAPTURE(i);
    CHECK(stray(thin, {0, 0.02 * i * (rim - 0.02), 0}, kAhead).has_value());
  }
  CHECK_FALSE(stray(thin, {0, rim + 0.03, 0}, kAhead));
}

TEST_CASE("thousands of bodies that come and go do not change the sound reflected by those that are there",
          "[sim][sonar][crosstalk]") {
  Caster caster(WorldModel{});
  const Pose2 neighbour{0, 0.4, 0};
  caster.add_body({Box{{3.1, 0, 0}, {0.1, 1.0}}, 0.0, 1.0});
  const double expected = 0.5 * (std::hypot(2.0 * 3.0, 0.4) - kSoundSpeed * 0.005);
  detail::SonarAir air;
  for (int i = 0; i < 3000; ++i) {
    const orca::TimePoint now = kNow + i * 100ms;
    air.settle(now - 10ms);
    air.send(now - 5ms, ring_beam_at(neighbour), echo_at(caster, neighbour));
    const std::size_t passing = caster.add_body({Circle{{2.9, -3.0}, 0.05}, 0.0, 1.0});
    const Pose2 aside{0, -3.0, 0};
    air.send(now - 4ms, ring_beam_at(aside), echo_at(caster, aside));
    caster.remove_body(passing);
    air.settle(now - 4ms);
    CAPTURE(i);
    REQUIRE(heard_by(caster, air, kAhead, now).value() == Approx(expected).margin(1e-9));
  }
}

TEST_CASE("a sonar that fires on and on hears its own last sound, and nothing older",
          "[sim][sonar][crosstalk]") {
  const Caster caster(wall_at(3.0));
  detail::SonarAir air;
  for (int tick = 0; tick < 20; ++tick) {
    const orca::TimePoint now = kNow + tick * 10ms;
    air.settle(now - 10ms);
    const std::optional<double> heard = heard_by(caster, air, kAhead, now);
    CAPTURE(tick);
    if (tick == 0) CHECK_FALSE(heard);
    if (tick > 0) CHECK(heard.value() == Approx(3.0 - 0.5 * kSoundSpeed * 0.010).margin(1e-9));
  }
}

TEST_CASE("a chirp sent more than forty milliseconds ago is not heard", "[sim][sonar][crosstalk]") {
  CHECK(stray(wall_at(6.4), {0, 0.1, 0}, kAhead, 30ms).has_value());
  CHECK_FALSE(stray(wall_at(6.4), {0, 0.1, 0}, kAhead, 41ms));
}

TEST_CASE("the first arrival counts: its own echo or another's sound", "[sim][sonar][crosstalk]") {
  const Caster caster(wall_at(3.0));
  const detail::Echo echo = echo_at(caster, kAhead);
  REQUIRE(echo.range.value() == Approx(3.0));
  for (const bool earlier : {false, true}) {
    detail::SonarAir air;
    air.send(earlier ? kNow - 10ms : kNow, ring_beam_at({0, 0.4, 0}), echo_at(caster, {0, 0.4, 0}));
    const std::uint64_t own = air.send(kNow, ring_beam_at(kAhead), echo);
    const double stray = 0.5 * (std::hypot(6.0, 0.4) - kSoundSpeed * 0.010);
    detail::Sectors::Search search;
    CHECK(air.first_heard(caster, own, echo, search).value() == Approx(earlier ? stray : 3.0).margin(1e-9));
  }
}

TEST_CASE("sound does not go through walls, nor out of a lobe", "[sim][sonar][crosstalk]") {
  CHECK_FALSE(stray(wall_at(2.0), facing(4.0), kAhead));
  CHECK_FALSE(stray({}, {4.0, 0, 0}, kAhead));                   // It looks away.
  CHECK_FALSE(stray({}, {4.0, 0, 160.0 * kDegree}, kAhead));     // 20 deg off the listener.
  CHECK_FALSE(stray({}, {2.0, 2.0, -135.0 * kDegree}, kAhead));  // It faces, but from the side.
  CHECK_FALSE(stray(wall_at(3.0), {0, 0.4, std::numbers::pi}, kAhead));
}

TEST_CASE("two robots face to face hear each other at nominal realism, not at ideal",
          "[sim][sonar][crosstalk][validation]") {
  for (const Realism realism : {Realism::ideal, Realism::nominal}) {
    World world({}, {.seed = 1, .realism = realism});
    const RobotId a = *world.add_robot("a", one_eared(), {});
    const RobotId b = *world.add_robot("b", one_eared(), {3, 0, std::numbers::pi});
    const double apart = 3.0 - 2 * 0.19;
    const double expected = realism == Realism::ideal ? 3.0 - 0.19 - 0.205 : 0.5 * apart;
    for (const RobotId robot : {a, b}) {
      std::vector<double> ranges;
      for (int round = 0; round < 21; ++round) {
        do world.step();
        while (!world.sonar(robot));
        ranges.push_back(world.sonar(robot)->readings[0].range);
      }
      std::ranges::sort(ranges);  // The median leaves the few outliers aside.
      CHECK(ranges[10] == Approx(expected).epsilon(0.02));
    }
  }
}
