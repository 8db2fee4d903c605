// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual time that does not pass any more ends the run.
#include <catch2/catch.hpp>
#include <map>

#include "deployer.hpp"

using namespace orca::test;

namespace {

std::vector<std::string> executors() {
  if (kThreadSanitizer) return {"baton"};  // ThreadSanitizer does not support fibers
  return {"fiber", "baton"};
}

void check_that_both_are_named(const Run& run) {
  const std::string beginning = "virtual time stands still at 1 s: ";
  const std::string ending = " go on at this instant without end (100000 turns so far)";
  CHECK((run.says(beginning + "ping, pong" + ending) || run.says(beginning + "pong, ping" + ending)));
}

}  // namespace

TEST_CASE("components that answer each other at one instant for ever end the run and are named",
          "[system][standstill]") {
  std::map<std::string, int> hashes;
  for (const std::string& executor : executors()) {
    for (const Words& more : {Words{}, Words{"--until", "10 s"}}) {
      CAPTURE(executor, more);
      const Run run =
          run_deployer(Words{system_graph("answerers.xml"), "--clock", "virtual", "--executor", executor} +
                           with_test_plugins() + more,
                       Seconds(60));
      INFO(run.err);
      REQUIRE(run.ended);
      CHECK(run.exit_code() == 1);
      check_that_both_are_named(run);
      REQUIRE(run.trace_hash());
      ++hashes[*run.trace_hash()];
    }
  }
  CHECK(hashes.size() == 1);
}

TEST_CASE("components that go first do not keep the run from ending", "[system][standstill]") {
  const Run run = run_deployer(
      Words{system_graph("answerers.xml"), "--profile", "urgent"} + with_test_plugins() + virtual_clock(),
      Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  check_that_both_are_named(run);
}
