// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/base_senses.hpp"

#include <catch2/catch.hpp>

#include <numbers>

#include "orca/idl/time.hpp"

using namespace orca;
using namespace orca::hw;

namespace {

constexpr TimePoint kNow{10s};

template <class T>
const T& latest(SensorEndpoint& endpoint) {
  REQUIRE(endpoint.latest());
  return *object_cast<T>(endpoint.latest());
}

TimePoint measured(BaseSonars& sonars, std::size_t number) {
  return to_time_point(latest<idl::SonarRangeReadings>(sonars.endpoint()).stamps()[number]);
}

BaseSonars::Traits two_metres() { return {.min_range = 0.1, .max_range = 2.0, .cycle = 400ms}; }

}  // namespace

TEST_CASE("of a whole round of sonars a range that stays was measured at most a cycle ago", "[hw][senses]") {
  BaseSonars sonars(two_metres(), 100ms);
  sonars.add({}, 0.25);
  sonars.add({0.0, 0.0, 0.5}, 0.25);
  sonars.forget();
  sonars.take_all(kNow, [](std::size_t) { return 1.0; });
  sonars.take_all(kNow + 100ms, [](std::size_t i) { return i == 0 ? 1.5 : 1.0; });
  sonars.publish(kNow + 100ms);
  CHECK(measured(sonars, 0) == kNow + 100ms);
  CHECK(measured(sonars, 1) == kNow);  // it has changed less than a cycle ago
  sonars.take_all(kNow + 1s, [](std::size_t) { return 1.5; });
  sonars.publish(kNow + 1s);
  CHECK(measured(sonars, 0) == kNow + 600ms);
  CHECK(measured(sonars, 1) == kNow + 1s);
}

TEST_CASE("what is beyond the reach of a sonar is as far as it reaches", "[hw][senses]") {
  BaseSonars sonars(two_metres(), 100ms);
  sonars.add({0.1, 0.2, 0.3}, 0.25);
  sonars.take(0, 7.0, kNow);
  sonars.publish(kNow);
  const auto& readings = latest<idl::SonarRangeReadings>(sonars.endpoint());
  CHECK(readings.ranges() == std::vector<double>{2.0});
  CHECK(readings.poses()[0].position().z() == 0.25);
  CHECK(sonars.describe("ring").angle_sonar0() == 0.3);
}

TEST_CASE("rounds are published once in a cycle, and not before each sonar has fired", "[hw][senses]") {
  BaseSonars sonars(two_metres(), 400ms);
  sonars.add({}, 0.0);
  sonars.await_round(kNow);
  sonars.publish_round(kNow + 500ms);
  CHECK_FALSE(sonars.endpoint().latest());
  sonars.publish_round(kNow + 800ms);
  const ObjectRef first = sonars.endpoint().latest();
  CHECK(first);
  sonars.publish_round(kNow + 1100ms);
  CHECK(sonars.endpoint().latest() == first);
}

TEST_CASE("a bumper that is pressed in motion lies where the base drives to, until it is let go",
          "[hw][senses]") {
  BaseBumpers bumpers(50ms, 0.2);
  bumpers.add("left", 0.5 * std::numbers::pi);
  bumpers.take(0, true, {-0.3, 0.0});
  bumpers.take(0, true, {0.3, 0.0});  // it drives away
  REQUIRE(bumpers.pressed().size() == 1);
  CHECK(bumpers.pressed()[0].outwards == Vec2{-1.0, 0.0});
  bumpers.publish(kNow);
  CHECK(latest<idl::BumperReadings>(bumpers.endpoint()).poses()[0].position().x() == -0.2);
  bumpers.forget();
  CHECK(bumpers.pressed().empty());
  bumpers.take(0, true);
  CHECK(bumpers.pressed()[0].outwards.y == Approx(1.0));
}

TEST_CASE("bumpers whose place is not known are published without places", "[hw][senses]") {
  BaseBumpers bumpers(50ms);
  for (const char* const name : {"a", "b", "c"}) bumpers.add(name, 0.0);
  bumpers.take(1, true);
  bumpers.publish(kNow, 2);
  const auto& readings = latest<idl::BumperReadings>(bumpers.endpoint());
  CHECK(readings.names() == std::vector<std::string>{"a", "b"});
  CHECK(readings.pressed()[1]);
  CHECK(readings.poses().empty());
}
