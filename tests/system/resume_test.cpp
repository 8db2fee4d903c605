// SPDX-License-Identifier: GPL-3.0-or-later
// Host processes that are killed on the way to a goal, seen from outside.
#include <signal.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <regex>
#include <string>
#include <thread>

#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

// Returns whether a process has loaded a plugin.
bool holds(pid_t process, const std::string& plugin) {
  std::ifstream maps("/proc/" + std::to_string(process) + "/maps");
  const std::string text{std::istreambuf_iterator<char>(maps), {}};
  return text.find("/" + plugin + ".so") != std::string::npos;
}

// Returns the child process of `parent` that has loaded a plugin.
std::optional<pid_t> find_child(pid_t parent, const std::string& plugin) {
  for (const auto& entry : std::filesystem::directory_iterator("/proc")) {
    std::ifstream file(entry.path() / "stat");
    pid_t pid = 0;
    std::string name;
    char state = 0;
    pid_t its_parent = 0;
    if (file >> pid >> name >> state >> its_parent && its_parent == parent && holds(pid, plugin)) return pid;
  }
  return std::nullopt;
}

// Drives to `goal` in real time, and kills the process of the behaviours twice: 5 s after the start of the program, and 3 s later.
Run drive_and_kill(const std::string& goal) {
  Subprocess program(
      deployer({source_file("graphs/scout_goto_processes.xml"), "--until", "60s", "--set", "goals=" + goal}));
  std::this_thread::sleep_for(Seconds(5));
  for (int i = 0; i < 2; ++i) {
    const std::optional<pid_t> behaviours = find_child(program.pid(), "goto");
    REQUIRE(behaviours);
    REQUIRE(kill(*behaviours, SIGKILL) == 0);
    std::this_thread::sleep_for(Seconds(3));
  }
  return finish(program, Seconds(90));
}

// Drives to two goals, kills the process of Command a second after the first arrival, and returns the whole run.
// @param restore  what the graph says of Command.
Run drive_and_kill_command(const std::string& restore) {
  std::string graph = read_text(source_file("graphs/scout_goto_processes.xml"));
  const auto replace = [&](const std::string& from, const std::string& to) {
    REQUIRE(graph.find(from) != std::string::npos);
    for (std::size_t at = 0; (at = graph.find(from, at)) != std::string::npos; at += to.size())
      graph.replace(at, from.size(), to);
  };
  replace("\"../sim/", "\"" + source_file("sim/"));
  replace("restore=\"last\"", "restore=\"" + restore + "\"");
  const TempFolder folder;
  Subprocess program(deployer(
      {folder.write("graph.xml", graph), "--until", "60s", "--set", "goals=near: 2 6; door: 3.6 6"}));
  REQUIRE(program.wait_for_output("arrived near", Seconds(30)));
  std::this_thread::sleep_for(Seconds(1));
  const std::optional<pid_t> command = find_child(program.pid(), "command");
  REQUIRE(command);
  REQUIRE(kill(*command, SIGKILL) == 0);
  return finish(program, Seconds(90));
}

// The shipped graph of a robot with an emulated base, localized as the real one is.
std::string emulated_by_odometry(const TempFolder& folder, const std::string& name) {
  std::string graph = read_text(source_file("graphs/" + name + ".xml"));
  graph = std::regex_replace(graph, std::regex("\\.\\./sim/"), source_file("sim/"));
  std::smatch real;
  REQUIRE(std::regex_search(
      graph, real, std::regex("<component name=\"localizer\" type=\"orca.OdometryLocalizer\"[^>]*/>")));
  const std::string by_odometry =
      real.str() + "<connect from=\"base.OdometryPush\" to=\"localizer.odometry\"/>";
  return folder.write(
      name + ".xml",
      std::regex_replace(graph,
                         std::regex("<component name=\"localizer\" type=\"orca.TruthLocalizer\"[^>]*/>"),
                         by_odometry));
}

}  // namespace

TEST_CASE(
    "a shipped robot that knows by its odometry where it is says that it is lost after its process was, and "
    "drives nowhere",
    "[system][resume]") {
  const TempFolder folder;
  Subprocess program(deployer({emulated_by_odometry(folder, "nomad_scout"), "--profile", "emulate", "--set",
                               "goals=ahead: 9 0; back: 0 0", "--until", "40s"}));
  std::this_thread::sleep_for(Seconds(3));
  const std::optional<pid_t> process = find_child(program.pid(), "odometry_localizer");
  REQUIRE(process);
  REQUIRE(kill(*process, SIGKILL) == 0);
  const Run run = finish(program, Seconds(90));
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 1);
  CHECK(run.arrivals().empty());
  CHECK(run.says("localizer: it is not known any more where the robot is: \"base\" has begun anew"));
  REQUIRE(run.failures().size() == 2);
  CHECK(run.failures()[0] == "failed ahead lost: it is not known any more where the robot is");
  CHECK(run.failures()[1] == "failed back lost: it is not known any more where the robot is");
}

TEST_CASE(
    "in each shipped graph a localizer in the process of its base keeps in mind which odometry it has heard",
    "[system][resume]") {
  int localizers = 0;
  for (const auto& entry : std::filesystem::directory_iterator(source_file("graphs"))) {
    if (entry.path().extension() != ".xml") continue;
    const std::string graph = read_text(entry.path().string());
    const std::regex element("<component [^>]*\"orca.OdometryLocalizer\"[^>]*>");
    for (std::sregex_iterator found(graph.begin(), graph.end(), element), end; found != end; ++found) {
      const std::string text = found->str();
      CAPTURE(entry.path().string(), text);
      if (text.find("process=") != std::string::npos) continue;
      CHECK(text.find("restore=\"last\"") != std::string::npos);
      ++localizers;
    }
  }
  CHECK(localizers >= 7);
}

TEST_CASE("with restore=last a Command that is killed goes on with the goal that it drove to",
          "[system][resume]") {
  const Run run = drive_and_kill_command("last");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"near", "door"});
  CHECK(run.says("goes on from the state orca.Command/3"));
}

TEST_CASE("without restore a Command that is killed begins its list again", "[system][resume]") {
  const Run run = drive_and_kill_command("none");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.goals() == Words{"near", "near", "door"});
  CHECK_FALSE(run.says("goes on from the state"));
}

TEST_CASE("a robot whose behaviours are killed on the way reaches its goal all the same",
          "[system][resume]") {
  const Run run = drive_and_kill("kitchen: 1.5 6 > 3.6 6 > 3.6 7.6 > 4.2 9.8");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
  CHECK(run.failures().empty());
  REQUIRE(run.arrivals().size() == 1);
  CHECK(run.arrivals()[0].name == "kitchen");
  CHECK(std::hypot(run.arrivals()[0].x - 4.2, run.arrivals()[0].y - 9.8) < 0.25);
  CHECK(run.says("of 4 points are left"));
  CHECK_FALSE(run.says("4 of 4 points are left"));  // it passed the first one long before
}
