// SPDX-License-Identifier: GPL-3.0-or-later
// Logs of real robots as hardware: CARMEN logs are written, and drive the components that would run on the robot.
#include <signal.h>
#include <sys/resource.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <iostream>
#include <map>
#include <numbers>
#include <sstream>
#include <thread>

#include "deployer.hpp"
#include "measured_relations.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "orca/recording/carmen/log.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
using orca::Pose2;
using orca::carmen::Entry;

namespace {

const std::string kPlayer = source_file("graphs/intel_log.xml");

// Returns a log that a simulated Pioneer has written in 10 s.
std::string simulated_log(const TempFolder& folder) {
  std::string log = folder.file("run.carmen");
  const Run run = run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--until", "10 s",
                                     "--record", log, "--record", folder.file("run.mcap")} +
                                   virtual_clock(),
                               Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return log;
}

Run play(const std::string& log, const Words& more) {
  return run_deployer(Words{kPlayer, "--set", "log=" + log} + more, Seconds(60));
}

orca::carmen::Log read_log(const std::string& path) {
  orca::Result<orca::carmen::Log> log = orca::carmen::read_log_file(path);
  INFO((log ? "" : log.error().text()));
  REQUIRE(log);
  return *std::move(log);
}

orca::Duration since_begin(const orca::carmen::Log& log, const Entry& entry) {
  return entry.sensed - log.entries.front().sensed;
}

// Returns the columns of a table that the deployer has recorded, by name.
std::map<std::string, std::vector<double>> columns_of(const std::string& path,
                                                      const std::vector<std::string>& names) {
  std::map<std::string, std::vector<double>> columns;
  std::vector<std::string> head;
  for (const std::string& line : split_lines(read_text(path))) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    if (head.empty()) {
      head = cells;
      continue;
    }
    for (const std::string& name : names) {
      const auto at = static_cast<std::size_t>(std::ranges::find(head, name) - head.begin());
      REQUIRE(at < cells.size());
      columns[name].push_back(std::stod(cells[at]));
    }
  }
  return columns;
}

// Returns a line without its stamp and, for a scan, the poses, which follow from the odometry around it and from where the laser is on the robot.
std::string text_without_poses(const Entry& entry) {
  orca::carmen::Line line{{}, entry.what.content};
  if (auto* const scan = std::get_if<orca::carmen::ScanLine>(&line.content)) scan->X_OL = scan->X_OB = {};
  return to_text(line);
}

// Returns how far two lines put the robot or the laser from each other [m]; 0 if they are no scans.
double places_apart(const Entry& a, const Entry& b) {
  const auto* const one = std::get_if<orca::carmen::ScanLine>(&a.what.content);
  const auto* const other = std::get_if<orca::carmen::ScanLine>(&b.what.content);
  if (one == nullptr || other == nullptr) return 0.0;
  return std::max(norm(one->X_OL.position() - other->X_OL.position()),
                  norm(one->X_OB.position() - other->X_OB.position()));
}

// A way that a component has said, as text.
struct Way {
  std::vector<double> stamps;  // [s]
  std::vector<Pose2> poses;
};

Way way_of(const std::string& xml) {
  Way way;
  const auto number_after = [&](const std::string& word, std::size_t from) {
    const std::size_t at = xml.find(word, from);
    REQUIRE(at != std::string::npos);
    return std::stod(xml.substr(at + word.size(), 40));
  };
  for (std::size_t at = 0; (at = xml.find("<poses ", at)) != std::string::npos; ++at) {
    way.stamps.push_back(number_after(" stamp=\"", at));
    way.poses.push_back({number_after(" x=\"", at), number_after(" y=\"", at), number_after(" yaw=\"", at)});
  }
  return way;
}

std::size_t scans_in(const orca::carmen::Log& log) {
  return static_cast<std::size_t>(std::ranges::count_if(log.entries, [](const Entry& entry) {
    return std::holds_alternative<orca::carmen::ScanLine>(entry.what.content);
  }));
}

