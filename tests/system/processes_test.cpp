// SPDX-License-Identifier: GPL-3.0-or-later
// A graph in several host processes: each of them may die at any moment, in any way, and so may the deployer.
#include <signal.h>
#include <sys/ptrace.h>
#include <sys/resource.h>

#include <array>
#include <catch2/catch.hpp>
#include <cstdio>
#include <filesystem>
#include <future>
#include <stop_token>
#include <thread>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "process_table.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

namespace {

const std::string kScout = source_file("graphs/scout_goto_processes.xml");
const std::string kNear = "goals=hall: 3.6 6 > 3.6 7.6";

Words hooligan(const Words& settings) {
  Words words = Words{system_graph("hooligan_process.xml")} + with_test_plugins();
  for (const std::string& setting : settings) words = words + Words{"--set", setting};
  return words;
}

}  // namespace

TEST_CASE("a graph in three processes reaches its goals, and says so as in one", "[system][processes]") {
  const Words words{kScout, "--set", kNear};
  const std::vector<Run> runs = run_together({words, words + Words{"--in-process"}}, Seconds(60));
  const Run& several = runs[0];
  const Run& one = runs[1];
  INFO(several.err << one.err);
  CHECK(several.exit_code() == 0);
  REQUIRE(several.arrivals().size() == 1);
  CHECK(one.exit_code() == 0);
  REQUIRE(one.arrivals().size() == 1);
  CHECK(one.arrivals()[0].x == Approx(several.arrivals()[0].x).margin(0.5));
  CHECK(one.arrivals()[0].y == Approx(several.arrivals()[0].y).margin(0.5));
}

TEST_CASE("in virtual time the trace hash is that of the graph without processes", "[system][processes]") {
  const Run several = run_deployer(Words{kScout} + virtual_clock(), Seconds(60));
  const Run one = run_deployer(Words{source_file("graphs/scout_goto.xml")} + virtual_clock(), Seconds(60));
  REQUIRE(one.trace_hash());
  CHECK(several.trace_hash() == one.trace_hash());
  CHECK(several.arrivals().size() == 3);
}

