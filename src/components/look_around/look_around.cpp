// SPDX-License-Identifier: LGPL-3.0-or-later
#include <optional>
#include <string>

#include "orca/avoidance/laser_avoider.hpp"
#include "orca/component/held_motors.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/time.hpp"
#include "outlook.hpp"

namespace {

/// A behaviour that looks around while the localizer does not know where the robot is: it turns, and drives a little way to other views. While
/// that is known it has no opinion. See README.md.
class LookAround final : public orca::avoid::LaserAvoider {
 public:
  explicit LookAround(orca::ComponentHost& host)
      : LaserAvoider(host, {.shapes = true, .time = kMemoryTime, .range = orca::look::Panorama::kFar}) {}

 private:
  orca::Status configure() override {
    if (!remembers())
      return orca::fail(orca::Code::failed_precondition,
                        "connect its port odometry: it must know how far it has turned");
    return LaserAvoider::configure();
  }

  orca::Status start() override {
    settle();
    return LaserAvoider::start();
  }

  orca::avoid::Advice advice(const orca::avoid::EchoMemory& memory, const orca::avoid::Situation& situation,
                             const orca::avoid::Limits& limits) override {
    const orca::Duration held = held_.since_last(now(), kept_alarms());
    if (lost_since_) *lost_since_ += held;  // it does not turn meanwhile
    if (!situation.is_heeded) settle();
    if (!situation.is_heeded || !is_lost()) {
      note_known();
      return {};
    }
    if (!lost_since_) {
      // A robot that is lost was perhaps carried: what lay around it is not there any more.
      lost_since_ = now();
      outlook_.reset();
      return {.forgets = true};
    }
    const double time = orca::to_seconds(now() - *lost_since_);
    if (time < kPatience || gave_up_) return {};
    if (orca::to_seconds(looked_) + time > kPatience + *limit_) {
      give_up();
      return {};
    }
    orca::look::Limits mine{.body = with_body(memory.echoes(), situation, limits), .turn_rate = *turn_rate_};
    mine.body.slides = false;  // It turns to where it drives, as its view does.
    mine.body.watches_goal = true;
    const orca::Pose2 here{situation.place.x, situation.place.y, situation.heading};
    const orca::look::Moment moment{time, here, situation, memory.echoes()};
    return outlook_.step(moment, mine).value_or(orca::avoid::Advice{});
  }

  [[nodiscard]] bool is_lost() const {
    const auto state = localization_.latest();
    return state && state->state() != orca::idl::LOCALIZATION_LOCALIZED &&
           orca::to_seconds(now() - orca::to_time_point(state->creation_time())) <= kFresh;
  }

  // In a building of which the map is of another one, a localizer may believe for some seconds in a place that is none.
  void note_known() {
    constexpr orca::Duration kBelieved = std::chrono::seconds(30);
    if (lost_since_) {
      looked_ += now() - *lost_since_;
      known_since_ = now();
      lost_since_.reset();
    }
    if (now() - known_since_ >= kBelieved) settle();
  }

  // The next time it has all its time again.
  void settle() {
    lost_since_.reset();
    looked_ = orca::Duration{0};
    gave_up_ = false;
  }

  void give_up() {
    gave_up_ = true;
    log_warning(
        "the robot has looked around for " + std::to_string(std::lround(*limit_)) +
        " s and does not know where it is; say it by a RobotPose to the localizer, or drive the robot to "
        "where it looks like nowhere else");
  }

  static constexpr double kMemoryTime = 15.0;  // [s] longer than a turn
  static constexpr double kFresh = 1.0;        // [s]
  // [s] for which the robot stands first: its localizer may find it at once.
  static constexpr double kPatience = 1.5;

  orca::PushProxy<orca::idl::Localization> localization_{
      *this, "localization", {.text = "How well it is known where the robot is: a Localizer."}};
  orca::Param<double> limit_{
      *this,
      "limit",
      90.0,
      {.unit = "s", .min = 0.0, .text = "Time of looking around after which it gives up."}};
  orca::Param<double> turn_rate_{
      *this, "turn_rate", 1.0, {.unit = "rad/s", .min = 0.05, .text = "Turn rate of its turns on the spot."}};
  orca::look::Outlook outlook_;
  std::optional<orca::TimePoint> lost_since_;  // while it is not known where the robot is
  orca::TimePoint known_since_{};              // or was last
  orca::Duration looked_{0};                   // before lost_since_
  orca::HeldTime held_;
  bool gave_up_ = false;
};

}  // namespace

ORCA_COMPONENT(LookAround, "orca.LookAround")
