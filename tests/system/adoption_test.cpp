// SPDX-License-Identifier: GPL-3.0-or-later
// A deployer that is killed while its graph says on_supervisor_loss="continue": the processes go on, and the next deployer
// takes them over.
#include <signal.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <thread>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "process_table.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

constexpr double kFlows = 50.0 / kSlowdown;  // [objects/s]; 100 are pushed, but the machine may be busy
const std::vector<std::string> kNames{"source", "relay", "sink"};

Words lasting_flow(const std::string& link = "shm") { return flow(link) + Words{"--set", "loss=continue"}; }

std::map<std::string, pid_t> processes_of(System& system) {
  std::map<std::string, pid_t> processes;
  for (const std::string& name : kNames) processes[name] = system.process(name);
  return processes;
}

void kill_deployer(System& system) {
  system.program().send(SIGKILL);
  REQUIRE(system.program().wait(Seconds(2) * kSlowdown));
}

bool all_live(const std::map<std::string, pid_t>& processes) {
  return std::ranges::all_of(processes, [](const auto& process) { return is_alive(process.second); });
}

bool none_lives(const std::map<std::string, pid_t>& processes) {
  return std::ranges::none_of(processes, [](const auto& process) { return is_alive(process.second); });
}

// Returns how many objects reach the sink in a second, as the deployer tells.
double rate_of_flow() {
  const Run run = run_orcactl({"--system", "flow", "hz", "sink.in", "--for", "1s", "--json"});
  INFO(run.out << run.err);
  REQUIRE(run.exit_code() == 0);
  const std::size_t at = run.out.find("\"per_second\":");
  REQUIRE(at != std::string::npos);
  return std::atof(run.out.c_str() + at + 13);
}

// Returns the files that hosts and deployers have left beside the system's socket.
std::vector<std::string> left_in_folder() {
  std::vector<std::string> files;
  std::error_code none;
  const char* const runtime = std::getenv("XDG_RUNTIME_DIR");
  REQUIRE(runtime != nullptr);
  for (const auto& entry : std::filesystem::directory_iterator(std::string(runtime) + "/orca", none))
    files.push_back(entry.path().filename().string());
  return files;
}

// A flow whose deployer is killed when it runs.
struct Orphans {
  explicit Orphans(const Words& words = lasting_flow()) : first(words) {
    first.when("flow ", 0, Seconds(10));
    processes = processes_of(first);
    std::this_thread::sleep_for(Seconds(0.2));
    kill_deployer(first);
  }

  System first;  // kills at its end what is left
  std::map<std::string, pid_t> processes;
};

void check_adopted(System& system) {
  for (const std::string& name : kNames) system.when("process " + name + " is adopted", 0, Seconds(10));
}

// Ends a system that holds adopted processes, and checks that nothing is left.
Run stop_adopted(System& system, const std::map<std::string, pid_t>& processes) {
  const Run run = stop(system);
  CHECK(none_lives(processes));
  CHECK(left_in_folder().empty());
  return run;
}

// Returns where the odometry of the scout is [m].
std::pair<double, double> place_of_scout() {
  const Run run = run_orcactl({"echo", "base.OdometryPush", "--count", "1"});
  const auto number = [&](const std::string& name) {
    const std::size_t at = run.out.find(" " + name + "=\"");
    INFO(run.out << run.err);
    REQUIRE(at != std::string::npos);
    return std::atof(run.out.c_str() + at + name.size() + 3);
  };
  return {number("x"), number("y")};
}

// Returns whether the log tells of something that happened while no deployer ran.
bool says_of_between(const Run& run, const std::string& text) {
  return std::ranges::any_of(run.said(text), [](const std::string& line) {
    return line.find("while no deployer ran") != std::string::npos;
  });
}

}  // namespace

