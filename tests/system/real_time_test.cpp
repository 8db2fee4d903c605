// SPDX-License-Identifier: GPL-3.0-or-later
// The thesis's run in real time, with a thread per component.
#include <signal.h>

#include <catch2/catch.hpp>
#include <thread>

#include "deployer.hpp"

using namespace orca::test;

TEST_CASE("in real time the Scout drives to its three goals and touches nothing", "[system][slow]") {
  const Run run = run_deployer({source_file("graphs/scout_goto.xml")}, Seconds(180));
  INFO(run.err);
  REQUIRE(run.ended);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 3);
  CHECK(run.contacts().empty());
  CHECK(run.out.find("trace-hash") == std::string::npos);
  REQUIRE_FALSE(run.arrivals().empty());
  const double end = run.arrivals().back().t;
  CHECK(run.ending.wall > Seconds(end));
  CHECK(run.ending.wall < Seconds(end + 10.0));
}

TEST_CASE("a real-time run spends its time waiting, not computing", "[system][slow]") {
  const Run run = run_deployer({source_file("graphs/scout_goto.xml"), "--until", "10 s"}, Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  CHECK(run.ending.wall > Seconds(10.0));
  CHECK(run.ending.cpu < 0.5 * run.ending.wall * (kSanitized ? 4.0 : 1.0));
}

TEST_CASE("a short drive in real time arrives once", "[system][slow]") {
  const Run run =
      run_deployer({source_file("graphs/scout_goto.xml"), "--set", "goals=ahead: 3 6"}, Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 1);
  CHECK(run.arrivals().front().name == "ahead");
}

TEST_CASE("a simulated world that was stopped for a while says how much time it has left out",
          "[system][slow]") {
  Subprocess program(deployer({source_file("graphs/scout_goto.xml"), "--in-process"}));
  std::this_thread::sleep_for(Seconds(kSlowdown));  // until it drives
  program.send(SIGSTOP);
  std::this_thread::sleep_for(Seconds(2));
  program.send(SIGCONT);
  CHECK(program.wait_for_output("the world stood still for", Seconds(5 * kSlowdown)));
}
