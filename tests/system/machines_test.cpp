// SPDX-License-Identifier: GPL-3.0-or-later
// A graph on two machines: network namespaces that the test makes, joined by a cable that it can pull.
#include <signal.h>

#include <catch2/catch.hpp>
#include <fstream>
#include <sstream>
#include <thread>

#include "deployer.hpp"
#include "pair_of_machines.hpp"
#include "process_table.hpp"

using namespace orca::test;

namespace {

std::string read(const std::string& file) {
  std::ifstream in(file);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

bool has_dds(pid_t process) {
  return read("/proc/" + std::to_string(process) + "/maps").find("libfastrtps") != std::string::npos;
}

}  // namespace

TEST_CASE("machines that are started one after the other begin together", "[system][machines][tool]") {
  if (is_skipped()) return;
  const int first = GENERATE(0, 1);
  Pair pair;
  pair.start(first);
  pair.says(first, "waiting for machine " + kMachines[1 - first]);
  std::this_thread::sleep_for(Seconds(1));
  CHECK_FALSE(pair.finish(first, Seconds(0)).says("flow "));
  pair.start(1 - first);
  pair.flow(0);
  pair.flow(1);
  for (const int machine : {0, 1}) {
    CHECK(pair.at(machine).err().find("machine " + kMachines[1 - machine] + " is there") !=
          std::string::npos);
    CHECK(pair.at(machine).err().find("alarm") == std::string::npos);
  }
  pair.stop(first);
}

TEST_CASE("the end of the run on one machine ends it on both", "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"laps=10"});
  pair.start_both();
  for (const int machine : {0, 1}) {
    const Run run = pair.finish(machine, Seconds(20));
    INFO(run.err);
    CHECK(run.ended);
    CHECK(run.exit_code() == 0);
    CHECK_FALSE(run.says("alarm"));
  }
}

TEST_CASE("a machine that does not come is named when the time is over", "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"wait=1 s"});
  pair.start(0);
  const Run run = pair.finish(0);
  INFO(run.err);
  CHECK(run.exit_code() == 3);
  CHECK(run.says("machine brain did not come in time"));
  CHECK(living_in_group(pair.at(0).pid()).empty());
}

TEST_CASE("two machines with different graphs do not start", "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair;
  pair.start(0, {"laps=7"});
  pair.start(1, {"laps=8"});
  for (const int machine : {0, 1}) {
    const Run run = pair.finish(machine);
    INFO(run.err);
    CHECK(run.exit_code() == 3);
    CHECK(run.says("run different graphs"));
    CHECK((run.says("machine base and machine brain") || run.says("machine brain and machine base")));
  }
}

TEST_CASE("a cut between machines raises an alarm on both, and both go on after it",
          "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair;
  pair.start_both();
  pair.flow(0);
  pair.flow(1);
  const std::size_t marks[] = {pair.mark(0), pair.mark(1)};
  pair.network().connect(false);
  pair.says(0, "alarm MACHINE_LOST: machine brain was not heard for 1 s; the others go on", marks[0]);
  pair.says(1, "alarm MACHINE_LOST: machine base was not heard for 1 s; the others go on", marks[1]);
  std::this_thread::sleep_for(Seconds(4));
  pair.network().connect(true);
  pair.says(0, "machine brain is heard again", marks[0]);
  pair.says(1, "machine base is heard again", marks[1]);
  pair.stop(1);
}

TEST_CASE("the loss of a machine that the graph needs ends the run", "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"on_loss=stop"});
  pair.start_both();
  pair.flow(0);
  pair.flow(1);
  pair.at(1).send(SIGKILL);
  const Run run = pair.finish(0);
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("alarm MACHINE_LOST: machine brain was not heard for 1 s, so the run ends"));
}

TEST_CASE("a machine whose deployer is started again is taken in", "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair;
  pair.start_both();
  pair.flow(0);
  pair.flow(1);
  const std::size_t mark = pair.mark(0);
  pair.at(1).send(SIGKILL);
  pair.says(0, "alarm MACHINE_LOST", mark);
  pair.start(1);
  pair.says(0, "machine brain was started again", mark);
  pair.flow(1);
  pair.stop(0);
}

TEST_CASE("only the process that speaks with other machines has the network, and it may die",
          "[system][machines][tool][quiet]") {
  if (is_skipped()) return;
  Pair pair;
  pair.start_both();
  pair.flow(0);
  pair.flow(1);
  const auto children = children_of(pair.at(0).pid());
  REQUIRE(children.contains("peers"));
  CHECK(has_dds(children.at("peers")));
  CHECK_FALSE(has_dds(pair.at(0).pid()));
  CHECK_FALSE(has_dds(children.at("base_source")));
  for (int i = 0; i < 3; ++i) {
    const std::size_t mark = pair.mark(0);
    kill(children_of(pair.at(0).pid()).at("peers"), SIGKILL);
    pair.says(0, "process peers, which speaks with the other machines, was ended by SIGKILL", mark);
    std::this_thread::sleep_for(Seconds(1.5));
  }
  if (!kSanitized)  // with a sanitizer it takes longer than loss_limit to start the process again
    for (const int machine : {0, 1}) {
      INFO(pair.at(machine).err());
      CHECK(pair.at(machine).err().find("alarm") == std::string::npos);
    }
  pair.stop(1);
}