TEST_CASE("processes go on without their deployer, and the next one takes them over", "[system][adoption]") {
  const std::vector<std::string> before = kept_by_system();
  Orphans orphans;
  std::this_thread::sleep_for(Seconds(1));
  CHECK(all_live(orphans.processes));
  System second(lasting_flow());
  check_adopted(second);
  CHECK(all_live(orphans.processes));
  CHECK(second.children().empty());
  CHECK(rate_of_flow() > kFlows);
  const Run ps = run_orcactl({"ps"});
  for (const auto& [name, pid] : orphans.processes) CHECK_THAT(ps.out, Contains(std::to_string(pid)));
  const Run run = stop_adopted(second, orphans.processes);
  INFO(run.err);
  CHECK(run.says("the deployer is gone; this process goes on"));
  CHECK(run.says("while no deployer ran"));
  CHECK_FALSE(run.says("PROCESS_ENDED"));
  const std::size_t laps = run.err.find("laps ");
  REQUIRE(laps != std::string::npos);
  double count = 0.0, longest = 0.0;
  REQUIRE(std::sscanf(run.err.c_str() + laps, "laps %lf longest %lf", &count, &longest) == 2);
  std::printf("laps of 10 ms across the loss of the deployer: %.0f, the longest %.1f ms\n", count,
              1e3 * longest);
  CHECK(longest < 0.1 * kSlowdown);
  CHECK(kept_by_system() == before);
}

TEST_CASE("what is printed while no deployer runs harms nobody, and the next one reads it",
          "[system][adoption]") {
  Orphans orphans;
  signal(SIGPIPE, SIG_IGN);
  std::ofstream output("/proc/" + std::to_string(orphans.processes["relay"]) + "/fd/1");
  output << "printed to nobody" << std::endl;
  CHECK(output.good());
  System second(lasting_flow());
  second.when("relay: printed to nobody", 0, Seconds(10));
  output << "printed to the next" << std::endl;
  second.when("relay: printed to the next", 0);
  stop_adopted(second, orphans.processes);
}

TEST_CASE("an adopted process is watched and started again as any other", "[system][adoption]") {
  Orphans orphans;
  System second(lasting_flow());
  check_adopted(second);
  SECTION("killed") {
    const std::size_t mark = second.mark();
    kill(orphans.processes["relay"], SIGKILL);
    second.when("process relay ended, and its new supervisor cannot tell how", mark);
    second.when("process relay is back", mark);
    second.flows_without(orphans.processes["relay"], mark);
  }
  SECTION("hung") {
    const std::size_t mark = second.mark();
    kill(orphans.processes["source"], SIGSTOP);
    second.when("process source hung and was killed", mark);
    second.when("process source is back", mark);
    second.flows_without(orphans.processes["source"], mark);
  }
  SECTION("restarted by an operator") {
    const Run run = run_orcactl({"restart", "sink"});
    INFO(run.err);
    CHECK(run.exit_code() == 0);
    second.flows_without(orphans.processes["sink"], 0);
  }
  stop_adopted(second, orphans.processes);
}

TEST_CASE("what has died while no deployer ran is started again", "[system][adoption]") {
  const std::string link = GENERATE("shm", "dds");
  CAPTURE(link);
  Orphans orphans(lasting_flow(link));
  const std::string lost = GENERATE("source", "relay", "sink");
  CAPTURE(lost);
  kill(orphans.processes[lost], SIGKILL);
  REQUIRE(comes_true([&] { return !is_alive(orphans.processes[lost]); }, Seconds(1)));
  System second(lasting_flow(link));
  second.when("alarm PROCESS_ENDED: process " + lost + " was gone when this deployer came", 0, Seconds(10));
  second.when("process " + lost + " is back", 0, Seconds(10));
  second.flows_without(orphans.processes[lost], 0);
  CHECK(rate_of_flow() > kFlows);
  stop_adopted(second, orphans.processes);
}

TEST_CASE("ten deployers in a row are killed, and the processes are still the first", "[system][adoption]") {
  const std::vector<std::string> before = kept_by_system();
  Orphans orphans;
  std::vector<double> seconds;
  for (int i = 0; i < 10; ++i) {
    CAPTURE(i);
    const Seconds begun = since_boot();
    System next(lasting_flow());
    check_adopted(next);
    seconds.push_back((since_boot() - begun).count());
    kill_deployer(next);
    CHECK(all_live(orphans.processes));
  }
  print("deployer started to adopted", seconds);
  System last(lasting_flow());
  check_adopted(last);
  CHECK(rate_of_flow() > kFlows);
  stop_adopted(last, orphans.processes);
  CHECK(kept_by_system() == before);
}

TEST_CASE("a deployer that is killed while all comes up leaves what the next one can use",
          "[system][adoption]") {
  for (int i = 0; i < 20; ++i) {
    CAPTURE(i);
    System first(lasting_flow());
    std::this_thread::sleep_for(Seconds(0.02 * i));
    kill_deployer(first);
    System second(lasting_flow());
    const auto flows = [] { return run_orcactl({"echo", "sink.in", "--count", "10"}).exit_code() == 0; };
    CHECK(comes_true(flows, Seconds(10)));
    stop(second);
    CHECK(comes_true([&] { return first.left().empty(); }, Seconds(1)));
    CHECK(left_in_folder().empty());
  }
}

