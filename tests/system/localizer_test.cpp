// SPDX-License-Identifier: GPL-3.0-or-later
// A robot with a map finds where it is, drives by that, and says so when it does not know.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <numbers>
#include <optional>
#include <random>
#include <sstream>

#include "deployer.hpp"
#include "hosted_system.hpp"
#include "slow_run.hpp"
#include "temp_folder.hpp"

using namespace orca::test;

namespace {

constexpr double kAnywhere = 1e9;  // [m2]

struct Stamped {
  double stamp = 0.0;
  double x = 0.0, y = 0.0, yaw = 0.0;
  double variance = 0.0;  // of x
  int seq = 0;
};

// The poses of a port that a run has written.
std::vector<Stamped> poses_of(const std::string& csv, const std::string& port) {
  std::vector<Stamped> poses;
  for (const std::string& line : split_lines(csv)) {
    std::vector<std::string> words;
    std::istringstream in(line);
    for (std::string word; std::getline(in, word, ',');) words.push_back(word);
    if (words.size() < 17 || words[1] != port) continue;
    poses.push_back({std::stod(words[0]), std::stod(words[10]), std::stod(words[11]), std::stod(words[12]),
                     std::stod(words[16]), std::stoi(words[5])});
  }
  return poses;
}

bool is_known(const Stamped& pose) { return pose.variance < kAnywhere; }

/// How far poses were off the truth of the same instants.
struct Errors {
  std::vector<double> place;  // [m], from the least on
  std::size_t unknown = 0;
  std::vector<std::pair<double, double>> at;  // [s], [m]

  [[nodiscard]] double share(double part) const {
    REQUIRE_FALSE(place.empty());
    return place[static_cast<std::size_t>(part * static_cast<double>(place.size() - 1))];
  }
};

Errors errors_of(const std::string& csv) {
  std::map<long, Stamped> truth;
  for (const Stamped& pose : poses_of(csv, "truth.RobotPosePush"))
    truth[std::lround(1e4 * pose.stamp)] = pose;
  Errors errors;
  for (const Stamped& pose : poses_of(csv, "localizer.RobotPosePush")) {
    const auto right = truth.find(std::lround(1e4 * pose.stamp));
    if (!is_known(pose)) ++errors.unknown;
    if (right == truth.end() || !is_known(pose)) continue;
    errors.place.push_back(std::hypot(pose.x - right->second.x, pose.y - right->second.y));
    errors.at.emplace_back(pose.stamp, errors.place.back());
  }
  std::ranges::sort(errors.place);
  return errors;
}

const std::map<std::string, std::pair<double, double>> kGoals{
    {"kitchen", {4.2, 9.8}}, {"office_2", {9.0, 2.0}}, {"meeting", {13.0, 10.4}}};

/// Runs of a graph in a folder of their own.
struct Drives {
  TempFolder folder;

  struct Drive {
    Run run;
    std::string csv;
  };

  Drive drive(const std::string& graph, const Words& more) const {
    const std::string csv = folder.file("poses.csv");
    std::filesystem::remove(csv);
    Drive drive;
    drive.run =
        run_deployer(Words{source_file("graphs/" + graph + ".xml"), "--profile", "sim", "--profile", "truth",
                           "--record", csv + "=localizer.RobotPosePush,truth.RobotPosePush"} +
                         virtual_clock() + more,
                     Seconds(120));
    drive.csv = read_text(csv);
    return drive;
  }

  // Returns an office in which more happens.
  [[nodiscard]] std::string office_with(const std::string& events) const {
    std::string text = read_text(source_file("sim/worlds/office.xml"));
    text.insert(text.rfind("</world>"), events);
    return folder.write("office_with.xml", text);
  }
};

int right_arrivals(const Run& run) {
  int right = 0;
  for (const Arrival& arrival : run.arrivals()) {
    const auto [x, y] = kGoals.at(arrival.name);
    right += std::hypot(arrival.x - x, arrival.y - y) < 0.5 ? 1 : 0;
  }
  return right;
}

const int kSeeds = is_slow_run() ? 4 : 1;  // of each level of realism
const Words kOfficeMap{"--set", "map=" + source_file("sim/worlds/office.xml")};

}  // namespace

TEST_CASE("a robot with a laser finds where it is, and knows it to some centimetres", "[system][localizer]") {
  const Drives drives;
  struct Level {
    const char* realism;
    double median, most;  // [m]
  };
  for (const auto& [realism, median, most] : {Level{"nominal", 0.02, 0.05}, {"harsh", 0.03, 0.08}})
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const auto [run, csv] = drives.drive(
          "pioneer_localize", {"--set", std::string("realism=") + realism, "--seed", std::to_string(seed)});
      INFO(realism << ' ' << seed << '\n' << run.err);
      CHECK(right_arrivals(run) == 3);
      CHECK(run.contacts().empty());
      const Errors errors = errors_of(csv);
      CHECK(errors.share(0.5) <= median);
      CHECK(errors.share(0.95) <= most);
      CHECK(errors.unknown <= 20);  // the first second
    }
}