TEST_CASE("a robot whose commands come from another machine reaches its goals", "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"interface=orca0", kNear}, kDrive);
  pair.start_both();
  const Run base = pair.finish(0, Seconds(60));
  const Run brain = pair.finish(1, Seconds(5));
  INFO("base:\n" << base.err << "\nbrain:\n" << brain.err);
  CHECK(base.exit_code() == 0);
  CHECK(brain.exit_code() == 0);
  CHECK(brain.arrivals().size() == 1);
  if (kDdsLetsPluginsGo) CHECK_FALSE(base.says("alarm"));
}

TEST_CASE("a robot stands while its commands are cut off, and then drives on", "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"interface=orca0", kNear}, kDrive);
  pair.start_both();
  pair.says(1, "machine base is there", 0, Seconds(10));
  std::this_thread::sleep_for(Seconds(3));
  const std::size_t mark = pair.mark(0);
  CHECK_FALSE(pair.at(0).err().find("the base stands") != std::string::npos);
  pair.network().connect(false);
  const auto cut = std::chrono::steady_clock::now();  // no command can have come since
  pair.says(0, "the base stands: no motion command", mark, Seconds(2));
  const Seconds stopped = std::chrono::steady_clock::now() - cut;
  CHECK(stopped < Seconds(0.2 + 0.1) * kSlowdown);  // 0.2 s, and what it takes to tell
  pair.says(0, "alarm MACHINE_LOST: machine brain", mark);
  std::this_thread::sleep_for(Seconds(5) - (std::chrono::steady_clock::now() - cut));
  pair.network().connect(true);
  pair.says(0, "machine brain is heard again", mark);
  const Run base = pair.finish(0, Seconds(60));
  const Run brain = pair.finish(1, Seconds(5));
  INFO("base:\n" << base.err << "\nbrain:\n" << brain.err);
  CHECK(base.exit_code() == 0);
  CHECK(brain.arrivals().size() == 1);
}

TEST_CASE("a robot drives on while the deployers of both machines are killed and replaced",
          "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair({"interface=orca0", kNear, "on_supervisor_loss=continue"}, kDrive);
  pair.start_both();
  pair.says(1, "machine base is there", 0, Seconds(10));
  std::this_thread::sleep_for(Seconds(2));
  for (const int machine : {0, 1}) {
    pair.replace(machine);
    pair.says(machine, "is adopted", 0, Seconds(10));
    pair.says(1 - machine, "machine " + kMachines[machine] + " was started again");
  }
  const Run base = pair.finish(0, Seconds(60));
  const Run brain = pair.finish(1, Seconds(5));
  INFO("base:\n" << base.err << "\nbrain:\n" << brain.err);
  CHECK(base.exit_code() == 0);
  CHECK(brain.exit_code() == 0);
  CHECK(brain.arrivals().size() == 1);
  CHECK_FALSE(base.says("PROCESS_ENDED"));
  CHECK_FALSE(brain.says("PROCESS_ENDED"));
}

TEST_CASE("the deployer must know which machine it is on", "[system][machines]") {
  Run run = run_deployer(Words{kFlows} + with_test_plugins());
  CHECK(run.exit_code() == 2);
  CHECK(run.says(
      "error C002: the graph runs on several machines; say which one this is: --machine NAME, one of: "
      "base, brain"));
  run = run_deployer(on_machine(kFlows, "brian"));
  CHECK(run.exit_code() == 2);
  CHECK(run.says("did you mean \"brain\"?"));
  run = run_deployer(Words{source_file("graphs/scout_goto_processes.xml"), "--machine", "base"});
  CHECK(run.exit_code() == 2);
  CHECK(run.says("error C002: --machine: the graph declares no machines"));
  run = run_deployer(Words{kDrive, "--machine", "base"} + virtual_clock());
  CHECK(run.exit_code() == 2);
  CHECK(run.says("error C004: --machine"));
}

TEST_CASE("a machine whose network interface is missing says so while it waits", "[system][machines]") {
  const Run run = run_deployer(on_machine(kFlows, "base", {"wait=2 s"}));
  INFO(run.err);
  CHECK(run.exit_code() == 3);
  CHECK(run.says("there is no network interface \"orca0\" with an IPv4 address"));
  CHECK(run.says("machine brain did not come in time"));
}
