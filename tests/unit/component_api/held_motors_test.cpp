// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/component/held_motors.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace std::chrono_literals;

namespace {

idl::Alarm alarm(idl::AlarmKind kind, bool active) {
  idl::Alarm alarm;
  alarm.kind(kind);
  alarm.active(active);
  return alarm;
}

}  // namespace

TEST_CASE("motors are held as long as an emergency stop is active, not only kept", "[component]") {
  CHECK_FALSE(are_motors_held({}));
  CHECK_FALSE(are_motors_held({alarm(idl::ESTOP, false), alarm(idl::FAILED, true)}));
  CHECK(are_motors_held({alarm(idl::FAILED, true), alarm(idl::ESTOP, true)}));
}

TEST_CASE("it is said what holds the motors, which is not always an operator", "[component]") {
  std::vector<idl::Alarm> kept{alarm(idl::ESTOP, false), alarm(idl::ESTOP, true)};
  kept[0].text() = "the emergency stop is released";
  CHECK(why_motors_are_held(kept) == "the motors are held");
  kept[1].text() = "the base is held: its motor button was pressed; press it again";
  CHECK(why_motors_are_held(kept) == kept[1].text());
  CHECK(why_motors_are_held({kept[0]}).empty());
}

TEST_CASE("the time for which motors are held is counted lap by lap, from the second lap on", "[component]") {
  const std::vector<idl::Alarm> held{alarm(idl::ESTOP, true)};
  HeldTime time;
  CHECK(time.since_last(TimePoint(5s), held) == 0s);
  CHECK(time.since_last(TimePoint(6s), held) == 1s);
  CHECK(time.since_last(TimePoint(8s), {}) == 0s);
  CHECK(time.since_last(TimePoint(9s), held) == 1s);
}
