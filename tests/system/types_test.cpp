// SPDX-License-Identifier: GPL-3.0-or-later
// Which types there are, and what one of them looks like, without knowing the plugin files.
#include <catch2/catch.hpp>

#include <set>

#include "deployer.hpp"

using namespace orca::test;

namespace {

const Words kTestPlugins{"--plugins", ORCA_BINARY_DIR "/tests/plugins"};

Run good(const Words& words) {
  const Run run = run_deployer(words);
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.err.empty());
  return run;
}

bool has(const Run& run, const std::string& text) { return run.out.find(text) != std::string::npos; }

}  // namespace

TEST_CASE("--types lists the types of all plugins that a graph can name, with kind and file",
          "[system][types]") {
  const Run run = good({"--types"});
  const std::vector<std::string> lines = run.lines();
  const std::set<std::string> all(lines.begin(), lines.end());
  CHECK(lines.size() == 55);
  CHECK(all.size() == lines.size());
  CHECK(has(run, "orca.Goto                component  " ORCA_BINARY_DIR
                 "/plugins/goto.so  A behaviour that drives to a goal "
                 "in a straight line (thesis 11.1).\n"));
  CHECK(has(run, "orca.hw.Sim              hardware   " ORCA_BINARY_DIR "/plugins/sim.so  "));
  for (const std::string& line : lines) CHECK(line.ends_with("."));
  CHECK_FALSE(has(run, "orca.Avoid "));
}

TEST_CASE("--plugins adds a folder, whose types are listed, described and run", "[system][types]") {
  CHECK(has(good(Words{"--types"} + kTestPlugins), "orca.Avoid "));
  CHECK(has(good(Words{"--describe", "orca.Avoid"} + kTestPlugins), "stop_distance = 0.5 m"));
  const Words refused{
      system_graph("one_component.xml"), "--check", "--set", "type=orca.Avoid", "--set", "plugins="};
  CHECK(run_deployer(refused).says("no plugin holds the type \"orca.Avoid\""));
  CHECK_FALSE(run_deployer(refused + kTestPlugins).says("no plugin holds the type"));
}

TEST_CASE("--types and --describe TYPE write JSON for programs", "[system][types]") {
  const Run list = good({"--types", "--json"});
  CHECK(list.out.starts_with("["));
  CHECK(has(list, "\"type\": \"orca.Goto\""));
  CHECK(has(list, "\"kind\": \"hardware\""));
  CHECK(has(list, "\"file\": \"" ORCA_BINARY_DIR "/plugins/goto.so\""));
  CHECK(has(list, "\"text\": \"A behaviour that drives to a goal"));
  CHECK(has(good({"--describe", "orca.Goto", "--json"}), "\"type\": \"orca.Goto\""));
}

TEST_CASE("a type is described like its plugin", "[system][types]") {
  CHECK(good({"--describe", "orca.Goto"}).out ==
        good({"--describe", ORCA_BINARY_DIR "/plugins/goto.so"}).out);
}

TEST_CASE("of a plugin with several types, only the one that is asked for is constructed and described",
          "[system][types]") {
  const std::string file = ORCA_BINARY_DIR "/tests/plugins/test_components.so";
  CHECK(run_deployer({"--describe", file}).says("test.ThrowsInConstructor cannot be described"));
  const Run one = good(Words{"--describe", "test.CommandSink"} + kTestPlugins);
  CHECK(has(one, "test.CommandSink  (component"));
  CHECK_FALSE(has(one, "test.LapCounter"));
}

TEST_CASE("a type that no plugin holds is refused with the nearest one and the folders", "[system][types]") {
  for (const char* type : {"orca.Gotto", "goto"}) {
    const Run run = run_deployer({"--describe", type});
    CAPTURE(type);
    INFO(run.err);
    CHECK(run.exit_code() == 2);
    CHECK(run.out.empty());
    CHECK(run.says(std::string("no plugin holds the type \"") + type + "\""));
    CHECK(run.says(ORCA_BINARY_DIR "/plugins"));
    CHECK(run.says("did you mean \"orca.Goto\"?"));
  }
}

TEST_CASE("a folder for --plugins that is not there is a wrong option", "[system][types]") {
  const Run run = run_deployer({"--types", "--plugins", "no/such/folder"});
  CHECK(run.exit_code() == 2);
  CHECK(run.says("command line: error C002: --plugins expects a folder that exists, not \"no/such/folder\""));
}
