// SPDX-License-Identifier: GPL-3.0-or-later
#include <cmath>
#include <cstdio>

#include "orca/component.hpp"
#include "orca/idl/sensing.hpp"

namespace {

/// Reports in the log when a robot begins to move and when it comes to rest, each with the way that it has made by
/// then, and each kStep of that way.
class MotionWatch final : public orca::Component {
  static constexpr double kStep = 0.25;  // [m]

 public:
  explicit MotionWatch(orca::ComponentHost& host) : Component(host) { lap_on("odometry"); }

 private:
  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    look(*odometry_.get_update());
    return orca::again();
  }

  void look(const orca::idl::Odometry& reading) {
    const double way_before = way_;
    if (known_) way_ += std::hypot(reading.x() - x_, reading.y() - y_);
    if (std::floor(way_ / kStep) > std::floor(way_before / kStep)) report("drives on");
    known_ = true;
    x_ = reading.x();
    y_ = reading.y();
    const bool moves =
        std::abs(reading.translational_velocity()) > 0.005 || std::abs(reading.steering_velocity()) > 0.01;
    if (moves == moves_) return;
    moves_ = moves;
    report(moves ? "moves" : "rests");
  }

  void report(const char* what) {
    char text[64];
    std::snprintf(text, sizeof text, "%s after %.2f m", what, way_);
    log_info(text);
  }

  orca::PushProxy<orca::idl::Odometry> odometry_{*this, "odometry"};
  bool known_ = false;
  bool moves_ = false;
  double x_ = 0.0;
  double y_ = 0.0;
  double way_ = 0.0;
};

}  // namespace

ORCA_COMPONENT(MotionWatch, "test.MotionWatch")
