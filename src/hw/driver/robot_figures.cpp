// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/hw/robot_figures.hpp"

#include <utility>

#include "link_tree.hpp"
#include "orca/base/portable_math.hpp"
#include "orca/base/text.hpp"
#include "orca/robot_file/codes.hpp"
#include "orca/robot_file/reader.hpp"
#include "orca/xml/extras.hpp"

namespace orca::hw {
namespace {

constexpr double kLevel = 1e-9;  // what a level laser may be off, as 1 - cos of the tilt

// @param at  its element.
void place(robot_file::LaserScanner& laser, const LinkTree& tree, const xml::Element& at,
           xml::Reporter& reporter) {
  const Eigen::Isometry3d place = tree.place_of(laser.link);
  laser.center = {place.translation().x(), place.translation().y(),
                  portable::atan2(place(1, 0), place(0, 0))};
  laser.height = place.translation().z();
  laser.upside_down = place(2, 2) < 0.0;
  if (laser.upside_down)
    for (robot_file::LaserScanner::Sector& sector : laser.ignore) sector = {-sector.to, -sector.from};
  if (std::abs(place(2, 2)) < 1.0 - kLevel)
    reporter.error(robot_file::codes::kContradiction, at.position(),
                   "the laser " + in_quotes(laser.name) +
                       " is tilted; drivers know lasers that look horizontally only, upright or upside down");
}

RobotFigures figures_of(const xml::Element& robot, xml::Reporter& reporter) {
  RobotFigures figures;
  const xml::Element* const orca = read_devices(robot, figures, reporter);
  if (orca == nullptr) return figures;
  const LinkTree tree(robot, reporter);
  auto laser = figures.lasers.begin();
  for (const xml::Element& e : orca->children())
    if (e.name() == "laser" && laser != figures.lasers.end()) place(*laser++, tree, e, reporter);
  figures.size = plan_size(robot, tree);
  figures.usual = robot_file::usual_figures_text(*orca);
  return figures;
}

}  // namespace

std::vector<double> RobotFigures::bumper_directions() const {
  std::vector<double> all;
  for (const robot_file::BumperRing& ring : bumpers)
    for (std::size_t i = 0; i < ring.count; ++i) all.push_back(ring.segment(i).yaw);
  return all;
}

std::optional<RobotFigures> read_robot_figures(const std::string& path, std::vector<HardwareFault>& faults) {
  if (path.empty()) return std::nullopt;
  xml::Diagnostics diagnostics;
  const Result<std::string> bytes = xml::read_bytes(path);
  const std::optional<xml::Document> document =
      bytes ? xml::read_text(xml::without_extras(*bytes), path, diagnostics)
            : xml::read_file(path, diagnostics);
  RobotFigures figures;
  xml::Reporter reporter(diagnostics);
  if (document && !diagnostics.has_errors()) figures = figures_of(document->root, reporter);
  for (const xml::Diagnostic& wrong : diagnostics.sorted())
    if (wrong.severity == xml::Severity::error)
      faults.push_back({"robot", wrong.position.text() + ": " + wrong.message});
  return diagnostics.has_errors() ? std::nullopt : std::optional(std::move(figures));
}

}  // namespace orca::hw