TEST_CASE("a robot with sonars alone keeps where it is once that is said", "[system][localizer]") {
  const Drives drives;
  for (const char* const realism : {"nominal", "harsh"})
    for (int seed = 1; seed <= kSeeds; ++seed) {
      const auto [run, csv] = drives.drive(
          "scout_localize", {"--set", std::string("realism=") + realism, "--seed", std::to_string(seed)});
      INFO(realism << ' ' << seed << '\n' << run.err);
      CHECK(right_arrivals(run) == 3);
      const Errors errors = errors_of(csv);
      CHECK(errors.share(0.5) <= 0.03);
      CHECK(errors.share(0.95) <= 0.08);
      CHECK(errors.unknown == 0);
    }
}

TEST_CASE("a robot in another building than its map's looks around for some time, and then stands",
          "[system][localizer]") {
  const Drives drives;
  for (const char* const map : {"warehouse", "hall", "gallery"}) {
    if (!is_slow_run() && map != std::string("warehouse")) continue;
    const auto [run, csv] = drives.drive(
        "pioneer_localize", {"--until", "140 s", "--set",
                             std::string("map=") + source_file(std::string("sim/worlds/") + map + ".xml")});
    INFO(map << '\n' << run.err);
    CHECK(run.arrivals().empty());
    CHECK(run.contacts().empty());
    // A view that happens to fit is believed for some seconds.
    const Errors errors = errors_of(csv);
    CHECK(errors.place.size() <= errors.unknown / 9);
    CHECK(run.says("look_around: the robot has looked around for 90 s and does not know where it is"));
    const auto truth = poses_of(csv, "truth.RobotPosePush");
    const Stamped& late = truth[truth.size() * 9 / 10];
    CHECK(std::hypot(truth.back().x - late.x, truth.back().y - late.y) < 0.01);
  }
}

TEST_CASE("a robot whose laser is silent stands and raises an alarm", "[system][localizer]") {
  const Drives drives;
  const std::string world = drives.office_with("<outage robot=\"Pioneer\" sensor=\"laser\" at=\"10 s\"/>");
  const auto [run, csv] =
      drives.drive("pioneer_localize", Words{"--until", "30 s", "--set", "world=" + world} + kOfficeMap);
  INFO(run.err);
  CHECK(run.says("alarm LOST"));
  const auto poses = poses_of(csv, "localizer.RobotPosePush");
  const auto known_at = [&](double time) {
    const auto found = std::ranges::find_if(poses, [&](const Stamped& pose) { return pose.stamp >= time; });
    return found != poses.end() && is_known(*found);
  };
  CHECK(known_at(9.9));
  CHECK_FALSE(known_at(13.0));
  const auto truth = poses_of(csv, "truth.RobotPosePush");
  const auto at = [&](double time) {
    return *std::ranges::find_if(truth, [&](const Stamped& pose) { return pose.stamp >= time; });
  };
  // The run ends with the goals, which are lost.
  CHECK(std::hypot(truth.back().x - at(12.9).x, truth.back().y - at(12.9).y) < 0.05);
}

