// SPDX-License-Identifier: GPL-3.0-or-later
// orcactl swap: the code of a component of a running system is exchanged, between processes as within one.
#include <sys/stat.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <thread>
#include <vector>

#include "client.hpp"
#include "deployer.hpp"
#include "hosted_system.hpp"
#include "slow_run.hpp"
#include "telling.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using namespace std::chrono_literals;
using Catch::Contains;
using orca::orcactl::Client;
using orca::supervisor::ControlAnswer;
using orca::supervisor::RecordAnswer;

namespace {

std::string bad_plugin(const std::string& name) {
  return std::string(ORCA_BINARY_DIR "/tests/unit_plugins/bad/") + name + ".so";
}

// Returns how much memory a process has that nobody else has [bytes].
double private_memory(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("RssAnon:")) return 1024 * std::stod(line.substr(8));
  return 0;
}

// Returns how many copies of plugins are in the memory of a process, in which one is used.
int copies_in_memory(pid_t process) {
  std::ifstream maps("/proc/" + std::to_string(process) + "/maps");
  int copies = 0;
  for (std::string line; std::getline(maps, line);)
    copies +=
        line.find("/memfd:orca:") != std::string::npos && line.find(" r-xp ") != std::string::npos ? 1 : 0;
  return copies;
}

}  // namespace

TEST_CASE(
    "the code of a component is exchanged and exchanged back while objects go to and fro, and none is lost",
    "[system][swap]") {
  for (const std::string process : {"counting", "talking"}) {
    Telling system(process);
    for (int i = 0; i < 3; ++i) {
      const Run newer = system.swap(next_version("test_teller_2"), {"--probation", "0 s"});
      INFO(newer.err << system.log());
      REQUIRE(newer.exit_code() == 0);
      CHECK_THAT(newer.out, Contains("test.Teller/1"));
      REQUIRE(system.hears("heard 2:"));
      const Run older = system.swap(next_version("test_teller_again"), {"--probation", "0 s"});
      REQUIRE(older.exit_code() == 0);
    }
    const Run shown = run_orcactl({"plugins"});
    CHECK_THAT(shown.out, Contains("test_teller_again.so"));
    CHECK_THAT(run_orcactl({"ps", "--json"}).out, Contains("next_plugins/test_teller_again.so"));
    system.end_in_order();
  }
}

namespace {

int components_at_work() {
  std::istringstream shown(run_orcactl({"ps"}).out);
  int count = 0;
  for (std::string line; std::getline(shown, line);) count += line.find("WORK") != std::string::npos ? 1 : 0;
  return count;
}

// The teller is asked for a thousand counts a second from another process, where a gauge notes when they come.
class Gauged {
 public:
  Gauged() : program_(deployer({folder_.write("swap.xml", gauged_graph()), "--log", "debug"})) {
    REQUIRE(comes_true([] { return components_at_work() == 3; }, Seconds(20) * kSlowdown));
  }

  // Exchanges the teller, and returns for how long neither object could work [us]. What orcactl does, without a program that
  // is started for each swap: that takes as much of the processors as the swap itself.
  int swap(int number) {
    std::this_thread::sleep_for(6ms);  // the deployer takes at most 200 questions a second from a client
    const std::string plugin = next_version(number % 2 == 0 ? "test_teller_2" : "test_teller_again");
    std::map<std::string, std::string> told;
    const auto take = [&](ControlAnswer& answer) {
      if (const auto* const record = std::get_if<RecordAnswer>(&answer))
        for (const auto& cell : record->record) told[cell.name] = cell.value;
    };
    const orca::Status outcome =
        client().ask({"swap", {"teller", plugin, "--tryout", "0 s", "--probation", "0 s"}, true}, take, 60s);
    INFO(number << (outcome.ok() ? "" : outcome.error().text()));
    REQUIRE(outcome.ok());
    REQUIRE(told["state"] == "test.Teller/1");
    return std::stoi(told["pause_us"]);
  }

