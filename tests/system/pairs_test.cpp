// SPDX-License-Identifier: GPL-3.0-or-later
// Two robots of one type in one hall, each driven by a shipped graph with its avoider: they see each other and keep
// apart. docs/meetings.md has the figures and says which meetings end otherwise.
#include <catch2/catch.hpp>

#include <cmath>
#include <iostream>

#include "deployer.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

struct Type {
  std::string robot;
  std::string graph;        // That drives it.
  std::string margin = "";  // Of its avoider, where that of the graph is too little.
};

constexpr const char* kSonars = "scout_goto";
constexpr const char* kLaser = "pioneer_laser_goto";
// Its laser sees only the column of another, 6 cm narrower to each side than the body and 16 cm behind its front.
constexpr const char* kPastColumns = "0.15 m";
const std::vector<Type> kTypes{{"nomad_scout", kSonars}, {"nomad_200", kSonars},
                               {"omni", kLaser},         {"pioneer_2dx", kLaser},
                               {"barn_base", kLaser},    {"peoplebot", kLaser, kPastColumns},
                               {"create2", kLaser},      {"courier", "courier_depot"}};

struct Start {
  double x, y;     // [m]
  double heading;  // [deg]
};

// How two robots meet in the middle of the hall.
struct Meeting {
  Start one, other;
  std::string goal_of_one, goal_of_other;
  Start spread;  // Largest difference of the first start from seed to seed.
  bool one_is_slow = false;
};

const Meeting kHeadOn{{2, 4.5, 0}, {12, 4.5, 180}, "goal: 12 4.5", "goal: 2 4.5", {0, 0.3, 0}};
const Meeting kOvertaking{{4, 4.5, 0}, {2, 4.5, 0}, "goal: 12 4.5", "goal: 12 3", {0, 0.3, 0}, true};
// Their ways cross, 2.5 m from the first start and 3.5 m from the other one.
const Meeting kCrossing{{4.5, 4.5, 0}, {7, 1, 90}, "goal: 11.5 4.5", "goal: 7 8", {0.3, 0, 0}};

std::string use_of(const Type& type, const std::string& prefix, const std::string& goal) {
  const auto arg = [](const std::string& name, const std::string& value) {
    return "<arg name=\"" + name + "\" value=\"" + value + "\"/>";
  };
  return "<use graph=\"" + source_file("graphs/" + type.graph + ".xml") + "\" prefix=\"" + prefix + "\">" +
         arg("robot", source_file("sim/robots/" + type.robot + ".urdf")) +
         arg("world", source_file("sim/worlds/hall.xml")) + arg("name", prefix) + arg("place", "") +
         arg("goals", goal) + "</use>\n";
}

std::string graph_of(const Type& type, const Meeting& meeting) {
  return "<graph name=\"pair\" version=\"1\" ends=\"one/command; other/command\" "
         "default_profile=\"sim\">\n" +
         use_of(type, "one", meeting.goal_of_one) + use_of(type, "other", meeting.goal_of_other) +
         "</graph>\n";
}

Words start_words(const std::string& hardware, const Start& start) {
  Words words;
  for (const auto& [name, value] :
       {std::pair("x", std::to_string(start.x) + " m"), std::pair("y", std::to_string(start.y) + " m"),
        std::pair("heading", std::to_string(start.heading) + " deg")})
    words = words + Words{"--set", hardware + "." + name + "=" + value};
  return words;
}