TEST_CASE("the loss of each process is seen at once, and objects flow again", "[system][processes][quiet]") {
  const std::vector<std::string> before = kept_by_system();
  System system(flow());
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

TEST_CASE("a process that cannot be started again for lack of descriptors is, as soon as there are some",
          "[system][processes]") {
  if (kSanitized) return;  // without descriptors the sanitizer of types finds faults that are none
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  const pid_t lost = system.process("sink");
  const pid_t deployer = system.program().pid();
  rlimit before{};
  REQUIRE(prlimit(deployer, RLIMIT_NOFILE, nullptr, &before) == 0);
  const rlimit few{11, before.rlim_max};  // what it polls; others are open
  REQUIRE(prlimit(deployer, RLIMIT_NOFILE, &few, nullptr) == 0);
  const std::size_t mark = system.mark();
  REQUIRE(kill(lost, SIGKILL) == 0);
  system.when("process sink could not be started: ", mark);
  REQUIRE(prlimit(deployer, RLIMIT_NOFILE, &before, nullptr) == 0);
  system.when("process sink is back", mark);
  system.flows_without(lost, mark);
  stop(system);
}

TEST_CASE("processes that are lost together come back together", "[system][processes]") {
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  for (int i = 0; i < 5; ++i) {
    CAPTURE(i);
    const std::size_t mark = system.mark();
    const pid_t relay = system.process("relay");
    kill(relay, SIGKILL);
    std::this_thread::sleep_for(Seconds(0.02 * i));
    kill(system.process("sink"), SIGKILL);
    system.when("process sink is back", mark, Seconds(10));
    system.flows_without(relay, mark);
    std::this_thread::sleep_for(Seconds(0.2));
  }
  stop(system);
}

TEST_CASE("a process that is lost while it comes up does not hold up one that comes up with it",
          "[system][processes]") {
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  const std::size_t mark = system.mark();
  const pid_t relay = system.process("relay");
  const pid_t sink = system.process("sink");
  system.program().send(SIGSTOP);  // so that it sees both losses together
  kill(relay, SIGKILL);
  kill(sink, SIGKILL);
  system.program().send(SIGCONT);
  kill(system.process("relay", relay), SIGKILL);
  system.when("process sink is back", mark, Seconds(5));
  system.flows_without(relay, mark);
  stop(system);
}

TEST_CASE("a hundred random kills", "[.][slow][processes]") { kill_many(100, "shm"); }

TEST_CASE("while the process of the behaviours hangs the base stops the robot", "[system][processes]") {
  System system({kScout, "--set", kNear});
  const pid_t behaviours = system.process("behaviours");
  std::this_thread::sleep_for(Seconds(3));
  const std::size_t mark = system.mark();
  const Seconds stopped = since_boot();
  REQUIRE(kill(behaviours, SIGSTOP) == 0);
  CHECK(system.when("the base stands: no motion command", mark) - stopped < Seconds(0.6 * kSlowdown));
  CHECK(system.when("process behaviours hung and was killed", mark) - stopped < Seconds(1.0 * kSlowdown));
  system.when("process behaviours is back", mark);
  CHECK_FALSE(is_alive(behaviours));
  stop(system);
}

namespace {

/// Keeps the threads of a process from ending, however it is killed, as long as this object lives.
class HeldBeforeItsEnd {
 public:
  explicit HeldBeforeItsEnd(pid_t process) {
    std::promise<int> held;
    std::future<int> number = held.get_future();
    holder_ = std::jthread([process, &held](const std::stop_token& stop) {
      int count = 0;  // whoever traces is a thread: with it ends what it does
      for (const auto& thread :
           std::filesystem::directory_iterator("/proc/" + std::to_string(process) + "/task"))
        count +=
            ptrace(PTRACE_SEIZE, std::stoi(thread.path().filename().string()), 0, PTRACE_O_TRACEEXIT) == 0;
      held.set_value(count);
      while (!stop.stop_requested()) std::this_thread::sleep_for(kMoment);
    });
    threads_ = number.get();
  }
  [[nodiscard]] int threads() const { return threads_; }

 private:
  std::jthread holder_;
  int threads_ = 0;
};

}  // namespace

TEST_CASE("a process that was killed and takes long to end did not hang", "[system][processes]") {
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  const pid_t sink = system.process("sink");
  const std::size_t mark = system.mark();
  {
    const HeldBeforeItsEnd held(sink);
    REQUIRE(held.threads() > 0);
    REQUIRE(kill(sink, SIGKILL) == 0);
    std::this_thread::sleep_for(Seconds(1.0));  // twice what a silent process has
    CHECK(is_alive(sink));
  }
  system.when("process sink was ended by SIGKILL", mark);
  system.when("process sink is back", mark);
  stop(system);
}

TEST_CASE("nobody is killed because the deployer was stopped for a while", "[system][processes]") {
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  const auto before = system.children();
  system.program().send(SIGSTOP);
  std::this_thread::sleep_for(Seconds(2));
  system.program().send(SIGCONT);
  std::this_thread::sleep_for(Seconds(1));
  CHECK(system.children() == before);
  CHECK_FALSE(stop(system).says("PROCESS_ENDED"));
}

TEST_CASE("no process outlives a deployer that was killed", "[system][processes]") {
  const std::vector<std::string> before = kept_by_system();
  for (const double after : {0.05, 0.1, 0.2, 0.4, 1.5}) {
    CAPTURE(after);
    System system({kScout});
    std::this_thread::sleep_for(Seconds(after));
    system.program().send(SIGKILL);
    system.program().wait(Seconds(1));
    CHECK(comes_true([&] { return system.left().empty(); }, Seconds(1)));
  }
  CHECK(kept_by_system() == before);
}

// Whoever stops a service, such as systemd, signals all its processes.
TEST_CASE("SIGINT and SIGTERM to all, and SIGTERM to the deployer, end everything with 0",
          "[system][processes]") {
  for (const auto& [signal, to_all] :
       {std::pair(SIGINT, true), std::pair(SIGTERM, true), std::pair(SIGTERM, false)}) {
    for (const double after : {0.3, 1.5}) {
      CAPTURE(signal, to_all, after);
      System system({kScout});
      std::this_thread::sleep_for(Seconds(after));
      const Seconds sent = since_boot();
      to_all ? system.program().send_to_group(signal) : system.program().send(signal);
      const Run run = finish(system.program(), Seconds(10));
      INFO(run.err);
      CHECK(run.exit_code() == 0);
      CHECK(since_boot() - sent < Seconds(3.0 * kSlowdown));
      CHECK(system.left() == Nobody{});
      CHECK_FALSE(run.says(": alarm "));
    }
  }
}

TEST_CASE("a process that hangs when the run ends does not hold it up", "[system][processes]") {
  System system(flow() + Words{"--until", "2 s"});
  system.when("flow ", 0, Seconds(10));
  const pid_t sink = system.process("sink");
  std::this_thread::sleep_for(Seconds(1.7));  // less than its hang limit before the end
  REQUIRE(kill(sink, SIGSTOP) == 0);
  const Run run = finish(system.program(), Seconds(10));
  INFO(run.err);
  CHECK(run.says("process sink hung"));
  CHECK(system.left() == Nobody{});
}

TEST_CASE("a process that is lost on its way back while the run ends does not make the run fail",
          "[system][processes]") {
  System system(flow() + Words{"--until", "2 s"});
  system.when("flow ", 0, Seconds(10));
  const pid_t sink = system.process("sink");
  REQUIRE(kill(sink, SIGKILL) == 0);
  REQUIRE(kill(system.process("sink", sink), SIGSTOP) == 0);
  const Run run = finish(system.program(), Seconds(10));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("it had not come back yet when the run ended"));
  CHECK(system.left() == Nobody{});
}

