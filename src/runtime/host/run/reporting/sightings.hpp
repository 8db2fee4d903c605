// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <vector>

#include "orca/host/run_result.hpp"
#include "orca/host/run_view.hpp"
#include "orca/idl/navigation.hpp"

namespace orca::host {

/// The places where the robots are and to which they drive, as far as objects that are delivered tell: poses,
/// odometry, and the goals that a component pushes.
///
/// Thread contract: any strand or thread.
class Sightings {
 public:
  /// Takes note of an object that was delivered to a component. Other types of objects cost a comparison each.
  void delivered(std::string_view component, const ObjectRef& object);

  /// Returns the goals of those components that have also received a pose.
  [[nodiscard]] std::vector<RunGlance::Goal> goals() const;

  /// Returns how far each robot has driven: by its odometry, or by its poses where nobody listens to any odometry.
  [[nodiscard]] std::vector<RunResult::Way> ways() const;

 private:
  struct Place {
    double x = 0.0;
    double y = 0.0;
  };
  struct Goal {
    std::string name;
    Place place;
  };
  struct Pose {
    Place place;
    bool from_odometry = false;
  };
  struct Track {
    std::uint64_t last_seq = 0;
    Place last;
    double way = 0.0;  // [m]
  };
  template <class Value>
  using ByName = std::map<std::string, Value, std::less<>>;

  template <class Posed>
  void note_pose(std::string_view component, const Posed& object, ByName<Track>& tracks, bool odometry);
  void note_goal(const idl::GoalPoint& goal);

  mutable std::mutex mutex_;
  ByName<Goal> goals_;     // by the component that pushes them
  ByName<Pose> poses_;     // by the component that receives them
  ByName<Track> driven_;   // by the component that pushes the odometry
  ByName<Track> located_;  // by the component that pushes the poses
};

}  // namespace orca::host
