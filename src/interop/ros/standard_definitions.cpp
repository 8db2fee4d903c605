// SPDX-License-Identifier: LGPL-3.0-or-later
#include <map>
#include <set>
#include <string>
#include <vector>

#include "orca/ros/message_type.hpp"

namespace orca::ros {
namespace {

// Fields in their order, by the names of the types without "msg". Facts of the packages common_interfaces, geometry2 and
// rcl_interfaces of ROS 2 Jazzy; constants are left out, which do not travel.
const std::map<std::string, std::string, std::less<>>& fields() {
  static const std::map<std::string, std::string, std::less<>> all{
      {"builtin_interfaces/Time", "int32 sec\nuint32 nanosec\n"},
      {"std_msgs/Header", "builtin_interfaces/Time stamp\nstring frame_id\n"},
      {"geometry_msgs/Vector3", "float64 x\nfloat64 y\nfloat64 z\n"},
      {"geometry_msgs/Point", "float64 x\nfloat64 y\nfloat64 z\n"},
      {"geometry_msgs/Quaternion", "float64 x\nfloat64 y\nfloat64 z\nfloat64 w\n"},
      {"geometry_msgs/Pose", "geometry_msgs/Point position\ngeometry_msgs/Quaternion orientation\n"},
      {"geometry_msgs/Transform", "geometry_msgs/Vector3 translation\ngeometry_msgs/Quaternion rotation\n"},
      {"geometry_msgs/Twist", "geometry_msgs/Vector3 linear\ngeometry_msgs/Vector3 angular\n"},
      {"geometry_msgs/PoseStamped", "std_msgs/Header header\ngeometry_msgs/Pose pose\n"},
      {"geometry_msgs/PoseWithCovariance", "geometry_msgs/Pose pose\nfloat64[36] covariance\n"},
      {"geometry_msgs/TwistWithCovariance", "geometry_msgs/Twist twist\nfloat64[36] covariance\n"},
      {"geometry_msgs/PoseWithCovarianceStamped",
       "std_msgs/Header header\ngeometry_msgs/PoseWithCovariance pose\n"},
      {"geometry_msgs/TransformStamped",
       "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/Transform transform\n"},
      {"tf2_msgs/TFMessage", "geometry_msgs/TransformStamped[] transforms\n"},
      {"nav_msgs/MapMetaData",
       "builtin_interfaces/Time map_load_time\nfloat32 resolution\nuint32 width\nuint32 height\n"
       "geometry_msgs/Pose origin\n"},
      {"nav_msgs/OccupancyGrid", "std_msgs/Header header\nnav_msgs/MapMetaData info\nint8[] data\n"},
      {"nav_msgs/Odometry",
       "std_msgs/Header header\nstring child_frame_id\ngeometry_msgs/PoseWithCovariance pose\n"
       "geometry_msgs/TwistWithCovariance twist\n"},
      {"nav_msgs/Path", "std_msgs/Header header\ngeometry_msgs/PoseStamped[] poses\n"},
      {"sensor_msgs/LaserScan",
       "std_msgs/Header header\nfloat32 angle_min\nfloat32 angle_max\nfloat32 angle_increment\n"
       "float32 time_increment\nfloat32 scan_time\nfloat32 range_min\nfloat32 range_max\nfloat32[] ranges\n"
       "float32[] intensities\n"},
      {"sensor_msgs/Image",
       "std_msgs/Header header\nuint32 height\nuint32 width\nstring encoding\nuint8 is_bigendian\nuint32 "
       "step\n"
       "uint8[] data\n"},
      {"sensor_msgs/BatteryState",
       "std_msgs/Header header\nfloat32 voltage\nfloat32 temperature\nfloat32 current\nfloat32 charge\n"
       "float32 capacity\nfloat32 design_capacity\nfloat32 percentage\nuint8 power_supply_status\n"
       "uint8 power_supply_health\nuint8 power_supply_technology\nbool present\nfloat32[] cell_voltage\n"
       "float32[] cell_temperature\nstring location\nstring serial_number\n"},
      {"rcl_interfaces/Log",
       "builtin_interfaces/Time stamp\nuint8 level\nstring name\nstring msg\nstring file\nstring function\n"
       "uint32 line\n"},
  };
  return all;
}

// Returns the types that a definition names, in their order.
std::vector<std::string> types_in(const std::string& definition) {
  std::vector<std::string> names;
  for (std::size_t at = 0; at < definition.size(); at = definition.find('\n', at) + 1) {
    const std::string type = definition.substr(at, definition.find(' ', at) - at);
    const std::string name = type.substr(0, type.find('['));
    if (name.find('/') != std::string::npos) names.push_back(name);
  }
  return names;
}

void append_parts(const std::string& definition, std::set<std::string>& known, std::string& text) {
  for (const std::string& name : types_in(definition)) {
    if (!known.insert(name).second) continue;
    const std::string& part = fields().at(name);
    text += std::string(80, '=') + "\nMSG: " + name + "\n" + part;
    append_parts(part, known, text);
  }
}

}  // namespace

std::optional<MessageType> standard_message_type(std::string_view name) {
  constexpr std::string_view kMiddle = "/msg/";
  const std::size_t at = name.find(kMiddle);
  if (at == std::string_view::npos) return std::nullopt;
  const auto found =
      fields().find(std::string(name.substr(0, at)) + "/" + std::string(name.substr(at + kMiddle.size())));
  if (found == fields().end()) return std::nullopt;
  MessageType type{std::string(name), found->second};
  std::set<std::string> known;
  append_parts(found->second, known, type.definition);
  return type;
}

}  // namespace orca::ros