  // Counts the gaps between the gauge's laps anew, as those of a phase.
  void begin(const std::string& phase) {
    REQUIRE(run_orcactl({"set", "gauge.phase", phase}).exit_code() == 0);
  }
  // Returns what 99.9 % of the gaps of a phase that has ended are below [ms].
  double gap_of(const std::string& phase) {
    const std::string title = "gauge: gaps of " + phase + ": ";
    REQUIRE(program_.wait_for_output(title, Seconds(10) * kSlowdown));
    const std::string log = program_.err();
    const std::string below = " 99.9 % below ";
    return std::stod(log.substr(log.find(below, log.find(title)) + below.size())) / 1000;
  }

  [[nodiscard]] pid_t host() const { return children_of(program_.pid()).at("counting"); }

  // Ends the system, and checks that nothing was lost, doubled or out of order in all that time.
  void end_in_order() {
    CHECK(run_orcactl({"suspend", "talker"}).exit_code() == 0);
    CHECK(run_orcactl({"stop"}).exit_code() == 0);
    const Run run = finish(program_, Seconds(10));
    CHECK(run.exit_code() == 0);
    CHECK_THAT(run.err,
               !Contains("gap ") && !Contains("poke ") && !Contains("not sent") && !Contains("gauge: heard"));
  }

 private:
  static std::string gauged_graph() {
    // A line of log in start() would be most of the exchange.
    const std::string silent = "><param name=\"tells\" value=\"false\"/>";
    std::string text = telling_graph("talking");
    const std::string teller = "process=\"counting\"/>\n  <component";
    text.replace(text.find(teller), teller.size(),
                 "process=\"counting\"" + silent + "</component>\n  <component");
    const std::string talker = "process=\"talking\"/>\n  <connect";
    text.replace(text.find(talker), talker.size(),
                 "process=\"talking\"" + silent +
                     "<param name=\"period\" value=\"0.001\"/></component>"
                     "<component name=\"gauge\" type=\"test.Gauge\" process=\"talking\"/>"
                     "<connect from=\"teller.out\" to=\"gauge.in\" queue=\"1000\"/>\n  <connect");
    return text;
  }

  Client& client() {
    if (!client_) {
      auto connected = Client::connect(orca::apps::Call{});
      REQUIRE(std::holds_alternative<Client>(connected));
      client_.emplace(std::move(std::get<Client>(connected)));
    }
    return *client_;
  }

  TempFolder folder_;
  Subprocess program_;
  std::optional<Client> client_;
};

}  // namespace

TEST_CASE("whoever hears a component whose code is exchanged in another process hears each of its words once",
          "[system][swap]") {
  Gauged system;
  for (int i = 0; i < 20; ++i) system.swap(i);
  system.begin("rest");
  CHECK(system.gap_of("start") > 0.0);
  system.end_in_order();
}

