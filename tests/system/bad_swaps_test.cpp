// SPDX-License-Identifier: GPL-3.0-or-later
// A swap cannot lose the robot: whatever the new version does, the robot drives or stands, and its process lives.
#include <catch2/catch.hpp>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "process_table.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

// A version that is tried or taken, and what an operator reads if it is not.
struct Version {
  std::string plugin;  // with its type
  Words more;          // of the order
  std::string refusal;
  std::string tryout = "300 ms";
};

Version rogue(const std::string& where, const std::string& deed, const std::string& refusal) {
  return {ORCA_BINARY_DIR "/tests/next_plugins/test_rogue.so:test.RogueAvoid",
          {"--set", "where=" + where, "--set", "deed=" + deed},
          refusal,
          where.starts_with("lap") ? "1200 ms" : "300 ms"};  // ten laps a second
}

Version rogue_built(const std::string& name, const std::string& refusal) {
  return {ORCA_BINARY_DIR "/tests/next_plugins/test_rogue_" + name + ".so:test.RogueAvoid", {}, refusal};
}

Version asking_nobody(Version version) {
  version.more = version.more + Words{"--set", "asks=false"};
  return version;
}

// Shipped avoiders, which ask the base in start().
const std::vector<Version>& shipped() {
  static const std::vector<Version> all{
      {ORCA_BINARY_DIR "/plugins/vfh_plus.so:orca.VfhPlus", {}, ""},
      {ORCA_BINARY_DIR "/plugins/dwa.so:orca.Dwa", {}, ""},
      {ORCA_BINARY_DIR "/plugins/nd_plus.so:orca.NdPlus", {}, ""},
      {ORCA_BINARY_DIR "/plugins/potential_field.so:orca.PotentialField", {}, ""},
      {ORCA_BINARY_DIR "/plugins/laser_avoid.so:orca.LaserAvoid", {}, ""}};
  return all;
}

// A Pioneer that drives to and fro in an office for longer than any test.
class Driving {
 public:
  Driving()
      : program_(deployer({source_file("graphs/pioneer_laser_goto.xml"), "--set", "goals=" + goals()})) {
    REQUIRE(
        comes_true([] { return run_orcactl({"ps"}).out.find("WORK") != std::string::npos; }, Seconds(20)));
    host_ = children_of(program_.pid()).at("main");
  }

  // Exchanges the avoider.
  static Run swap(const Version& version, const Words& more = {}) {
    const Words span{"--probation", "100 ms", "--tryout", version.tryout};
    return run_orcactl(Words{"swap", "avoid", version.plugin} + span + version.more + more, Seconds(60));
  }

  // Whether the components work in the process with which all has begun.
  [[nodiscard]] bool lives() const {
    const auto now = children_of(program_.pid());
    const auto host = now.find("main");
    return host != now.end() && host->second == host_;
  }

  // The name of the plugin that `ps` shows for the avoider.
  static std::string shown() {
    const std::string told = run_orcactl({"ps", "--json"}).out;
    std::smatch found;
    const std::regex avoid("\"avoid\"[^}]*/([a-z_]+)\\.so");
    return std::regex_search(told, found, avoid) ? found[1].str() : "none: " + told;
  }

  // The names of exchanged plugins in the memory of the process.
  [[nodiscard]] std::vector<std::string> mapped() const {
    std::ifstream maps("/proc/" + std::to_string(host_) + "/maps");
    std::vector<std::string> names;
    std::smatch found;
    const std::regex image(" r-xp .*/memfd:orca:.*?([a-z_]+)\\.so");
    for (std::string line; std::getline(maps, line);)
      if (std::regex_search(line, found, image)) names.push_back(found[1].str());
    return names;
  }

  [[nodiscard]] std::string log() const { return program_.err(); }

  void end() {
    CHECK(run_orcactl({"stop"}).exit_code() == 0);
    const Run run = finish(program_, Seconds(10));
    CHECK(run.exit_code() == 0);
    CHECK(run.contacts().empty());
    CHECK_THAT(run.err, !Contains("PROCESS_ENDED"));
  }

