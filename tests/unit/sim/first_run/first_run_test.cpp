// SPDX-License-Identifier: GPL-3.0-or-later
// docs/simulation.md's example, as a program of its own.
#include <catch2/catch.hpp>
#include <sstream>

#include "subprocess.hpp"

using namespace orca::test;

TEST_CASE("the example of docs/simulation.md measures five sonar rounds in a simulated second",
          "[sim][docs]") {
  Subprocess program({ORCA_BINARY_DIR "/tests/sim_first_run"}, {.folder = ORCA_SOURCE_DIR});
  const auto ending = program.wait(Seconds(30.0));
  INFO(program.err());
  REQUIRE(ending);
  CHECK(ending->exit_code == 0);
  int rounds = 0;
  std::istringstream out(program.out());
  for (std::string nearest, echo, unit; out >> nearest >> echo;) {
    double range = 0.0;
    REQUIRE(out >> range >> unit);
    CHECK(range >= 0.15);  // the ring's limits
    CHECK(range <= 6.5);
    ++rounds;
  }
  CHECK(rounds == 5);
}

TEST_CASE("outside the source tree the example says which file it cannot read", "[sim][docs]") {
  Subprocess program({ORCA_BINARY_DIR "/tests/sim_first_run"}, {.folder = "/"});
  const auto ending = program.wait(Seconds(30.0));
  REQUIRE(ending);
  CHECK(ending->exit_code == 2);
  CHECK_THAT(program.err(),
             Catch::Contains("sim/worlds/office.xml") && Catch::Contains("sim/robots/nomad_scout.urdf"));
}
