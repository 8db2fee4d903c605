// SPDX-License-Identifier: GPL-3.0-or-later
// Components, and whole processes, that are there only while a component in another process uses them.
#include <signal.h>

#include <catch2/catch.hpp>
#include <sstream>
#include <thread>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "process_table.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

// Returns what starts a visit by a plan, in a profile.
Words visit(const std::string& profile, const std::string& plan, const Words& settings = {}) {
  Words words = Words{system_graph("visit.xml"), "--profile", profile, "--set", "plan=" + plan};
  for (const std::string& setting : settings) words = words + Words{"--set", setting};
  return words + with_test_plugins();
}

bool has_house(const System& system) { return system.children().contains("house"); }

bool house_goes(const System& system, Seconds limit = Seconds(8)) {
  return comes_true([&] { return !has_house(system); }, limit);
}

// Waits for a line "WHAT after TIME s: OUTCOME" behind a mark, and returns its time.
Seconds took(System& system, const std::string& what, const std::string& outcome, std::size_t mark = 0) {
  system.when(what + " after ", mark, Seconds(20));
  const std::string err = system.program().err();
  std::istringstream line(err.substr(err.find(what + " after ", mark) + what.size() + 7));
  double seconds = -1.0;
  std::string unit, rest;
  line >> seconds >> unit;
  std::getline(line, rest);
  INFO(err);
  CHECK_THAT(rest, Contains(outcome));
  return Seconds(seconds);
}

// Returns the line in which orcactl shows a component; empty if the system cannot be reached.
std::string shown(const std::string& component) {
  const Run run = run_orcactl({"--system", "visit", "ps"});
  for (const std::string& line : split_lines(run.out))
    if (line.starts_with(component + " ")) return line;
  return "";
}

bool comes_to_show(const std::string& component, const std::string& state) {
  return comes_true([&] { return shown(component).find(" " + state + " ") != std::string::npos; },
                    Seconds(5));
}

// Waits until the plan has begun.
void begin() { REQUIRE(comes_to_show("visitor", "WORK")); }

// The graph that has the process from the start; only the component comes and goes.
const Words kOnlyComponent{"process=at_once", "component=on_demand"};
const Words kSoonIdle{"idle_time=0.5 s"};

}  // namespace

TEST_CASE("a component is loaded for a client in another process, and unloaded when long unused",
          "[system][on_demand]") {
  const auto link = GENERATE(as<std::string>{}, "shm", "dds");
  CAPTURE(link);
  System system(visit("cold_component", "send 2; ask 4.5; listen 7; leave 8",
                      kOnlyComponent + kSoonIdle + Words{"link=" + link}));
  begin();
  CHECK(comes_to_show("visited", "UNLOADED"));
  took(system, "sent", "ok");
  system.when("handles what was sent", 0);
  CHECK(comes_to_show("visited", "UNLOADED"));
  took(system, "asked", "ok");
  CHECK(comes_to_show("visited", "UNLOADED"));
  took(system, "heard", "ok");
  system.when("has no listener", 0);
  CHECK(comes_to_show("visited", "UNLOADED"));
  const Run run = stop(system);
  if (link == "shm" || kDdsLetsPluginsGo) CHECK_FALSE(run.says("alarm"));
}

TEST_CASE("a process on demand is started by the first use, and ends when nobody uses it",
          "[system][on_demand]") {
  const auto [verb, word] =
      GENERATE(table<std::string, std::string>({{"send", "sent"}, {"ask", "asked"}, {"listen", "heard"}}));
  CAPTURE(verb);
  System system(visit("cold_process", verb + " 2; leave 3; " + verb + " 5.5", kSoonIdle));
  begin();
  CHECK_FALSE(has_house(system));
  CHECK(comes_to_show("visited", "on demand"));
  took(system, word, "ok");
  CHECK(has_house(system));
  const std::size_t mark = system.mark();
  CHECK(house_goes(system));
  CHECK(comes_to_show("visited", "on demand"));
  took(system, word, "ok", mark);
  const Run run = stop(system);
  CHECK_FALSE(run.says("alarm"));
  CHECK_FALSE(run.says("error"));
}

TEST_CASE("a process that is to stay warm stays", "[system][on_demand]") {
  System system(visit("warm_process", "send 1"));
  took(system, "sent", "ok");
  std::this_thread::sleep_for(Seconds(3));
  CHECK(has_house(system));
  stop(system);
}

TEST_CASE("a process on demand is in use while a question is answered, however long that takes",
          "[system][on_demand]") {
  System system(visit("cold_process", "ask 1", {"answer_time=2.5 s"}));
  CHECK(took(system, "asked", "ok") >= Seconds(2.5));
  CHECK(house_goes(system));
  stop(system);
}

TEST_CASE("a process on demand that crashes comes back if it is needed, and stays away if not",
          "[system][on_demand]") {
  System system(visit("warm_process", "listen 1; leave 6"));
  took(system, "heard", "ok");
  const pid_t first = system.process("house");
  const std::size_t mark = system.mark();
  REQUIRE(kill(first, SIGKILL) == 0);
  system.when("alarm PROCESS_ENDED: process house was ended by SIGKILL", mark);
  const pid_t second = system.process("house", first);
  system.when("has a listener in process " + std::to_string(second), mark);
  system.when("has no listener in process " + std::to_string(second), mark, Seconds(10));
  REQUIRE(kill(second, SIGKILL) == 0);
  CHECK(house_goes(system));
  std::this_thread::sleep_for(Seconds(1));
  CHECK_FALSE(has_house(system));
  CHECK(comes_to_show("visited", "on demand"));
  stop(system);
}

TEST_CASE("a process on demand that must not be started again refuses its clients after a crash",
          "[system][on_demand]") {
  System system(visit("warm_process", "send 1; send 4", {"restart=temporary"}));
  took(system, "sent", "ok");
  const std::size_t mark = system.mark();
  REQUIRE(kill(system.process("house"), SIGKILL) == 0);
  took(system, "sent", "the link was cut, because process house was ended by SIGKILL", mark);
  CHECK_FALSE(has_house(system));
  stop(system);
}

TEST_CASE("while the visitor's process starts again, a process on demand that sleeps is not woken",
          "[system][on_demand]") {
  System system(visit("cold_process", "send 2"));
  const pid_t guest = system.process("guest");
  std::this_thread::sleep_for(Seconds(0.7));
  const std::size_t mark = system.mark();
  REQUIRE(kill(guest, SIGKILL) == 0);
  system.when("process guest is back", mark);
  CHECK_FALSE(has_house(system));
  took(system, "sent", "ok", mark);
  stop(system);
}

TEST_CASE("an operator starts a process on demand", "[system][on_demand]") {
  System system(visit("cold_process", "leave 1"));
  begin();
  const Run refused = run_orcactl({"--system", "visit", "get", "visited.answer_time"});
  CHECK(refused.exit_code() == 0);
  const Run set = run_orcactl({"--system", "visit", "set", "visited.answer_time", "1 s"});
  CHECK(set.exit_code() == 1);
  CHECK_THAT(set.err, Contains("orcactl restart house starts it"));
  CHECK(run_orcactl({"--system", "visit", "restart", "house"}).exit_code() == 0);
  CHECK(has_house(system));
  CHECK(house_goes(system));
  stop(system);
}
