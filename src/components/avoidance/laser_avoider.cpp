// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/laser_avoider.hpp"

#include <numbers>

#include "orca/avoidance/scan.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::avoid {
namespace {

// [m] Echoes as near to each other as that are one, if those beside what is seen must not be drawn into it.
constexpr double kErrorOfReading = 0.01;
constexpr double kSector = std::numbers::pi / 36;

}  // namespace

LaserAvoider::LaserAvoider(ComponentHost& host, bool keeps_hidden, double memory_time)
    : Avoider(host, memory_time, memory_time),
      keeps_hidden_(keeps_hidden),
      squeeze_(
          *this, "squeeze", true,
          {.text =
               "Whether the robot passes where half its width finds room if its circle finds no way nearby; "
               "otherwise only where its circle does."}),
      robot_length_(
          *this, "robot_length", 0.0,
          {.unit = "m",
           .min = 0.0,
           .text =
               "Length of a robot that is longer than wide, unless the base says it; 0: the circle is all."}),
      robot_width_(*this, "robot_width", 0.0, {.unit = "m", .min = 0.0, .text = "Its width."}) {}

std::optional<Rectangle> LaserAvoider::body() const {
  if (!*squeeze_) return std::nullopt;
  const std::optional<Rectangle> described = described_body();
  return described ? described : rectangle(*robot_length_, *robot_width_);
}

Limits LaserAvoider::with_body(const EchoMemory& memory, const Situation& situation, Limits limits) const {
  limits.body = body();
  limits.squeezes = limits.body && should_squeeze(memory.echoes(), situation, limits);
  return limits;
}

const ObjectType& LaserAvoider::sensed() const { return object_type<idl::LaserRangeReadings>(); }

// The scan was taken a moment ago, from the robot's pose at that time.
void LaserAvoider::listen(EchoMemory& memory) {
  const auto readings = laser_.get_update();
  const Pose2 mount = plane_pose(readings->pose());
  const double age = to_seconds(now() - to_time_point(readings->stamp()));
  const Vec2 place = moved_since(mount.position(), age);
  const double yaw = mount.yaw - turned_since(age);
  const Scan scan{readings->ranges(),      readings->min_range(),       readings->max_range(),
                  readings->angle_start(), readings->angle_increment(), {place.x, place.y, yaw}};
  EchoMemory::Limits kept = keep();
  kept.hidden = keeps_hidden_;
  if (keeps_hidden_) kept.no_news = kErrorOfReading;
  see(scan, kSector, farthest(), kept, memory);
}

}  // namespace orca::avoid
