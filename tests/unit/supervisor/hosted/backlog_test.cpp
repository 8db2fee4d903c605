// SPDX-License-Identifier: GPL-3.0-or-later
#include "hosted/backlog.hpp"

#include <catch2/catch.hpp>

using namespace orca;
using namespace orca::supervisor;
using Catch::Contains;

namespace {

Logged line(const std::string& text) { return {log::Level::info, "avoid", text}; }

const std::string& text_of(const Report& report) { return std::get<Logged>(report).text; }

}  // namespace

TEST_CASE("what is said without a supervisor comes in its order, with its time", "[supervisor][adoption]") {
  Backlog backlog;
  backlog.keep(line("one"), 1500ms);
  backlog.keep(AlarmReport{}, 2s);
  backlog.keep(line("two"), 2500ms);
  const std::vector<Report> all = backlog.take();
  REQUIRE(all.size() == 3);
  CHECK(text_of(all[0]) == "one (said at 1.500 s, while no deployer ran)");
  CHECK(std::holds_alternative<AlarmReport>(all[1]));
  CHECK_THAT(text_of(all[2]), Contains("two"));
  CHECK(backlog.take().empty());
}

TEST_CASE("what means nothing later is not kept", "[supervisor][adoption]") {
  Backlog backlog;
  backlog.keep(Glance{}, 0s);
  backlog.keep(Answer{}, 0s);
  backlog.keep(Prompting{}, 0s);
  CHECK(backlog.take().empty());
}

TEST_CASE("of too much, lines are given up first, the oldest first, and counted", "[supervisor][adoption]") {
  Backlog backlog;
  backlog.keep(AlarmReport{}, 0s);
  for (std::size_t i = 0; i < Backlog::kMost + 9; ++i) backlog.keep(line(std::to_string(i) + "."), 0s);
  const std::vector<Report> all = backlog.take();
  REQUIRE(all.size() == Backlog::kMost + 1);
  CHECK(std::holds_alternative<AlarmReport>(all[0]));
  CHECK_THAT(text_of(all[1]), Catch::StartsWith("10."));
  CHECK_THAT(text_of(all.back()), Catch::StartsWith("10 more "));
  backlog.keep(line("later"), 0s);
  CHECK(backlog.take().size() == 1);
}

TEST_CASE("of a line that is very long the middle is left out", "[supervisor][adoption]") {
  Backlog backlog;
  backlog.keep(line(std::string(1'000'000, 'a')), 0s);
  CHECK(text_of(backlog.take().at(0)).size() < 2 * Backlog::kLongestLine);
}

TEST_CASE("a flood of alarms does not take all memory", "[supervisor][adoption]") {
  Backlog backlog;
  for (std::size_t i = 0; i < 2 * Backlog::kMost; ++i) backlog.keep(AlarmReport{}, 0s);
  CHECK(backlog.take().size() == Backlog::kMost + 1);
}
