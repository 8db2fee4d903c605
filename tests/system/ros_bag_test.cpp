// SPDX-License-Identifier: GPL-3.0-or-later
// Bags of ROS 2 drive the components that would run on the robot.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <sstream>

#include "bags.hpp"
#include "database_bag.hpp"
#include "deployer.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/recording/objects/object_reader.hpp"
#include "orca/ros/frame_tree.hpp"
#include "orca/ros/generated/messages.hpp"
#include "orca/ros/twin.hpp"
#include "temp_folder.hpp"

using namespace orca::test;
using Catch::Contains;
using orca::Pose2;

namespace {

constexpr std::int64_t kBegin = 1'700'000'000'000'000'000;  // [ns since 1970]
const std::string kSlam = source_file("graphs/intel_log.xml");
const std::string kLocalize = source_file("graphs/localize_log.xml");
const std::string kOffice = source_file("sim/worlds/office.xml");

// Returns a recording of a simulated Pioneer that drives in the office.
std::string simulated_run(const TempFolder& folder) {
  std::string file = folder.file("run.mcap");
  const Run run =
      run_deployer(Words{source_file("graphs/pioneer_laser_goto.xml"), "--until", "25 s", "--record", file} +
                       virtual_clock(),
                   Seconds(60));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  return file;
}

// Writes odometry and scans of a recording as `ros2 bag record /odom /scan /tf_static` has them, in two files.
std::string bag_of(const std::string& recording, const std::string& folder, int version) {
  std::filesystem::create_directory(folder);
  const std::string name = folder + "/" + std::filesystem::path(folder).filename().string();
  DatabaseBag first(name + "_0.db3", version);
  DatabaseBag second(name + "_1.db3", version);
  const auto reader = orca::recording::ObjectReader::open(recording);
  REQUIRE(reader);
  orca::ros::FrameTree frames;
  std::size_t count = 0;
  const auto read = reader->objects(
      {"base.OdometryPush", "laser.LaserRangeReadingsPush"}, [&](const orca::recording::RecordedObject& one) {
        const std::int64_t passed = kBegin + one.passed.time_since_epoch().count();
        DatabaseBag& bag =
            one.passed.time_since_epoch() < orca::Duration(std::chrono::seconds(12)) ? first : second;
        const bool is_scan = one.row == "laser.LaserRangeReadingsPush";
        const std::string topic = is_scan ? "/scan" : "/odom";
        const orca::ros::Twin* const twin = orca::ros::twin_to_ros(one.object.type());
        std::vector<std::vector<std::byte>> payloads;
        twin->to_ros(one.object, payloads);
        bag.topic(topic, std::string(twin->message));
        bag.add_bytes(topic, passed, payloads.at(0));
        if (const auto news = frames.hear(one.object); news && news->is_static && count++ == 0)
          bag.add("/tf_static", passed, news->message);
        return true;
      });
  REQUIRE(read.ok());
  return folder;
}

// Returns the last line of a table of poses.
Pose2 last_pose(const std::string& path) {
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    std::istringstream text(line);
    for (std::string cell; std::getline(text, cell, ',');) cells.push_back(cell);
    return cells;
  };
  const Words lines = split_lines(read_text(path));
  REQUIRE(lines.size() > 50);
  const std::vector<std::string> head = cells_of(lines.front());
  const std::vector<std::string> cells = cells_of(lines.back());
  const auto number = [&](const std::string& name) {
    const auto at = static_cast<std::size_t>(std::ranges::find(head, name) - head.begin());
    REQUIRE(at < cells.size());
    return std::stod(cells[at]);
  };
  return {number("x"), number("y"), number("orientation")};
}

// Plays a recording. Returns the last pose of the localizer. A bag's stamps are those of the simulation, which is said.
Pose2 played(const TempFolder& folder, const Words& graph, const std::string& log) {
  const std::string table = folder.file("poses.csv");
  std::filesystem::remove(table);
  const Run run = run_deployer(
      graph +
          Words{"--set", "log=" + log, "--until", "26 s", "--record", table + "=localizer.RobotPosePush"} +
          virtual_clock(),
      Seconds(100));
  INFO(run.err);
  REQUIRE(run.exit_code() == 0);
  const bool is_bag = std::filesystem::is_directory(log);
  CHECK(run.says("its stamps are of a clock that is 1700000000.0 s behind") == is_bag);
  CHECK(run.says("warning") == is_bag);
  CHECK_FALSE(run.says("tf_static"));
  return last_pose(table);
}

double apart(const Pose2& a, const Pose2& b) { return norm(a.position() - b.position()); }

}  // namespace

TEST_CASE("a bag in SQLite drives SlamLocalizer and Localizer to where the robot's own recording leads them",
          "[system][bag]") {
  const TempFolder folder;
  const std::string run = simulated_run(folder);
  const std::string bag = bag_of(run, folder.file("drive"), GENERATE(3, 4));
  const Pose2 by_slam = played(folder, {kSlam}, bag);
  CHECK(apart(by_slam, played(folder, {kSlam}, run)) < 0.02);

  // Where it truly was is in the recording, too.
  const std::string truth = folder.file("truth.csv");
  const Run table = run_orcactl({"bag", "csv", run, "localizer.RobotPosePush"});
  REQUIRE(table.exit_code() == 0);
  folder.write("truth.csv", table.out);
  const Pose2 found = played(folder, {kLocalize, "--set", "map=" + kOffice}, bag);
  CHECK(apart(found, last_pose(truth)) < 0.1);
  CHECK(std::fabs(orca::wrapped(found.yaw - last_pose(truth).yaw)) < 0.05);
}

