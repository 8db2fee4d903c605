// SPDX-License-Identifier: GPL-3.0-or-later
// Processes of one machine that are joined by DDS instead of shared memory.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>

#include "hosted_system.hpp"
#include "internet_sockets.hpp"

using namespace orca::test;

namespace {

const std::string kScout = source_file("graphs/scout_goto_processes.xml");
const std::string kNear = "goals=hall: 3.6 6 > 3.6 7.6";

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

// What a process holds that only DDS needs.
struct Traces {
  bool library = false;
  bool thread = false;
  bool socket = false;  // of the Internet
};

Traces traces_of(pid_t pid) {
  const std::filesystem::path folder = "/proc/" + std::to_string(pid);
  Traces traces;
  traces.library = read(folder / "maps").find("libfastrtps") != std::string::npos;
  for (const auto& task : std::filesystem::directory_iterator(folder / "task"))
    traces.thread = traces.thread || read(task.path() / "comm").starts_with("dds");
  for (const std::string table : {"udp", "udp6", "tcp", "tcp6"})
    traces.socket = traces.socket || !ports_of(pid, table).empty();
  return traces;
}

}  // namespace

TEST_CASE("a graph whose processes are joined by DDS reaches its goals", "[system][dds]") {
  const Run run = run_deployer({kScout, "--set", kNear, "--set", "link=dds"}, Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
  if (kDdsLetsPluginsGo) CHECK_FALSE(run.says("alarm"));
}

TEST_CASE("without a loopback interface a graph with link=\"dds\" does not start, and says why",
          "[system][dds][tool]") {
  const Words alone{"/usr/bin/env", "unshare", "--net"};  // where "lo" is down
  Subprocess trial(alone + Words{"true"});
  if (finish(trial, Seconds(10)).exit_code() != 0) {
    std::cout << "SKIPPED: this user may not make a network of its own\n";
    return;
  }
  Subprocess program(alone + deployer({kScout, "--set", kNear, "--set", "link=dds"}));
  const Run run = finish(program, Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() != 0);
  CHECK(run.says("DDS between processes of one machine needs its loopback interface"));
  CHECK(run.says("ip link set lo up"));
  Subprocess other(alone + deployer({kScout, "--set", kNear}));
  CHECK(finish(other, Seconds(60)).exit_code() == 0);  // shared memory needs none
}

TEST_CASE("only a process with an edge that goes over DDS has anything of DDS", "[system][dds]") {
  for (const std::string link : {"shm", "dds"}) {
    System system(flow(link));
    system.when("flow ", 0, Seconds(10));
    CAPTURE(link);
    for (const std::string name : {"source", "relay", "sink"}) {
      CAPTURE(name);
      const Traces traces = traces_of(system.process(name));
      const bool expected = link == "dds";
      CHECK(traces.library == expected);
      CHECK(traces.thread == expected);
      CHECK(traces.socket == expected);
    }
    const Traces of_deployer = traces_of(system.program().pid());
    CHECK_FALSE((of_deployer.library || of_deployer.thread || of_deployer.socket));
    stop(system);
  }
}

TEST_CASE("the loss of each process is seen at once, and objects flow again over DDS",
          "[system][dds][quiet]") {
  const std::vector<std::string> before = kept_by_system();
  System system(flow("dds"));
  system.when("flow ", 0, Seconds(10));
  for (const std::string name : {"source", "relay", "sink"}) {
    CAPTURE(name);
    const Outage outage = kill_one(system, name);
    CHECK(outage.detected < Seconds(0.5 * kSlowdown));
    CHECK(outage.flows < Seconds(3.0 * kSlowdown));
    std::this_thread::sleep_for(Seconds(0.15));
  }
  const Run run = stop(system);
  CHECK_FALSE(run.says("GAVE_UP"));
  CHECK(kept_by_system() == before);
}

TEST_CASE("a robot whose behaviours are killed drives on, over DDS too", "[system][dds]") {
  System system({kScout, "--set", kNear, "--set", "link=dds"});
  const pid_t behaviours = system.process("behaviours");
  std::this_thread::sleep_for(Seconds(kSanitized ? 8 : 3));  // it drives by then
  REQUIRE(kill(behaviours, SIGKILL) == 0);
  const Run run = finish(system.program(), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
}

TEST_CASE("a hundred random kills over DDS", "[.][slow][dds]") { kill_many(100, "dds"); }

TEST_CASE("a thousand starts of processes joined by DDS", "[.][slow][dds]") {
  constexpr int kStarts = 1000;
  std::vector<double> times;
  for (int i = 0; i < kStarts; ++i) {
    CAPTURE(i);
    const Seconds began = since_boot();
    System system(flow("dds"));
    times.push_back((system.when("flow ", 0, Seconds(5)) - began).count());
    stop(system);
  }
  print("start to the first object", times);
}
