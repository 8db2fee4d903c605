// SPDX-License-Identifier: GPL-3.0-or-later
// LaserAvoid in a whole system. The scans are cast by a component of the tests.
#include <catch2/catch.hpp>

#include "deployer.hpp"

using namespace orca::test;

namespace {

Run behind_the_pillar(const Words& more = {}) {
  return run_deployer(Words{system_graph("laser.xml")} + with_test_plugins() + virtual_clock() + more);
}

}  // namespace

TEST_CASE("with LaserAvoid the Scout passes a pillar on its way and touches nothing", "[system][laser]") {
  const Run run = behind_the_pillar();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
  CHECK(run.contacts().empty());
}

TEST_CASE("without it the Scout drives into the pillar", "[system][laser]") {
  const Run run = behind_the_pillar({"--set", "behaviours=goto", "--until", "30 s"});
  INFO(run.err);
  CHECK_FALSE(run.contacts().empty());
}

TEST_CASE("the same run with LaserAvoid has the same trace", "[system][laser]") {
  const Run run = behind_the_pillar();
  REQUIRE(run.trace_hash().has_value());
  CHECK(run.trace_hash() == behind_the_pillar().trace_hash());
}
