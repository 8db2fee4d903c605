// SPDX-License-Identifier: LGPL-3.0-or-later
#include <string>
#include <vector>

#include "orca/component.hpp"
#include "orca/component/sender_life.hpp"
#include "orca/component/sender_watch.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/motion.hpp"
#include "orca/idl/moving.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/idl/time.hpp"
#include "pursuit.hpp"

namespace {

using orca::follow::Person;
using orca::follow::Pursuit;
using orca::follow::Step;

/// A behaviour that follows a person at a distance, on the way that he took. It says by the alarm PERSON_LOST when it has lost him, and follows the next
/// one who walks before it. See README.md.
class FollowPerson final : public orca::Component {
 public:
  explicit FollowPerson(orca::ComponentHost& host) : Component(host) { lap_on(odometry_); }

 private:
  orca::Status start() override {
    motion_.start(lap_period());
    pursuit_.clear();
    last_ = Step::Kind::nobody;
    return orca::ok();
  }
  void stop() override { clear_alarm(kLost, "nobody is followed any more"); }

  orca::Outcome work() override {
    const auto odometry = odometry_.get_update();
    if (!senders_.accepts(*odometry)) {
      motion_.push(orca::full_stop());
      return orca::again();
    }
    if (odometer_.begins_anew(*odometry)) pursuit_.clear();  // all lies elsewhere now
    const Step step = pursuit_.step(orca::plane_pose(*odometry), people(), orca::to_seconds(now()),
                                    {*distance_, *max_speed_, *search_});
    tell(step);
    if (step.aim) show(*step.aim);
    motion_.push(orca::turn(step.turn_rate, step.speed, *weight_));
    return orca::again();
  }

  void show(orca::Vec2 aim) {
    auto goal = goal_.loan();
    goal->name() = "trail";
    goal->coordinate().point().x(aim.x);
    goal->coordinate().point().y(aim.y);
    goal->via(true);
    goal_.push(std::move(goal));
  }

  // Returns who moves; nobody if the tracker is silent.
  std::vector<Person> people() {
    std::vector<Person> people;
    const auto moving = moving_.latest();
    if (!moving || !senders_.accepts(*moving, orca::check_reading(*moving))) return people;
    const double age = orca::to_seconds(now() - orca::to_time_point(moving->stamp()));
    constexpr double kAhead = 0.6;  // [s] Later ones would be taken back along their ways.
    if (age < 0.0 && !senders_.accepts(*moving, orca::check_age(age, kAhead))) return people;
    for (const orca::idl::MovingThing& thing : moving->things())
      people.push_back({thing.number(),
                        {thing.x() + age * thing.velocity_x(), thing.y() + age * thing.velocity_y()},
                        {thing.velocity_x(), thing.velocity_y()},
                        thing.unseen() + age});
    return people;
  }

  void tell(const Step& step) {
    if (step.kind == Step::Kind::follows && last_ != Step::Kind::follows) {
      if (last_ != Step::Kind::searches) log_info("follows somebody");
      clear_alarm(kLost, "it follows somebody");
    }
    if (step.kind == Step::Kind::lost)
      raise_alarm(kLost, orca::idl::ALARM_WARNING,
                  "it does not see any more whom it follows; come back and walk before it");
    last_ = step.kind;
  }

  static constexpr const char* kLost = "PERSON_LOST";

  orca::PushProxy<orca::idl::Odometry> odometry_{*this, "odometry", {.text = "Motion of the robot."}};
  orca::PushProxy<orca::idl::MovingThings> moving_{
      *this, "moving", {.text = "Who moves near the robot: a PersonTracker."}};
  orca::PushServer<orca::idl::MotionCommand> motion_{
      *this, "MotionCmdPush", {.text = "One command per lap: to stand while it follows nobody."}};
  orca::PushServer<orca::idl::GoalPoint> goal_{
      *this,
      "GoalPush",
      {.text = "The place on his way that it drives to now, in the frame of the odometry, once per lap."}};
  orca::Param<double> distance_{
      *this, "distance", 1.2, {.unit = "m", .min = 0.5, .text = "Distance to keep from the person."}};
  orca::Param<double> max_speed_{
      *this, "max_speed", 0.9, {.unit = "m/s", .min = 0.05, .text = "Largest speed."}};
  orca::Param<double> search_{*this,
                              "search",
                              10.0,
                              {.unit = "s",
                               .min = 1.0,
                               .text = "Time of looking for a person out of sight, after which he is lost."}};
  orca::Param<double> weight_{
      *this,
      "weight",
      1.0,
      {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}};

  Pursuit pursuit_;
  Step::Kind last_ = Step::Kind::nobody;
  orca::SenderWatch senders_{host()};
  orca::SenderLife odometer_;
};

}  // namespace

ORCA_COMPONENT(FollowPerson, "orca.FollowPerson")
