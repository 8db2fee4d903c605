// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/host/alarm_store.hpp"
#include "orca/host/alarm.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::host;

namespace {

idl::Alarm alarm(idl::AlarmKind kind, const std::string& source, bool active = true) {
  idl::Alarm alarm;
  alarm.kind(kind);
  alarm.source() = source;
  alarm.active(active);
  return alarm;
}

}  // namespace

TEST_CASE("an alarm stays until it is acknowledged", "[host][alarms]") {
  AlarmStore store;
  const std::uint64_t first = store.take(alarm(idl::FAILED, "avoid"), "behaviours");
  const std::uint64_t second = store.take(alarm(idl::FAILED, "goto"), "behaviours");
  CHECK(second > first);
  REQUIRE(store.kept().size() == 2);
  CHECK(store.kept()[0].process == "behaviours");
  REQUIRE(store.acknowledge(first).ok());
  REQUIRE(store.kept().size() == 1);
  CHECK(store.kept()[0].number == second);
  CHECK(store.acknowledge(first).error().code == Code::not_found);
}

TEST_CASE("an alarm that is raised again keeps its number and is counted", "[host][alarms]") {
  AlarmStore store;
  const std::uint64_t number = store.take(alarm(idl::FAILED, "avoid"));
  idl::Alarm again = alarm(idl::FAILED, "avoid");
  again.text() = "once more";
  CHECK(store.take(again) == number);
  REQUIRE(store.kept().size() == 1);
  CHECK(store.kept()[0].times == 2);
  CHECK(store.kept()[0].alarm.text() == "once more");
}

TEST_CASE("an alarm that is raised again after it was acknowledged is a new one", "[host][alarms]") {
  AlarmStore store;
  const std::uint64_t number = store.take(alarm(idl::FAILED, "avoid"));
  REQUIRE(store.acknowledge(number).ok());
  CHECK(store.take(alarm(idl::FAILED, "avoid")) > number);
  CHECK(store.kept()[0].times == 1);
}

TEST_CASE("kind, source and process tell alarms apart", "[host][alarms]") {
  AlarmStore store;
  store.take(alarm(idl::PROCESS_ENDED, ""), "base");
  store.take(alarm(idl::PROCESS_ENDED, ""), "behaviours");
  store.take(alarm(idl::GAVE_UP, ""), "behaviours");
  CHECK(store.kept().size() == 3);
}

TEST_CASE("the names of a component's own kinds tell its alarms apart", "[host][alarms]") {
  AlarmStore store;
  for (const char* name : {"GRIPPER_WORN", "HOUSE_FULL", "HOUSE_FULL"})
    store.take(make_alarm(name, idl::ALARM_NOTICE, "gripper", "mend it"), "behaviours");
  CHECK(store.kept().size() == 2);
}

TEST_CASE("an alarm that is cleared stays, too", "[host][alarms]") {
  AlarmStore store;
  CHECK(store.take(alarm(idl::HARDWARE_FAULT, "scout", false)) == 0);
  store.take(alarm(idl::HARDWARE_FAULT, "scout"));
  store.take(alarm(idl::HARDWARE_FAULT, "scout", false));
  REQUIRE(store.kept().size() == 1);
  CHECK_FALSE(store.kept()[0].alarm.active());
  CHECK(store.kept()[0].times == 1);
}

TEST_CASE("a flood of alarms takes limited memory", "[host][alarms]") {
  AlarmStore store;
  for (std::size_t i = 0; i < AlarmStore::kMost + 5; ++i) store.take(alarm(idl::FAILED, std::to_string(i)));
  CHECK(store.kept().size() == AlarmStore::kMost);
  CHECK(store.kept().front().alarm.source() == "5");
  CHECK(store.given_up() == 5);
}
