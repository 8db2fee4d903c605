// SPDX-License-Identifier: GPL-3.0-or-later
// A robot of Orca among nodes of ROS 2, which are programs over another implementation of DDS: Eclipse Cyclone DDS.
#include <catch2/catch.hpp>
#include <cmath>
#include <csignal>
#include <cstdlib>
#include <functional>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "deployer.hpp"
#include "orca/ros/cdr.hpp"
#include "orca/ros/generated/messages.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// All programs of this test speak over loopback only, in a domain of their own.
const bool kSet = [] {
  const std::string domain = std::to_string(40 + getpid() % 50);
  return setenv("ROS_LOCALHOST_ONLY", "1", 1) == 0 && setenv("ROS_DOMAIN_ID", domain.c_str(), 1) == 0 &&
         setenv("CYCLONEDDS_URI",
                "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name=\"lo\"/></Interfaces>"
                "<AllowMulticast>false</AllowMulticast></General><Discovery><SPDPInterval>200 "
                "ms</SPDPInterval><ParticipantIndex>auto"
                "</ParticipantIndex><Peers><Peer "
                "Address=\"127.0.0.1\"/></Peers></Discovery></Domain></CycloneDDS>",
                1) == 0;
}();

const Seconds kSoon(20 * kSlowdown);

Words peer(Words words) {
  words.insert(words.begin(), ORCA_ROS_PEER);
  return words;
}

struct Robot {
  explicit Robot(const Words& more = {})
      : program(deployer(Words{source_file("graphs/ros2_pioneer.xml")} + more)) {
    REQUIRE(kSet);
  }
  Subprocess program;
};

bool eventually(const std::function<bool()>& condition) {
  for (int i = 0; i < 60; ++i) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  }
  return false;
}

std::vector<std::byte> bytes_of(const std::string& hex) {
  std::vector<std::byte> bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
  return bytes;
}

// Returns what a reader of Cyclone DDS has got, as messages.
template <class Message>
std::vector<Message> messages_in(const std::string& output) {
  std::vector<Message> messages;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);) {
    const std::size_t at = line.find(" bytes ");
    if (at == std::string::npos) continue;
    Message message;
    const Status read = ros::from_cdr(bytes_of(line.substr(at + 7)), message);
    INFO(line);
    REQUIRE(read.ok());
    messages.push_back(std::move(message));
  }
  return messages;
}

// A line of a large message comes in pieces.
std::string whole_lines(const std::string& text) { return text.substr(0, text.rfind('\n') + 1); }

// Reads a topic until something has come, or it is too late.
template <class Message>
std::vector<Message> heard(const std::string& topic, const std::string& qos) {
  Subprocess reader(peer({"read", topic, std::string(Reflection<Message>::name), qos, "30"}));
  CHECK(reader.wait_for_output(" bytes ", kSoon));
  CHECK(eventually([&] { return whole_lines(reader.out()).find(" bytes ") != std::string::npos; }));
  INFO(reader.err());
  return messages_in<Message>(whole_lines(reader.out()));
}

// Returns where the robot is by its odometry, and how fast [m, m/s].
ros::nav_msgs::Odometry odometry() {
  const auto all = heard<ros::nav_msgs::Odometry>("/odom", "best_effort");
  REQUIRE_FALSE(all.empty());
  return all.back();
}

}  // namespace

TEST_CASE("nodes get scans, odometry, frames and the latched map, whatever reliability they ask for",
          "[system][ros2]") {
  Robot robot;
  for (const char* const qos : {"best_effort", "reliable"}) {
    CAPTURE(qos);
    const auto scans = heard<ros::sensor_msgs::LaserScan>("/scan", qos);
    REQUIRE_FALSE(scans.empty());
    CHECK(scans.front().header.frame_id == "laser");
    CHECK(scans.front().ranges.size() == 181);
    CHECK(scans.front().angle_min == Approx(-1.5708).margin(1e-3));
    CHECK(scans.front().range_max == Approx(8.0).margin(0.5));
    const auto odometry = heard<ros::nav_msgs::Odometry>("/odom", qos);
    REQUIRE_FALSE(odometry.empty());
    CHECK(odometry.front().header.frame_id == "odom");
    CHECK(odometry.front().child_frame_id == "base_link");
    CHECK(std::abs(odometry.front().pose.pose.position.x) < 0.05);
  }
  const auto maps = heard<ros::nav_msgs::OccupancyGrid>("/map", "latched");
  REQUIRE_FALSE(maps.empty());
  CHECK(maps.front().info.width * maps.front().info.height == maps.front().data.size());
  CHECK(maps.front().info.resolution == Approx(0.05));
  CHECK(std::count(maps.front().data.begin(), maps.front().data.end(), 100) > 1000);
  const auto rings = heard<ros::sensor_msgs::Range>("/sonar", "best_effort");
  REQUIRE_FALSE(rings.empty());
  CHECK(rings.front().radiation_type == 0);
  const auto mounts = heard<ros::tf2_msgs::TFMessage>("/tf_static", "latched");
  REQUIRE_FALSE(mounts.empty());
  std::set<std::string> frames;
  for (const auto& said : mounts.back().transforms) frames.insert(said.child_frame_id);
  CHECK(frames.contains("laser"));
  CHECK(frames.contains("base_15"));
}

