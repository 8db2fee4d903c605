// SPDX-License-Identifier: LGPL-3.0-or-later
#include "robot_plan.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include "orca/robot_file/reader.hpp"
#include "orca/xml/number.hpp"

namespace orca::hw {
namespace {

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
