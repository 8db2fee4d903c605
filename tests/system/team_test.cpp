// SPDX-License-Identifier: GPL-3.0-or-later
// A team: systems with a graph of their own each, that see each other come and go, and let each other pass.
#include <signal.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdlib>
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "pair_of_machines.hpp"
#include "process_table.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"
#include "two_machines.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kMate = source_file("tests/data/graphs/team/mate.xml");
const std::string kTwoMates = source_file("tests/data/graphs/team/two_mates.xml");
const std::string kOtherType = source_file("tests/data/graphs/team/other_type.xml");

const Words kAcross{"--set", "goals=east: 13 7; west: 1 7", "--set", "command.rounds=0"};
const Words kAlong{"--set", "place=south",     "--set", "goals=north: 7 13; south: 7 1",
                   "--set", "command.rounds=0"};

// In a room beside the corridors. In one of them he would meet others head-on, and then nobody makes room (README of Teammates).
const Words kBeside{"--set", "place=beside",    "--set", "goals=far: 4.5 4.5; near: 1.5 1.5",
                    "--set", "command.rounds=0"};

// Two tests at a time have a team each.
std::string team_of_this_test() { return "team_of_" + std::to_string(getpid()); }

// The computer of a robot.
struct Computer {
  const TwoMachines* network = nullptr;  // null: this one
  int machine = 0;
  int clock_ahead = 0;  // [s] of its time of day

  [[nodiscard]] Words command(const Words& words) const {
    if (network == nullptr) return words;
    return network->on(machine, Words{"/usr/bin/env", "LD_PRELOAD=" ORCA_SET_CLOCK,
                                      "ORCA_TEST_CLOCK_AHEAD=" + std::to_string(clock_ahead)} +
                                    words);
  }
};

// A robot of the team, in a world of its own.
class Robot {
 public:
  explicit Robot(std::string name, const Words& settings = kAcross, const std::string& graph = kMate,
                 const Computer& computer = {})
      : name_(std::move(name)),
        computer_(computer),
        program_(std::make_unique<Subprocess>(computer.command(
            deployer(Words{graph, "--name", name_, "--set", "team=" + team_of_this_test()} + settings)))) {}
  ~Robot() {
    if (program_) kill_all();
  }
  Robot(Robot&&) = default;

  // Returns what `orcactl team` says: a line for each system, by name.
  [[nodiscard]] std::map<std::string, std::string> team() const {
    std::map<std::string, std::string> lines;
    for (const std::string& line : split_lines(answer({"team"})))
      lines[line.substr(0, line.find(' '))] = line;
    lines.erase("SYSTEM");
    return lines;
  }
  [[nodiscard]] bool sees(const Words& names) const {
    const auto lines = team();
    return lines.size() == names.size() + 1 &&
           std::ranges::all_of(names, [&](const std::string& name) { return lines.contains(name); });
  }
  // Returns how many robots are among those that it lets pass.
  [[nodiscard]] std::size_t others_nearby() const {
    const std::string moving = answer({"echo", "team.MovingThingsPush", "--count", "1", "--for", "2s"});
    std::size_t count = 0;
    for (std::size_t at = 0; (at = moving.find("<things ", at)) != std::string::npos; ++at) ++count;
    return count;
  }
  [[nodiscard]] bool says(const std::string& text, Seconds limit) const {
    return comes_true([&] { return program_->err().find(text) != std::string::npos; }, limit);
  }
  [[nodiscard]] std::size_t arrivals() const {
    const auto lines = split_lines(program_->out());
    return std::ranges::count_if(lines, [](const std::string& line) { return line.starts_with("arrived "); });
  }
  // As a computer that fails.
  void kill_all() {
    const auto children = children_of(program_->pid());
    program_->send(SIGKILL);
    for (const auto& [name, pid] : children) kill(pid, SIGKILL);
  }
  Subprocess& program() { return *program_; }
  [[nodiscard]] std::string log() const { return program_->err(); }

 private:
  // Returns what orcactl prints on the robot's computer.
  [[nodiscard]] std::string answer(const Words& words) const {
    Subprocess program(computer_.command(orcactl(Words{"--system", name_} + words)));
    return finish(program, Seconds(20)).out;
  }

  std::string name_;
  Computer computer_;
  std::unique_ptr<Subprocess> program_;
};

