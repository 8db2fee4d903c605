// SPDX-License-Identifier: LGPL-3.0-or-later
#include "urdf_rotations.hpp"

#include "orca/base/portable_math.hpp"
#include "orca/xml/attributes.hpp"
#include "urdf_parts.hpp"

namespace orca::sim::detail {
namespace {

// A turn about x, y and z in this order, all of the outer frame.
urdf::Rotation turned(double roll, double pitch, double yaw) {
  const auto [cos_roll, sin_roll] = portable::cos_sin(0.5 * roll);
  const auto [cos_pitch, sin_pitch] = portable::cos_sin(0.5 * pitch);
  const auto [cos_yaw, sin_yaw] = portable::cos_sin(0.5 * yaw);
  const urdf::Rotation about_x(sin_roll, 0.0, 0.0, cos_roll);
  const urdf::Rotation about_y(0.0, sin_pitch, 0.0, cos_pitch);
  const urdf::Rotation about_z(0.0, 0.0, sin_yaw, cos_yaw);
  urdf::Rotation whole = about_z * about_y * about_x;
  whole.normalize();
  return whole;
}

// Of an element with an <origin>, or without: then it is not turned.
void compute_rotation(const xml::Element& element, urdf::Pose& pose) {
  const xml::Element* const origin = only_child(element, "origin");
  if (origin == nullptr) return;
  xml::Diagnostics reported_before;
  xml::Reporter reporter(reported_before);
  const xml::Attributes attributes(*origin, kRobotFile, reporter);
  const auto angles = attributes.has("rpy") ? attributes.bare_numbers("rpy", 3) : std::nullopt;
  if (angles) pose.rotation = turned((*angles)[0], (*angles)[1], (*angles)[2]);
}

void compute_rotations_of_link(const xml::Element& element, urdf::Link& link) {
  std::size_t collision = 0;
  for (const xml::Element& child : element.children()) {
    if (child.name() == "collision" && collision < link.collision_array.size())
      compute_rotation(child, link.collision_array[collision++]->origin);
    if (child.name() == "inertial" && link.inertial) compute_rotation(child, link.inertial->origin);
  }
}

}  // namespace

void compute_rotations(const xml::Element& robot, urdf::ModelInterface& model) {
  for (const xml::Element& element : robot.children()) {
    const xml::Attribute* const name = element.attribute("name");
    if (name == nullptr) continue;
    if (const auto joint = model.joints_.find(name->value);
        element.name() == "joint" && joint != model.joints_.end())
      compute_rotation(element, joint->second->parent_to_joint_origin_transform);
    if (const auto link = model.links_.find(name->value);
        element.name() == "link" && link != model.links_.end())
      compute_rotations_of_link(element, *link->second);
  }
}

}  // namespace orca::sim::detail
