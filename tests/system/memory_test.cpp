// SPDX-License-Identifier: GPL-3.0-or-later
// Memory over a long run: what a system keeps of its past is bounded.
#include <sys/resource.h>

#include <catch2/catch.hpp>
#include <iostream>

#include "deployer.hpp"

using namespace orca::test;

namespace {

// The most that a process of this test has held so far [KiB].
long most_held() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  return usage.ru_maxrss;
}

// Returns the most that the course held, or an earlier one if that held more [KiB].
long held_after(const std::string& simulated) {
  const Run run = run_deployer(
      Words{source_file("graphs/random_walk.xml"), "--until", simulated} + virtual_clock(), Seconds(1500));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  REQUIRE(run.trace_hash());
  return most_held();
}

}  // namespace

// The second run has 660,000 more ticks, so 512 KiB are less than a byte per tick. When the way of the robot was kept for
// pictures in each run, it was 1700 KiB.
TEST_CASE("a robot that walks about for two hours holds no more memory than after ten minutes",
          "[system][memory]") {
  const long early = held_after("600 s");
  const long late = held_after("7200 s");
  std::cout << "after ten minutes " << early << " KiB, after two hours " << late << " KiB\n";
  CHECK(early > 4000);  // It is the deployer that was measured.
  CHECK(late - early < 512);
}