namespace {

/// The time and way after a robot was carried off, until something was so.
struct Until {
  double time = 0.0, way = 0.0;  // [s], [m]
};

struct Kidnapping {
  std::optional<Until> noticed;  // it did not claim a wrong place any more
  std::optional<Until> found;    // it was right, to 10 cm and 5 degrees
  double way = 0.0;              // [m] that the robot drove until the next one
};

bool is_right(const Stamped& pose, const Stamped& truth) {
  return is_known(pose) && std::hypot(pose.x - truth.x, pose.y - truth.y) < 0.1 &&
         std::fabs(std::remainder(pose.yaw - truth.yaw, 2.0 * std::numbers::pi)) < 0.087;
}

// The kidnappings of a run: where the truth jumps.
std::vector<Kidnapping> kidnappings_in(const std::string& csv) {
  std::map<long, Stamped> poses;
  for (const Stamped& pose : poses_of(csv, "localizer.RobotPosePush"))
    poses[std::lround(1e4 * pose.stamp)] = pose;
  std::vector<Kidnapping> all;
  std::optional<Stamped> before;
  double begin = 0.0;
  for (const Stamped& truth : poses_of(csv, "truth.RobotPosePush")) {
    const double way = before ? std::hypot(truth.x - before->x, truth.y - before->y) : 0.0;
    before = truth;
    if (way > 1.0) {
      all.emplace_back();
      begin = truth.stamp;
      continue;
    }
    const auto pose = poses.find(std::lround(1e4 * truth.stamp));
    if (all.empty() || pose == poses.end()) continue;
    Kidnapping& last = all.back();
    last.way += way;
    const Until now{truth.stamp - begin, last.way};
    const bool right = is_right(pose->second, truth);
    if (!last.noticed && (right || !is_known(pose->second))) last.noticed = now;
    if (!last.found && right) last.found = now;
  }
  return all;
}

// A robot that drives about in an office, and is put elsewhere every 35 s.
std::vector<Kidnapping> kidnap(const Drives& drives, const std::string& realism, int seed) {
  std::mt19937 random(static_cast<unsigned>(seed));
  const auto within = [&](double most) { return most * static_cast<double>(random() % 10000) / 1e4; };
  std::ostringstream events;
  for (int i = 0; i < 8; ++i) {
    events << "<kidnap robot=\"Pioneer\" at=\"" << 25 + 35 * i << " s\" x=\"" << 0.5 + within(17.0);
    events << "\" y=\"" << 0.5 + within(11.0) << "\" yaw=\"" << within(6.28) << "\"/>\n";
  }
  const std::string csv = drives.folder.file("poses.csv");
  std::filesystem::remove(csv);
  const Run run =
      run_deployer(Words{system_graph("kidnapped.xml"), "--set", "world=" + drives.office_with(events.str()),
                         "--set", "realism=" + realism, "--seed", std::to_string(seed), "--until", "300 s",
                         "--record", csv + "=localizer.RobotPosePush,truth.RobotPosePush"} +
                       virtual_clock(),
                   Seconds(120));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  return kidnappings_in(read_text(csv));
}

}  // namespace

TEST_CASE("a robot that is carried off notices within 3 s or 1 m, and is found again within 15 s or 8 m",
          "[system][localizer]") {
  const Drives drives;
  int all = 0;
  int noticed = 0;
  int driving = 0;
  int found = 0;
  for (const char* const realism : {"nominal", "harsh"}) {
    if (!is_slow_run() && realism == std::string("nominal")) continue;
    for (int seed = 1; seed <= (is_slow_run() ? 20 : 2); ++seed)
      for (const Kidnapping& one : kidnap(drives, realism, seed)) {
        ++all;
        noticed += one.noticed && (one.noticed->time <= 3.0 || one.noticed->way <= 1.0) ? 1 : 0;
        // One that was put so near to furniture that it cannot drive may see the same as elsewhere.
        if (one.way < 0.5) continue;
        ++driving;
        found += one.found && (one.found->time <= 15.0 || one.found->way <= 8.0) ? 1 : 0;
      }
  }
  std::printf("%d kidnappings, %d noticed; %d robots drove on, %d of them were found\n", all, noticed,
              driving, found);
  CHECK(all > 10);
  CHECK(noticed >= 0.95 * all);
  CHECK(found >= 0.95 * driving);
}

TEST_CASE("people who hide 30 % of the beams do not lead astray where a robot is", "[system][localizer]") {
  const Drives drives;
  const std::string csv = drives.folder.file("poses.csv");
  const Words people{"--profile", "sim",
                     "--profile", "people",
                     "--set",     "plugins=" ORCA_BINARY_DIR "/tests/plugins",
                     "--set",     "scans=crowd.laser_out"};
  for (const bool is_told : {true, false}) {
    std::filesystem::remove(csv);
    const Run run =
        run_deployer(Words{system_graph("kidnapped.xml"), "--seed", "3", "--until", "100 s", "--record",
                           csv + "=localizer.RobotPosePush,truth.RobotPosePush"} +
                         people + (is_told ? Words{"--profile", "told"} : Words{}) + virtual_clock(),
                     Seconds(60));
    INFO(is_told << '\n' << run.err);
    REQUIRE(run.exit_code() == 0);
    const std::size_t said = run.err.find("people hid ");
    REQUIRE(said != std::string::npos);
    CHECK(std::fabs(std::stod(run.err.substr(said + 11)) - 30.0) < 3.0);
    const Errors errors = errors_of(read_text(csv));
    CHECK(errors.unknown < (is_told ? 20U : errors.place.size()));
    CHECK(errors.share(0.5) <= 0.02);
    CHECK(errors.share(0.95) <= 0.05);
  }
}

