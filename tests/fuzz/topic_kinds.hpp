// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "orca/idl/object.hpp"
#include "orca/ros/twin.hpp"

namespace orca::test {

/// A topic that a port can hear.
struct TopicKind {
  std::string name;
  const ObjectType& object;
  const ros::Twin* twin;  ///< Null: it is a team's.
};

/// Returns a topic of each kind: each message of ROS 2 that becomes an object, and some of a team.
inline const std::vector<TopicKind>& topic_kinds() {
  static const std::vector<TopicKind> kinds = [] {
    std::vector<TopicKind> all;
    for (const char* const type : {"Teammate", "RobotPose", "OccupancyGrid", "RangeReadings"})
      all.push_back({std::string("team/") + type, *find_object_type(type), nullptr});
    for (const ros::Twin& twin : ros::twins())
      if (twin.from_ros != nullptr) all.push_back({"/" + std::string(twin.message), twin.object, &twin});
    return all;
  }();
  return kinds;
}

}  // namespace orca::test
