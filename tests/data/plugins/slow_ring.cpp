// SPDX-License-Identifier: GPL-3.0-or-later
#include <array>

#include "orca/component.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"

namespace {

using namespace std::chrono_literals;

/// Two sonars of a turning robot, which fire in turn, and its odometry, as a base tells them over a slow line: ten times a second,
/// of both sonars each time, and late. From 1 s on the first sonar hears something in `echoes` firings.
class SlowRing final : public orca::Component {
 public:
  explicit SlowRing(orca::ComponentHost& host) : Component(host) { lap_every(100ms); }

 private:
  static constexpr double kMaxRange = 5.0;  // [m]

  orca::Status configure() override {
    stay_active(true);
    return orca::ok();
  }

  orca::Outcome work() override {
    const orca::TimePoint stamp = now() - orca::from_seconds(*lag_);
    const std::size_t fires = static_cast<std::size_t>(laps_++ % 2);
    stamps_[fires] = stamp;
    if (fires == 0) range_ = now() >= orca::TimePoint{1s} && heard_++ < *echoes_ ? 0.6 : kMaxRange;
    push_ring();
    push_odometry(stamp);
    return orca::again();
  }

  void push_ring() {
    auto ring = sonar_.loan();
    ring->ranges() = {range_, kMaxRange};
    ring->poses().resize(2);
    ring->poses()[0].rotation().yaw(*bearing_);
    for (const orca::TimePoint stamp : stamps_) ring->stamps().push_back(orca::to_time_value(stamp));
    ring->max_range(kMaxRange);
    sonar_.push(std::move(ring));
  }

  void push_odometry(orca::TimePoint stamp) {
    auto odometry = odometry_.loan();
    odometry->steer_angle(orca::wrapped(0.1 * static_cast<double>(laps_) * *turn_rate_));
    odometry->steering_velocity(*turn_rate_);
    odometry->stamp(orca::to_time_value(stamp));
    odometry_.push(std::move(odometry));
  }

  orca::PushServer<orca::idl::SonarRangeReadings> sonar_{*this, "sonar"};
  orca::PushServer<orca::idl::Odometry> odometry_{*this, "odometry"};
  orca::PushProxy<orca::idl::MotionCommand> motion_{
      *this, "motion", {.text = "Whoever listens; without anybody they do not."}};
  orca::Param<std::int64_t> echoes_{*this, "echoes", 1, {.min = 0.0}};
  orca::Param<double> bearing_{*this, "bearing", 0.0, {.unit = "rad"}};
  orca::Param<double> turn_rate_{*this, "turn_rate", 0.0, {.unit = "rad/s"}};
  orca::Param<double> lag_{*this, "lag", 0.0, {.unit = "s", .min = 0.0}};
  std::int64_t laps_ = 0;
  std::int64_t heard_ = 0;
  double range_ = kMaxRange;
  std::array<orca::TimePoint, 2> stamps_{};
};

}  // namespace

ORCA_COMPONENT(SlowRing, "test.SlowRing")
