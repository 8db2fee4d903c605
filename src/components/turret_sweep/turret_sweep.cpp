// SPDX-License-Identifier: LGPL-3.0-or-later
#include <cmath>
#include <string>

#include "orca/component.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "sweep.hpp"

namespace {

orca::Status check_angle(const orca::idl::TurretAngle& turret) {
  if (std::isfinite(turret.angle())) return orca::ok();
  return orca::fail(orca::Code::data_loss,
                    "angle is " + std::to_string(turret.angle()) + "; expected a finite number");
}

/// Turns a turret round and round while the robot moves, so that the sensors on it see what stands between their beams. See README.md.
class TurretSweep final : public orca::Component {
 public:
  explicit TurretSweep(orca::ComponentHost& host) : Component(host) { lap_on(angle_); }

 private:
  orca::Status configure() override {
    stay_active(true);  // Nobody subscribes to it.
    return orca::ok();
  }

  orca::Status start() override {
    is_refused_ = false;
    return orca::ok();
  }

  orca::Outcome work() override {
    const auto turret = angle_.get_update();
    if (senders_.accepts(*turret, check_angle(*turret)))
      point(orca::turret::next_angle(motion(), turret->angle(), *lead_));
    return orca::again();
  }

  // Returns how the robot moves; a robot of which nothing is known rests.
  [[nodiscard]] orca::Twist2 motion() {
    constexpr double kFresh = 0.6;  // [s]
    const auto odometry = odometry_.latest();
    if (!odometry || !senders_.accepts(*odometry)) return {};
    const double age = orca::to_seconds(now() - orca::to_time_point(odometry->stamp()));
    if (!orca::check_age(age, kFresh).ok()) return {};
    return {odometry->translational_velocity(), odometry->sideways_velocity(), odometry->steering_velocity()};
  }

  // Says it each lap: a base whose driver was exchanged knows nothing of an earlier command.
  void point(double angle) {
    auto command = turret_.loan();
    command->angle(angle);
    const orca::Status told = turret_.send(std::move(command));
    if (!told.ok() && !is_refused_)
      log_warning("the turret is not turned, and its sensors do not see what stands between their beams: " +
                  told.error().text());
    is_refused_ = !told.ok();
  }

  orca::PushProxy<orca::idl::TurretAngle> angle_{
      *this, "angle", {.text = "Direction in which the turret points."}};
  orca::PushProxy<orca::idl::Odometry> odometry_{
      *this, "odometry", {.text = "Motion of the robot, by its wheels."}};
  orca::SendProxy<orca::idl::TurretCommand> turret_{
      *this, "turret", {.text = "The turret: a robot base that has one."}};
  orca::Param<double> lead_{
      *this,
      "lead",
      1.57,
      {.unit = "rad",
       .min = -3.0,
       .max = 3.0,
       .text =
           "Angle from where the turret points to where it is pointed while the robot moves, to the left if "
           "positive; a small one makes it slower than it can be. 0: it points ahead."}};

  orca::SenderWatch senders_{host()};
  bool is_refused_ = false;
};

}  // namespace

ORCA_COMPONENT(TurretSweep, "orca.TurretSweep")
