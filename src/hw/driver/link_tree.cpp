// SPDX-License-Identifier: LGPL-3.0-or-later
#include "link_tree.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/robot_file/reader.hpp"
#include "orca/robot_file/rules.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/number.hpp"

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

using Eigen::Isometry3d;
using Eigen::Vector3d;
using robot_file::only_child;
using xml::Element;

constexpr double kSame = 1e-9;  // [m] below which two places are one

double number(const Element& e, const char* name) {
  const xml::Attribute* const a = e.attribute(name);
  return a != nullptr ? xml::parse_number(a->value).value_or(0.0) : 0.0;
}

// A part of the body, seen from above.
struct Part {
  std::vector<Vec2> points;  // whose hull, widened by the radius, holds it
  double radius = 0.0;       // [m]
  [[nodiscard]] bool is_round_in_the_middle() const {
    return radius > 0.0 && std::ranges::all_of(points, [](const Vec2& p) { return norm(p) < kSame; });
  }
  [[nodiscard]] double reach() const {
    double farthest = 0.0;
    for (const Vec2& p : points) farthest = std::max(farthest, norm(p));
    return farthest + radius;
  }
  [[nodiscard]] Vec2 half_size() const {
    Vec2 half;
    for (const Vec2& p : points)
      half = {std::max(half.x, std::abs(p.x) + radius), std::max(half.y, std::abs(p.y) + radius)};
    return half;
  }
};

Part box(const Vector3d& size, const Isometry3d& place) {
  Part part;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) {
        const Vector3d corner = place * Vector3d(x * size.x(), y * size.y(), z * size.z());
        part.points.push_back({corner.x(), corner.y()});
      }
  return part;
}

Part cylinder(double radius, double length, const Isometry3d& place) {
  const bool upright = place.linear().col(2).head<2>().norm() < kSame;
  if (!upright) return box({2.0 * radius, 2.0 * radius, length}, place);
  return {{{place.translation().x(), place.translation().y()}}, radius};
}

std::optional<Part> part_of(const Element& geometry, const LinkTree& tree, const Isometry3d& place) {
  if (const Element* const e = only_child(geometry, "box")) {
    const std::array<double, 3> size = tree.three(*e, "size");
    return box({size[0], size[1], size[2]}, place);
  }
  if (const Element* const e = only_child(geometry, "cylinder"))
    return cylinder(number(*e, "radius"), number(*e, "length"), place);
  if (const Element* const e = only_child(geometry, "sphere"))
    return Part{{{place.translation().x(), place.translation().y()}}, number(*e, "radius")};
  return std::nullopt;
}

// All parts; nothing if there is one that cannot be read.
std::optional<std::vector<Part>> parts_of(const Element& robot, const LinkTree& tree) {
  std::vector<Part> parts;
  for (const Element& link : robot.children()) {
    if (link.name() != "link") continue;
    for (const Element& e : link.children()) {
      if (e.name() != "collision") continue;
      const Element* const geometry = only_child(e, "geometry");
      const Element* const origin = only_child(e, "origin");
      const Isometry3d at = origin != nullptr ? tree.origin(*origin) : Isometry3d::Identity();
      const xml::Attribute* const name = link.attribute("name");
      const Isometry3d place = tree.place_of(name != nullptr ? name->value : "") * at;
      const std::optional<Part> part = geometry != nullptr ? part_of(*geometry, tree, place) : std::nullopt;
      if (!part) return std::nullopt;
      parts.push_back(*part);
    }
  }
  return parts;
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

std::optional<Vec2> plan_size(const Element& robot, const LinkTree& tree) {
  const std::optional<std::vector<Part>> parts = parts_of(robot, tree);
  if (!parts || parts->empty()) return std::nullopt;
  double round = 0.0;
  double reach = 0.0;
  Vec2 half;
  for (const Part& part : *parts) {
    if (part.is_round_in_the_middle()) round = std::max(round, part.radius);
    reach = std::max(reach, part.reach());
    const Vec2 own = part.half_size();
    half = {std::max(half.x, own.x), std::max(half.y, own.y)};
  }
  return reach <= round + kSame ? Vec2{} : 2.0 * half;
}

}  // namespace orca::hw
