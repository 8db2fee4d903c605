// SPDX-License-Identifier: GPL-3.0-or-later
// A robot that follows a person through an office.
#include <catch2/catch.hpp>

#include <cstdlib>
#include <string>

#include "deployer.hpp"

using namespace orca::test;

namespace {

Run follow(const Words& more) {
  return run_deployer(Words{source_file("graphs/pioneer_follow.xml")} + virtual_clock() + more, Seconds(60));
}

// Returns how far the robot was driven [m], by the account of its gate.
double way_of(const Run& run) {
  const std::string account = "gate: in ";
  const auto at = run.err.rfind(account);
  REQUIRE(at != std::string::npos);
  return std::strtod(run.err.c_str() + at + account.size(), nullptr);
}

}  // namespace

TEST_CASE("a robot follows a guide through three doors, twice round, and touches nothing",
          "[system][follow]") {
  const Run run = follow({"--until", "80 s"});
  INFO(run.err);
  CHECK(run.says("follows somebody"));
  CHECK_FALSE(run.says("PERSON_LOST"));
  CHECK(way_of(run) > 0.85 * 0.5 * 80.0);  // The guide walks at 0.5 m/s.
  CHECK(run.contacts().empty());
}

TEST_CASE("a robot that is too slow for its guide says that it has lost him", "[system][follow]") {
  // Later its guide comes round, and walks into it from behind while it stands.
  const Run run = follow({"--set", "follow.max_speed=0.15 m/s", "--until", "35 s"});
  INFO(run.err);
  CHECK(run.says("follow: alarm PERSON_LOST: it does not see any more whom it follows"));
  CHECK(run.contacts().empty());
}
