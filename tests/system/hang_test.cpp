// SPDX-License-Identifier: GPL-3.0-or-later
// One signal ends the process within 3 s if the machine has nothing else to do, whatever hangs and whenever, and the last line names it.
#include <signal.h>
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <functional>
#include <future>
#include <string>
#include <thread>
#include <vector>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr double kEndLimit = 3.0 * kSlowdown;  // [s]

struct Stopped {
  Run run;
  Seconds took{0};
  bool ran = false;  // until the signal
  bool left_behind = true;
};

// Where a plugin hangs, and what the last line says of the time that it had.
struct Place {
  Words words;
  std::string when;
};
const std::vector<Place> kPlaces{{{"--in-process"}, "2.5 s after the signal to stop"}, {{}, "in time"}};

// Sends SIGTERM after a while in which the program has come to where it hangs. The system has a name of its own.
std::future<Stopped> stop(const Words& words) {
  static int number = 0;
  const std::string name = "hang_" + std::to_string(++number);
  return std::async(std::launch::async, [command = deployer(words + Words{"--name", name})] {
    Subprocess program(command);
    std::this_thread::sleep_for(Seconds(3));
    Stopped stopped;
    stopped.ran = program.group_lives();
    program.send(SIGTERM);
    const auto sent = std::chrono::steady_clock::now();
    stopped.run = finish(program, Seconds(10));
    stopped.took = std::chrono::steady_clock::now() - sent;
    stopped.left_behind = program.group_lives();
    return stopped;
  });
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

// Stops at the same time what hangs at each place in each way, and checks the end of all.
void check_all(const std::vector<std::string>& ways,
               const std::function<Words(const Place&, const std::string& way)>& words,
               const std::function<void(const Place&, const Stopped&)>& check) {
  std::vector<std::future<Stopped>> stops;
  for (const Place& place : kPlaces)
    for (const std::string& way : ways) stops.push_back(stop(words(place, way)));
  auto next = stops.begin();
  for (const Place& place : kPlaces)
    for (const std::string& way : ways) {
      const Stopped stopped = (next++)->get();
      CAPTURE(way, place.words);
      INFO(stopped.run.err);
      CHECK(stopped.ran);
      CHECK(stopped.took < Seconds(kEndLimit));
      CHECK_FALSE(stopped.left_behind);
      check(place, stopped);
    }
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
  const std::vector<std::string> ends{"0.1 s", "1000 s"};
  check_all(
      ends,
      [](const Place& place, const std::string& until) {
        return clinger({"where=destructor"}) + Words{"--until", until} + place.words;
      },
      [](const Place& place, const Stopped& stopped) {
        CHECK(stopped.run.exit_code() == 1);
        CHECK(stopped.run.says("error: clinger: its destructor has not ended " + place.when));
        CHECK(stopped.run.says("test_clinger.so"));
      });
}

TEST_CASE(
    "a static destructor or an atexit handler of a plugin that hangs is ended after one signal, and named",
    "[system][signals]") {
  if (kSanitized) return;
  const std::vector<std::string> hooks{"where=static", "where=atexit"};
  check_all(
      hooks,
      [](const Place& place, const std::string& where) {
        return clinger({where}) + Words{"--until", "0.1 s"} + place.words;
      },
      [](const Place& place, const Stopped& stopped) {
        CHECK(stopped.run.exit_code() == 1);
        CHECK(stopped.run.says("test_clinger.so: its static destruction has not ended " + place.when));
      });
}

TEST_CASE("a constructor that hangs before anything has started is ended with 0 after one signal, and named",
          "[system][signals]") {
  if (kSanitized) return;
  const std::vector<std::string> types{"type=LateClinger"};
  check_all(
      types, [](const Place& place, const std::string& type) { return clinger({type}) + place.words; },
      [](const Place& place, const Stopped& stopped) {
        CHECK(stopped.run.exit_code() == 0);
        // It hangs in the trial, too. After the signal no host process is started.
        CHECK(stopped.run.says("clinger: its constructor has not ended") == !place.words.empty());
      });
}