TEST_CASE(
    "ten thousand swaps of a component whose peers are in another process: nothing is lost, nothing is left, "
    "and "
    "the rhythm of the laps stays",
    "[.][slow][swap]") {
  Gauged system;
  for (int i = 0; i < 100; ++i) system.swap(i);
  const double before = private_memory(system.host());
  std::vector<int> pauses;
  system.begin("swaps");
  const Seconds began = since_boot();
  for (int i = 0; i < 10'000; ++i) pauses.push_back(system.swap(i));
  const Seconds time = since_boot() - began;
  const double growth = (private_memory(system.host()) - before) / 10'000;
  system.begin("rest");
  std::this_thread::sleep_for(time);
  system.begin("end");
  std::ranges::sort(pauses);
  const double with_swaps = system.gap_of("swaps");
  const double at_rest = system.gap_of("rest");
  WARN("exchange: median " << pauses[pauses.size() / 2] << " us, longest " << pauses.back()
                           << " us; private memory grows by " << growth << " bytes per swap");
  WARN("99.9 % of the gaps between laps are below " << with_swaps << " ms with swaps, and below " << at_rest
                                                    << " ms without, in " << time.count() << " s each");
  // A machine that is late by itself says nothing of swaps.
  constexpr double kQuiet = 1.5;  // [ms] of gaps of 1 ms
  if (at_rest < kQuiet) CHECK(with_swaps < at_rest + 1.0);
  CHECK(growth < 64.0);
  CHECK(copies_in_memory(system.host()) == 1);
  system.end_in_order();
}

TEST_CASE("a plugin whose old code cannot be unloaded is shown as pinned", "[system][swap]") {
  if (kSanitized) return;  // the graph limits the memory of the process, which a sanitizer does not keep to
  Subprocess program(
      deployer(Words{system_graph("hooligan_process.xml"), "--set", "where=work", "--set", "deed=thread"} +
               with_test_plugins()));
  const auto works = [] { return run_orcactl({"ps"}).out.find("WORK") != std::string::npos; };
  REQUIRE(comes_true(works, Seconds(10)));
  CHECK_THAT(run_orcactl({"plugins", "--json"}).out, !Contains("\"pinned\": true"));
  const Run swapped = run_orcactl({"swap", "hooligan", ORCA_BINARY_DIR "/tests/plugins/test_hooligan.so",
                                   "--set", "deed=none", "--tryout", "300 ms", "--probation", "300 ms"},
                                  Seconds(20));
  INFO(swapped.err << program.err());
  CHECK(swapped.exit_code() == 0);
  CHECK_THAT(program.err(), Contains("PLUGIN_PINNED"));
  CHECK_THAT(run_orcactl({"plugins", "--json"}).out, Contains("\"pinned\": true"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("what cannot be a new version is refused with a reason, and the old one goes on",
          "[system][swap]") {
  Telling system("talking");
  const std::string cut = system.folder().file("cut.so");
  {
    std::ifstream whole(next_version("test_teller_2"), std::ios::binary);
    std::string bytes(5000, '\0');
    whole.read(bytes.data(), 5000);
    std::ofstream(cut, std::ios::binary) << bytes;
  }
  const std::string fifo = system.folder().file("fifo.so");
  REQUIRE(mkfifo(fifo.c_str(), 0600) == 0);
  std::vector<std::pair<std::string, std::string>> bad{
      {"/nowhere/new.so", "No such file or directory"},
      {fifo, "it is no file"},
      {cut, "cut.so"},
      {source_file("README.md"), "README.md"},
      {bad_plugin("bad_no_manifest"), "is not an Orca plugin"},
      {bad_plugin("bad_abi_older"), "the plugin is older"},
      {bad_plugin("bad_layout"), "another layout of the object type GoalPoint"},
      {bad_plugin("bad_pinned"), "could never be unloaded"},
      {bad_plugin("bad_static_crashes"), "its static initialisation"},
      {next_version("test_teller_port"), "it has no port \"in\""},
      {next_version("test_teller_2") + ":test.Other", "has no component type \"test.Other\""},
      {next_version("test_teller_constructor"), "no teller today"},
      {next_version("test_teller_configure"), "is not liked today"},
      {next_version("test_teller_odd"), "value 1 of the state is a whole number, where a text is expected"}};
  const std::vector<std::pair<std::string, std::string>> bad_in_shadow{
      {next_version("test_teller_first_lap"), "not taken: work() threw std::runtime_error: no lap today"},
      {next_version("test_teller_constructor_crashes"), "its constructor"},
      {next_version("test_teller_lap_crashes"), "its laps, in the shadow of the present one,"},
      // A busy machine needs longer to fill the memory than the code gets.
      {next_version("test_teller_lap_eats"), "was tried out beside the one that runs, and not taken"},
      {next_version("test_teller_lap_hangs"), "its laps, in the shadow of the present one,"}};
  if (kTriesInShadow) bad.insert(bad.end(), bad_in_shadow.begin(), bad_in_shadow.end());
  for (const auto& [plugin, reason] : bad) {
    const Run run = system.swap(plugin, {"--probation", "100 ms"}, "100 ms");
    INFO(plugin << run.err);
    CHECK(run.exit_code() == 1);
    CHECK_THAT(run.err, Contains(reason));
  }
  CHECK(run_orcactl({"swap", "taller", next_version("test_teller_2")}).exit_code() == 1);
  CHECK(run_orcactl({"swap", "teller"}).exit_code() == 2);
  CHECK_THAT(system.swap(next_version("test_teller_2"), {}, "2 min").err, Contains("60 s at most"));
  CHECK_THAT(system.swap(next_version("test_teller_2"), {"--set", "step"}).err,
             Contains("write PARAM=VALUE"));
  CHECK_THAT(system.swap(next_version("test_teller_2"), {"--set", "step=70"}, "0s").err, Contains("step"));
  CHECK(system.swap(next_version("test_teller_2"), {"--probation", "0 s"}).exit_code() == 0);
  system.end_in_order();
}

TEST_CASE("new code is tried with what reaches the old one, and the log says with how much",
          "[system][swap]") {
  Telling system("talking");
  REQUIRE(system.swap(next_version("test_teller_2"), {"--set", "step=3", "--probation", "0 s"}).exit_code() ==
          0);
  if (!kThreadSanitizer) {
    CHECK(system.hears("the new code was tried out: it got "));
    CHECK_THAT(system.log(), !Contains("it got 0 objects"));
  }
  system.end_in_order();
}

TEST_CASE("a swap that meets a restart of its process ends with an error or with the new code, and once",
          "[system][swap]") {
  for (const Seconds wait : {Seconds(0.0), Seconds(0.2), Seconds(0.35), Seconds(0.5)}) {
    Telling system("talking");
    Subprocess swap(orcactl(
        {"swap", "teller", next_version("test_teller_2"), "--tryout", "300 ms", "--probation", "300 ms"}));
    std::this_thread::sleep_for(wait);
    CHECK(run_orcactl({"restart", "counting"}).exit_code() == 0);
    const Run swapped = finish(swap, Seconds(20));
    INFO(swapped.err);
    CHECK((swapped.exit_code() == 0 ? swapped.out.find("test.Teller") != std::string::npos
                                    : swapped.exit_code() == 1 && !swapped.err.empty()));
    CHECK(system.swap(next_version("test_teller_2"), {"--probation", "0 s"}).exit_code() == 0);
    CHECK(run_orcactl({"stop"}).exit_code() == 0);
    CHECK(finish(system.program(), Seconds(10)).exit_code() == 0);
  }
}

TEST_CASE("the plugin's file may be overwritten or removed once the swap was ordered", "[system][swap]") {
  Telling system("talking");
  const std::string file = system.folder().file("new.so");
  std::filesystem::copy_file(next_version("test_teller_2"), file);
  REQUIRE(system.swap(file, {"--probation", "0 s"}).exit_code() == 0);
  {
    std::fstream open(file, std::ios::in | std::ios::out | std::ios::binary);  // in place: the same inode
    open << std::string(4096, 'x');
  }
  REQUIRE(system.hears("heard 2:"));
  std::filesystem::remove(file);
  CHECK(system.swap(next_version("test_teller_again"), {"--probation", "0 s"}).exit_code() == 0);
  system.end_in_order();
}

TEST_CASE("the parameters of a component are those of the code that runs, whatever type the graph names",
          "[system][swap]") {
  Telling system("talking");
  const auto value_of = [](const std::string& param) { return run_orcactl({"get", param, "--json"}).out; };
  REQUIRE(run_orcactl({"set", "teller.step", "2"}).exit_code() == 0);
  const Run other = system.swap(next_version("test_teller_other") + ":test.OtherTeller",
                                {"--set", "tone=sharp", "--probation", "0 s"});
  INFO(other.err << system.log());
  REQUIRE(other.exit_code() == 0);
  CHECK_THAT(value_of("teller.tone"), Contains(R"("value": "sharp")"));
  CHECK_THAT(value_of("teller.step"), Contains(R"("value": "2")"));
  CHECK(run_orcactl({"set", "teller.tone", "flat", "teller.step", "3"}).exit_code() == 0);
  CHECK_THAT(run_orcactl({"set", "teller.tone", "loud"}).err, Contains("loud") && Contains("sharp"));
  CHECK_THAT(value_of("teller.tone"), Contains(R"("value": "flat")"));
  CHECK_THAT(run_orcactl({"names", "param"}).out, Contains("teller.tone"));
  REQUIRE(system.swap(next_version("test_teller_2") + ":test.Teller", {"--probation", "0 s"}).exit_code() ==
          0);
  CHECK_THAT(value_of("teller"), !Contains("tone"));
  CHECK_THAT(value_of("teller.step"), Contains(R"("value": "3")"));
  CHECK_THAT(run_orcactl({"set", "teller.tone", "flat"}).err, Contains("has no parameter \"tone\""));
  CHECK(run_orcactl({"restart", "counting"}).exit_code() == 0);
  CHECK_THAT(value_of("teller.step"), Contains(R"("value": "1")"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("a swap that meets a long probation is told how long that lasts, and what ends it",
          "[system][swap]") {
  Telling system("talking");
  Subprocess patient(
      orcactl({"swap", "teller", next_version("test_teller_2"), "--tryout", "100 ms", "--probation", "1 h"}));
  REQUIRE(system.hears("heard 2:"));
  const Run refused = system.swap(next_version("test_teller_again"));
  CHECK(refused.exit_code() == 1);
  CHECK_THAT(refused.err, Contains("test_teller_2.so is on probation for another 35") &&
                              Contains("orcactl restart teller ends that at once"));
  CHECK(run_orcactl({"restart", "teller"}).exit_code() == 0);
  CHECK(finish(patient, Seconds(10)).exit_code() == 1);
  CHECK(system.swap(next_version("test_teller_again"), {"--probation", "0 s"}).exit_code() == 0);
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
}

TEST_CASE("a process that is started again runs the code that the graph names, and says so",
          "[system][swap]") {
  Telling system("talking");
  REQUIRE(system.swap(next_version("test_teller_2"), {"--probation", "0 s"}).exit_code() == 0);
  CHECK(run_orcactl({"restart", "counting"}).exit_code() == 0);
  CHECK(system.hears("with the code that the graph names"));
  CHECK_THAT(run_orcactl({"ps", "--json"}).out, Contains("host_plugins/test_teller.so"));
  CHECK(run_orcactl({"stop"}).exit_code() == 0);
  CHECK(finish(system.program(), Seconds(10)).exit_code() == 0);
}

namespace {

std::string shipped(const std::string& plugin) {
  return std::string(ORCA_BINARY_DIR "/plugins/") + plugin + ".so";
}

// A component, and what takes its place.
using Swaps = std::vector<std::pair<std::string, std::string>>;

struct Drive {
  Run run;
  int swaps = 0;
};

const std::size_t kGoals = is_slow_run() ? 3 : 1;
const int kLeastSwaps = is_slow_run() ? 20 : 6;

// Drives a shipped graph in real time, and exchanges code in turn until the last goal is reached.
Drive exchange_on_the_way(const std::string& graph, const Swaps& swaps) {
  Words words{source_file(graph)};
  if (!is_slow_run()) words = words + Words{"--set", "goals=hall: 3.6 6 > 3.6 7.6"};
  Subprocess program(deployer(words));
  Drive drive;
  const std::string last = is_slow_run() ? "arrived meeting" : "arrived hall";
  for (std::size_t next = 0; next < 400 && !program.wait_for_output(last, Seconds(0.3)); ++next) {
    const auto& [component, plugin] = swaps[next % swaps.size()];
    if (run_orcactl({"swap", component, plugin, "--tryout", "300 ms", "--probation", "200 ms"}).exit_code() ==
        0)
      ++drive.swaps;
  }
  drive.run = finish(program, Seconds(30));
  return drive;
}

void check_drive(const std::string& graph, const Swaps& swaps) {
  const Drive drive = exchange_on_the_way(graph, swaps);
  INFO(drive.run.err);
  CHECK(drive.run.exit_code() == 0);
  CHECK(drive.run.arrivals().size() == kGoals);
  CHECK(drive.run.contacts().empty());
  CHECK(drive.swaps >= kLeastSwaps);
}

}  // namespace

TEST_CASE(
    "behaviours are exchanged again and again while the robot drives, and it reaches its goals without a "
    "contact",
    "[system][swap]") {
  check_drive("graphs/scout_goto_processes.xml",
              {{"goto", shipped("goto")}, {"avoid", shipped("sonar_avoid")}});
}

TEST_CASE(
    "who fuses is exchanged again and again while the robot drives, keeps its clients, and the robot arrives",
    "[system][swap]") {
  check_drive("graphs/pioneer_laser_goto.xml", {{"fuser", shipped("motion_command_fuser")}});
}

TEST_CASE("LaserAvoid is exchanged for VFH+ and back while the Pioneer drives its course, without a contact",
          "[system][swap]") {
  check_drive("graphs/pioneer_laser_goto.xml", {{"avoid", shipped("vfh_plus") + ":orca.VfhPlus"},
                                                {"avoid", shipped("laser_avoid") + ":orca.LaserAvoid"}});
}
