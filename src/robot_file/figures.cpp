// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/robot_file/figures.hpp"

#include <cmath>

#include "orca/base/portable_math.hpp"
#include "orca/base/text.hpp"
#include "orca/robot_file/codes.hpp"
#include "orca/robot_file/reader.hpp"
#include "orca/xml/extras.hpp"

namespace orca::robot_file {
namespace {

constexpr double kLevel = 1e-9;   // what a level laser may be off, as 1 - cos of the tilt
constexpr double kPaddle = 0.02;  // [m] thickness of a paddle, which no file says
constexpr double kAbove = 0.05;   // [m] of paddles and load above the root of the paddles

Pose2 plane_pose(const Eigen::Isometry3d& place) {
  return {place.translation().x(), place.translation().y(), portable::atan2(place(1, 0), place(0, 0))};
}

// @param at  its element.
void place(LaserScanner& laser, const LinkTree& tree, const xml::Element& at, xml::Reporter& reporter) {
  const Eigen::Isometry3d place = tree.place_of(laser.link);
  laser.center = plane_pose(place);
  laser.height = place.translation().z();
  laser.upside_down = place(2, 2) < 0.0;
  if (laser.upside_down)
    for (LaserScanner::Sector& sector : laser.ignore) sector = {-sector.to, -sector.from};
  if (std::abs(place(2, 2)) < 1.0 - kLevel)
    reporter.error(codes::kContradiction, at.position(),
                   "the laser " + in_quotes(laser.name) +
                       " is tilted; drivers know lasers that look horizontally only, upright or upside down");
}

// Returns the prism over a rectangle in front of the root of the paddles.
BodyPart before(const Gripper& gripper, double right, double left, double top) {
  const auto at = [&](double x, double y) { return gripper.mount * Vec2{x, y}; };
  return {{at(0.0, right), at(gripper.depth, right), at(gripper.depth, left), at(0.0, left)}, 0.0, 0.0, top};
}

void place_gripper(Figures& figures, const LinkTree& tree) {
  Gripper& gripper = *figures.gripper;
  const Eigen::Isometry3d place = tree.place_of(gripper.link);
  gripper.mount = plane_pose(place);
  gripper.height = place.translation().z();
  figures.paddles = paddles_of(gripper, gripper.lift);
  const double side = 0.5 * gripper.opening;
  figures.load = {before(gripper, -side, side, figures.paddles.front().top)};
}

Figures figures_of(const xml::Element& robot, xml::Reporter& reporter) {
  Figures figures;
  const xml::Element* const orca = read_devices(robot, figures, reporter);
  if (orca == nullptr) return figures;
  const LinkTree tree(robot, reporter);
  auto laser = figures.lasers.begin();
  for (const xml::Element& e : orca->children())
    if (e.name() == "laser" && laser != figures.lasers.end()) place(*laser++, tree, e, reporter);
  if (figures.gripper) place_gripper(figures, tree);
  if (const auto parts = body_parts(robot, tree); parts && !parts->empty()) {
    figures.size = plan_size(*parts);
    figures.parts = *parts;
  }
  figures.usual = usual_figures_text(*orca);
  return figures;
}

}  // namespace

std::vector<BodyPart> paddles_of(const Gripper& gripper, double raised) {
  const double top = gripper.height + raised + kAbove;
  const double side = 0.5 * gripper.opening;
  return {before(gripper, side, side + kPaddle, top), before(gripper, -side - kPaddle, -side, top)};
}

std::optional<Figures> read_figures(const std::string& path, xml::Diagnostics& diagnostics) {
  const Result<std::string> bytes = xml::read_bytes(path);
  const std::optional<xml::Document> document =
      bytes ? xml::read_text(xml::without_extras(*bytes), path, diagnostics)
            : xml::read_file(path, diagnostics);
  if (!document || diagnostics.has_errors()) return std::nullopt;
  xml::Reporter reporter(diagnostics);
  Figures figures = figures_of(document->root, reporter);
  if (diagnostics.has_errors()) return std::nullopt;
  return figures;
}

}  // namespace orca::robot_file
