// SPDX-License-Identifier: GPL-3.0-or-later
// Goals by the names of places of the world.
#include <catch2/catch.hpp>
#include <cmath>

#include "deployer.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

const std::string kGraph = source_file("graphs/scout_gallery.xml");

Run drive(const Words& more) { return run_deployer(Words{kGraph} + virtual_clock() + more); }

bool is_near(const Arrival& arrival, double x, double y) {
  return std::hypot(arrival.x - x, arrival.y - y) < 0.3;
}

// Returns the place of the goals in a graph.
std::string goals_line(const std::string& graph) { return line_of(graph, "<param name=\"goals\"") + ":32"; }

// Under ThreadSanitizer there is no trial of configure(), so the place is not known.
void check_refused(const Run& run, const std::string& place, const std::string& why) {
  INFO(run.err);
  CHECK(run.exit_code() == kRefusedByComponent);
  CHECK(run.out.empty());
  if (kRefusedByComponent == 2)
    CHECK(run.says(place + ": error G062: component \"command\": parameter \"goals\": "));
  CHECK(run.says(why));
}

}  // namespace

TEST_CASE("the robot of the shipped gallery drives to the places of its world", "[system][places]") {
  const std::vector<Arrival> arrivals = drive({}).arrivals();
  REQUIRE(arrivals.size() == 3);
  CHECK(arrivals[0].name == "east");
  CHECK(is_near(arrivals[0], 13.0, 4.5));
  CHECK(arrivals[1].name == "north");
  CHECK(is_near(arrivals[1], 7.0, 8.0));
  CHECK(arrivals[2].name == "west");
  CHECK(is_near(arrivals[2], 1.0, 4.5));
}

TEST_CASE("a route by places passes them, in a world of rooms", "[system][places]") {
  const Run run = drive(
      {"--set", "world=" + source_file("sim/worlds/office.xml"), "--set",
       "goals=lunch: kitchen_hall > kitchen_door > 4.2 9.8; kitchen_door > kitchen_hall > corridor_east"});
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 2);
  CHECK(run.arrivals()[0].name == "lunch");
  CHECK(run.arrivals()[1].name == "corridor_east");
  CHECK(is_near(run.arrivals()[1], 17.0, 6.0));
}

TEST_CASE("a robot without a map knows from where it starts", "[system][places]") {
  const Run run = run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--profile", "sim",
                                     "--profile", "odometry", "--set", "realism=ideal", "--set",
                                     "goals=kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8"} +
                               virtual_clock());
  INFO(run.out << run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 1);
  CHECK(is_near(run.arrivals()[0], 4.2, 9.8));
}

TEST_CASE("a robot that says it has arrived where it is not is contradicted, in simulation",
          "[system][places]") {
  const Words blind{source_file("graphs/pioneer_laser_goto.xml"),
                    "--profile",
                    "sim",
                    "--profile",
                    "odometry",
                    "--set",
                    "command.reach_radius=0.4 m"};
  const Run wrong =
      run_deployer(blind +
                   Words{"--set", "localizer.start_place=", "--set", "localizer.start_x=0.5 m", "--set",
                         "localizer.start_y=6 m", "--set", "goals=kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8"} +
                   virtual_clock());
  INFO(wrong.out << wrong.err);
  REQUIRE(wrong.arrivals().size() == 1);
  // It begins 0.5 m off.
  const std::string said = "goto: says that it has arrived at \"kitchen\", and truly the robot is ";
  CHECK((wrong.says(said + "0.4") || wrong.says(said + "0.5")));
  const Run right =
      run_deployer(blind + Words{"--set", "goals=kitchen: 3.6 6 > 3.6 7.6 > 4.2 9.8"} + virtual_clock());
  CHECK(right.arrivals().size() == 1);
  CHECK_FALSE(right.says("truly the robot is"));
}

TEST_CASE("a start that is no place of the world is refused", "[system][places]") {
  const Run run = run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--profile", "sim",
                                     "--profile", "odometry", "--set", "localizer.start_place=harbour"} +
                               virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == kRefusedByComponent);
  CHECK(run.says("\"harbour\""));
  CHECK(run.says("start_place"));
}

TEST_CASE("the robot drives to the place of a drawn world", "[system][places]") {
  for (const char* seed : {"1", "3"}) {
    const Run run =
        drive({"--set", "world=" + source_file("sim/worlds/barn_like.xml#") + seed, "--set", "goals=goal"});
    INFO(run.err);
    REQUIRE(run.arrivals().size() == 1);
    CHECK(run.arrivals()[0].name == "goal");
    CHECK(is_near(run.arrivals()[0], -2.25, 13.0));
  }
}

TEST_CASE("an unknown place is refused before anything starts, with the nearest one", "[system][places]") {
  check_refused(drive({"--set", "goals=east; nroth"}), "scout_gallery.xml:" + goals_line(kGraph),
                "\"nroth\" is no place of ");
  CHECK(drive({"--set", "goals=east; nroth"})
            .says("places: start, east, north, west; did you mean \"north\"?"));
}

TEST_CASE("a place can be named at the prompt, and a wrong one is asked for again", "[system][places]") {
  Subprocess program(deployer(Words{kGraph, "--set", "goals="} + virtual_clock()),
                     {.input = "nroth\nnorth\n\n"});
  const Run run = finish(program, Seconds(30));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("\"nroth\" is no place of "));
  REQUIRE(run.arrivals().size() == 1);
  CHECK(is_near(run.arrivals()[0], 7.0, 8.0));
}

TEST_CASE("a place by name where nobody knows places is refused with what to do", "[system][places]") {
  const std::string graph = source_file("graphs/scout_goto.xml");
  const Run run = run_deployer(Words{graph, "--set", "goals=kitchen"} + virtual_clock());
  check_refused(run, "scout_goto.xml:" + goals_line(graph),
                "connect the port \"places\" to a PlaceServer, or give coordinates");
}

TEST_CASE("a Command that is up before the one who knows the places asks it on the way", "[system][places]") {
  std::string text = ShippedGraph("scout_gallery").text();
  const auto replace = [&](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("start_after=\"fuser places\"", "start_after=\"fuser\"");
  replace("type=\"orca.PlaceServer\"", "type=\"orca.PlaceServer\" start_after=\"command\"");
  const TempFolder folder;
  const Run run = run_deployer(Words{folder.write("graph.xml", text)} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 3);
}

TEST_CASE("a PlaceServer without a world that can be read is refused", "[system][places]") {
  const std::string graph = kGraph;
  for (const char* world : {"", "no_such.xml"}) {
    const Run run = run_deployer(Words{graph, "--check", "--set", std::string("places.world=") + world});
    CAPTURE(world);
    INFO(run.err);
    if (kRefusedByComponent == 2)
      CHECK(run.says("command line: error G062: component \"places\": parameter \"world\": "));
  }
}
