// SPDX-License-Identifier: LGPL-3.0-or-later
#include <numbers>

#include "orca/avoidance/avoider.hpp"
#include "orca/avoidance/scan.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace {

/// An avoid behaviour that keeps the robot from driving into what its laser sees (thesis 11.1). See
/// README.md.
class LaserAvoid final : public orca::avoid::Avoider {
 public:
  explicit LaserAvoid(orca::ComponentHost& host) : Avoider(host, 4.0) {}

 private:
  static constexpr double kSector = std::numbers::pi / 36;

  orca::PushProxyHandle& sensor() override { return laser_; }
  [[nodiscard]] const orca::ObjectType& sensed() const override {
    return orca::object_type<orca::idl::LaserRangeReadings>();
  }

  // The scan was taken a moment ago, from the robot's pose at that time.
  void listen(orca::avoid::EchoMemory& memory) override {
    const auto readings = laser_.get_update();
    const orca::Pose2 mount = orca::plane_pose(readings->pose());
    const double age = orca::to_seconds(now() - orca::to_time_point(readings->stamp()));
    const orca::Vec2 place = moved_since(mount.position(), age);
    const double yaw = mount.yaw - turned_since(age);
    const orca::avoid::Scan scan{readings->ranges(),          readings->min_range(),
                                 readings->max_range(),       readings->angle_start(),
                                 readings->angle_increment(), {place.x, place.y, yaw}};
    orca::avoid::see(scan, kSector, farthest(), keep(), memory);
  }

  orca::PushProxy<orca::idl::LaserRangeReadings> laser_{*this, "laser", {.text = "Scans of the laser."}};
};

}  // namespace

ORCA_COMPONENT(LaserAvoid, "orca.LaserAvoid")
