// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/sim/robot_file.hpp"

#include <cmath>
#include <tuple>

#include "footprint.hpp"
#include "motion/hull_corners.hpp"
#include "orca/robots/codes.hpp"
#include "orca/robots/robot_file.hpp"
#include "orca/sim/world.hpp"
#include "orca/xml/number.hpp"

namespace orca::sim {
namespace {

namespace codes = robots::codes;

static_assert(robots::kShortestPeriod == World::kTick);

constexpr double kBumperTolerance = 0.001;  // [m]

double reach_of(const Shape& footprint) {
  const auto* circle = std::get_if<Circle>(&footprint);
  double reach = circle != nullptr ? circle->radius : 0.0;
  for (const Segment& e : edges_of(footprint)) reach = std::fmax(reach, norm(e.a));
  return reach;
}

// The solid body of the robot that is read: what the simulator needs beyond the robot's characteristics.
class SolidBody final : public robots::BodyReader {
 public:
  Result<std::vector<Vec3>> hull_of(const std::string& path) override {
    const Result<Mesh> mesh = read_mesh(path);
    if (!mesh) return mesh.error();
    return detail::hull_corners(*mesh);
  }

  void check(const robots::Characteristics& robot, const xml::Attributes& extension) override {
    footprint_ = footprint_of(robot.parts);
    std::tie(bottom_, top_) = height_range_of(robot.parts);
    const double reach = reach_of(footprint_);
    if (reach > robot.bumper_radius + kBumperTolerance)
      extension.error_at("bumper_radius", codes::kBumperRadius,
                         "the collision geometry reaches " + xml::number_text(reach) +
                             " m from the axis, but bumper_radius is " +
                             xml::number_text(robot.bumper_radius) + " m; make them agree");
  }

  void check_turret(const robots::Characteristics& robot, const xml::Attributes& turret) override {
    for (std::size_t i = robot.turret->first_part; i < robot.turret->end_part; ++i)
      if (detail::round_radius(robot.parts[i], robot.turret->axis) < 0.0)
        return turret.error_at(
            "joint", codes::kContradiction,
            "the collision geometry of a turret must be round about its axis, upright cylinders "
            "and spheres on it: the simulator does not turn it");
  }

  [[nodiscard]] std::optional<RobotModel> model_of(std::optional<robots::Characteristics> read) const {
    if (!read) return std::nullopt;
    return RobotModel{std::move(*read), footprint_, bottom_, top_};
  }

 private:
  Shape footprint_;
  double bottom_ = 0.0;
  double top_ = 0.0;
};

}  // namespace

std::optional<RobotModel> read_robot_text(std::string_view text, const std::string& file_name,
                                          xml::Diagnostics& diagnostics) {
  SolidBody body;
  return body.model_of(robots::read_robot_text(text, file_name, diagnostics, &body));
}

std::optional<RobotModel> read_robot(const std::string& path, xml::Diagnostics& diagnostics) {
  SolidBody body;
  return body.model_of(robots::read_robot(path, diagnostics, &body));
}

}  // namespace orca::sim
