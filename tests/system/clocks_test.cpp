// SPDX-License-Identifier: GPL-3.0-or-later
// The clocks of two machines, which agree or do not: network namespaces that the test makes, with a time of day of their own.
#include <catch2/catch.hpp>

#include <cmath>
#include <string>
#include <thread>

#include "deployer.hpp"
#include "pair_of_machines.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

// Writes the graph of two machines with the fuser on the robot, which weighs how old the commands of the other machine are.
std::string with_fuser_on_base(const TempFolder& folder) {
  std::string text = ShippedGraph("two_machines").text();
  const std::string fuser = "type=\"orca.MotionCommandFuser\" process=\"";
  const std::size_t at = text.find(fuser + "behaviours");
  REQUIRE(at != std::string::npos);
  text.replace(at, fuser.size() + std::string("behaviours").size(), fuser + "base");
  return folder.write("fuser_on_base.xml", text);
}

// Returns a number of the record of that machine in what orcactl has written as JSON.
double figure(const std::string& json, const std::string& machine, const std::string& name) {
  INFO(json);
  const std::size_t record = json.find("\"machine\": \"" + machine + "\"");
  REQUIRE(record != std::string::npos);
  const std::string key = "\"" + name + "\": ";
  const std::size_t at = json.find(key, record);
  REQUIRE(at != std::string::npos);
  return std::stod(json.substr(at + key.size()));
}

// Asks on a machine until the answer has something in it, and returns that.
std::string asked(const Pair& pair, int machine, const Words& words, const std::string& awaited) {
  const auto end = std::chrono::steady_clock::now() + Seconds(10) * kSlowdown;
  for (;;) {
    const Run run = pair.orcactl(machine, words + Words{"--json"});
    INFO(run.out << run.err);
    if (run.out.find(awaited) != std::string::npos) return run.out;
    REQUIRE(std::chrono::steady_clock::now() < end);
  }
}

// Returns what a machine says of all of them once the other one works.
std::string machines(const Pair& pair, int machine) {
  return asked(pair, machine, {"machines"}, "\"works\"");
}

// Returns how old objects are when they come from the other machine [ms].
double age(const Pair& pair, int machine, const std::string& port) {
  const std::string known = "\"median_ms\": ";
  const std::string said = asked(pair, machine, {"latency", port, "--for", "1 s"}, known);
  const std::string text = said.substr(said.find(known) + known.size());
  INFO(said);
  REQUIRE_FALSE(text.starts_with("null"));
  return std::stod(text);
}

}  // namespace

TEST_CASE("two machines with one clock say that they have", "[system][machines][tool]") {
  if (is_skipped()) return;
  Pair pair;
  pair.start_both();
  pair.flow(0);
  pair.flow(1);
  for (const int machine : {0, 1}) {
    const std::string said = machines(pair, machine);
    const std::string other = kMachines[1 - machine];
    CHECK(std::abs(figure(said, other, "clock_ahead_ms")) <= figure(said, other, "error_ms"));
    CHECK(figure(said, other, "error_ms") < 10.0 * kSlowdown);
    CHECK_THAT(said, Contains("\"state\": \"works\"") && Contains("\"corrected\": false"));
    CHECK(pair.at(machine).err().find("CLOCKS_DIFFER") == std::string::npos);
  }
  pair.stop(0);
}

TEST_CASE("a robot reaches its goal although the clocks of its machines differ, and both say by how much",
          "[system][machines][tool]") {
  if (is_skipped() || kSanitized) return;  // a sanitizer does not let itself be preloaded by another library
  const int ahead = GENERATE(3, -3);
  const TempFolder folder;
  Pair pair({"interface=orca0", kNear}, with_fuser_on_base(folder));
  pair.set_clock(1, ahead);
  pair.start_both();
  pair.says(0, "alarm CLOCKS_DIFFER: the clock of machine brain is ", 0, Seconds(10));
  pair.says(1, "alarm CLOCKS_DIFFER: the clock of machine base is ", 0, Seconds(10));
  for (const int machine : {0, 1}) {
    const std::string said = machines(pair, machine);
    const std::string other = kMachines[1 - machine];
    const double truth = 1000.0 * (machine == 0 ? ahead : -ahead);
    // When both were started, the kernel's two clocks were read one after the other, and stood a little apart since.
    constexpr double kReading = 0.1;
    CHECK(std::abs(figure(said, other, "clock_ahead_ms") - truth) <=
          figure(said, other, "error_ms") + kReading);
    CHECK_THAT(said, Contains("\"corrected\": true"));
  }
  CHECK(std::abs(age(pair, 1, "avoid.odometry")) < 100.0 * kSlowdown);
  CHECK(std::abs(age(pair, 0, "fuser.motion")) < 100.0 * kSlowdown);
  const Run base = pair.finish(0, Seconds(60));
  const Run brain = pair.finish(1, Seconds(5));
  INFO("base:\n" << base.err << "\nbrain:\n" << brain.err);
  CHECK(base.exit_code() == 0);
  CHECK(brain.arrivals().size() == 1);
}

TEST_CASE(
    "what comes from a machine whose clock differs is corrected on, while the deployers are killed and "
    "replaced",
    "[system][machines][tool]") {
  if (is_skipped() || kSanitized) return;
  const TempFolder folder;
  Pair pair({"interface=orca0", kNear, "on_supervisor_loss=continue"}, with_fuser_on_base(folder));
  pair.set_clock(1, -3);  // without the correction all commands are too old for the fuser
  pair.start_both();
  pair.says(0, "alarm CLOCKS_DIFFER", 0, Seconds(10));
  machines(pair, 0);
  std::this_thread::sleep_for(Seconds(2));
  for (const int machine : {0, 1}) {
    pair.replace(machine);
    pair.says(machine, "is adopted", 0, Seconds(10));
    pair.says(machine, "alarm CLOCKS_DIFFER", 0, Seconds(10));
  }
  const Run base = pair.finish(0, Seconds(60));
  const Run brain = pair.finish(1, Seconds(5));
  INFO("base:\n" << base.err << "\nbrain:\n" << brain.err);
  CHECK(base.exit_code() == 0);
  CHECK(brain.arrivals().size() == 1);
  CHECK_FALSE(base.says("stops the robot"));
}
