// SPDX-License-Identifier: GPL-3.0-or-later
// The example component: a few lines of code, compiled by one line of CMake, work in a graph.
#include <algorithm>
#include <catch2/catch.hpp>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

Run with_echo_at(const std::string& range) {
  return run_deployer(Words{system_graph("avoid.xml"), "--set", "range=" + range} + with_test_plugins() +
                      virtual_clock());
}

Run towards_the_wall(const Words& more = {}) {
  return run_deployer(Words{system_graph("avoid_wall.xml"), "--until", "30 s"} + with_test_plugins() +
                      virtual_clock() + more);
}

bool is_code(const std::string& line) {
  const auto first = line.find_first_not_of(' ');
  return first != std::string::npos && line.compare(first, 2, "//") != 0;
}

}  // namespace

TEST_CASE("the example component is a file of at most 25 lines of code", "[system][avoid]") {
  const auto lines = split_lines(read_text(source_file("templates/component/@NAME@.cpp")));
  CHECK(std::ranges::count_if(lines, is_code) <= 25);
  CHECK(std::ranges::count(lines, std::string("ORCA_COMPONENT(@CLASS@, \"@TYPE@\")")) == 1);
}

TEST_CASE("the example component commands a full stop while an echo is nearer than its parameter says",
          "[system][avoid]") {
  const Run run = with_echo_at("0.59 m");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("sink: got a full stop"));
  CHECK_FALSE(run.says("got no opinion"));
}

TEST_CASE("the example component has no opinion while nothing is near", "[system][avoid]") {
  const Run run = with_echo_at("61 cm");
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("sink: got no opinion"));
  CHECK_FALSE(run.says("got a full stop"));
}

TEST_CASE("--describe lists the ports and the parameter of the example component", "[system][avoid]") {
  const Run run = run_deployer({"--describe", ORCA_BINARY_DIR "/tests/plugins/avoid.so"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  for (const char* said :
       {"orca.Avoid", "ranges", "RangeReadings", "motion", "MotionCommand", "stop_distance = 0.5 m"}) {
    CAPTURE(said);
    CHECK(run.out.find(said) != std::string::npos);
  }
}

TEST_CASE("the example component keeps the Scout from driving into a wall", "[system][avoid]") {
  const Run run = towards_the_wall();
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.contacts().empty());
  CHECK(run.arrivals().empty());
}

TEST_CASE("the example component keeps a Pioneer from driving into a wall by its laser",
          "[system][avoid][subtype]") {
  const Words laser{"--set", "robot=pioneer_2dx", "--profile", "laser"};
  CHECK(towards_the_wall(laser).contacts().empty());
  CHECK_FALSE(towards_the_wall(laser + Words{"--set", "behaviours=goto"}).contacts().empty());
}

TEST_CASE("when nobody listens to the example component, the Scout drives into the wall and says so",
          "[system][avoid]") {
  const Run run = towards_the_wall({"--set", "behaviours=goto"});
  INFO(run.err);
  REQUIRE_FALSE(run.contacts().empty());
  CHECK(run.contacts().front().starts_with("contact Dewey "));
}
