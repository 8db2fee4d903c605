// SPDX-License-Identifier: GPL-3.0-or-later
// Additional permission: LICENSES/Orca-plugin-exception.txt
#include "foxglove/channels.hpp"

#include <algorithm>
#include <optional>
#include <set>

#include "orca/idl/object.hpp"
#include "orca/ros/message_type.hpp"
#include "orca/ros/twin.hpp"

namespace orca::view {
namespace {

using nlohmann::json;

constexpr const char* kFrames = "tf2_msgs/msg/TFMessage";
constexpr const char* kLog = "rcl_interfaces/msg/Log";

std::string topic_of(std::string port) {
  std::ranges::replace(port, '.', '/');
  return "/" + port;
}

std::string component_of(const std::string& port) { return port.substr(0, port.rfind('.')); }

bool sends_out(const json& port) {
  return (port.at("pattern") == "Push" && port.at("role") == "Server") ||
         (port.at("pattern") == "Send" && port.at("role") == "Proxy");
}

// Returns the type that ROS 2 has for objects of a type; nothing if there is none.
std::optional<std::string> twin_of(const ObjectType& type) {
  const auto twin = ros::ros_twin(make_object(type).seal());
  return twin ? std::optional(std::string(twin->type)) : std::nullopt;
}

bool says_frames(const std::string& type) {
  static const std::set<std::string> all{"Odometry", "RobotPose", "LaserRangeReadings", "Image"};
  return all.contains(type);
}

Channel standard(Channel::Kind kind, std::string topic, const std::string& type) {
  return {0, kind, std::move(topic), {}, type, ros::standard_message_type(type)->definition};
}

Channel channel_of(const std::string& port, const ObjectType& type) {
  const std::optional<std::string> twin = twin_of(type);
  Channel channel;
  if (twin) {
    channel = standard(Channel::Kind::twin, topic_of(port), *twin);
  } else {
    const ros::MessageType own = ros::message_type_of(type);
    channel = {0, Channel::Kind::object, topic_of(port), {}, own.name, own.definition};
  }
  channel.ports = {port};
  return channel;
}

}  // namespace

std::vector<Channel> channels_of(const json& ports) {
  std::vector<Channel> channels{standard(Channel::Kind::frames, "/tf", kFrames),
                                standard(Channel::Kind::log, "/rosout", kLog)};
  for (const json& port : ports) {
    const ObjectType* const type = find_object_type(port.at("type").get<std::string>());
    if (!sends_out(port) || type == nullptr) continue;
    const auto name = port.at("port").get<std::string>();
    channels.push_back(channel_of(name, *type));
    if (says_frames(std::string(type->name))) channels.front().ports.push_back(name);
  }
  for (std::size_t i = 0; i < channels.size(); ++i) channels[i].id = static_cast<std::uint32_t>(i + 1);
  return channels;
}

json advertisement_of(const std::vector<Channel>& channels) {
  json list = json::array();
  for (const Channel& channel : channels)
    list.push_back({{"id", channel.id},
                    {"topic", channel.topic},
                    {"encoding", "cdr"},
                    {"schemaName", channel.type},
                    {"schemaEncoding", "ros2msg"},
                    {"schema", channel.definition}});
  return {{"op", "advertise"}, {"channels", std::move(list)}};
}

json connection_graph_of(const json& ports) {
  json published = json::array();
  json subscribed = json::array();
  json services = json::array();
  for (const json& port : ports) {
    const auto name = port.at("port").get<std::string>();
    if (sends_out(port))
      published.push_back({{"name", topic_of(name)}, {"publisherIds", json::array({component_of(name)})}});
    if (port.at("pattern") == "Query" && port.at("role") == "Server")
      services.push_back({{"name", topic_of(name)}, {"providerIds", json::array({component_of(name)})}});
    // The topic of a push is its server's, that of a send its client's.
    json takers = json::array();
    for (const json& other : port.at("connected_to"))
      takers.push_back(component_of(other.get<std::string>()));
    if (sends_out(port) && !takers.empty())
      subscribed.push_back({{"name", topic_of(name)}, {"subscriberIds", std::move(takers)}});
  }
  return {{"op", "connectionGraphUpdate"},
          {"publishedTopics", std::move(published)},
          {"subscribedTopics", std::move(subscribed)},
          {"advertisedServices", std::move(services)},
          {"removedTopics", json::array()},
          {"removedServices", json::array()}};
}

std::string port_with_end(const json& ports, const std::string& end) {
  std::string found;
  for (const json& port : ports) {
    const auto name = port.at("port").get<std::string>();
    if (!name.ends_with(end)) continue;
    if (!found.empty()) return {};
    found = name;
  }
  return found;
}

}  // namespace orca::view
