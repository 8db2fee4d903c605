// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/ros/message_type.hpp"

#include <catch2/catch.hpp>

#include "orca/idl/object.hpp"
#include "orca/idl/sensing.hpp"

using namespace orca;
using namespace orca::ros;

TEST_CASE(
    "an object type is described with its fields in order, units as comments and enumerators as constants",
    "[ros][types]") {
  const MessageType image = message_type_of(object_type<idl::Image>());
  CHECK(image.name == "orca/msg/Image");
  CHECK_THAT(image.definition, Catch::Matchers::StartsWith("orca_values/TimeValue creation_time\n"
                                                           "string origin\n"
                                                           "string origin_port\n"
                                                           "uint64 seq\n"
                                                           "uint64 mission\n"
                                                           "orca_values/Cause cause\n"
                                                           "uint32 MONO8=0\n"
                                                           "uint32 MONO16=1\n"));
  CHECK_THAT(image.definition, Catch::Matchers::Contains("uint32 DEPTH16=6\n"
                                                         "uint32 encoding\n"
                                                         "uint32 width\n"
                                                         "uint32 height\n"
                                                         "uint32 step\n"
                                                         "uint8[] data\n"
                                                         "float64 focal_length  # [pixels]\n"
                                                         "orca_values/Pose3D pose\n"
                                                         "====="));
  CHECK_THAT(image.definition, Catch::Matchers::Contains("=\nMSG: orca_values/Point\n"
                                                         "float64 x  # [m]\n"));
  CHECK_THAT(image.definition, Catch::Matchers::Contains("float64[36] covariance  # [m2, m rad, rad2]\n"));
}

TEST_CASE("every object type has a description in which each part is described once", "[ros][types]") {
  for (const ObjectType* const type : object_types()) {
    const MessageType message = message_type_of(*type);
    INFO(message.definition);
    std::size_t named = 0;
    std::size_t described = 0;
    std::set<std::string> parts;
    for (std::size_t at = 0; (at = message.definition.find("orca_values/", at)) != std::string::npos; ++at) {
      const std::string name =
          message.definition.substr(at, message.definition.find_first_of(" \n[", at) - at);
      const bool describes = at >= 5 && message.definition.compare(at - 5, 5, "MSG: ") == 0;
      described += describes ? 1 : 0;
      if (parts.insert(name).second) ++named;
    }
    CHECK(named == described);
  }
}

TEST_CASE("message types of ROS 2 are described with all that they hold; others are not known",
          "[ros][types]") {
  const auto path = standard_message_type("nav_msgs/msg/Path");
  REQUIRE(path);
  CHECK_THAT(path->definition, Catch::Matchers::StartsWith("std_msgs/Header header\n"
                                                           "geometry_msgs/PoseStamped[] poses\n"
                                                           "====="));
  for (const char* const part : {"std_msgs/Header", "builtin_interfaces/Time", "geometry_msgs/PoseStamped",
                                 "geometry_msgs/Pose", "geometry_msgs/Point", "geometry_msgs/Quaternion"})
    CHECK_THAT(path->definition, Catch::Matchers::Contains("MSG: " + std::string(part) + "\n"));
  CHECK_FALSE(standard_message_type("nav_msgs/Path"));
  CHECK_FALSE(standard_message_type("teapots/msg/Teapot"));
}
