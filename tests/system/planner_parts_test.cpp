// SPDX-License-Identifier: GPL-3.0-or-later
// The planner in its parts: WorldModel, PathPlanner and Pilot, as the graph that ships with them connects them.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr const char* kHall = R"(<room name="hall" from="0 0" to="10 8"/>
  <place name="start" x="1" y="4" yaw="0"/>)";
constexpr const char* kWall = R"(<box name="shelf" x="5" y="3.5" yaw="0" length="0.3" width="5"/>)";

std::string world(const std::string& name, const std::string& content) {
  return "<world name=\"" + name + "\" version=\"1\">\n  " + content + "\n</world>";
}

Run drive(const Words& more, const char* until = "150 s") {
  return run_deployer(Words{source_file("graphs/pioneer_planner_parts.xml"), "--until", until} +
                      virtual_clock() + more);
}

// Returns the values of a column of a recording.
std::vector<double> column(const std::string& file, const std::string& name) {
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::istringstream head(line);
  std::size_t at = 0;
  for (std::string word; std::getline(head, word, ',') && word.find(name) == std::string::npos;) ++at;
  std::vector<double> values;
  while (std::getline(in, line)) {
    std::istringstream words(line);
    std::string word;
    for (std::size_t i = 0; i <= at; ++i) std::getline(words, word, ',');
    if (!word.empty()) values.push_back(std::stod(word));
  }
  return values;
}

// Returns when the last goal was reached.
double end_of(const Run& run) {
  REQUIRE_FALSE(run.arrivals().empty());
  return run.arrivals().back().t;
}

}  // namespace

TEST_CASE("the parts drive a Pioneer to three goals of the office by its map, and touch nothing",
          "[system][planner][parts]") {
  for (const char* realism : {"nominal", "harsh"})
    for (int seed = 1; seed <= part_of(20); ++seed) {
      const Run run = drive({"--seed", std::to_string(seed), "--set", std::string("realism=") + realism});
      INFO(realism << ", seed " << seed << "\n" << run.out << run.err);
      CHECK(run.exit_code() == 0);
      CHECK(run.arrivals().size() == 3);
      CHECK(run.contacts().empty());
    }
}

TEST_CASE("a robot that steers reaches the goals in the directions asked for, and never turns on the spot",
          "[system][planner][parts]") {
  const TempFolder folder;
  for (int seed = 1; seed <= part_of(20); ++seed) {
    const std::string csv = folder.path() / "odometry.csv";
    const Run run = drive({"--seed", std::to_string(seed), "--set", "turning_radius=0.5 m", "--set",
                           "goals=kitchen: 4.2 9.8 @ 90; office_2: 9 2 @ 180; meeting: 13 10.4", "--record",
                           csv + "=fuser.base"});
    INFO("seed " << seed << "\n" << run.out << run.err);
    CHECK(run.arrivals().size() == 3);
    CHECK(run.contacts().empty());
    const std::vector<double> speeds = column(csv, "speed");
    const std::vector<double> rates = column(csv, "turn_rate");
    REQUIRE(speeds.size() == rates.size());
    REQUIRE(speeds.size() > 100);
    int tight = 0;
    for (std::size_t i = 0; i < speeds.size(); ++i)
      tight += std::fabs(rates[i]) * 0.5 > std::fabs(speeds[i]) + 1e-6 ? 1 : 0;
    CHECK(tight == 0);
  }
}

TEST_CASE(
    "what stands where the map knows nothing is driven around, and what the map has in vain counts no more",
    "[system][planner][parts]") {
  const TempFolder folder;
  const std::string empty = folder.write("empty.xml", world("hall", kHall));
  const std::string shelf = folder.write("shelf.xml", world("hall", std::string(kHall) + kWall));
  for (const auto& [is, drawn] : {std::pair{shelf, empty}, std::pair{empty, shelf}}) {
    const Run run = drive({"--set", "world=" + is, "--set", "map=" + drawn, "--set", "goals=east: 9 3"});
    INFO(is << " drawn as " << drawn << "\n" << run.out << run.err);
    CHECK(run.arrivals().size() == 1);
    CHECK(run.contacts().empty());
  }
}