TEST_CASE("a deployer that is killed at any moment of the adoption changes nothing", "[system][adoption]") {
  Orphans orphans;
  for (int i = 0; i < 40; ++i) {
    CAPTURE(i);
    System next(lasting_flow());
    std::this_thread::sleep_for(Seconds(0.003 * i));  // it adopts after about 30 ms
    kill_deployer(next);
    CHECK(all_live(orphans.processes));
  }
  System last(lasting_flow());
  check_adopted(last);
  CHECK(rate_of_flow() > kFlows);
  stop_adopted(last, orphans.processes);
}

TEST_CASE("a second deployer is refused while one runs, also one that has adopted", "[system][adoption]") {
  Orphans orphans;
  System second(lasting_flow());
  check_adopted(second);
  const Run third = run_deployer(lasting_flow());
  INFO(third.err);
  CHECK(third.exit_code() == 3);
  CHECK(third.says("a system named \"flow\" runs already"));
  CHECK(rate_of_flow() > kFlows);
  stop_adopted(second, orphans.processes);
}

TEST_CASE("another graph of the same name is refused, and orcactl ends what runs", "[system][adoption]") {
  Orphans orphans;
  const Run other = run_deployer(flow());
  INFO(other.err);
  CHECK(other.exit_code() == 3);
  CHECK(other.says("processes of another graph named \"flow\" run without a deployer: "));
  CHECK(other.says("orcactl --system flow stop"));
  CHECK(all_live(orphans.processes));
  const Run ps = run_orcactl({"ps"});
  CHECK(ps.exit_code() == 3);
  CHECK_THAT(ps.err, Contains("processes of flow go on without a deployer"));
  const Run stop = run_orcactl({"--system", "flow", "stop"});
  INFO(stop.err);
  CHECK(stop.exit_code() == 0);
  CHECK(comes_true([&] { return none_lives(orphans.processes); }, Seconds(1)));
  CHECK(left_in_folder().empty());
  CHECK(run_orcactl({"stop"}).exit_code() == 3);
}

TEST_CASE("a process that waits for a deployer ends at SIGTERM", "[system][adoption]") {
  Orphans orphans;
  for (const auto& [name, pid] : orphans.processes) {
    kill(pid, SIGTERM);
    CHECK(comes_true([pid = pid] { return !is_alive(pid); }, Seconds(1)));
  }
  CHECK(left_in_folder() == std::vector<std::string>{"flow.sock"});  // of the deployer that was killed
}

TEST_CASE("a graph may say how long its processes go on alone", "[system][adoption]") {
  Orphans orphans(lasting_flow() + Words{"--set", "wait=1.5 s"});
  std::this_thread::sleep_for(Seconds(1));
  CHECK(all_live(orphans.processes));
  CHECK(comes_true([&] { return none_lives(orphans.processes); }, Seconds(1.5)));
  CHECK(left_in_folder() == std::vector<std::string>{"flow.sock"});
}

TEST_CASE("a process that waits for a deployer and hangs is killed and replaced", "[system][adoption]") {
  Orphans orphans;
  kill(orphans.processes["relay"], SIGSTOP);
  System second(lasting_flow());
  second.when("has no deployer and does not answer; it is killed", 0, Seconds(10));
  second.when("process relay is back", 0, Seconds(10));
  second.flows_without(orphans.processes["relay"], 0);
  stop_adopted(second, orphans.processes);
}

TEST_CASE("an emergency stop outlives the deployer, and is released by the next", "[system][adoption]") {
  System first(lasting_flow());
  first.when("flow ", 0, Seconds(10));
  const auto processes = processes_of(first);
  CHECK(run_orcactl({"estop"}).exit_code() == 0);
  kill_deployer(first);
  System second(lasting_flow());
  check_adopted(second);
  second.when("the emergency stop holds all motors", 0);
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 1);
  kill_deployer(second);
  CHECK(run_orcactl({"estop"}).exit_code() == 0);  // the processes themselves
  System third(lasting_flow());
  third.when("the emergency stop holds all motors", 0, Seconds(10));
  stop_adopted(third, processes);
}

