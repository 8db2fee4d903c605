// SPDX-License-Identifier: GPL-3.0-or-later
// LaserServer and LaserAvoid in a whole system, and the graph that ships with them.
#include <catch2/catch.hpp>

#include "deployer.hpp"

using namespace orca::test;

namespace {

Run behind_the_pillar(const Words& more = {}) {
  return run_deployer(Words{system_graph("laser.xml")} + virtual_clock() + more);
}

}  // namespace

TEST_CASE("with LaserAvoid a robot passes a pillar on its way and touches nothing", "[system][laser]") {
  const Run run = behind_the_pillar();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
  CHECK(run.contacts().empty());
}

TEST_CASE("without LaserAvoid the robot drives into the pillar", "[system][laser]") {
  const Run run = behind_the_pillar({"--set", "behaviours=goto", "--until", "30 s"});
  INFO(run.err);
  CHECK_FALSE(run.contacts().empty());
}

TEST_CASE("the same run with LaserAvoid has the same trace", "[system][laser]") {
  const Run run = behind_the_pillar();
  REQUIRE(run.trace_hash().has_value());
  CHECK(run.trace_hash() == behind_the_pillar().trace_hash());
}

TEST_CASE(
    "the Pioneer drives to three goals in different rooms by its laser and touches nothing, for ten seeds",
    "[system][laser][pioneer]") {
  for (int seed = 1; seed <= 10; ++seed) {
    const Run run = run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--seed",
                                       std::to_string(seed), "--until", "120 s"} +
                                 virtual_clock());
    INFO(run.err);
    CAPTURE(seed);
    CHECK(run.exit_code() == 0);
    const std::vector<Arrival> arrivals = run.arrivals();
    REQUIRE(arrivals.size() == 3);
    CHECK(arrivals[0].name == "kitchen");
    CHECK(arrivals[1].name == "office_2");
    CHECK(arrivals[2].name == "meeting");
    CHECK(arrivals[2].t < 120.0);
    CHECK(run.contacts().empty());
  }
}