TEST_CASE("a layer makes robots drive slowly before the kitchen, and they still arrive",
          "[system][planner][parts]") {
  const TempFolder folder;
  const std::string csv = folder.path() / "pose.csv";
  const Words to_kitchen{"--set", "goals=kitchen: 4.2 9.8"};
  const auto fastest_before_kitchen = [&](const Words& more, std::size_t goals) {
    const Run run = drive(more + Words{"--record", csv + "=localizer.RobotPosePush"});
    INFO(run.out << run.err);
    CHECK(run.arrivals().size() == goals);
    CHECK(run.contacts().empty());
    const std::vector<double> x = column(csv, "x"), y = column(csv, "y");
    const std::vector<double> speed = column(csv, "translational_velocity");
    double most = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i)
      if (x[i] > 2.7 && x[i] < 4.5 && y[i] > 5.2 && y[i] < 6.8) most = std::max(most, speed[i]);
    return most;
  };
  const Words layer{"--set", "layer=" + source_file("sim/layers/office.xml")};
  CHECK(fastest_before_kitchen(to_kitchen, 1) > 0.4);
  CHECK(fastest_before_kitchen(layer, 3) < 0.35);
  CHECK(fastest_before_kitchen(to_kitchen + layer + Words{"--set", "turning_radius=0.5 m"}, 1) < 0.35);
}

TEST_CASE("each part is exchanged while the robot drives, and it drives on by the whole map",
          "[system][planner][parts][quiet]") {
  const TempFolder folder;
  std::filesystem::create_directory(folder.file("next"));
  const std::string csv = folder.file("odometry.csv");
  const std::string hall = folder.write("long.xml", world("long", R"(<room name="hall" from="0 0" to="30 6"/>
  <place name="start" x="1" y="3" yaw="0"/>)"));
  Subprocess program(
      deployer({source_file("graphs/pioneer_planner_parts.xml"), "--until", "11 s", "--set", "world=" + hall,
                "--set", "goals=east: 28 3", "--record", csv + "=fuser.base"}));
  std::this_thread::sleep_for(std::chrono::seconds(3));
  for (const auto& [name, plugin] :
       {std::pair{"world_model", "world_model.so"}, std::pair{"planner", "path_planner.so"},
        std::pair{"pilot", "pilot.so"}}) {
    copy_plugin(std::string(ORCA_BINARY_DIR "/plugins/") + plugin, folder.file("next"));
    const Run swapped = run_orcactl({"swap", name, folder.file("next") + "/" + plugin, "--untried",
                                     "--tryout", "500 ms", "--probation", "500 ms"});
    INFO(swapped.out << swapped.err);
    CHECK(swapped.exit_code() == 0);
  }
  const Run saved = run_orcactl({"map", "save", folder.file("seen"), "world_model.OccupancyGridQuery"});
  INFO(saved.out << saved.err);
  CHECK_THAT(saved.err, Catch::Contains("602 x 122 cells"));
  // Farther away than the part around the robot reaches.
  const Run far = run_orcactl({"query", "planner.PathQuery",
                               "<GoalPoint name=\"corner\"><coordinate x=\"29\" y=\"1\"/></GoalPoint>"});
  INFO(far.out << far.err);
  CHECK(far.exit_code() == 0);
  const Run run = finish(program, Seconds(30));
  INFO(run.out << run.err);
  const std::vector<double> speeds = column(csv, "speed");
  REQUIRE(speeds.size() > 100);
  const auto moving = std::ranges::find_if(speeds, [](double speed) { return speed > 0.4; });
  CHECK(speeds.end() - moving > 80);
  // At the end of the run it stops.
  CHECK(std::all_of(moving, speeds.end() - 1, [](double speed) { return speed > 0.1; }));
}

TEST_CASE("a robot gets out where nothing leads on, and without its recoveries stays in a dead end",
          "[system][planner][parts][ablation]") {
  const auto drive_out = [](const std::string& kind, int place, const Words& more) {
    const std::string number = "_" + std::to_string(place);
    const std::string nose = kind == "dead_end" ? "nose" + number + "; " : "";
    return run_deployer(Words{source_file("sim/experiments/to_goal/parts.xml"), "--until", "30 s", "--set",
                              "world=" + source_file("sim/experiments/stuck/" + kind + ".xml"), "--set",
                              "place=start" + number, "--set", "goals=" + nose + "goal" + number} +
                        virtual_clock() + more);
  };
  for (const std::string kind : {"dead_end", "ghost", "too_near", "stander"})
    for (int place = 1; place <= part_of(10); ++place) {
      const Run run = drive_out(kind, place, {});
      INFO(kind << " " << place << "\n" << run.out << run.err);
      CHECK(run.arrivals().size() == (kind == "dead_end" ? 2 : 1));
      CHECK(run.contacts().empty());
      if (kind != "dead_end") continue;
      const Run stands = drive_out(kind, place, {"--set", "pilot.recoveries="});
      CHECK(stands.arrivals().size() < 2);
      CHECK_FALSE(stands.says("alarm RECOVERS"));
    }
}

TEST_CASE(
    "a step that only bumpers feel is remembered, and driven around; without them the goal is not reached",
    "[system][planner][parts][ablation]") {
  const TempFolder folder;
  const std::string hall = R"(<room name="hall" from="0 0" to="7 5"/>
  <box name="step" x="3.5" y="2.5" length="0.2" width="1.6" height="0.1"/>
  <place name="start" x="1.2" y="2.4"/>)";
  const std::string feels = folder.write("feels.xml", world("feels", hall));
  const std::string numb =
      folder.write("numb.xml", world("numb", hall + R"(<outage robot="Dewey" sensor="bumper" at="0 s"/>)"));
  int blocked = 0;
  for (int seed = 1; seed <= part_of(3); ++seed) {
    const Words behind{"--seed", std::to_string(seed), "--set", "goals=behind: 5.6 2.5", "--set"};
    const Run with_bumpers = drive(behind + Words{"world=" + feels});
    const Run without = drive(behind + Words{"world=" + numb});
    INFO(seed << with_bumpers.out << without.out << without.err);
    CHECK(with_bumpers.arrivals().size() == 1);
    CHECK(with_bumpers.contacts().size() <= 4);
    CHECK(with_bumpers.says("alarm BUMPER_TOUCHED: its bumper"));
    CHECK(with_bumpers.says("alarm BUMPER_TOUCHED is over"));
    CHECK(without.says("alarm MOTOR_STALLED: its motors are stalled"));
    CHECK(without.arrivals().empty());
    CHECK(without.contacts().size() > with_bumpers.contacts().size());
    blocked += without.says("alarm BLOCKED: \"behind\" was not reached") ? 1 : 0;
  }
  if (is_slow_run()) CHECK(blocked > 0);  // The others have not given up by then.
}

