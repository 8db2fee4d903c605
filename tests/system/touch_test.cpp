// SPDX-License-Identifier: GPL-3.0-or-later
// The reflex of a base that touches something, in a whole system.
#include <catch2/catch.hpp>

#include "deployer.hpp"

using namespace orca::test;

namespace {

Run into_the_pillar() {
  return run_deployer(Words{system_graph("laser.xml"), "--set", "behaviours=goto", "--until", "30 s"} +
                      virtual_clock());
}

}  // namespace

TEST_CASE("a robot that drives into a pillar stands there, says why, and refuses to push on",
          "[system][touch]") {
  const Run run = into_the_pillar();
  INFO(run.err);
  CHECK(run.contacts().size() == 1);  // it does not bounce against it again and again
  CHECK(run.says("stands: it touched pillar"));
  CHECK(run.says("the base refuses commands: "));
  CHECK(run.says("it touched pillar; ask for another direction"));
  CHECK(run.arrivals().empty());
}
