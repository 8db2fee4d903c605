// SPDX-License-Identifier: GPL-3.0-or-later
// Several systems of one graph at a time, on one machine and on one network, each under a name of its own.
#include <signal.h>

#include <catch2/catch.hpp>

#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "deployer.hpp"
#include "pair_of_machines.hpp"
#include "process_table.hpp"
#include "two_machines.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kScout = source_file("graphs/scout_goto_processes.xml");

// A system of the graph that says who it is by its only goal.
struct Robot {
  std::string name;
  std::string goals;
};

// A system of two machines on a network that others use, too.
class SystemOfTwo {
 public:
  SystemOfTwo(const TwoMachines& network, std::string name, const Words& settings, const Words& options = {})
      : name_(std::move(name)) {
    for (const int machine : {0, 1})
      programs_[machine] = std::make_unique<Subprocess>(network.on(
          machine, deployer(on_machine(kDrive, kMachines[machine], Words{"interface=orca0"} + settings) +
                            Words{"--name", name_} + options)));
  }
  ~SystemOfTwo() {
    for (const auto& program : programs_)
      for (const auto& [name, pid] : children_of(program->pid())) kill(pid, SIGKILL);
  }
  SystemOfTwo(const SystemOfTwo&) = delete;
  SystemOfTwo& operator=(const SystemOfTwo&) = delete;

  Subprocess& at(int machine) { return *programs_[machine]; }
  [[nodiscard]] bool says(int machine, const std::string& text, Seconds limit) {
    const auto end = std::chrono::steady_clock::now() + limit * kSlowdown;
    while (at(machine).err().find(text) == std::string::npos) {
      if (std::chrono::steady_clock::now() > end) return false;
      std::this_thread::sleep_for(Seconds(0.02));
    }
    return true;
  }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  const std::string name_;
  std::unique_ptr<Subprocess> programs_[2];
};

// Checks that a log tells of no trouble, and of nobody else.
void check_undisturbed(const std::string& log) {
  INFO(log);
  CHECK_THAT(log, !Contains("alarm ") && !Contains("another deployer") && !Contains("different graphs") &&
                      !Contains("strange") && !Contains("not believed"));
}

}  // namespace

TEST_CASE("two systems of one graph, joined by DDS on one machine, reach the goals that each has",
          "[system][dds][names]") {
  const Robot robots[] = {{"red", "door: 3.6 6 > 3.6 7.6"}, {"blue", "hall: 3.6 6"}};
  const bool is_apart = GENERATE(false, true);  // whether they have domains of their own, too
  CAPTURE(is_apart);
  std::vector<std::unique_ptr<Subprocess>> programs;
  for (const Robot& robot : robots) {
    Words words{kScout, "--name", robot.name, "--set", "link=dds", "--set", "goals=" + robot.goals};
    if (is_apart) words = words + Words{"--domain", std::to_string(100 + programs.size())};
    programs.push_back(std::make_unique<Subprocess>(deployer(words)));
  }
  for (std::size_t i = 0; i < programs.size(); ++i) {
    const Run run = finish(*programs[i], Seconds(60));
    INFO(robots[i].name << ":\n" << run.err);
    CHECK(run.exit_code() == 0);
    REQUIRE(run.arrivals().size() == 1);
    CHECK(run.arrivals()[0].name == robots[i].goals.substr(0, robots[i].goals.find(':')));
    if (kDdsLetsPluginsGo) check_undisturbed(run.err);
  }
}

TEST_CASE("orcactl finds a system by the name that it was given", "[system][names]") {
  Subprocess red(deployer({kScout, "--name", "red"}));
  Subprocess blue(deployer({kScout, "--name", "blue"}));
  const auto answers = [](const std::string& name) {
    return run_orcactl({"--system", name, "graph"}).out.find("<graph name=\"" + name + "\"") !=
           std::string::npos;
  };
  const auto end = std::chrono::steady_clock::now() + Seconds(10) * kSlowdown;
  while (!answers("red") || !answers("blue")) {
    REQUIRE(std::chrono::steady_clock::now() < end);
    std::this_thread::sleep_for(Seconds(0.1));
  }
  const Run twice = run_deployer({kScout, "--name", "red"});
  CHECK(twice.exit_code() == 3);
  CHECK(run_orcactl({"--system", "red", "stop"}).exit_code() == 0);
  CHECK(finish(red, Seconds(10)).exit_code() == 0);
  CHECK(answers("blue"));
  CHECK(run_orcactl({"--system", "blue", "stop"}).exit_code() == 0);
  CHECK(finish(blue, Seconds(10)).exit_code() == 0);
}