// The sanitizers' memory does not fit into the limit of that process, and they take its signals.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

TEST_CASE("a second SIGTERM ends everything within half a second", "[system][processes][quiet]") {
  System system(hooligan({"where=stop", "deed=hang"}));
  system.when("flow ", 0, Seconds(10));
  std::this_thread::sleep_for(Seconds(0.3));
  system.program().send(SIGTERM);
  std::this_thread::sleep_for(Seconds(0.1));
  const Seconds sent = since_boot();
  system.program().send(SIGTERM);
  const Run run = finish(system.program(), Seconds(10));
  INFO(run.err);
  CHECK(since_boot() - sent < Seconds(0.5 * kSlowdown));
  CHECK(comes_true([&] { return system.left().empty(); }, Seconds(0.5)));
}

namespace {

// A way to end a process, and what is said of it.
struct Deed {
  const char* deed;
  const char* end;    // how the process ends
  const char* words;  // of the plugin's last ones, behind the component's name
};

constexpr std::array kDeeds{Deed{"segfault", "was ended by SIGSEGV", ": work() ended the process"},
                            Deed{"abort", "was ended by SIGABRT", ": work() ended the process"},
                            Deed{"exit", "exited with status 1", ": work() called exit(0)"},
                            Deed{"overflow", "was ended by SIGSEGV", "its stack has overflowed"},
                            Deed{"hang", "", ": work() has computed or slept"},
                            Deed{"hoard", "used more memory than the graph allows", ""}};

struct Laps {
  double count = 0.0;
  double longest = 0.0;  // [s]
};

// Reads what the source of a flow says of its laps at its end.
Laps laps_of_source(const std::string& log) {
  const std::size_t at = log.find("laps ");
  REQUIRE(at != std::string::npos);
  Laps laps;
  REQUIRE(std::sscanf(log.c_str() + at, "laps %lf longest %lf", &laps.count, &laps.longest) == 2);
  return laps;
}

// Returns the alarms that tell of the end of a process.
std::vector<std::string> ends_of(const std::string& process, const std::string& log) {
  std::vector<std::string> lines = split_lines(log);
  std::erase_if(lines, [&](const std::string& line) {
    return line.find("alarm PROCESS_ENDED: process " + process + " ") == std::string::npos;
  });
  return lines;
}

}  // namespace

TEST_CASE("a plugin that ends its process in any way harms no other process", "[system][processes]") {
  const Deed deed = GENERATE(from_range(kDeeds));
  const std::vector<std::string> before = kept_by_system();
  System system(hooligan({"where=later", std::string("deed=") + deed.deed}));
  CAPTURE(deed.deed);
  const pid_t bad = system.process("bad");
  const Seconds began = system.when("flow ", 0, Seconds(10));
  const std::map<std::string, pid_t> others{{"source", system.process("source")},
                                            {"sink", system.process("sink")}};
  system.when(std::string("alarm PROCESS_ENDED: process bad ") + deed.end, 0, Seconds(20));
  system.when("process bad is back", 0, Seconds(5));
  CHECK(system.process("bad") != bad);
  for (const auto& [name, pid] : others) CHECK(system.process(name) == pid);
  const Run run = stop(system);
  const Seconds worked = since_boot() - began;
  INFO(run.err);
  const std::vector<std::string> ends = ends_of("bad", run.err);
  REQUIRE(!ends.empty());
  CHECK_THAT(ends.front(), Contains("hooligan") && Contains(deed.words));
  const Laps laps = laps_of_source(run.err);
  CHECK(laps.longest < 0.1 * kSlowdown);
  CHECK(laps.count > 0.8 * worked.count() / 0.01 / kSlowdown);
  CHECK(kept_by_system() == before);
}

