// SPDX-License-Identifier: LGPL-3.0-or-later
#include "robot_extension.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "extension_readers.hpp"
#include "orca/sim/world.hpp"

namespace orca::sim::detail {
namespace {

struct Kind {
  const char* name;
  bool once;  // A robot has at most one.
  void (*read)(const Attributes& e, RobotModel& model);
};

constexpr std::array kKinds{
    Kind{"drive", true, read_drive},
    Kind{"turret", true, read_turret},
    Kind{"sonar_ring", false, read_sonar_ring},
    Kind{"laser", false, read_laser},
    Kind{"infrared_ring", false, read_infrared_ring},
    Kind{"bumper_ring", false, read_bumper_ring},
    Kind{"odometry", true, read_odometry},
};

std::vector<std::string> kind_names() {
  std::vector<std::string> names;
  for (const Kind& kind : kKinds) names.emplace_back(kind.name);
  return names;
}

void read_robot_attributes(const Attributes& e, RobotModel& model) {
  model.vendor = e.text_or("vendor", "");
  model.model = e.text_or("model", "");
  set(model.radius, e.quantity("radius", "m", Sign::positive));
  set(model.bumper_radius, e.quantity_or("bumper_radius", "m", Sign::positive, model.radius));
  if (model.bumper_radius < model.radius)
    e.error_at("bumper_radius", 22, "bumper_radius must not be less than radius: the bumper is outside");
}

}  // namespace

void check_period(const Attributes& e, Duration period) {
  if (period < World::kTick || period > std::chrono::hours{1})
    e.error_at("period", 22, "the period must be between the simulation's tick of 10 ms and an hour");
}

void read_extension(const xml::Element& orca, RobotModel& model, xml::Diagnostics& diagnostics) {
  const Attributes e(orca, 'R', diagnostics);
  e.allow({"vendor", "model", "radius", "bumper_radius"}, kind_names());
  read_robot_attributes(e, model);
  std::set<std::string> seen;
  for (const xml::Element& child : orca.children()) {
    const auto kind = std::ranges::find(kKinds, child.name(), &Kind::name);
    if (kind == kKinds.end()) continue;
    const Attributes element(child, 'R', diagnostics);
    if (!seen.insert(child.name()).second && kind->once) {
      element.error(10, "there is a <" + child.name() + "> already; a robot has one");
    } else {
      kind->read(element, model);
    }
  }
  if (!seen.contains("drive")) e.error(4, "<orca> needs the element <drive>");
}

}  // namespace orca::sim::detail
