// SPDX-License-Identifier: LGPL-3.0-or-later
#include "mounts.hpp"

#include <cmath>

#include "attributes.hpp"
#include "orca/xml/names.hpp"

namespace orca::sim::detail {
namespace {

void check_links(const std::map<std::string, Pose3>& links, const xml::Element& orca,
                 xml::Diagnostics& diagnostics) {
  std::vector<std::string> names;
  for (const auto& entry : links) names.push_back(entry.first);
  for (const xml::Element& e : orca.children()) {
    const xml::Attribute* link = e.attribute("link");
    if (link == nullptr || !link->intact || links.contains(link->value)) continue;
    Attributes(e, 'R', diagnostics)
        .error_at("link", 12,
                  "there is no link \"" + link->value + "\"" +
                      xml::did_you_mean(xml::nearest_name(link->value, names)));
  }
}

// @tparam Sensor  has link, center and height.
template <class Sensor>
void mount(std::vector<Sensor>& sensors, const std::map<std::string, Pose3>& links) {
  for (Sensor& sensor : sensors) {
    const auto link = links.find(sensor.link);
    if (link == links.end()) continue;
    const Pose3& X = link->second;
    const double yaw = std::atan2(2.0 * (X.qw * X.qz + X.qx * X.qy), 1.0 - 2.0 * (X.qy * X.qy + X.qz * X.qz));
    sensor.center = {X.x, X.y, yaw};
    sensor.height = X.z;
  }
}

}  // namespace

void mount_sensors(RobotModel& model, const std::map<std::string, Pose3>& links, const xml::Element& orca,
                   xml::Diagnostics& diagnostics) {
  check_links(links, orca, diagnostics);
  mount(model.sonars, links);
  mount(model.lasers, links);
  mount(model.infrareds, links);
}

}  // namespace orca::sim::detail