TEST_CASE("odometry moves base_link in odom on /tf, also if nobody reads it itself", "[system][ros2]") {
  Robot robot;
  const auto frames = heard<ros::tf2_msgs::TFMessage>("/tf", "reliable");
  REQUIRE_FALSE(frames.empty());
  REQUIRE(frames.front().transforms.size() == 1);
  CHECK(frames.front().transforms.front().header.frame_id == "odom");
  CHECK(frames.front().transforms.front().child_frame_id == "base_link");
}

TEST_CASE("a Twist drives the robot a metre, and silence stops it", "[system][ros2]") {
  Robot robot;
  const double before = odometry().pose.pose.position.x;
  Subprocess driver(peer({"twist", "/cmd_vel", "0.25", "0", "4.2"}));
  REQUIRE(driver.wait(kSoon));
  REQUIRE(eventually([] { return std::abs(odometry().twist.twist.linear.x) < 0.01; }));
  const double driven = odometry().pose.pose.position.x - before;
  CHECK(driven > 0.85);
  CHECK(driven < 1.15);
  CHECK(std::abs(odometry().pose.pose.position.x - before - driven) < 0.01);
}

TEST_CASE("what comes on /cmd_vel goes through the gate", "[system][ros2]") {
  Robot robot({"--set", "place=kitchen"});  // some metres from its wall
  Subprocess driver(peer({"twist", "/cmd_vel", "0.6", "0", "60"}));
  CHECK(robot.program.wait_for_output("gate", kSoon));
  REQUIRE(eventually([] { return std::abs(odometry().twist.twist.linear.x) < 0.01; }));
  robot.program.send(SIGINT);
  REQUIRE(robot.program.wait(kSoon));
  CHECK(robot.program.err().find("touch") == std::string::npos);
}

TEST_CASE(
    "every writer carries the hash of its type, and every component is a node with its writers and readers",
    "[system][ros2]") {
  Robot robot;
  constexpr std::ptrdiff_t kTopics = 8;  // odom, sonar, battery_state, scan, map, diagnostics, tf, tf_static
  Subprocess looker(peer({"writers", "60"}));
  REQUIRE(eventually([&] {
    const std::string out = looker.out();
    const std::regex writer("writer rt/[^\n]*\n");
    return std::distance(std::sregex_iterator(out.begin(), out.end(), writer), {}) >= kTopics;
  }));
  std::set<std::string> gids;
  std::istringstream lines(whole_lines(looker.out()));
  for (std::string line; std::getline(lines, line);) {
    if (!line.starts_with("writer rt/")) continue;
    INFO(line);
    CHECK(line.find("'typehash=RIHS01_") != std::string::npos);
    CHECK(line.find("::msg::dds_::") != std::string::npos);
    gids.insert(line.substr(line.rfind(' ') + 1));
  }
  CHECK(gids.size() == kTopics);
  const auto nodes = heard<ros::rmw_dds_common::ParticipantEntitiesInfo>("ros_discovery_info", "latched");
  REQUIRE_FALSE(nodes.empty());
  std::set<std::string> names;
  std::size_t writers = 0;
  std::size_t readers = 0;
  for (const auto& node : nodes.back().node_entities_info_seq) {
    CHECK(node.node_namespace == "/");
    names.insert(node.node_name);
    writers += node.writer_gid_seq.size();
    readers += node.reader_gid_seq.size();
    for (const auto& gid : node.writer_gid_seq) {
      std::string text;
      for (const std::uint8_t byte : gid.data) {
        char digits[3];
        std::snprintf(digits, sizeof digits, "%02x", byte);
        text += digits;
      }
      CHECK(gids.contains(text));
    }
  }
  CHECK(names == std::set<std::string>{"alarms", "base", "gate", "laser", "maps"});
  CHECK(writers == gids.size());
  CHECK(readers == 1);
}

TEST_CASE("a reader that asks for what the port does not offer is reported with topic and policy",
          "[system][ros2]") {
  Robot robot;
  Subprocess reader(peer({"read", "/scan", "sensor_msgs/msg/LaserScan", "deadline", "30"}));
  CHECK(robot.program.wait_for_output(
      "laser.LaserRangeReadingsPush: a reader of topic /scan gets nothing: it asks for another deadline",
      kSoon));
}

TEST_CASE("in virtual time topics are silent, and the graph runs", "[system][ros2]") {
  const Run run =
      run_deployer({source_file("graphs/ros2_robot.xml"), "--clock", "virtual", "--until", "2 s"});
  INFO(run.err);
  CHECK(run.exit_code() == 0);
}

TEST_CASE("a port hears its topic after its component's plugin was swapped", "[system][ros2]") {
  Robot robot;
  const double before = odometry().pose.pose.position.x;
  const Run swapped =
      run_orcactl(Words{"swap", "gate", ORCA_BINARY_DIR "/plugins/collision_monitor.so"} + kBriefly, kSoon);
  INFO(swapped.err);
  CHECK(swapped.exit_code() == 0);
  Subprocess driver(peer({"twist", "/cmd_vel", "0.25", "0", "3"}));
  REQUIRE(driver.wait(kSoon));
  CHECK(odometry().pose.pose.position.x - before > 0.3);
}

TEST_CASE("a robot of ROS 2 is found in the map and driven to three goals over its topics",
          "[system][ros2]") {
  Robot robot;
  const Run run = run_deployer({source_file("graphs/ros2_robot.xml"), "--set", "speed=0.5 m/s", "--set",
                                "goals=near: 2 6; hall: 3.6 6; door: 3.6 7.4"},
                               Seconds(60 * kSlowdown));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 3);
  CHECK(run.arrivals()[0].name == "near");
  CHECK(run.arrivals()[2].name == "door");
}