Run meet(const Type& type, const Meeting& meeting, int seed) {
  const TempFolder folder;
  Start one = meeting.one;
  const double share = std::remainder(0.618034 * seed, 1.0);  // Even over -0.5 to 0.5.
  one.x += 2.0 * share * meeting.spread.x;
  one.y += 2.0 * share * meeting.spread.y;
  // Each of these graphs is named after its hardware: scout_goto.
  const std::string device = "/" + type.graph.substr(0, type.graph.find('_'));
  Words words{folder.write("pair.xml", graph_of(type, meeting)), "--seed", std::to_string(seed), "--until",
              "150 s"};
  words = words + start_words("one" + device, one) + start_words("other" + device, meeting.other);
  if (meeting.one_is_slow)
    words = words + Words{"--set", "one/goto.max_speed=0.12", "--set", "one/avoid.max_speed=0.12"};
  if (!type.margin.empty())
    words = words +
            Words{"--set", "one/avoid.margin=" + type.margin, "--set", "other/avoid.margin=" + type.margin};
  return run_deployer(words + virtual_clock(), Seconds(60));
}

// Returns the number of seeds in which the two touched.
int touches(const Type& type, const Meeting& meeting, int seeds) {
  int touched = 0;
  std::size_t arrived = 0;
  for (int seed = 1; seed <= seeds; ++seed) {
    const Run run = meet(type, meeting, seed);
    INFO(run.err);
    REQUIRE(run.trace_hash());  // It ran to its end.
    touched += run.contacts().empty() ? 0 : 1;
    arrived += run.arrivals().size();
  }
  std::cout << type.robot << ": " << touched << " of " << seeds << " seeds with a touch, " << arrived
            << " of " << 2 * seeds << " goals reached\n";
  // A pair that does not move does not touch either. Some pairs meet and stand.
  CHECK(2 * arrived >= static_cast<std::size_t>(seeds));
  return touched;
}

void check_pass(const std::string& name, const Meeting& meeting, int seeds) {
  std::cout << name << '\n';
  for (const Type& type : kTypes) {
    INFO(type.robot);
    CHECK(touches(type, meeting, seeds) == 0);
  }
}

}  // namespace

TEST_CASE("two robots of one type pass each other head-on", "[system][pairs]") {
  check_pass("head-on", kHeadOn, 2);
}

TEST_CASE("a robot overtakes a slow one of its type", "[system][pairs]") {
  check_pass("overtaking", kOvertaking, 1);
}

TEST_CASE("two robots of one type cross, one well before the other", "[system][pairs]") {
  check_pass("crossing", kCrossing, 1);
}

TEST_CASE("the same in twenty seeds", "[.][slow]") {
  check_pass("head-on", kHeadOn, 20);
  check_pass("overtaking", kOvertaking, 20);
  check_pass("crossing", kCrossing, 20);
}

TEST_CASE("two robots whose lasers look over each other touch", "[system][pairs]") {
  // The same Pioneer without the housing of its laser: --check says so, and head-on they do not see each other.
  const TempFolder folder;
  std::string text = read_text(source_file("sim/robots/pioneer_2dx.urdf"));
  const auto begin = text.find("    <collision name=\"housing\">");
  const std::string end = "</collision>\n";
  REQUIRE(begin != std::string::npos);
  text.erase(begin, text.find(end, begin) + end.size() - begin);
  const std::string robot = folder.write("low.urdf", text);
  const std::string shipped = source_file("sim/robots/pioneer_2dx.urdf");
  std::string graph = graph_of({"pioneer_2dx", kLaser}, kHeadOn);
  for (auto at = graph.find(shipped); at != std::string::npos; at = graph.find(shipped))
    graph.replace(at, shipped.size(), robot);
  const Words words = Words{folder.write("low.xml", graph)} + start_words("one/pioneer", kHeadOn.one) +
                      start_words("other/pioneer", kHeadOn.other) + virtual_clock();
  const Run check = run_deployer(words + Words{"--check"}, Seconds(30));
  INFO(check.err);
  CHECK(check.exit_code() == 0);
  CHECK(check.says("warning G057"));
  CHECK(
      check.says("the laser \"laser\" is 0.3 m above the floor, where a \"pioneer_2dx\" has nothing solid"));
  CHECK(run_deployer(words + Words{"--check", "--strict"}, Seconds(30)).exit_code() == 2);
  CHECK(run_deployer(words + Words{"--until", "60 s"}, Seconds(60)).contacts().size() >= 2);
}