// Two robots that come to the blind corner, with different leads of the one from the west.
Run cross(int seed, const std::string& lead, const std::string& profile) {
  return run_deployer(Words{kTwoMates, "--profile", profile, "--until", "120 s", "--seed",
                            std::to_string(seed), "--set", "west=" + lead} +
                      virtual_clock());
}

}  // namespace

TEST_CASE("three robots of one file see each other come and go, and hear where the others are",
          "[system][team]") {
  Robot anna("anna"), bert("bert");
  auto carl = std::make_unique<Robot>("carl");
  REQUIRE(comes_true(
      [&] {
        return anna.sees({"bert", "carl"}) && bert.sees({"anna", "carl"}) && carl->sees({"anna", "bert"});
      },
      Seconds(15)));
  CHECK_THAT(anna.team()["bert"], Contains("there") && Contains("pose (Teammate)"));
  CHECK_THAT(anna.team()["anna"], Contains("this system"));
  CHECK(comes_true([&] { return carl->others_nearby() == 2; }, Seconds(10)));
  CHECK(comes_true([&] { return bert.others_nearby() == 1; }, Seconds(10)));  // carl gives way to it
  CHECK(comes_true([&] { return anna.others_nearby() == 0; }, Seconds(10)));

  const Seconds killed = since_boot();
  carl->kill_all();
  REQUIRE(anna.says("carl is lost from the team", Seconds(5)));
  CHECK(since_boot() - killed > Seconds(0.7));
  CHECK(since_boot() - killed < Seconds(1.2) * kSlowdown);
  CHECK(anna.sees({"bert"}));

  const Seconds left = since_boot();
  bert.program().send(SIGINT);
  REQUIRE(anna.says("bert has left the team", Seconds(5)));
  CHECK(since_boot() - left < Seconds(2) * kSlowdown);
  CHECK(finish(bert.program(), Seconds(10)).exit_code() == 0);
  CHECK(anna.sees({}));

  carl = std::make_unique<Robot>("carl");
  CHECK(comes_true([&] { return anna.sees({"carl"}) && carl->sees({"anna"}); }, Seconds(15)));
  CHECK_THAT(anna.log(), !Contains("warning") && !Contains("alarm "));
}

TEST_CASE("a robot waits for one that it only hears of, and no order of its operator reaches that one",
          "[system][team]") {
  Robot anna("anna"), bert("bert", kAlong);
  REQUIRE(bert.says("stops the robot: somebody passes", Seconds(60)));
  CHECK_THAT(anna.log(), !Contains("somebody passes"));  // it has the right of way
  CHECK(run_orcactl({"--system", "bert", "estop"}).exit_code() == 0);
  const std::size_t before = anna.arrivals();
  CHECK(comes_true([&] { return anna.arrivals() > before; }, Seconds(40)));
}

TEST_CASE("robots of two computers whose clocks differ let each other pass, and find each other again",
          "[system][team][tool]") {
  if (is_skipped()) return;
  const TwoMachines network;
  const Words by_cable{"--set", "interface=orca0"};
  Robot anna("anna", kAcross + by_cable, kMate, {&network, 0});
  Robot bert("bert", kAlong + by_cable, kMate, {&network, 1, 3});
  REQUIRE(comes_true([&] { return anna.sees({"bert"}) && bert.sees({"anna"}); }, Seconds(15)));
  CHECK(comes_true([&] { return bert.others_nearby() == 1; }, Seconds(10)));
  CHECK(bert.says("stops the robot: somebody passes", Seconds(60)));
  CHECK_THAT(anna.log(), !Contains("somebody passes"));

  network.connect(false);
  CHECK(anna.says("bert is lost from the team", Seconds(5)));
  CHECK(bert.says("anna is lost from the team", Seconds(5)));
  const std::size_t before = anna.arrivals();
  CHECK(comes_true([&] { return anna.arrivals() > before; }, Seconds(60)));  // alone, too
  network.connect(true);
  CHECK(comes_true([&] { return anna.sees({"bert"}) && bert.sees({"anna"}); }, Seconds(15)));
  CHECK(comes_true([&] { return bert.others_nearby() == 1; }, Seconds(10)));
}