TEST_CASE("orcactl bag shows, checks, cuts and converts a bag in SQLite", "[system][bag]") {
  const TempFolder folder;
  const std::string drive = bag_of(simulated_run(folder), folder.file("drive"), 4);
  const std::string info = info_of(drive);
  CHECK(cell_of(info, "/scan", "type") == "sensor_msgs/msg/LaserScan");
  CHECK(count_in(info, "/odom") > 100);
  CHECK_THAT(info, Contains("\"begin\": \"2023-11-1"));
  const Run checked = bag({"check", drive});
  INFO(checked.err);
  CHECK(checked.exit_code() == 0);
  CHECK_THAT(checked.out, Contains("in order: "));
  const Run table = bag({"csv", drive, "/odom"});
  CHECK(static_cast<int>(split_lines(table.out).size()) == count_in(info, "/odom") + 1);
  CHECK(bag({"csv", drive, "base.OdometryPush"}).out == table.out);

  const std::string whole = folder.file("whole.mcap");
  REQUIRE(bag({"cut", drive, whole}).exit_code() == 0);
  CHECK(bag({"csv", whole, "/odom"}).out == table.out);
  CHECK(bag({"check", whole}).exit_code() == 0);
  CHECK(bag({"diff", drive, whole}).exit_code() == 0);
  const Run part = bag({"cut", drive, folder.file("part.mcap"), "5s", "15s"});
  CHECK(part.exit_code() == 0);
  CHECK(count_in(info_of(folder.file("part.mcap")), "/odom") < count_in(info, "/odom") / 2);

  const Run recovered = bag({"recover", drive + "/drive_0.db3", folder.file("new.mcap")});
  CHECK(recovered.exit_code() == 1);
  CHECK_THAT(recovered.err, Contains(".dump | sed 's/^ROLLBACK.*/COMMIT;/' | sqlite3 NEW.db3"));
  CHECK_FALSE(std::filesystem::exists(folder.file("new.mcap")));
}

TEST_CASE("a bag with two lasers needs to be told which is meant, and one without says so",
          "[system][bag][fault]") {
  const TempFolder folder;
  const std::string path = folder.file("two.db3");
  {
    DatabaseBag two(path);
    const orca::ros::sensor_msgs::LaserScan scan{
        {{1'700'000'000, 0}, "laser"}, -1.0F, 1.0F, 1.0F, 0.0F, 0.1F, 0.1F, 8.0F, {1.0F, 2.0F, 3.0F}, {}};
    for (const char* const name : {"/odom", "/wheel/odom"})
      two.add(name, kBegin, orca::ros::nav_msgs::Odometry{});
    for (const char* const name : {"/scan_front", "/scan_rear"}) two.add(name, kBegin, scan);
    two.topic("/scan_top", "sensor_msgs/msg/LaserScan");
    two.topic("/points", "sensor_msgs/msg/PointCloud2");
  }
  const auto checked = [&](const std::string& ports) {
    return run_deployer(Words{kSlam, "--check", "--set", "log=" + path} +
                        (ports.empty() ? Words{} : Words{"--set", "ports=" + ports}));
  };
  const Run several = checked("");
  CHECK(several.exit_code() == 2);
  CHECK(several.says("\"base.OdometryPush\"; name one of them in its place: /odom, /wheel/odom"));
  CHECK(several.says(
      "\"laser.LaserRangeReadingsPush\"; name one of them in its place: /scan_front, /scan_rear"));
  const Run right = checked("/wheel/odom; /scan_rear");
  INFO(right.err);
  CHECK(right.exit_code() == 0);
  CHECK(checked("/odom; /scan_front; /scan_rear").exit_code() == 0);
  CHECK(checked("/odom; /scan_front").says("its /tf_static does not say where 'laser' is"));
  CHECK(checked("/odom; /scan_top").says("there is nothing of \"/scan_top\" in the recording"));
  CHECK(checked("/odom; /points").says("sensor_msgs/msg/PointCloud2, which no object of Orca says"));
  CHECK(checked("/odom; /odom; /scan_front").says("\"/odom\" is named twice"));
}

TEST_CASE("bags that the Python package rosbags has written are read", "[system][bag][tool]") {
  const TempFolder folder;
  const std::string form = GENERATE("sqlite3", "mcap", "sqlite3 message", "sqlite3 file");
  const std::string drive = folder.file("drive");
  Subprocess writer({"/usr/bin/env", "python3", source_file("tests/system/write_bag.py"), drive, form});
  const Run written = finish(writer, Seconds(60));
  if (written.exit_code() == 77) {
    std::cout << "SKIPPED: " << written.out << "\n";
    return;
  }
  INFO(written.out << written.err);
  REQUIRE(written.exit_code() == 0);
  const Run table = bag({"csv", drive});
  INFO(table.out << table.err);
  if (form == "sqlite3 message") CHECK_THAT(table.err, Contains("compressed one by one"));
  if (form == "sqlite3 file") CHECK_THAT(table.err, Contains("zstd -d "));
  if (form.find(' ') != std::string::npos) return;
  CHECK(split_lines(table.out).size() == 1 + 20);
  CHECK_THAT(table.out, Contains("/odom") && Contains("/scan"));
  CHECK(bag({"check", drive}).exit_code() == 0);
  const Run run = run_deployer(Words{kSlam, "--set", "log=" + drive, "--until", "2 s", "--record",
                                     folder.file("o.csv") + "=base.OdometryPush"} +
                               virtual_clock());
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(split_lines(read_text(folder.file("o.csv"))).size() == 1 + 10);
}