TEST_CASE("a robot that is put in a corner is not sure of one of the many that look alike",
          "[system][localizer]") {
  const Run run = run_deployer(Words{source_file("sim/experiments/lost/localize.xml"), "--profile", "sim",
                                     "--profile", "localized", "--seed", "10", "--until", "180 s", "--set",
                                     "world=" + source_file("sim/experiments/lost/offices.xml#1")} +
                                   virtual_clock(),
                               Seconds(120));
  INFO(run.err);
  CHECK(run.says("Pioneer is kidnapped"));
  CHECK(run.arrivals().size() == 1);
  CHECK_FALSE(run.says("truly the robot is"));
}

TEST_CASE("a robot that is switched on where it was switched off knows at once where it is",
          "[system][localizer]") {
  const Drives drives;
  const auto run_from = [&](const std::string& place, const Words& more) {
    return drives.drive(
        "pioneer_localize",
        Words{"--set", "place=" + place, "--set", "localizer.keeps_pose=office"} + kOfficeMap + more);
  };
  const auto [evening, csv] = run_from("start", {"--until", "60 s"});
  INFO(evening.err);
  const auto truth = poses_of(csv, "truth.RobotPosePush");
  REQUIRE_FALSE(truth.empty());
  const Stamped last = truth.back();
  CHECK(std::hypot(last.x - truth.front().x, last.y - truth.front().y) > 3.0);
  std::ostringstream bed;
  bed << "<place name=\"bed\" x=\"" << last.x << "\" y=\"" << last.y << "\" yaw=\"" << last.yaw << "\"/>";
  const std::string world = "world=" + drives.office_with(bed.str());
  const Words asks_nobody{"--until", "3 s", "--set", world, "--set", "localizer.searches=false"};

  const Errors there = errors_of(run_from("bed", asks_nobody).csv);
  CHECK(there.unknown <= 10);
  CHECK(there.share(1.0) < 0.05);
  const Errors elsewhere = errors_of(run_from("start", asks_nobody).csv);
  CHECK(elsewhere.place.empty());
  // The search finds a robot that was carried off.
  const Errors carried = errors_of(run_from("start", {"--until", "20 s"}).csv);
  CHECK(carried.share(1.0) < 0.1);
  CHECK(carried.place.size() > carried.unknown);

  // Programs that a test starts have a state folder of their own.
  const std::string file = std::string(std::getenv("XDG_STATE_HOME")) + "/orca/kept/office.pose";
  std::filesystem::resize_file(file, std::filesystem::file_size(file) / 2);
  const auto [damaged, poses] = run_from("bed", asks_nobody);
  CHECK(damaged.says("what was kept of where the robot was is not used"));
  CHECK(damaged.says("office.pose: this file is damaged"));
  CHECK(errors_of(poses).place.empty());
}

TEST_CASE("a robot finds where it is the same way on both executors", "[system][localizer]") {
  const Drives drives;
  const auto hash = [&](const std::string& executor) {
    const auto [run, csv] = drives.drive("pioneer_localize", {"--executor", executor, "--until", "20 s"});
    INFO(run.err);
    REQUIRE(run.trace_hash());
    return *run.trace_hash();
  };
  CHECK(hash("fiber") == hash("baton"));
}

TEST_CASE("a Localizer that is exchanged while the robot drives keeps its belief and loses no pose",
          "[system][localizer][quiet]") {
  const TempFolder folder;
  std::filesystem::create_directory(folder.file("next"));
  copy_plugin(ORCA_BINARY_DIR "/plugins/localizer.so", folder.file("next"));
  const std::string csv = folder.file("poses.csv");
  Subprocess program(deployer({source_file("graphs/pioneer_localize.xml"), "--profile", "sim", "--profile",
                               "truth", "--until", "11 s", "--log", "info", "--record",
                               csv + "=localizer.RobotPosePush,truth.RobotPosePush"}));
  REQUIRE(program.wait_for_output("it is known where the robot is", Seconds(10) * kSlowdown));
  REQUIRE(comes_true([&] { return run_orcactl({"ps"}).exit_code() == 0; }, Seconds(5)));
  const Run swapped = run_orcactl({"swap", "localizer", folder.file("next") + "/localizer.so"});
  INFO(swapped.err);
  REQUIRE(swapped.exit_code() == 0);
  const Run run = finish(program, Seconds(30));
  INFO(run.err);
  const std::string text = read_text(csv);
  const auto poses = poses_of(text, "localizer.RobotPosePush");
  REQUIRE(poses.size() > 100);
  bool known = false;
  for (std::size_t i = 1; i < poses.size(); ++i) {
    CHECK(poses[i].seq == poses[i - 1].seq + 1);
    known |= is_known(poses[i - 1]);
    if (known) CHECK(is_known(poses[i]));
  }
  CHECK(errors_of(text).share(1.0) < 0.1);
}
