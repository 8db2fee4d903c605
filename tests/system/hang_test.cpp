// SPDX-License-Identifier: GPL-3.0-or-later
// One signal ends the process within 3 s if the machine has nothing else to do, whatever hangs and whenever, and the last line names it.
#include <signal.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr double kEndLimit = 3.0 * kSlowdown;  // [s]

struct Stopped {
  Run run;
  Seconds took{0};
  bool left_behind = true;
};

// Where a plugin hangs, and what the last line says of the time that it had.
struct Place {
  Words words;
  std::string when;
};
const std::vector<Place> kPlaces{{{"--in-process"}, "2.5 s after the signal to stop"}, {{}, "in time"}};

// Sends SIGTERM after a while in which the program has come to where it hangs.
Stopped stop(const Words& words, double after = 3.0) {
  Subprocess program(deployer(words));
  std::this_thread::sleep_for(Seconds(after));
  CHECK(program.group_lives());
  program.send(SIGTERM);
  const auto sent = std::chrono::steady_clock::now();
  Stopped stopped{finish(program, Seconds(10)), {}, true};
  stopped.took = std::chrono::steady_clock::now() - sent;
  stopped.left_behind = program.group_lives();
  return stopped;
}

// A folder with a pipe that nobody writes to, under a name that ends as it must.
class Pipe {
 public:
  explicit Pipe(const std::string& name) : path_(folder_.file(name)) {
    REQUIRE(mkfifo(path_.c_str(), 0600) == 0);
  }
  [[nodiscard]] const std::string& path() const { return path_; }
  [[nodiscard]] std::string write(const std::string& name, const std::string& text) const {
    return folder_.write(name, text);
  }

 private:
  const TempFolder folder_;
  const std::string path_;
};

void check_refused(const Words& words) {
  CAPTURE(words);
  const Run run = run_deployer(words, Seconds(10));
  INFO(run.err);
  CHECK(run.exit_code() == 2);
  CHECK((run.says("pipe that nobody writes to") || run.says("it is a pipe or a device") ||
         run.says("this is not a file")));
}

Words clinger(const Words& settings) {
  Words words = Words{system_graph("clinger.xml")} + with_test_plugins();
  for (const std::string& setting : settings) words = words + Words{"--set", setting};
  return words;
}

}  // namespace

TEST_CASE("a pipe that nobody writes to is refused as graph, include, world, picture, table, mesh or robot",
          "[system][signals]") {
  const std::string graph = source_file("graphs/scout_goto.xml");
  check_refused({Pipe("graph.xml").path()});
  check_refused({Pipe("graph.xml").path(), "--check"});
  const Pipe included("included.xml");
  check_refused(
      {included.write("graph.xml", R"(<graph name="a" version="1"><include file="included.xml"/></graph>)")});
  for (const std::string name : {"world.xml", "world.csv", "world.csv.gz"}) {
    const Pipe world(name);
    check_refused({graph, "--set", "world=" + world.path() + (name == "world.xml" ? "" : "#1")});
  }
  const Pipe picture("world.pgm");
  check_refused({source_file("graphs/random_walk.xml"), "--set", "world=" + picture.path(), "--set",
                 "map_width=10 m", "--set", "place=", "--set", "x=5", "--set", "y=5"});
  const Pipe mesh("shape.stl");
  check_refused(
      {graph, "--set",
       "world=" + mesh.write("world.xml", R"(<world name="a" version="1"><place name="start" x="1" y="1"/>)"
                                          R"(<mesh name="m" x="3" y="3" file="shape.stl"/></world>)")});
  check_refused({graph, "--set", "robot=" + Pipe("robot.urdf").path()});
}

TEST_CASE("a graph may come from a pipe that somebody writes to", "[system][signals]") {
  Subprocess program(Words{"/bin/sh", "-c",
                           "\"$0\" --print /dev/stdin < /dev/null; cat \"$1\" | \"$0\" --check /dev/stdin"} +
                     deployer({source_file("graphs/orca-graph.xsd")}));
  const Run run = finish(program, Seconds(10));
  INFO(run.err);
  CHECK(run.says("/dev/stdin:1:1: error G10"));  // the first is empty
  CHECK(run.says("error G001"));                 // the second was read: it is no graph
}

TEST_CASE("a destructor that hangs is ended with 1 after one signal, and named", "[system][signals]") {
  if (kSanitized) return;  // they take longer to end
  for (const Place& place : kPlaces) {
    for (const std::string& until : {std::string("0.1 s"), std::string("1000 s")}) {
      CAPTURE(until, place.words);
      const Stopped stopped = stop(clinger({"where=destructor"}) + Words{"--until", until} + place.words);
      INFO(stopped.run.err);
      CHECK(stopped.run.exit_code() == 1);
      CHECK(stopped.took < Seconds(kEndLimit));
      CHECK(stopped.run.says("error: clinger: its destructor has not ended " + place.when));
      CHECK(stopped.run.says("test_clinger.so"));
      CHECK_FALSE(stopped.left_behind);
    }
  }
}

TEST_CASE(
    "a static destructor or an atexit handler of a plugin that hangs is ended after one signal, and named",
    "[system][signals]") {
  if (kSanitized) return;
  for (const Place& place : kPlaces) {
    for (const std::string& where : {std::string("where=static"), std::string("where=atexit")}) {
      CAPTURE(where, place.words);
      const Stopped stopped = stop(clinger({where}) + Words{"--until", "0.1 s"} + place.words);
      INFO(stopped.run.err);
      CHECK(stopped.run.exit_code() == 1);
      CHECK(stopped.took < Seconds(kEndLimit));
      CHECK(stopped.run.says("test_clinger.so: its static destruction has not ended " + place.when));
      CHECK_FALSE(stopped.left_behind);
    }
  }
}

TEST_CASE("a constructor that hangs before anything has started is ended with 0 after one signal, and named",
          "[system][signals]") {
  if (kSanitized) return;
  for (const Place& place : kPlaces) {
    CAPTURE(place.words);
    const Stopped stopped = stop(clinger({"type=LateClinger"}) + place.words);
    INFO(stopped.run.err);
    CHECK(stopped.run.exit_code() == 0);
    CHECK(stopped.took < Seconds(kEndLimit));
    // It hangs in the trial, too. After the signal no host process is started.
    CHECK(stopped.run.says("clinger: its constructor has not ended") == !place.words.empty());
    CHECK_FALSE(stopped.left_behind);
  }
}
