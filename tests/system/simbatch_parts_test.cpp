// SPDX-License-Identifier: GPL-3.0-or-later
// Batches in several parts, on machines that are overloaded, of plugins and files that are fit and unchanged, or not.
#include <catch2/catch.hpp>

#include <sched.h>
#include <sys/inotify.h>
#include <sys/resource.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "batches.hpp"
#include "deployer.hpp"
#include "screen.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;

TEST_CASE(
    "a plugin that uses clocks, sleeps, threads or random numbers is refused by name before anything runs",
    "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = folder.write(
      "e.xml", "<experiment name=\"e\" seeds=\"1\" until=\"1 s\" graph=\"" +
                   system_graph("one_component.xml") + "\"><set arg=\"plugins\" value=\"" +
                   std::string(ORCA_BINARY_DIR "/tests/plugins") +
                   "\"/><variant name=\"good\"><set arg=\"type\" value=\"test.LapCounter\"/></variant>"
                   "<variant name=\"bad\"><set arg=\"type\" value=\"test.WallClock\"/></variant>"
                   "<world name=\"here\"/></experiment>");
  const Run run = run_simbatch({experiment, "--out", folder.file("out")});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says(
      "test.WallClock cannot run in virtual time: test_wall_clock.so uses usleep, which waits for the "
      "machine's clock"));
  CHECK(run.says("uses rand, which draws random numbers that the run's seed does not decide"));
  CHECK(run.says("(variant bad, world here)"));
  CHECK_FALSE(std::filesystem::exists(folder.file("out")));
}

