// SPDX-License-Identifier: GPL-3.0-or-later
#include "foxglove/ros_messages.hpp"

#include <catch2/catch.hpp>

#include "foxglove/channels.hpp"

using namespace orca::view;
using Catch::Contains;

namespace {

std::string bytes_of(const std::string& hex) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

// Of a document on ROS 2 over DDS, on which two independent serializers agree.
const std::string kTwist = bytes_of(
    "00010000000000000000d03f00000000000000000000000000000000000000000000000000000000000000000000000000"
    "00e0bf");
const std::string kTwistStamped = bytes_of(
    "00010000010000000065cd1d0a000000626173655f6c696e6b000000000000000000d03f0000000000000000000000000000"
    "000000000000000000000000000000000000000000000000e0bf");

}  // namespace

TEST_CASE("a twist drives, with or without a header", "[foxglove]") {
  for (const auto& [type, bytes] :
       {std::pair{"geometry_msgs/msg/Twist", kTwist}, std::pair{"geometry_msgs/Twist", kTwist},
        std::pair{"geometry_msgs/msg/TwistStamped", kTwistStamped}}) {
    INFO(type);
    const auto message = read_ros_message(type, "cdr", bytes);
    REQUIRE(message);
    CHECK(message->port_end == ".MotionSend");
    CHECK_THAT(message->xml,
               Contains(R"(speed="0.25")") && Contains(R"(turn_rate="-0.5")") && Contains("BY_TURN_RATE"));
  }
}

TEST_CASE("a stamped pose is a goal, one with covariance is where the robot is", "[foxglove]") {
  const std::string pose =
      R"({"position":{"x":1.5,"y":-2,"z":0},"orientation":{"x":0,"y":0,"z":0.7071067811865476,"w":0.7071067811865476}})";
  const auto goal = read_ros_message("geometry_msgs/msg/PoseStamped", "json", R"({"pose":)" + pose + "}");
  REQUIRE(goal);
  CHECK(goal->port_end == ".GotoCoordinateSend");
  CHECK_THAT(goal->xml, Contains(R"(x="1.5")") && Contains(R"(y="-2")") && Contains(R"(yaw="1.57079632679)"));
  const auto place = read_ros_message("geometry_msgs/msg/PoseWithCovarianceStamped", "json",
                                      R"({"pose":{"pose":)" + pose + "}}");
  REQUIRE(place);
  CHECK(place->port_end == ".RobotPoseSend");
  CHECK_THAT(place->xml, Contains(R"(orientation="1.57079632679)"));
}

TEST_CASE("bytes that are no such message are refused", "[foxglove]") {
  for (std::size_t size = 0; size < kTwist.size(); ++size)
    CHECK_FALSE(read_ros_message("geometry_msgs/msg/Twist", "cdr", kTwist.substr(0, size)));
  for (std::size_t size = 0; size < kTwistStamped.size(); ++size)
    CHECK_FALSE(read_ros_message("geometry_msgs/msg/TwistStamped", "cdr", kTwistStamped.substr(0, size)));
  std::string most_first = kTwist;
  most_first[1] = '\0';
  CHECK_FALSE(read_ros_message("geometry_msgs/msg/Twist", "cdr", most_first));
  std::string nan = kTwist;
  nan.replace(4, 8, std::string("\0\0\0\0\0\0\xf8\x7f", 8));
  CHECK_FALSE(read_ros_message("geometry_msgs/msg/Twist", "cdr", nan));
  CHECK_FALSE(
      read_ros_message("geometry_msgs/msg/PoseStamped", "json", R"({"pose":{"position":{"x":"1"}}})"));
  CHECK_FALSE(read_ros_message("geometry_msgs/msg/PoseStamped", "json", "[]"));
  CHECK_FALSE(read_ros_message("geometry_msgs/msg/Twist", "protobuf", kTwist));
  const auto other = read_ros_message("std_msgs/msg/String", "cdr", kTwist);
  REQUIRE_FALSE(other);
  CHECK_THAT(other.error().message, Contains("PoseStamped"));
}

TEST_CASE("ports that send are channels; all that say where something is are frames", "[foxglove]") {
  const auto ports = nlohmann::json::parse(R"([
    {"port":"base.OdometryPush","pattern":"Push","role":"Server","type":"Odometry","connected_to":["avoid.odometry"]},
    {"port":"avoid.odometry","pattern":"Push","role":"Proxy","type":"Odometry","connected_to":["base.OdometryPush"]},
    {"port":"fuser.base","pattern":"Send","role":"Proxy","type":"MotionCommand","connected_to":["base.MotionCommandSend"]},
    {"port":"base.RobotQuery","pattern":"Query","role":"Server","type":"Ask","connected_to":[]},
    {"port":"odd.Push","pattern":"Push","role":"Server","type":"NobodyKnows","connected_to":[]}])");
  const std::vector<Channel> channels = channels_of(ports);
  REQUIRE(channels.size() == 4);
  CHECK(channels[0].topic == "/tf");
  CHECK(channels[0].ports == std::vector<std::string>{"base.OdometryPush"});
  CHECK(channels[1].topic == "/rosout");
  CHECK(channels[2].topic == "/base/OdometryPush");
  CHECK(channels[2].type == "nav_msgs/msg/Odometry");
  CHECK(channels[3].topic == "/fuser/base");
  CHECK(channels[3].kind == Channel::Kind::object);
  const nlohmann::json graph = connection_graph_of(ports);
  CHECK(graph["publishedTopics"][0] ==
        nlohmann::json({{"name", "/base/OdometryPush"}, {"publisherIds", {"base"}}}));
  CHECK(graph["subscribedTopics"][0] ==
        nlohmann::json({{"name", "/base/OdometryPush"}, {"subscriberIds", {"avoid"}}}));
  CHECK(graph["advertisedServices"][0]["name"] == "/base/RobotQuery");
  CHECK(port_with_end(ports, ".RobotQuery") == "base.RobotQuery");
  CHECK(port_with_end(ports, "y").empty());
}