TEST_CASE("an emergency stop that a stopped deployer does not confirm says so, and what to do",
          "[system][adoption]") {
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  const std::string deployer = std::to_string(system.program().pid());
  system.program().send(SIGSTOP);
  Subprocess look(orcactl({"ps"}));
  Subprocess estop(orcactl({"estop"}));
  CHECK(estop.wait_for_output("NOBODY HAS CONFIRMED THE EMERGENCY STOP", Seconds(4) * kSlowdown));
  CHECK_THAT(estop.err(), Contains("take the power from the motors") && Contains("kill -CONT " + deployer));
  CHECK(look.wait_for_output("process " + deployer + ", is stopped", Seconds(4) * kSlowdown));
  const Run run = finish(estop, Seconds(10));
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.err, Contains("has not answered for 5 s"));
  system.program().send(SIGCONT);
  system.when("alarm ESTOP", 0);  // the order was not lost
  CHECK(finish(look, Seconds(5)).exit_code() == 0);
  stop(system);
}

TEST_CASE("a process without a deployer that hangs does not hold up the emergency stop of the others",
          "[system][adoption]") {
  Orphans orphans;
  kill(orphans.processes["relay"], SIGSTOP);
  Subprocess estop(orcactl({"estop"}));
  const Run run = finish(estop, Seconds(4));
  CHECK(run.exit_code() == 1);
  CHECK_THAT(run.err, Contains("process " + std::to_string(orphans.processes["relay"]) + " of flow") &&
                          Contains("has not answered for 2 s") &&
                          Contains("take the power from the motors") &&
                          Contains("obeyed by the processes themselves: sink, source"));
  kill(orphans.processes["relay"], SIGCONT);
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("alarms that nobody has acknowledged outlive the deployer", "[system][adoption]") {
  System first(lasting_flow());
  first.when("flow ", 0, Seconds(10));
  kill_one(first, "relay");
  const auto processes = processes_of(first);
  std::this_thread::sleep_for(Seconds(0.3));
  kill_deployer(first);
  System second(lasting_flow());
  check_adopted(second);
  CHECK(comes_true([] { return run_orcactl({"alarms"}).out.find("PROCESS_ENDED") != std::string::npos; },
                   Seconds(5)));
  CHECK(run_orcactl({"alarms", "ack", "all"}).exit_code() == 0);
  kill_deployer(second);
  System third(lasting_flow());
  check_adopted(third);
  std::this_thread::sleep_for(Seconds(0.3));
  CHECK(run_orcactl({"alarms"}).out.find("PROCESS_ENDED") == std::string::npos);
  stop_adopted(third, processes);
}

TEST_CASE("a robot drives on while no deployer runs, and reaches its goals with the next",
          "[system][adoption]") {
  const Words words{source_file("graphs/scout_goto_processes.xml"), "--set", "on_supervisor_loss=continue",
                    "--set", "goals=hall: 3.6 6 > 3.6 7.6; kitchen: 3.6 7.6 > 4.2 9.8"};
  System first(words);
  const std::map<std::string, pid_t> processes{{"base", first.process("base")},
                                               {"behaviours", first.process("behaviours")},
                                               {"command", first.process("command")}};
  std::this_thread::sleep_for(Seconds(3));
  CHECK(run_orcactl({"set", "avoid.stop_distance", "0.31 m"}).exit_code() == 0);
  const auto [x, y] = place_of_scout();
  kill_deployer(first);
  std::this_thread::sleep_for(Seconds(2));
  CHECK(all_live(processes));
  System second(words);
  second.when("process command is adopted", 0, Seconds(10));
  const auto [x_now, y_now] = place_of_scout();
  CHECK(std::hypot(x_now - x, y_now - y) > 0.5);
  CHECK_THAT(run_orcactl({"get", "avoid.stop_distance"}).out, Contains("0.31"));
  const std::size_t mark = second.mark();
  kill(processes.at("behaviours"), SIGKILL);
  second.when("process behaviours is back", mark);
  const Run run = finish(second.program(), Seconds(90));
  INFO(first.program().err() << run.err);
  CHECK(run.exit_code() == 0);
  const std::size_t before = split_lines(first.program().out()).size();
  CHECK(before + run.arrivals().size() == 2);
  CHECK(says_of_between(run, "the deployer is gone"));
  CHECK_FALSE(says_of_between(run, "the base stands"));
  CHECK(none_lives(processes));
  CHECK(left_in_folder().empty());
}