TEST_CASE("without one of the parts the robot stays where it is", "[system][planner][parts][ablation]") {
  for (const char* part : {"command", "world_model", "planner", "pilot", "fuser", "base"}) {
    const Run run = drive({"--fail", std::string(part) + "=silent@0s"}, "40 s");
    INFO(part << "\n" << run.out << run.err);
    CHECK(run.arrivals().empty());
  }
}

TEST_CASE("without the map the robot drives into a dead end, and sonars alone do not see far",
          "[system][planner][parts][ablation]") {
  const TempFolder folder;
  const std::string lane = folder.write("lane.xml", world("lane", R"(<room name="hall" from="0 0" to="20 8"/>
  <place name="start" x="2" y="4" yaw="0"/>
  <box name="south" x="10" y="3" yaw="0" length="12" width="0.1"/>
  <box name="north" x="10" y="5" yaw="0" length="12" width="0.1"/>
  <box name="end" x="16" y="4" yaw="0" length="0.1" width="2"/>)"));
  const Words behind{"--set", "world=" + lane, "--set", "goals=behind: 18 4"};
  const Run whole = drive(behind);
  const Run without_map = drive(behind + Words{"--fail", "map=silent@0s"}, "80 s");
  INFO(whole.out << without_map.out << without_map.err);
  CHECK(end_of(whole) < 40.0);
  CHECK(without_map.arrivals().empty());

  double lost = 0.0;  // [s]
  for (const char* seed : {"1", "2"})
    lost += end_of(drive({"--seed", seed, "--fail", "laser=throw@0s"})) - end_of(drive({"--seed", seed}));
  CHECK(lost > 2 * 2.0);  // 1 to 10 s each in six seeds, 5 s on the mean
}
