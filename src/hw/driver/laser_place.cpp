// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/laser_place.hpp"

#include <algorithm>

#include "orca/base/text.hpp"
#include "orca/hw/robot_figures.hpp"

namespace orca::hw {

std::vector<HardwareFault> LaserPlace::read() {
  std::vector<HardwareFault> faults;
  place_ = {*x_, *y_, *yaw_};
  height_ = *z_;
  sense_ = *upside_down_ ? -1.0 : 1.0;
  if (!file_->empty()) read_file(faults);
  if (file_->empty() && !mount_->empty())
    faults.push_back({"mount", "it names a laser of the robot's file, and there is none; set robot, too"});
  return faults;
}

void LaserPlace::read_file(std::vector<HardwareFault>& faults) {
  if (!(place_ == Pose2{}) || height_ != 0.0 || *upside_down_)
    return faults.push_back(
        {"robot",
         "the robot's file says where the laser sits, and so do x, y, z, yaw or upside_down; leave "
         "these away, or the file"});
  const auto figures = read_robot_figures(*file_, faults);
  if (!figures) return;
  std::vector<std::string> names;
  for (const robot_file::LaserScanner& laser : figures->lasers) names.push_back(laser.name);
  if (names.empty())
    return faults.push_back(
        {"robot", in_quotes(*file_) + " has no laser; leave it away, and set x, y, z and yaw"});
  if (mount_->empty() && names.size() > 1)
    return faults.push_back({"mount", "the robot's file has several lasers; name one of " + listed(names)});
  const auto found = mount_->empty()
                         ? figures->lasers.begin()
                         : std::ranges::find(figures->lasers, *mount_, &robot_file::LaserScanner::name);
  if (found == figures->lasers.end())
    return faults.push_back(
        {"mount", "the robot's file has no laser " + in_quotes(*mount_) + "; lasers: " + listed(names)});
  place_ = found->center;
  height_ = found->height;
  sense_ = found->upside_down ? -1.0 : 1.0;
  errors_ = found->errors.general();
  laser_ = *found;
}

}  // namespace orca::hw