TEST_CASE("two robots that have taken one name are told of it, and are heard as two", "[system][team]") {
  Robot anna("anna"), carl("carl");
  REQUIRE(comes_true([&] { return anna.sees({"carl"}) && carl.sees({"anna"}); }, Seconds(10)));
  const TempFolder elsewhere;  // where the sockets of another computer are
  Subprocess second(
      Words{"/usr/bin/env", "XDG_RUNTIME_DIR=" + elsewhere.path().string()} +
      deployer(Words{kMate, "--name", "carl", "--set", "team=" + team_of_this_test()} + kAlong));
  CHECK(carl.says("another system of the team " + team_of_this_test() + " is called carl, too", Seconds(10)));
  CHECK(
      comes_true([&] { return second.err().find("is called carl, too") != std::string::npos; }, Seconds(10)));
  CHECK(anna.says("two systems of the team " + team_of_this_test() + " are called carl", Seconds(10)));
  CHECK(carl.says("team: another robot of the team is called carl, too", Seconds(10)));
  CHECK(comes_true([&] { return carl.others_nearby() == 2; }, Seconds(10)));
  second.send(SIGINT);
  CHECK(finish(second, Seconds(10)).exit_code() == 0);
}

TEST_CASE("what another type offers by the same name is refused, and told", "[system][team]") {
  Robot anna("anna"), zoe("zoe", {}, kOtherType);
  CHECK(anna.says("zoe offers pose to the team as Odometry, and this system has Teammate", Seconds(10)));
  CHECK(zoe.says("anna offers pose to the team as Teammate, and this system has Odometry", Seconds(10)));
  CHECK(comes_true([&] { return anna.team()["zoe"].find("other type: pose") != std::string::npos; },
                   Seconds(5)));
  CHECK(anna.says("what \"zoe\" offers to the team as \"pose\" is dropped: its objects are no Teammate",
                  Seconds(10)));
  CHECK(anna.others_nearby() == 0);
}

TEST_CASE("robots that hear each other do not touch at a blind corner, where others do", "[system][team]") {
  const int seeds = is_slow_run() ? 10 : 1;
  int touched = 0, deaf = 0, arrived = 0, runs = 0;
  for (const std::string lead : {"west_b", "west", "west_c", "west_d"}) {
    for (int seed = 2; seed <= seeds + 1; ++seed, ++runs) {  // with 1 those who do not hear do not touch
      const Run run = cross(seed, lead, "heard");
      CAPTURE(lead, seed, run.out, run.err);
      touched += run.contacts().empty() ? 0 : 1;
      arrived += static_cast<int>(run.arrivals().size());
      deaf += cross(seed, lead, "deaf").contacts().empty() ? 0 : 1;
    }
  }
  CAPTURE(runs, touched, deaf, arrived);
  CHECK(touched == 0);
  CHECK(arrived == 2 * runs);
  CHECK(deaf > 0);
}

TEST_CASE("alone, the robot of the team drives as one that is in none", "[system][team]") {
  const Run run =
      run_deployer(Words{source_file("graphs/team_robot.xml"), "--name", "anna"} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 3);
  CHECK(run.contacts().empty());
  const Run printed = run_deployer({source_file("graphs/team_robot.xml"), "--name", "anna", "--print"});
  CHECK_THAT(printed.out, Contains("join=\"lab\"") && Contains("<param name=\"name\" value=\"anna\"/>") &&
                              Contains("team=\"pose\""));
}

TEST_CASE("a team of three drives for long, and nobody is lost from it", "[.][slow][team]") {
  const char* const wanted = std::getenv("ORCA_TEST_SECONDS");
  const double seconds = wanted != nullptr ? std::atof(wanted) : 600.0;
  const Words until{"--until", std::to_string(static_cast<int>(seconds)) + "s"};
  std::map<std::string, Robot> robots;
  robots.emplace("anna", Robot("anna", kAcross + until));
  robots.emplace("bert", Robot("bert", kAlong + until));
  robots.emplace("carl", Robot("carl", kBeside + until));
  for (auto& [name, robot] : robots) {
    const Run run = finish(robot.program(), Seconds(seconds + 60));
    INFO(name << ":\n" << run.err);
    CHECK(run.exit_code() == 0);
    CHECK_THAT(run.err, !Contains("is lost from") && !Contains("warning") && !Contains("alarm "));
    CHECK(run.arrivals().size() >= static_cast<std::size_t>(seconds / 60.0));
    std::cout << name << ": " << run.arrivals().size() << " goals in " << seconds << " s\n";
  }
}
