// SPDX-License-Identifier: LGPL-3.0-or-later
#include "urdf_body.hpp"

#include <LinearMath/btTransform.h>
#include <urdf_parser/urdf_parser.h>
#include <algorithm>
#include <exception>

#include "orca/base/portable_math.hpp"
#include "orca/xml/attributes.hpp"
#include "urdf_check.hpp"

namespace orca::sim::detail {
namespace {

btTransform transform_of(const urdf::Pose& pose) {
  const urdf::Rotation& r = pose.rotation;
  return btTransform(btQuaternion(r.x, r.y, r.z, r.w),
                     btVector3(pose.position.x, pose.position.y, pose.position.z));
}

Pose3 pose_of(const btTransform& X) {
  const btVector3& p = X.getOrigin();
  const btQuaternion q = X.getRotation();
  return {p.x(), p.y(), p.z(), q.x(), q.y(), q.z(), q.w()};
}

Part::Hull hull_of(const urdf::Mesh& mesh, const MeshHulls& hulls) {
  Part::Hull hull{hulls.at(mesh.filename)};
  for (Vec3& p : hull.corners) p = {mesh.scale.x * p.x, mesh.scale.y * p.y, mesh.scale.z * p.z};
  return hull;
}

Part part_of(const urdf::Collision& collision, const btTransform& X_BL, const MeshHulls& hulls) {
  Part part;
  part.X_BP = pose_of(X_BL * transform_of(collision.origin));
  if (const auto* box = dynamic_cast<const urdf::Box*>(collision.geometry.get()))
    part.form = Part::Block{box->dim.x, box->dim.y, box->dim.z};
  if (const auto* cylinder = dynamic_cast<const urdf::Cylinder*>(collision.geometry.get()))
    part.form = Part::Cylinder{cylinder->radius, cylinder->length};
  if (const auto* ball = dynamic_cast<const urdf::Sphere*>(collision.geometry.get()))
    part.form = Part::Ball{ball->radius};
  if (const auto* mesh = dynamic_cast<const urdf::Mesh*>(collision.geometry.get()))
    part.form = hull_of(*mesh, hulls);
  return part;
}

// Adds a link's mass and its inertia about the base's z axis. The inertia is rotated into the base's axes and
// moved there by the parallel-axis theorem.
void add_inertial(const urdf::Inertial& inertial, const btTransform& X_BL, UrdfBody& body) {
  const btTransform X_BC = X_BL * transform_of(inertial.origin);
  const btMatrix3x3 about_center(inertial.ixx, inertial.ixy, inertial.ixz, inertial.ixy, inertial.iyy,
                                 inertial.iyz, inertial.ixz, inertial.iyz, inertial.izz);
  const btVector3 z = X_BC.getBasis().getRow(2);
  const btVector3& c = X_BC.getOrigin();
  body.mass += inertial.mass;
  body.yaw_inertia += z.dot(about_center * z) + inertial.mass * (c.x() * c.x() + c.y() * c.y());
}

UrdfJoint joint_of(const urdf::Joint& joint, const btTransform& X_BJ) {
  UrdfJoint made;
  made.X_BJ = pose_of(X_BJ);
  made.continuous = joint.type == urdf::Joint::CONTINUOUS;
  const btVector3 axis(joint.axis.x, joint.axis.y, joint.axis.z);
  if (made.continuous) made.upright = X_BJ.getBasis().getRow(2).dot(axis) / axis.length();
  return made;
}

// @return  the names of the link and of all below it.
std::vector<std::string> add_link(const urdf::Link& link, const btTransform& X_BL, const MeshHulls& hulls,
                                  UrdfBody& body) {
  std::vector<std::string> names{link.name};
  body.links[link.name] = pose_of(X_BL);
  if (link.inertial && link.inertial->mass > 0.0) add_inertial(*link.inertial, X_BL, body);
  for (const auto& collision : link.collision_array) {
    body.parts.push_back(part_of(*collision, X_BL, hulls));
    body.parts.back().link = link.name;
  }
  for (const auto& child : link.child_links) {
    const urdf::Joint& joint = *child->parent_joint;
    const btTransform X_BJ = X_BL * transform_of(joint.parent_to_joint_origin_transform);
    UrdfJoint made = joint_of(joint, X_BJ);
    made.first_part = body.parts.size();
    made.links = add_link(*child, X_BJ, hulls, body);
    made.end_part = body.parts.size();
    names.insert(names.end(), made.links.begin(), made.links.end());
    body.joints[joint.name] = std::move(made);
  }
  return names;
}

// In the values of attributes XML makes a blank of every line end and tab; urdfdom does not.
urdf::ModelInterfaceSharedPtr parsed(std::string text) {
  std::ranges::replace_if(
      text, [](char c) { return c == '\t' || c == '\n' || c == '\r'; }, ' ');
  try {
    return urdf::parseURDF(text);
  } catch (const std::exception&) {  // Thrown for some wrong versions and numbers; null otherwise.
    return nullptr;
  }
}

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

Result<UrdfBody> read_urdf_body(const xml::Element& robot, const std::string& text, const MeshHulls& hulls) {
  const urdf::ModelInterfaceSharedPtr model = parsed(text);
  if (!model || !model->getRoot())
    return fail(Code::invalid_argument,
                "urdfdom does not read this robot; the program check_urdf may say more");
  compute_rotations(robot, *model);
  UrdfBody body;
  body.name = model->getName();
  add_link(*model->getRoot(), btTransform::getIdentity(), hulls, body);
  return body;
}

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