// Waits until a player that is paused runs, and lets a time pass in it.
void step(const std::string& time) {
  const auto steps = [&] {
    return run_orcactl({"--system", "intel_log", "step", time}, Seconds(120)).exit_code() == 0;
  };
  bool stepped = false;
  for (int i = 0; i < 100 && !(stepped = steps()); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  REQUIRE(stepped);
}

// Returns the processor time of all programs that were started here and have ended [s].
double processor_time() {
  rusage usage{};
  getrusage(RUSAGE_CHILDREN, &usage);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace

TEST_CASE("a CARMEN log has the readings of the run, to its digits", "[system][log]") {
  const TempFolder folder;
  const orca::carmen::Log log = read_log(simulated_log(folder));
  CHECK(log.flaws.texts().empty());
  const auto reader = orca::recording::ObjectReader::open(folder.file("run.mcap"));
  REQUIRE(reader);
  std::size_t at = 0;
  const auto status =
      reader->objects({"base.OdometryPush", "laser.LaserRangeReadingsPush"}, [&](const auto& one) {
        REQUIRE(at < log.entries.size());
        const Entry& entry = log.entries[at++];
        CHECK(std::abs((one.object.stamp().time_since_epoch() - entry.sensed).count()) <= 500);
        if (const auto odometry = orca::object_cast<orca::idl::Odometry>(one.object)) {
          const auto& line = std::get<orca::carmen::OdometryLine>(entry.what.content);
          CHECK(std::fabs(odometry->x() - line.X_OB.x) <= 5.1e-7);
          CHECK(std::fabs(odometry->steer_angle() - line.X_OB.yaw) <= 5.1e-7);
        } else {
          const auto scan = orca::object_cast<orca::idl::LaserRangeReadings>(one.object);
          const auto& line = std::get<orca::carmen::ScanLine>(entry.what.content);
          REQUIRE(line.ranges.size() == scan->ranges().size());
          for (std::size_t i = 0; i < line.ranges.size(); ++i)
            CHECK(std::fabs(line.ranges[i] - scan->ranges()[i]) <= 5.1e-4);
          CHECK(line.angle_start == Approx(scan->angle_start()).margin(1e-9));
          CHECK(line.angle_increment == Approx(scan->angle_increment()).margin(1e-9));
          CHECK(max_range_of(log, line.laser) == scan->max_range());
        }
        return true;
      });
  CHECK(status.ok());
  CHECK(at == log.entries.size());
  CHECK(at > 250);
}

TEST_CASE("a log that is played and recorded is the same log, at the same times", "[system][log]") {
  const TempFolder folder;
  const std::string path = simulated_log(folder);
  const std::string again = folder.file("again.carmen");
  const Run run = play(path, Words{"--until", "11 s", "--record", again} + virtual_clock());
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  CHECK_FALSE(run.says("warning"));
  const orca::carmen::Log first = read_log(path);
  const orca::carmen::Log second = read_log(again);
  REQUIRE(first.entries.size() == second.entries.size());
  for (std::size_t i = 0; i < first.entries.size(); ++i) {
    const Entry& a = first.entries[i];
    const Entry& b = second.entries[i];
    CHECK(text_without_poses(a) == text_without_poses(b));
    CHECK(places_apart(a, b) < 3e-6);
    CHECK(std::abs((since_begin(first, a) - since_begin(second, b)).count()) <= 1000);
  }
}

TEST_CASE("a system of several processes writes a CARMEN log, too", "[system][log]") {
  const TempFolder folder;
  const std::string path = folder.file("run.carmen");
  const Run run =
      run_deployer({source_file("graphs/pioneer_laser_goto.xml"), "--until", "3 s", "--record", path});
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  const orca::carmen::Log log = read_log(path);
  CHECK(log.entries.size() > 60);
  CHECK(log.flaws.damaged.count == 0);
}

TEST_CASE("a CARMEN log is of one base and one laser, and of several those that are named", "[system][log]") {
  const TempFolder folder;
  const Words courier = Words{source_file("graphs/courier_depot.xml"), "--until", "2 s"} + virtual_clock();
  const Run both = run_deployer(courier + Words{"--record", folder.file("both.carmen")});
  INFO(both.err);
  CHECK(both.exit_code() == 1);
  CHECK(both.says("a CARMEN log is of one base and one laser, and there are several"));
  const std::string one = folder.file("one.carmen");
  const Run low =
      run_deployer(courier + Words{"--record", one + "=base.OdometryPush,base.low_LaserRangeReadingsPush"});
  INFO(low.err);
  CHECK(low.exit_code() == 0);
  CHECK(read_log(one).flaws.texts() == std::vector<std::string>{});
  CHECK(run_deployer({source_file("graphs/scout_goto.xml"), "--record", ".carmen"}).exit_code() == 2);
}

TEST_CASE("a log is played in virtual time to the same bytes each time, on both executors", "[system][log]") {
  const TempFolder folder;
  const std::string path = simulated_log(folder);
  std::map<std::string, int> results;
  for (const std::string executor : {"fiber", "baton", "baton"}) {
    if (kThreadSanitizer && executor == "fiber") continue;
    const std::string table = folder.file(std::to_string(results.size()) + executor + ".csv");
    const Run run = play(path, {"--clock", "virtual", "--executor", executor, "--until", "11 s", "--record",
                                table + "=localizer.RobotPosePush"});
    INFO(run.err);
    REQUIRE(run.trace_hash());
    ++results[*run.trace_hash() + read_text(table)];
  }
  CHECK(results.size() == 1);
}

TEST_CASE("a log is played in real time, paused, and stepped", "[system][log]") {
  const TempFolder folder;
  const std::string path = simulated_log(folder);
  const std::string real = folder.file("real.csv");
  const Run run = play(path, {"--until", "3 s", "--record", real + "=base.OdometryPush"});
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  const auto stamps = columns_of(real, {"stamp"}).at("stamp");
  REQUIRE(stamps.size() > 40);
  CHECK(stamps.back() - stamps.front() > 2.0);
  CHECK(stamps.back() - stamps.front() < 3.0);

  const std::string stepped = folder.file("stepped.csv");
  Subprocess paused(deployer(
      Words{kPlayer, "--set", "log=" + path, "--pace", "0", "--record", stepped + "=base.OdometryPush"} +
      virtual_clock()));
  step("2s");
  step("2s");
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // nothing happens in between
  paused.send(SIGTERM);
  CHECK(finish(paused, Seconds(20)).exit_code() == 0);
  const auto seen = columns_of(stepped, {"stamp"}).at("stamp");
  REQUIRE_FALSE(seen.empty());
  CHECK(seen.back() <= 4.0);
  CHECK(seen.back() > 3.9);
}

TEST_CASE("a log describes its laser as the robot's own driver would", "[system][log]") {
  const TempFolder folder;
  const std::string path = simulated_log(folder);
  Subprocess paused(deployer(Words{kPlayer, "--set", "log=" + path, "--pace", "0"} + virtual_clock()));
  step("1s");
  const Run laser = run_orcactl({"--system", "intel_log", "query", "laser.LaserSensorQuery", "<Ask/>"});
  paused.send(SIGTERM);
  CHECK(finish(paused, Seconds(20)).exit_code() == 0);
  INFO(laser.out << laser.err);
  CHECK_THAT(laser.out, Contains("number=\"181\"") && Contains("max_range=\"8\"") &&
                            Contains("angle_start=\"-1.5707963267948966\""));
}

TEST_CASE("what is wrong in a log is reported with its lines, and does not end the replay",
          "[system][log][fault]") {
  const TempFolder folder;
  std::vector<std::string> lines = split_lines(read_text(simulated_log(folder)));
  const auto line_with = [&](const std::string& kind, std::size_t from) {
    const auto found = std::find_if(lines.begin() + static_cast<std::ptrdiff_t>(from), lines.end(),
                                    [&](const std::string& line) { return line.starts_with(kind); });
    REQUIRE(found != lines.end());
    return static_cast<std::size_t>(found - lines.begin());
  };
  const std::size_t cut = line_with("FLASER", 40);
  lines[cut].resize(lines[cut].size() / 2);
  const std::size_t late = line_with("ODOM", 80);
  std::swap(lines[late], lines[line_with("ODOM", late + 1)]);
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  const std::string damaged = folder.write("damaged.carmen", text);
  const Run run = play(
      damaged, Words{"--until", "11 s", "--record", folder.file("poses.csv") + "=localizer.RobotPosePush"} +
                   virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("1 damaged line is left out, the first in line " + std::to_string(cut + 1) +
                 ": a line FLASER: it ends before its readings"));
  CHECK(run.says("1 stamp runs backwards, the first in line "));
  CHECK(columns_of(folder.file("poses.csv"), {"stamp"}).at("stamp").back() > 9.0);

  const Run none = play(folder.write("letter.txt", "Dear robot,\n"), {"--check"});
  CHECK(none.exit_code() == 2);
  CHECK(none.says(
      "it is neither an MCAP file nor a CARMEN log, nor a bag in SQLite: there is no line ODOM, FLASER"));
}

TEST_CASE(
    "the log of the Intel lab, played to the components of a robot, becomes a way as right as people have "
    "measured it",
    "[system][log][data]") {
  const std::string log = public_data("slam/intel_scans.txt.gz");
  const std::string relations = public_text("slam/intel.relations.gz");
  if (log.empty() || relations.empty()) return;
  const double before = processor_time();
  Subprocess player(deployer(Words{kPlayer, "--set", "log=" + log, "--pace", "0"} + virtual_clock()));
  step("2660s");
  const Run asked = run_orcactl({"--system", "intel_log", "query", "localizer.PathQuery", "<Ask/>"});
  player.send(SIGTERM);
  CHECK(finish(player, Seconds(20)).exit_code() == 0);
  const double took = processor_time() - before;
  const Way way = way_of(asked.out);
  REQUIRE(way.stamps.size() > 900);
  // Stamps are of the run's clock, in which the first scan comes at once.
  const double begin = orca::to_seconds(read_log(log).entries.front().sensed) - way.stamps.front();
  std::vector<double> stamps;
  for (const double stamp : way.stamps) stamps.push_back(stamp + begin);
  constexpr double kDegree = std::numbers::pi / 180.0;
  const RelationErrors errors = errors_of(relations, stamps, way.poses);
  std::cout << errors.count << " relations: " << errors.place << " m, " << errors.turn / kDegree
            << " degrees; " << errors.loops << " of loops: " << errors.of_loops << " m; " << took
            << " s of processor time\n";
  CHECK(errors.count == 97);
  CHECK(errors.place <= 0.026);
  CHECK(errors.turn <= 0.50 * kDegree);
  CHECK(errors.of_loops <= 0.035);
  CHECK(took <= 60.0 * kSlowCode);
}

TEST_CASE("the log of the Intel lab gives the same bytes on both executors", "[.][slow]") {
  const std::string log = public_data("slam/intel_scans.txt.gz");
  if (log.empty()) return;
  const TempFolder folder;
  std::map<std::string, int> results;
  for (const std::string executor : {"fiber", "baton"}) {
    if (kThreadSanitizer && executor == "fiber") continue;
    const std::string table = folder.file(executor + ".csv");
    const Run run = play(log, {"--clock", "virtual", "--executor", executor, "--until", "2660 s", "--record",
                               table + "=localizer.RobotPosePush"});
    INFO(run.err);
    REQUIRE(run.trace_hash());
    const std::string poses = read_text(table);
    CHECK(split_lines(poses).size() == 1 + 910);
    ++results[*run.trace_hash() + poses];
  }
  CHECK(results.size() == 1);
}

TEST_CASE("published CARMEN logs are played whole, and what is wrong in them is said",
          "[system][log][data]") {
  const auto [name, scans, flaw] = GENERATE(
      table<std::string, std::size_t, std::string>({{"localization/intel-corrected.carmen.log.gz", 910,
                                                     "run backwards, the first in line 32: by 0.00587 s"},
                                                    {"localization/aces-corrected.carmen.log.gz", 440,
                                                     "440 stamps are wrong, so their lines have the time of "
                                                     "the one before, the first in line 145: 0 s"}}));
  const std::string log = public_data(name);
  if (log.empty()) return;
  const TempFolder folder;
  const std::string table = folder.file("scans.csv");
  const Run run =
      play(log, Words{"--until", "1 h", "--record", folder.file("again.carmen")} + virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says(flaw));
  const orca::carmen::Log first = read_log(log);
  const orca::carmen::Log again = read_log(folder.file("again.carmen"));
  CHECK(again.entries.size() == first.entries.size());
  CHECK(scans_in(again) == scans);
}