TEST_CASE("a name and a domain of the command line take the place of the graph's", "[system][names]") {
  const Run printed = run_deployer({kScout, "--name", "red", "--domain", "7", "--print"});
  CHECK(printed.exit_code() == 0);
  CHECK_THAT(printed.out, Contains("<graph name=\"red\"") && Contains(" domain=\"7\""));
  CHECK_THAT(run_deployer({kScout, "--print"}).out, !Contains(" domain="));
  const Run named = run_deployer({kScout, "--check", "--name", "red green"});
  CHECK(named.exit_code() == 2);
  CHECK(named.says("--name"));
  CHECK(run_deployer({kScout, "--check", "--domain", "233"}).exit_code() == 2);
}

TEST_CASE(
    "two systems of two machines each share a network, and one that is killed is not missed by the other",
    "[system][machines][names][tool]") {
  if (is_skipped()) return;
  const TwoMachines network;
  SystemOfTwo red(network, "red", {kNear});
  SystemOfTwo blue(network, "blue", {kNear});
  for (SystemOfTwo* const system : {&red, &blue}) {
    INFO(system->name() << ":\n" << system->at(0).err() << "\n" << system->at(1).err());
    REQUIRE(system->says(0, "machine brain is there", Seconds(10)));
    REQUIRE(system->says(1, "machine base is there", Seconds(10)));
  }
  std::this_thread::sleep_for(Seconds(2));
  blue.at(0).send(SIGKILL);
  CHECK(blue.says(1, "alarm MACHINE_LOST", Seconds(5)));
  blue.at(1).send(SIGINT);
  const Run base = finish(red.at(0), Seconds(60));
  const Run brain = finish(red.at(1), Seconds(5));
  CHECK(base.exit_code() == 0);
  CHECK(brain.exit_code() == 0);
  CHECK(brain.arrivals().size() == 1);
  check_undisturbed(base.err);
  check_undisturbed(brain.err);
}

TEST_CASE("three robots of one graph drive on one network for long, and none notices the others",
          "[.][slow][machines][names]") {
  if (is_skipped()) return;
  const char* const wanted = std::getenv("ORCA_TEST_SECONDS");
  const double seconds = wanted != nullptr ? std::atof(wanted) : 600.0;
  const std::vector<Robot> robots{{"dewey", "kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8; back: 3.6 7.6 > 3.6 6"},
                                  {"huey", "east: 3.6 6 > 9 6; west: 9 6 > 3.6 6"},
                                  {"louie", "library_hall: 7.8 6; hall: 3.6 6"}};
  const TwoMachines network;
  std::vector<std::unique_ptr<SystemOfTwo>> systems;
  for (const Robot& robot : robots)
    systems.push_back(std::make_unique<SystemOfTwo>(
        network, robot.name, Words{"goals=" + robot.goals, "name=" + robot.name, "command.rounds=0"},
        Words{"--until", std::to_string(static_cast<int>(seconds)) + "s"}));
  for (std::size_t i = 0; i < robots.size(); ++i) {
    const Run base = finish(systems[i]->at(0), Seconds(seconds + 60));
    const Run brain = finish(systems[i]->at(1), Seconds(30));
    INFO(robots[i].name << ", base:\n" << base.err << "\nbrain:\n" << brain.err);
    CHECK(base.exit_code() == 0);
    CHECK(brain.exit_code() == 0);
    check_undisturbed(base.err);
    check_undisturbed(brain.err);
    CHECK(brain.failures().empty());
    CHECK(brain.arrivals().size() >= static_cast<std::size_t>(seconds / 60.0));
    for (const Arrival& arrival : brain.arrivals())
      CHECK(robots[i].goals.find(arrival.name + ":") != std::string::npos);
    std::cout << robots[i].name << ": " << brain.arrivals().size() << " goals in " << seconds << " s\n";
  }
}