 private:
  static std::string goals() {
    std::string goals;
    for (int i = 0; i < 200; ++i)
      goals += (i == 0 ? "" : "; ") + std::string("kitchen_") + std::to_string(i) +
               ": 3.6 6 > 3.6 7.6 > 4.2 9.8; office_" + std::to_string(i) +
               ": 3.6 7.6 > 3.6 6 > 9 6 > 9 4.4 > 9 2; back_" + std::to_string(i) + ": 9 4.4 > 9 6 > 3.6 6";
    return goals;
  }

  Subprocess program_;
  pid_t host_ = 0;
};

// Tries a bad version, and then takes a good one.
void exchange(Driving& robot, const Version& bad, const Version& good) {
  INFO(bad.plugin << " " << Catch::StringMaker<Words>::convert(bad.more));
  const std::string before = Driving::shown();
  const Run refused = Driving::swap(bad);
  INFO(refused.out << refused.err);
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains(bad.refusal));
  CHECK(Driving::shown() == before);
  const Run taken = Driving::swap(good);
  INFO(taken.err << robot.log());
  CHECK(taken.exit_code() == 0);
  CHECK(robot.mapped() == std::vector<std::string>{Driving::shown()});
  REQUIRE(robot.lives());
}

void exchange_all(Driving& robot, const std::vector<Version>& bad, int swaps) {
  for (int i = 0; i < swaps / 2; ++i) {
    const auto number = static_cast<std::size_t>(i);
    exchange(robot, bad[number % bad.size()], shipped()[number % shipped().size()]);
  }
}

const std::string kLaps = "its laps, in the shadow of the present one,";
const std::string kState = "its save_state() or load_state()";

// Those that are quickly found out.
std::vector<Version> quick_kinds() {
  return {rogue("lap1", "abort", kLaps),
          asking_nobody(rogue("lap10", "crash", kLaps)),
          rogue_built("constructor_crashes", "its constructor"),
          rogue("start", "crash", kLaps),
          rogue("save_state", "throw", "save_state() threw"),
          rogue("load_state", "crash", kState),
          rogue("destructor", "crash", "its end"),
          rogue("destructor", "throw", "its destructor threw std::runtime_error: no way"),
          rogue_built("unloading_crashes", "its end"),
          rogue("start", "pin", "PLUGIN_PINNED"),
          rogue("lap2", "limit", "it has changed the limit of the number of descriptors"),
          rogue("stop", "chdir", "it has changed the working folder to /"),
          rogue("start", "write", "with --untried it is taken all the same")};
}

std::vector<Version> all_kinds() {
  std::vector<Version> all = quick_kinds();
  for (const std::string lap : {"lap2", "lap3", "lap4", "lap5"}) all.push_back(rogue(lap, "abort", kLaps));
  for (const std::string lap : {"lap6", "lap7", "lap8", "lap9"})
    all.push_back(asking_nobody(rogue(lap, "sleep", "did not return")));
  for (const std::string hook : {"configure", "start", "stop", "save_state", "load_state", "destructor"})
    all.push_back(rogue(hook, "sleep", "did not return"));
  for (const std::string hook : {"configure", "stop", "save_state", "suspend", "resume"})
    all.push_back(rogue(hook, "crash", "ended the process with the signal"));
  for (const std::string hook :
       {"configure", "start", "lap3", "stop", "save_state", "load_state", "destructor"})
    all.push_back(rogue(hook, "eat", "threw std::bad_alloc"));
  all.push_back(rogue("lap1", "spin", "did not return"));
  all.push_back(rogue("start", "exit", "ended the process with exit"));
  all.push_back(rogue_built("constructor_sleeps", "did not return"));
  all.push_back(rogue_built("unloading_sleeps", "did not return"));
  Version large = rogue("", "none", "save_state()");
  large.more = large.more + Words{"--set", "state_size=300"};
  all.push_back(large);
  return all;
}

}  // namespace

TEST_CASE(
    "avoiders that ask the base are exchanged while the robot drives, and bad ones are refused for what they "
    "do in "
    "their trial",
    "[system][swap]") {
  if (!kTriesInShadow) return;  // ThreadSanitizer
  Driving robot;
  exchange_all(robot, quick_kinds(), 24);
  robot.end();
}

