// SPDX-License-Identifier: GPL-3.0-or-later
// Pictures are lent from process to process (ADR 0104), also after each of them was killed.
#include <signal.h>

#include <catch2/catch.hpp>
#include <string>

#include "deployer.hpp"
#include "hosted_system.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

Words gallery() { return Words{system_graph("gallery.xml")} + with_test_plugins(); }

std::string says(pid_t hall, const std::string& what) {
  return "gallery " + std::to_string(hall) + ": " + what;
}

}  // namespace

TEST_CASE("pictures are lent to another process, and again after one of the two was killed",
          "[system][gallery]") {
  System system(gallery());
  pid_t hall = system.process("hall");
  system.when(says(hall, "lent"), 0, Seconds(10));
  for (int round = 0; round < 3; ++round) {
    std::size_t mark = system.mark();
    REQUIRE(kill(system.process("eyes"), SIGKILL) == 0);
    system.when(says(hall, "lent"), mark, Seconds(10));  // after a first one that was copied
    mark = system.mark();
    REQUIRE(kill(hall, SIGKILL) == 0);
    hall = system.process("hall", hall);
    system.when(says(hall, "lent"), mark, Seconds(10));
  }
  const Run run = stop(system);
  CHECK_THAT(run.err, !Contains("wrong picture"));
  CHECK_THAT(run.err, !Contains("is cut off"));
}

TEST_CASE("small pictures are copied", "[system][gallery]") {
  System system(gallery() + Words{"--set", "size=10000"});
  const pid_t hall = system.process("hall");
  system.when(says(hall, "copied"), 0, Seconds(10));
  CHECK_THAT(stop(system).err, !Contains(says(hall, "lent")));
}
