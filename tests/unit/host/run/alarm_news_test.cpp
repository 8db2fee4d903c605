// SPDX-License-Identifier: GPL-3.0-or-later
#include "run/reporting/alarm_news.hpp"

#include <catch2/catch.hpp>

#include "orca/host/alarm.hpp"

using namespace orca;
using namespace orca::host;

namespace {

idl::Alarm alarm_of(const std::string& component) {
  return make_alarm(idl::FAILED, component, "work()", "it threw 7");
}

}  // namespace

TEST_CASE("each listener hears each alarm once, from the first on", "[host][alarms]") {
  AlarmNews news;
  news.add(alarm_of("goto"), "");
  std::uint64_t early = 0;
  REQUIRE(news.since(early).size() == 1);
  CHECK(news.since(early).empty());
  news.add(alarm_of("avoid"), "behaviours");
  std::uint64_t late = 0;
  CHECK(news.since(late).size() == 2);
  REQUIRE(news.since(early).size() == 1);
}

TEST_CASE("an alarm is kept until it is acknowledged, by the name of this process or of another",
          "[host][alarms]") {
  AlarmNews news;
  news.add(alarm_of("goto"), "");
  news.add(alarm_of("avoid"), "behaviours");
  CHECK(news.kept().size() == 2);
  news.acknowledge("FAILED", "avoid", "base");
  CHECK(news.kept().size() == 2);
  news.acknowledge("FAILED", "avoid", "behaviours");
  REQUIRE(news.kept().size() == 1);
  news.acknowledge("FAILED", "goto", "main");
  CHECK(news.kept().empty());
}

TEST_CASE("who does not listen for long misses the oldest alarms", "[host][alarms]") {
  AlarmNews news;
  std::uint64_t position = 0;
  for (std::size_t i = 0; i < AlarmNews::kMostNews + 3; ++i) news.add(alarm_of("goto"), "");
  CHECK(news.since(position).size() == AlarmNews::kMostNews);
  news.add(alarm_of("goto"), "");
  CHECK(news.since(position).size() == 1);
}
