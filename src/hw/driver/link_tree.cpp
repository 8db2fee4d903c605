// SPDX-License-Identifier: LGPL-3.0-or-later
#include "link_tree.hpp"

#include "orca/base/portable_math.hpp"
#include "orca/robot_file/reader.hpp"
#include "orca/robot_file/rules.hpp"
#include "orca/xml/attributes.hpp"

namespace orca::hw {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using robot_file::only_child;
using xml::Element;

// Returns the rotation by roll, then pitch, then yaw, about axes that stay.
Matrix3d turned(double roll, double pitch, double yaw) {
  const double cr = portable::cos(roll), sr = portable::sin(roll);
  const double cp = portable::cos(pitch), sp = portable::sin(pitch);
  const double cy = portable::cos(yaw), sy = portable::sin(yaw);
  Matrix3d rotation;
  rotation << cy * cp, cy * sp * sr - sy * cr, cy * sp * cr + sy * sr,  //
      sy * cp, sy * sp * sr + cy * cr, sy * sp * cr - cy * sr,          //
      -sp, cp * sr, cp * cr;
  return rotation;
}

}  // namespace

LinkTree::LinkTree(const Element& robot, xml::Reporter& reporter) : reporter_(reporter) {
  const auto link = [&](const Element* e) {
    return e != nullptr ? xml::Attributes(*e, robot_file::kRobotFile, reporter).text("link").value_or("")
                        : "";
  };
  for (const Element& e : robot.children()) {
    if (e.name() != "joint") continue;
    const Element* const at = only_child(e, "origin");
    joints_[link(only_child(e, "child"))] = {link(only_child(e, "parent")),
                                             at != nullptr ? origin(*at) : Isometry3d::Identity()};
  }
}

Isometry3d LinkTree::place_of(std::string link) const {
  Isometry3d place = Isometry3d::Identity();
  for (std::size_t steps = 0; joints_.contains(link) && steps <= joints_.size(); ++steps) {
    const Joint& joint = joints_.at(link);
    place = joint.place * place;
    link = joint.parent;
  }
  return place;
}

Isometry3d LinkTree::origin(const Element& e) const {
  const std::array<double, 3> xyz = three(e, "xyz");
  const std::array<double, 3> rpy = three(e, "rpy");
  Isometry3d place = Isometry3d::Identity();
  place.linear() = turned(rpy[0], rpy[1], rpy[2]);
  place.translation() << xyz[0], xyz[1], xyz[2];
  return place;
}

std::array<double, 3> LinkTree::three(const Element& e, const char* name) const {
  const xml::Attributes attributes(e, robot_file::kRobotFile, reporter_);
  const auto values = attributes.has(name) ? attributes.bare_numbers(name, 3) : std::nullopt;
  return values ? std::array{(*values)[0], (*values)[1], (*values)[2]} : std::array<double, 3>{};
}

}  // namespace orca::hw
