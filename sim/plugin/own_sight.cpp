// SPDX-License-Identifier: LGPL-3.0-or-later
#include "own_sight.hpp"

#include <set>

#include "orca/base/text.hpp"
#include "orca/xml/number.hpp"

namespace orca::sim {
namespace {

std::string gap_text(const RobotModel& robot, const std::string& kind, const std::string& name,
                     double height) {
  return "the " + kind + " " + in_quotes(name) + " is " + xml::number_text(height) +
         " m above the floor, where a " + in_quotes(robot.name) +
         " has nothing solid, so two of them do not see each other with it; give the robot a <collision> "
         "that "
         "reaches this height, such as the housing of the sensor";
}

class Gaps {
 public:
  explicit Gaps(const RobotModel& robot) : robot_(robot) {}
  void look(const std::string& kind, const std::string& name, double height) {
    if (robot_.section_at(height).empty()) texts_.push_back(gap_text(robot_, kind, name, height));
  }
  [[nodiscard]] std::vector<std::string> take() && { return std::move(texts_); }

 private:
  const RobotModel& robot_;
  std::vector<std::string> texts_;
};

std::set<double> heights_of(const SonarRing& ring) {
  std::set<double> heights;
  for (std::size_t k = 0; k < ring.count; ++k) heights.insert(ring.height_of(k));
  return heights;
}

}  // namespace

std::vector<std::string> gaps_at_own_sensors(const RobotModel& robot) {
  if (robot.fixed) return {};
  Gaps gaps(robot);
  for (const SonarRing& ring : robot.sonars)
    for (const double height : heights_of(ring)) gaps.look("sonar ring", ring.name, height);
  for (const LaserScanner& laser : robot.lasers) gaps.look("laser", laser.name, laser.height);
  for (const InfraredRing& ring : robot.infrareds) gaps.look("infrared ring", ring.name, ring.height);
  return std::move(gaps).take();
}

}  // namespace orca::sim
