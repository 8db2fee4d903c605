// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/robot_file.hpp"

#include "mounts.hpp"
#include "orca/sim/world.hpp"
#include "orca/xml/attributes.hpp"
#include "orca/xml/document.hpp"
#include "orca/xml/extras.hpp"
#include "orca/xml/number.hpp"
#include "urdf_body.hpp"
#include "urdf_check.hpp"

namespace orca::sim {
namespace {

namespace robot_codes = detail::robot_codes;

static_assert(robot_file::kShortestPeriod == World::kTick);

constexpr double kBumperTolerance = 0.001;     // [m]
constexpr double kBelowFloorTolerance = 0.01;  // [m] wheels of soft rubber may be drawn into the floor

double reach_of(const Shape& footprint) {
  const auto* circle = std::get_if<Circle>(&footprint);
  double reach = circle != nullptr ? circle->radius : 0.0;
  for (const Segment& e : edges_of(footprint)) reach = std::fmax(reach, norm(e.a));
  return reach;
}

void check_body(const RobotModel& model, const xml::Attributes& robot, const xml::Attributes& extension) {
  if (model.mass <= 0.0 && !model.fixed)
    robot.error(robot_codes::kMass, "no link of the robot has a mass; give its main link an <inertial>");
  if (model.mass > 0.0 && model.yaw_inertia <= 0.0 && !model.fixed)
    robot.error(robot_codes::kInertia,
                "all of the robot's mass is on its vertical axis, without an inertia about it; nothing could "
                "turn it");
  if (model.parts.empty())
    return robot.error(robot_codes::kMissing,
                       "no link of the robot has a <collision>; without one it would pass through walls");
  const double reach = reach_of(model.footprint);
  if (reach > model.bumper_radius + kBumperTolerance)
    extension.error_at("bumper_radius", robot_codes::kBumperRadius,
                       "the collision geometry reaches " + xml::number_text(reach) +
                           " m from the axis, but bumper_radius is " + xml::number_text(model.bumper_radius) +
                           " m; make them agree");
}

// Public robots often have their root link at the axle of the wheels.
void check_floor(const RobotModel& model, const xml::Element& root, xml::Reporter& reporter) {
  if (model.parts.empty() || model.fixed || model.bottom >= -kBelowFloorTolerance) return;
  const std::string depth = xml::number_text(-model.bottom);
  reporter.diagnostics().warning(
      robot_codes::kBelowFloor, root.position(),
      "the robot reaches " + depth +
          " m below its root link, which stands on the floor, so all of it is that much too low; "
          "put a link in front of the root, with a fixed joint of xyz=\"0 0 " +
          depth + "\"");
}

// @pre  the root is <robot> and has an <orca>; urdf and extension are checked as far as they stand alone.
void read_body(const xml::Element& root, const xml::Element& orca, const detail::MeshHulls& hulls,
               RobotModel& model, xml::Reporter& reporter) {
  const xml::Attributes robot(root, detail::kRobotFile, reporter);
  Result<detail::UrdfBody> body = detail::read_urdf_body(root, model.urdf, hulls);
  if (!body) return robot.error(robot_codes::kUrdfdom, body.error().message);
  model.name = body->name;
  model.mass = body->mass;
  model.yaw_inertia = body->yaw_inertia;
  model.parts = body->parts;
  if (!model.parts.empty()) {
    model.footprint = footprint_of(model.parts);
    std::tie(model.bottom, model.top) = height_range_of(model.parts);
  }
  check_body(model, robot, {orca, detail::kRobotFile, reporter});
  check_floor(model, root, reporter);
  detail::mount_devices(model, *body, orca, reporter);
}

std::optional<RobotModel> read_root(const xml::Element& root, std::string text, const std::string& packages,
                                    xml::Diagnostics& diagnostics) {
  const std::size_t before = diagnostics.error_count();
  xml::Reporter reporter(diagnostics);
  const xml::Attributes robot(root, detail::kRobotFile, reporter);
  if (root.name() != "robot")
    return robot.refuse(robot_codes::kWrongRoot, "the root element is <" + root.name() +
                                                     ">; a robot file begins with <robot name=\"...\">");
  robot.require("name");
  if (detail::report_xacro(root, reporter)) return std::nullopt;
  detail::MeshHulls hulls;
  detail::check_urdf(root, packages, reporter, hulls);
  const bool urdf_is_sound = diagnostics.error_count() == before;
  RobotModel model;
  model.urdf = std::move(text);
  const xml::Element* const orca = robot_file::read_devices(root, model, reporter);
  if (orca == nullptr) return std::nullopt;
  if (urdf_is_sound) read_body(root, *orca, hulls, model, reporter);
  if (diagnostics.error_count() != before) return std::nullopt;
  if (const std::string usual = robot_file::usual_figures_text(*orca); !usual.empty())
    diagnostics.warning(robot_codes::kUsualFigures, orca->position(), usual);
  return model;
}

}  // namespace

std::optional<RobotModel> read_robot_text(std::string_view text, const std::string& file_name,
                                          xml::Diagnostics& diagnostics, const std::string& packages) {
  const std::size_t before = diagnostics.error_count();
  std::string plain = xml::without_extras(std::string(text));
  const auto document = xml::read_text(plain, file_name, diagnostics);
  if (!document || diagnostics.error_count() != before) return std::nullopt;
  // urdfdom has its own parser and needs the text.
  return read_root(document->root, std::move(plain), packages, diagnostics);
}

std::optional<RobotModel> read_robot(const std::string& path, xml::Diagnostics& diagnostics,
                                     const std::string& packages) {
  const Result<std::string> bytes = xml::read_bytes(path);
  if (bytes) return read_robot_text(*bytes, path, diagnostics, packages);
  static_cast<void>(xml::read_file(path, diagnostics));  // which reports why not
  return std::nullopt;
}

}  // namespace orca::sim
