// SPDX-License-Identifier: LGPL-3.0-or-later
#include "link_tree.hpp"

#include <sstream>
#include <utility>

#include "orca/base/portable_math.hpp"
#include "orca/xml/number.hpp"

namespace orca::hw {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
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

const Element* child_of(const Element& parent, std::string_view name) {
  for (const Element& e : parent.children())
    if (e.name() == name) return &e;
  return nullptr;
}

std::string text_of(const Element& e, std::string_view name) {
  const xml::Attribute* const a = e.attribute(name);
  return a != nullptr ? a->value : "";
}

LinkTree::LinkTree(const Element& robot, Complain complain) : complain_(std::move(complain)) {
  for (const Element& e : robot.children()) {
    const Element* const parent = child_of(e, "parent");
    const Element* const below = child_of(e, "child");
    if (e.name() != "joint" || parent == nullptr || below == nullptr) continue;
    const Element* const at = child_of(e, "origin");
    joints_[text_of(*below, "link")] = {text_of(*parent, "link"),
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
  std::array<double, 3> values{};
  std::istringstream words(text_of(e, name));
  std::string word;
  std::size_t count = 0;
  for (; words >> word; ++count) {
    const Result<double> value = xml::parse_number(word);
    if (!value || count == values.size()) break;
    values[count] = *value;
  }
  if (count != 0 && count != values.size())
    complain_(e, std::string(name) + " needs three numbers, as in \"0.1 0 0.3\"");
  return values;
}

}  // namespace orca::hw