TEST_CASE("a thousand swaps, half of them to bad versions of more than thirty kinds, do not lose the robot",
          "[.][slow]") {
  if (!kTriesInShadow) return;  // ThreadSanitizer
  Driving robot;
  exchange_all(robot, all_kinds(), 1000);
  robot.end();
}

#if !defined(__SANITIZE_ADDRESS__)  // which limits no memory
TEST_CASE("a version that takes all memory is refused for it, and the system's process lives on",
          "[system][swap]") {
  if (!kTriesInShadow) return;  // ThreadSanitizer
  Driving robot;
  exchange_all(robot,
               {rogue("lap3", "eat", "work() threw std::bad_alloc"),
                rogue("destructor", "eat", "its destructor threw std::bad_alloc"),
                rogue_built("constructor_eats", "its constructor threw std::bad_alloc")},
               6);
  robot.end();
}
#endif

TEST_CASE("a version that leaks is taken, and goes again with all that it has taken", "[system][swap]") {
  Driving robot;
  REQUIRE(Driving::swap(rogue("each_lap", "leak", "")).exit_code() == 0);
  REQUIRE(Driving::swap(shipped()[0]).exit_code() == 0);
  CHECK(robot.mapped() == std::vector<std::string>{"vfh_plus"});
  robot.end();
}

TEST_CASE("what cannot be tried is taken with --untried only", "[system][swap]") {
  if (!kTriesInShadow) return;  // ThreadSanitizer
  Driving robot;
  const Version writer = rogue("start", "write", "");
  const Run refused = Driving::swap(writer);
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("would have left a trace outside its trial") &&
                              Contains("with --untried it is taken all the same"));
  CHECK(Driving::swap(writer, {"--untried"}).exit_code() == 0);
  CHECK(Driving::shown() == "test_rogue");
  robot.end();
}

TEST_CASE("a version whose save_state() cannot be used gives way to one that begins afresh",
          "[system][swap]") {
  Driving robot;
  Version stuck = rogue("save_state", "throw", "");
  stuck.more = stuck.more + Words{"--set", "process=main"};  // so the trial does not see it
  REQUIRE(Driving::swap(stuck).exit_code() == 0);
  const Run refused = Driving::swap(rogue("", "none", ""));
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("save_state() threw") && Contains("--fresh"));
  CHECK(Driving::swap(rogue("", "none", ""), {"--fresh"}).exit_code() == 0);
  robot.end();
}

TEST_CASE("a version that hangs only in the system's process ends in the old code", "[system][swap]") {
  Driving robot;
  const Words here{"--set", "process=main"};
  CHECK(Driving::swap(rogue("configure", "nap", ""), here).exit_code() == 0);  // it may take 3 s
  const Run refused = Driving::swap(rogue("configure", "sleep", ""), here);
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("configure() of the new one did not return within 10 s"));
  CHECK(robot.lives());
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("a version whose lap does not end in the system's process is not taken for one that works",
          "[system][swap]") {
  Driving robot;
  const auto swap = [](const std::string& deed) {
    const Version version = rogue("lap1", deed, "");
    return run_orcactl(Words{"swap", "avoid", version.plugin, "--tryout", "300 ms", "--probation", "1 s",
                             "--fresh", "--set", "process=main"} +
                           version.more,
                       Seconds(60));
  };
  CHECK(swap("nap").exit_code() == 0);  // it may take 3 s
  const Run refused = swap("sleep");
  INFO(refused.out << refused.err << robot.log());
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(robot.log(), Contains("work() of the new one hangs, so the process is ended"));
  CHECK(comes_true([] { return Driving::shown() == "laser_avoid"; }, Seconds(20)));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("an old version whose stop() hangs is left behind, and further versions can be taken",
          "[system][swap]") {
  Driving robot;
  const Words here{"--set", "process=main"};
  CHECK(Driving::swap(rogue("stop", "sleep", ""), here).exit_code() == 0);
  CHECK(Driving::swap(shipped()[0]).exit_code() == 0);
  CHECK(Driving::swap(shipped()[1]).exit_code() == 0);
  CHECK(robot.lives());
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}
