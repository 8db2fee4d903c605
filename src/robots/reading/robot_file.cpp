// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/robots/robot_file.hpp"

#include "mounts.hpp"
#include "orca/robots/codes.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/document.hpp"
#include "robot_extension.hpp"
#include "robot_rules.hpp"
#include "urdf_body.hpp"
#include "urdf_check.hpp"
#include "urdf_parts.hpp"

namespace orca::robots {
namespace {

void check_body(const Characteristics& robot, const xml::Attributes& root) {
  if (robot.mass <= 0.0)
    root.error(codes::kMass, "no link of the robot has a mass; give its main link an <inertial>");
  if (robot.parts.empty())
    root.error(codes::kMissing,
               "no link of the robot has a <collision>; without one it would pass through walls");
}

// @pre  the root is <robot> and has an <orca>; urdf and extension are checked as far as they stand alone.
void read_body(const xml::Element& root, const xml::Element& orca, const detail::MeshHulls& hulls,
               BodyReader* body_reader, Characteristics& robot, xml::Reporter& reporter) {
  const xml::Attributes attributes(root, detail::kRobotFile, reporter);
  Result<detail::UrdfBody> body = detail::read_urdf_body(root, robot.urdf, hulls);
  if (!body) return attributes.error(codes::kUrdfdom, body.error().message);
  robot.name = body->name;
  robot.mass = body->mass;
  robot.yaw_inertia = body->yaw_inertia;
  robot.parts = body->parts;
  check_body(robot, attributes);
  if (body_reader != nullptr && !robot.parts.empty())
    body_reader->check(robot, {orca, detail::kRobotFile, reporter});
  detail::mount_devices(robot, *body, orca, body_reader, reporter);
}

std::optional<Characteristics> read_root(const xml::Element& root, std::string text,
                                         xml::Diagnostics& diagnostics, BodyReader* body) {
  const std::size_t before = diagnostics.error_count();
  xml::Reporter reporter(diagnostics);
  const xml::Attributes robot(root, detail::kRobotFile, reporter);
  if (root.name() != "robot")
    return robot.refuse(codes::kWrongRoot, "the root element is <" + root.name() +
                                               ">; a robot file begins with <robot name=\"...\">");
  robot.require("name");
  detail::MeshHulls hulls;
  detail::check_urdf(root, reporter, body, hulls);
  const bool urdf_is_sound = diagnostics.error_count() == before;
  Characteristics model;
  model.urdf = std::move(text);
  const xml::Element* orca = detail::only_child(root, "orca");
  if (orca == nullptr)
    return robot.refuse(codes::kMissing,
                        "<robot> needs the element <orca radius=\"...\"> with its drive and sensors");
  detail::read_extension(*orca, model, reporter);
  detail::check_mounts(root, *orca, reporter);
  if (urdf_is_sound) read_body(root, *orca, hulls, body, model, reporter);
  if (diagnostics.error_count() != before) return std::nullopt;
  return model;
}

}  // namespace

std::optional<Characteristics> read_robot_text(std::string_view text, const std::string& file_name,
                                               xml::Diagnostics& diagnostics, BodyReader* body) {
  const std::size_t before = diagnostics.error_count();
  const auto document = xml::read_text(text, file_name, diagnostics);
  if (!document || diagnostics.error_count() != before) return std::nullopt;
  return read_root(document->root, std::string(text), diagnostics, body);
}

std::optional<Characteristics> read_robot(const std::string& path, xml::Diagnostics& diagnostics,
                                          BodyReader* body) {
  const std::size_t before = diagnostics.error_count();
  const Result<std::string> bytes = xml::read_bytes(path);
  const auto document = bytes ? xml::read_text(*bytes, path, diagnostics) : xml::read_file(path, diagnostics);
  if (!bytes || !document || diagnostics.error_count() != before) return std::nullopt;
  return read_root(document->root, *bytes, diagnostics,
                   body);  // urdfdom has its own parser and needs the text
}

}  // namespace orca::robots