TEST_CASE("while six plugins end their processes once a minute, no lap of another process is missed",
          "[.][slow][faults][processes]") {
  constexpr int kMinutes = 4;
  constexpr Seconds kPeriod{0.01};
  System system(Words{system_graph("hooligans_by_minute.xml")} + with_test_plugins());
  const Seconds began = system.when("flow ", 0, Seconds(20));
  const pid_t source = system.process("source");
  const pid_t sink = system.process("sink");
  std::this_thread::sleep_for(Seconds(60 * kMinutes + 30));
  CHECK(system.process("source") == source);
  CHECK(system.process("sink") == sink);
  for (const Deed& deed : kDeeds) (void)system.process(deed.deed);  // each is there again
  const Run run = stop(system);
  const Seconds worked = since_boot() - began;
  INFO(run.err);
  for (const Deed& deed : kDeeds) {
    CAPTURE(deed.deed);
    const std::vector<std::string> ends = ends_of(deed.deed, run.err);
    CHECK(ends.size() >= kMinutes - 1);
    for (const std::string& end : ends)
      CHECK_THAT(end, Contains(deed.end) && Contains(deed.words) && Contains(std::string(deed.deed)));
  }
  const Laps laps = laps_of_source(run.err);
  std::printf("%.0f laps of 10 ms in %.0f s, the longest took %.1f ms\n", laps.count, worked.count(),
              1e3 * laps.longest);
  CHECK(laps.longest < 2 * kPeriod.count());
  CHECK(laps.count > 0.99 * worked / kPeriod);
}

TEST_CASE("a process that crashes at once each time is given up", "[system][processes]") {
  const std::string where = GENERATE("start", "work");
  CAPTURE(where);
  System system(hooligan({"where=" + where, "deed=segfault"}));
  const Run run = finish(system.program(), Seconds(15));
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("GAVE_UP"));
  CHECK(system.left() == Nobody{});
  CHECK(run.said("PROCESS_ENDED").size() == 4);
}

TEST_CASE("a run that waits for a process that is not started again has failed", "[system][processes]") {
  System system(Words{system_graph("hooligan_once.xml")} + with_test_plugins());
  const Run run = finish(system.program(), Seconds(15));
  INFO(run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.says("process bad was ended by SIGSEGV"));
  CHECK(system.left() == Nobody{});
}

#endif

TEST_CASE("a process that never comes up ends the start with 3", "[system][processes]") {
  System system(hooligan({"where=configure", "deed=hang"}));
  const Run run = finish(system.program(), Seconds(20));
  INFO(run.err);
  CHECK(run.exit_code() == 3);
  CHECK(run.says("hooligan"));
  CHECK(system.left() == Nobody{});
}

TEST_CASE("twenty restarts leave nothing in the deployer", "[system][processes]") {
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  kill_one(system, "relay");
  const pid_t deployer_pid = system.program().pid();
  const std::size_t descriptors = descriptors_of(deployer_pid);
  const std::size_t threads = threads_of(deployer_pid);
  for (int i = 0; i < 20; ++i) {
    std::this_thread::sleep_for(Seconds(0.15));
    kill_one(system, i % 2 == 0 ? "relay" : "source");
  }
  for (int i = 0; i < 50 && descriptors_of(deployer_pid) > descriptors; ++i)
    std::this_thread::sleep_for(Seconds(0.1));  // the last one may still be coming up
  CHECK(descriptors_of(deployer_pid) <=
        descriptors);  // The first may have been coming up when they were counted.
  CHECK(threads_of(deployer_pid) == threads);
  stop(system);
}

TEST_CASE("the supervisor needs nearly no CPU time", "[system][processes]") {
  System system(flow());
  system.when("flow ", 0, Seconds(10));
  const Seconds before = cpu_time_of(system.program().pid());
  constexpr Seconds kTime{5.0};
  std::this_thread::sleep_for(kTime);
  const double share = (cpu_time_of(system.program().pid()) - before) / kTime;
  std::printf("CPU time of the supervisor: %.2f %%\n", 100.0 * share);
  CHECK(share < 0.05 * kSlowCode);
  stop(system);
}
