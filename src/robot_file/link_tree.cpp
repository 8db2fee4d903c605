// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/robot_file/link_tree.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "orca/base/portable_math.hpp"
#include "orca/robot_file/reader.hpp"
#include "orca/robot_file/rules.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/number.hpp"

namespace orca::robot_file {
namespace {

using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;
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

constexpr double kSame = 1e-9;  // [m] below which two places are one

double number(const Element& e, const char* name) {
  const xml::Attribute* const a = e.attribute(name);
  return a != nullptr ? xml::parse_number(a->value).value_or(0.0) : 0.0;
}

bool is_left_of(Vec2 from, Vec2 to, Vec2 p) { return cross(to - from, p - from) > kSame * kSame; }

// Adds the lower hull of points that are sorted by x, without the last one.
void add_half_hull(const std::vector<Vec2>& points, std::vector<Vec2>& hull) {
  const std::size_t first = hull.size();
  for (const Vec2 p : points) {
    while (hull.size() >= first + 2 && !is_left_of(hull[hull.size() - 2], hull.back(), p)) hull.pop_back();
    hull.push_back(p);
  }
  hull.pop_back();
}

// Returns the corners of the convex hull, counter-clockwise.
std::vector<Vec2> hull_of(std::vector<Vec2> points) {
  std::ranges::sort(points, [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
  std::vector<Vec2> hull;
  add_half_hull(points, hull);
  std::ranges::reverse(points);
  add_half_hull(points, hull);
  return hull;
}

BodyPart box(const Vector3d& size, const Isometry3d& place) {
  std::vector<Vec2> points;
  BodyPart part;
  part.bottom = std::numeric_limits<double>::infinity();
  part.top = -part.bottom;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) {
        const Vector3d corner = place * Vector3d(x * size.x(), y * size.y(), z * size.z());
        points.push_back({corner.x(), corner.y()});
        part.bottom = std::min(part.bottom, corner.z());
        part.top = std::max(part.top, corner.z());
      }
  part.corners = hull_of(std::move(points));
  return part;
}

BodyPart round(double radius, double half_height, const Isometry3d& place) {
  const Vector3d middle = place.translation();
  return {{{middle.x(), middle.y()}}, radius, middle.z() - half_height, middle.z() + half_height};
}

BodyPart cylinder(double radius, double length, const Isometry3d& place) {
  const bool upright = place.linear().col(2).head<2>().norm() < kSame;
  return upright ? round(radius, 0.5 * length, place) : box({2.0 * radius, 2.0 * radius, length}, place);
}

std::optional<BodyPart> part_of(const Element& geometry, const LinkTree& tree, const Isometry3d& place) {
  if (const Element* const e = only_child(geometry, "box")) {
    const std::array<double, 3> size = tree.three(*e, "size");
    return box({size[0], size[1], size[2]}, place);
  }
  if (const Element* const e = only_child(geometry, "cylinder"))
    return cylinder(number(*e, "radius"), number(*e, "length"), place);
  if (const Element* const e = only_child(geometry, "sphere"))
    return round(number(*e, "radius"), number(*e, "radius"), place);
  return std::nullopt;
}

}  // namespace

std::optional<std::vector<BodyPart>> body_parts(const Element& robot, const LinkTree& tree) {
  std::vector<BodyPart> parts;
  for (const Element& link : robot.children()) {
    if (link.name() != "link") continue;
    for (const Element& e : link.children()) {
      if (e.name() != "collision") continue;
      const Element* const geometry = only_child(e, "geometry");
      const Element* const origin = only_child(e, "origin");
      const Isometry3d at = origin != nullptr ? tree.origin(*origin) : Isometry3d::Identity();
      const xml::Attribute* const name = link.attribute("name");
      const Isometry3d place = tree.place_of(name != nullptr ? name->value : "") * at;
      const std::optional<BodyPart> part =
          geometry != nullptr ? part_of(*geometry, tree, place) : std::nullopt;
      if (!part) return std::nullopt;
      parts.push_back(*part);
    }
  }
  return parts;
}

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

Vec2 plan_size(const std::vector<BodyPart>& parts) {
  double round = 0.0;
  double reach = 0.0;
  Vec2 half;
  for (const BodyPart& part : parts) {
    if (part.corners.size() == 1 && norm(part.corners[0]) < kSame) round = std::max(round, part.radius);
    for (const Vec2& p : part.corners) {
      reach = std::max(reach, norm(p) + part.radius);
      half = {std::max(half.x, std::abs(p.x) + part.radius), std::max(half.y, std::abs(p.y) + part.radius)};
    }
  }
  return reach <= round + kSame ? Vec2{} : 2.0 * half;
}

}  // namespace orca::robot_file