TEST_CASE("the plugin folder of one graph is not that of the next graph", "[system][batch]") {
  const TempFolder folder;
  const std::string variants = "<variant name=\"has_it\"><set arg=\"plugins\" value=\"" +
                               std::string(ORCA_BINARY_DIR "/tests/plugins") +
                               "\"/></variant><variant name=\"lacks_it\"><set arg=\"plugins\" value=\"" +
                               folder.path().string() + "\"/></variant>";
  const std::string experiment = folder.write(
      "e.xml", "<experiment name=\"e\" seeds=\"1\" until=\"1 s\" graph=\"" +
                   system_graph("one_component.xml") + "\"><set arg=\"type\" value=\"test.LapCounter\"/>" +
                   variants + "<world name=\"here\"/></experiment>");
  const Run run = run_simbatch({experiment, "--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK(run.says("(variant lacks_it, world here)"));
  CHECK_FALSE(run.says("(variant has_it, world here)"));
}

namespace {

// Returns how often the world of an experiment with these avoid behaviours is opened while its graphs are checked.
// @param profile  of the graph: with "odometry" a component reads the world, too.
std::size_t opens_in_check(const Words& behaviours, const std::string& profile) {
  const TempFolder folder;
  const std::string world = folder.write("office.xml", text_in(source_file("sim/worlds/office.xml")));
  std::string experiment = "<experiment name=\"e\" seeds=\"1\" until=\"1 s\" profile=\"" + profile +
                           "\" graph=\"" + source_file("graphs/pioneer_laser_goto.xml") +
                           "\"><set arg=\"world\" value=\"" + world + "\"/><world name=\"office\"/>";
  for (const std::string& one : behaviours)
    experiment += "<variant name=\"" + one + "\"><set arg=\"avoid\" value=\"orca." + one + "\"/></variant>";
  const std::string file = folder.write("e.xml", experiment + "</experiment>");
  const int watch = inotify_init1(IN_NONBLOCK | IN_CLOEXEC);
  // Equal events that follow each other count as one, so closing is watched, too.
  REQUIRE(inotify_add_watch(watch, folder.path().c_str(), IN_OPEN | IN_CLOSE_NOWRITE) >= 0);
  const Run run = run_simbatch({file, "--check"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  alignas(inotify_event) std::array<char, 65536> bytes{};
  const ssize_t size = read(watch, bytes.data(), bytes.size());
  close(watch);
  std::size_t opens = 0;
  for (ssize_t at = 0; at < size;) {
    const auto* const event = reinterpret_cast<const inotify_event*>(bytes.data() + at);
    if ((event->mask & IN_OPEN) != 0 && event->len > 0 && std::string(event->name) == "office.xml") ++opens;
    at += static_cast<ssize_t>(sizeof(inotify_event) + event->len);
  }
  return opens;
}

}  // namespace

TEST_CASE("the check reads a world for all variants as often as for one", "[system][batch]") {
  for (const std::string profile : {"sim", "sim odometry"}) {
    const std::size_t of_one = opens_in_check({"LaserAvoid"}, profile);
    CHECK(of_one > 0);
    CHECK(opens_in_check({"LaserAvoid", "VfhPlus", "Dwa"}, profile) == of_one);
  }
}

TEST_CASE("seven parts that are joined are the whole, byte for byte, in any order", "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = dependents(folder, "e.xml", {"nothing", "nothing_more"}, "1-20");
  const std::string whole = batch(experiment, folder.file("whole"));
  Words parts;
  for (int i = 7; i >= 1; --i) {
    const std::string out = folder.file("part" + std::to_string(i));
    const Run run = run_simbatch({experiment, "--out", out, "--shard", std::to_string(i) + "/7"});
    INFO(run.err);
    REQUIRE(run.exit_code() == 0);
    CHECK(run.says("part " + std::to_string(i) + " of 7 is in " + out));
    parts.push_back(out);
  }
  const std::string all = folder.file("all");
  const Run joined = run_simbatch(Words{"join"} + parts + Words{"--out", all});
  INFO(joined.err);
  CHECK(joined.exit_code() == 0);
  CHECK(exported(all) == whole);
  CHECK(run_simbatch({"diff", folder.file("whole"), all}).exit_code() == 0);
}

TEST_CASE("parts that are not whole are joined, and what is missing can be made then", "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = dependents(folder, "e.xml", {"nothing"});
  const std::string whole = batch(experiment, folder.file("whole"));
  REQUIRE(run_simbatch({experiment, "--out", folder.file("part"), "--shard", "2/2"}).exit_code() == 0);
  const Run joined = run_simbatch({"join", folder.file("part"), "--out", folder.file("all")});
  INFO(joined.err);
  CHECK(joined.exit_code() == 0);
  CHECK(joined.says("1 of 2 runs are missing; --resume makes them"));
  CHECK(batch(experiment, folder.file("all"), {"--resume"}) == whole);
}

TEST_CASE("results of another experiment are not joined, and nothing is left of the attempt",
          "[system][batch]") {
  const TempFolder folder;
  (void)batch(dependents(folder, "a.xml", {"nothing"}), folder.file("a"));
  (void)batch(dependents(folder, "b.xml", {"hashes"}), folder.file("b"));
  const Run run = run_simbatch({"join", folder.file("a"), folder.file("b"), "--out", folder.file("all")});
  CHECK(run.exit_code() == 2);
  CHECK(run.says(folder.file("b")));
  CHECK(run.says("holds results of another experiment"));
  CHECK_FALSE(std::filesystem::exists(folder.file("all") + "/results.sqlite"));
}

namespace {

// Returns why a batch cannot go on.
std::string refusal(const std::string& experiment, const std::string& out) {
  const Run run = run_simbatch({experiment, "--out", out, "--resume"});
  CHECK(run.exit_code() == 2);
  return run.err;
}

}  // namespace

TEST_CASE("--resume refuses results of another plugin or reference, and names it", "[system][batch]") {
  const TempFolder folder;
  const std::string plugins = folder.file("plugins");
  std::filesystem::create_directory(plugins);
  for (const char* name : {"test_dependent", "test_components"})
    for (const char* end : {".so", ".types"})
      std::filesystem::copy(std::string(ORCA_BINARY_DIR "/tests/plugins/") + name + end, plugins);
  const auto write = [&](const std::string& reference) {
    return folder.write("e.xml", "<experiment name=\"e\" seeds=\"1-2\" until=\"10 s\" graph=\"" +
                                     system_graph("dependent.xml") + "\"><set arg=\"plugins\" value=\"" +
                                     plugins + "\"/><variant name=\"v\"/><world name=\"w\" reference=\"" +
                                     reference + "\"/></experiment>");
  };
  const std::string experiment = write("3 m");
  (void)batch(experiment, folder.file("out"));
  (void)batch(experiment, folder.file("out"), {"--resume"});
  write("4 m");
  CHECK_THAT(refusal(experiment, folder.file("out")),
             Contains("since results were made, these were changed: world w;"));
  write("3 m");
  std::ofstream(plugins + "/test_dependent.so", std::ios::app) << "a byte";
  CHECK_THAT(refusal(experiment, folder.file("out")),
             Contains("these were changed: plugin test_dependent.so;") && Contains("--out"));
}

TEST_CASE("--resume refuses results of another world file, and takes more worlds", "[system][batch]") {
  const TempFolder folder;
  const std::string world = folder.write("office.xml", text_in(source_file("sim/worlds/office.xml")));
  const auto write = [&](const std::string& more) {
    return folder.write(
        "e.xml",
        "<experiment name=\"e\" seeds=\"1\" until=\"2 s\" graph=\"" +
            source_file("graphs/pioneer_laser_goto.xml") +
            "\"><variant name=\"v\"/><world name=\"w\"><set arg=\"world\" file=\"office.xml\"/></world>" +
            more + "</experiment>");
  };
  const std::string experiment = write("");
  (void)batch(experiment, folder.file("out"));
  write("<world name=\"x\"/>");
  CHECK(split_lines(batch(experiment, folder.file("out"), {"--resume"})).size() == 3);
  std::ofstream(world, std::ios::app) << "<!-- another world -->";
  CHECK_THAT(refusal(experiment, folder.file("out")), Contains("these were changed: file office.xml;"));
}

TEST_CASE("while many graphs are checked, a terminal shows how far it is, and nothing else does",
          "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = drive(folder);
  Screen terminal;
  Subprocess program(
      Words{"/bin/sh", "-c", "exec \"$@\" 2>" + terminal.name(), "sh", "/usr/bin/env", "TERM=xterm"} +
      simbatch({experiment, "--check"}));
  CHECK(finish(program, Seconds(60)).exit_code() == 0);
  const std::string bytes = terminal.all_bytes();
  CHECK_THAT(bytes, Contains("checking graph 1 of 4") && Contains("checking graph 4 of 4"));
  const std::vector<std::string> left = screen_after(bytes);
  REQUIRE(left.size() == 1);
  CHECK_THAT(left[0], Contains("no errors; 2 variants, 2 worlds, 2 seeds: 8 runs"));
  CHECK_FALSE(run_simbatch({experiment, "--check"}).says("checking"));
}

namespace {

// Returns whether the process makes a run for the second time, only to compare it. It begins as a copy of the batch's process.
bool is_twin(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/cmdline");
  const std::string words{std::istreambuf_iterator<char>(file), {}};
  return words.empty() || words.find("make-alone") != std::string::npos;
}

// Returns a process that makes a run, once a batch has begun to make them.
pid_t worker_of(Subprocess& program) {
  REQUIRE(program.wait_for_output("running", Seconds(20 * kSlowdown)));
  const std::string task = std::to_string(program.pid());
  for (;;) {
    std::ifstream children("/proc/" + task + "/task/" + task + "/children");
    for (pid_t child = 0; children >> child;) {
      std::this_thread::sleep_for(Seconds(0.1));
      if (!is_twin(child)) return child;
    }
    REQUIRE_FALSE(program.wait(Seconds(0.01)));
  }
}

// A walk that takes a process some seconds.
std::string long_walk(const TempFolder& folder, const std::string& limit = "100 s") {
  return folder.write("walk.xml", "<experiment name=\"walk\" seeds=\"1-2\" until=\"1000 s\" limit=\"" +
                                      limit + "\" graph=\"" + source_file("graphs/random_walk.xml") +
                                      "\"><variant name=\"v\"/><world name=\"w\"/></experiment>");
}

}  // namespace

TEST_CASE("a run whose process the machine kills is no result, and is made again", "[system][batch]") {
  const TempFolder folder;
  const std::string experiment = long_walk(folder);
  const std::string undisturbed = batch(experiment, folder.file("undisturbed"));
  Subprocess program(simbatch({experiment, "--out", folder.file("out"), "--jobs", "1"}));
  kill(worker_of(program), SIGKILL);
  const Run run = finish(program, Seconds(120));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("warning: the machine is overloaded, variant v in world w with seed "));
  CHECK(run.says("somebody killed its process, as a machine without free memory does; it is made again"));
  CHECK(exported(folder.file("out")) == undisturbed);
}

namespace {

// Keeps one processor busy with everything but the run, and leaves it to the tests beside this one.
class BusyProcessor {
 public:
  BusyProcessor() {
    cpu_set_t mine;
    sched_getaffinity(0, sizeof mine, &mine);
    int number = 0;
    while (CPU_ISSET(number, &mine) == 0) ++number;
    CPU_ZERO(&processor_);
    CPU_SET(number, &processor_);
    for (int i = 0; i < 8; ++i) {
      hogs_.push_back(std::make_unique<Subprocess>(Words{"/bin/sh", "-c", "while :; do :; done"}));
      sched_setaffinity(hogs_.back()->pid(), sizeof processor_, &processor_);
      setpriority(PRIO_PROCESS, static_cast<id_t>(hogs_.back()->pid()), 10);
    }
  }
  // Leaves a process what the hogs do not take.
  void add(pid_t process) const {
    sched_setaffinity(process, sizeof processor_, &processor_);
    setpriority(PRIO_PROCESS, static_cast<id_t>(process), 19);
  }

 private:
  cpu_set_t processor_{};
  std::vector<std::unique_ptr<Subprocess>> hogs_;
};

}  // namespace

TEST_CASE("a run that waits for a processor longer than it may run is no result, and is made again",
          "[system][batch]") {
  const TempFolder folder;
  const std::string undisturbed = batch(long_walk(folder), folder.file("undisturbed"));
  const std::string experiment = long_walk(folder, kSanitized ? "80 s" : "4 s");
  // Before the run, which lasts only a second if nobody hinders it.
  auto busy = std::make_unique<BusyProcessor>();
  Subprocess program(simbatch({experiment, "--out", folder.file("out"), "--jobs", "1"}));
  busy->add(worker_of(program));
  REQUIRE(program.wait_for_output(
      "it waited longer for a processor than the limit allows it to run; it is made again",
      Seconds(kSanitized ? 400 : 60)));
  busy.reset();
  const Run run = finish(program, Seconds(120));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(exported(folder.file("out")) == undisturbed);
}
