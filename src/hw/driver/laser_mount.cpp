// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/laser_mount.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "orca/base/text.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/xml/names.hpp"

namespace orca::hw {
namespace {

constexpr double kNoAngle = 1e-9;  // [rad] "1 deg" times 90 may miss a right angle by less.

ParamOptions place_option(const std::string& unit, const std::string& text) {
  return {.unit = unit, .text = text + " Not set: as `robot` says, if that names a file."};
}

const char* yaw_text(LaserMount::Ahead ahead) {
  return ahead == LaserMount::Ahead::middle_beam
             ? "Direction of its middle beam, 0 ahead, positive to the left."
             : "Direction of its angle 0, 0 ahead, positive to the left.";
}

// Returns the direction of the middle beam in the laser's link [rad].
double middle_of(const robots::LaserScanner& laser) {
  const double middle = laser.first_angle + 0.5 * static_cast<double>(laser.count - 1) * laser.pitch;
  return std::abs(middle) < kNoAngle ? 0.0 : middle;
}

std::vector<std::string> laser_names(const std::vector<robots::LaserScanner>& lasers) {
  std::vector<std::string> names;
  for (const robots::LaserScanner& laser : lasers) names.push_back(laser.name);
  return names;
}

}  // namespace

LaserMount::LaserMount(HardwareContainer& owner, Ahead ahead)
    : ahead_(ahead),
      file_(owner),
      mount_(owner, "mount", "",
             {.fixed = true,
              .text = "Name of this laser in the file that `robot` names. Empty: the file has only one."}),
      name_(owner, "name", "laser",
            {.text = "Name of this laser, one word. Not set: as `robot` says, if that names a file."}),
      x_(owner, "x", 0.0, place_option("m", "Where it sits on the robot: ahead of the middle.")),
      y_(owner, "y", 0.0, place_option("m", "To the left of the middle.")),
      z_(owner, "z", 0.0, place_option("m", "Height of its beams above the floor.")),
      yaw_(owner, "yaw", 0.0, place_option("rad", yaw_text(ahead))) {}

std::vector<HardwareFault> LaserMount::read() {
  if (!file_.is_named() && !mount_->empty())
    return {
        {"mount", in_quotes(*mount_) + " is a laser of the robot's file, and no file is named; set robot"}};
  std::vector<HardwareFault> faults = file_.read();
  if (file_.robot() == nullptr) return faults;
  for (HardwareFault& fault : find(file_.robot()->lasers)) faults.push_back(std::move(fault));
  return faults;
}

std::vector<HardwareFault> LaserMount::find(const std::vector<robots::LaserScanner>& lasers) {
  const std::vector<std::string> names = laser_names(lasers);
  if (lasers.empty())
    return {{"robot",
             "the robot of " + file_.shown() +
                 " has no laser; add a <laser> to the file, or leave robot out and set x, y, z and yaw"}};
  if (mount_->empty() && lasers.size() > 1)
    return {{"robot", "the robot of " + file_.shown() + " has several lasers: " + listed(names) +
                          "; say by the parameter mount which of them this is"}};
  const auto found =
      mount_->empty() ? lasers.begin() : std::ranges::find(lasers, *mount_, &robots::LaserScanner::name);
  if (found == lasers.end())
    return {{"mount", in_quotes(*mount_) + " is no laser of " + file_.shown() + "; lasers: " + listed(names) +
                          xml::did_you_mean(xml::nearest_name(*mount_, names))}};
  sit(*found);
  if (!found->on_turret) return {};
  return {{.param = "robot",
           .text = "the laser " + in_quotes(found->name) + " of " + file_.shown() +
                   " sits on the turret, whose angle this driver does not know; its scans are right only "
                   "while the turret points ahead",
           .only_warns = true}};
}

void LaserMount::sit(const robots::LaserScanner& laser) {
  name_.take_from_file(laser.name);
  x_.take_from_file(laser.center.x);
  y_.take_from_file(laser.center.y);
  z_.take_from_file(laser.height);
  const double middle = ahead_ == Ahead::middle_beam ? middle_of(laser) : 0.0;
  yaw_.take_from_file(middle == 0.0 ? laser.center.yaw : wrapped(laser.center.yaw + middle));
}

}  // namespace orca::hw
