// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <utility>

#include "orca/component.hpp"
#include "orca/geometry/pose2.hpp"
#include "orca/goals/route.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/time.hpp"

namespace orca::go {

/// The ports and the goal of a component that takes goals in the place of a driver, such as Goto, and passes points on to it.
///
/// Thread contract: as the component that owns it.
class GoalRelay {
 public:
  /// The words in which the ports of such components differ.
  struct Words {
    std::string driver;  ///< who takes the points
    std::string done;    ///< text of ArrivedPush
    std::string undone;  ///< text of GoalFailedPush
  };
  /// The goal under way, with which a successor of the component goes on.
  struct Task {
    ObjectPtr<idl::GoalPoint> goal;  ///< The last point that came, until its result; null: there is none.
    std::uint64_t mission =
        0;  ///< Only its results count: the mission of the point that came or was sent last.
  };

  /// @param on_goal  the handler of goals, which calls keep().
  template <class Owner>
  GoalRelay(Owner& owner, ComponentHost& host, Status (Owner::*on_goal)(const ObjectPtr<idl::GoalPoint>&),
            const Words& words)
      : host_(host),
        goals_(owner, "GotoCoordinateSend", on_goal,
               {.text = "Via points and goals, as " + words.driver + " takes them."}),
        done_(owner, "ArrivedPush", {.text = words.done}),
        undone_(owner, "GoalFailedPush", {.text = words.undone}),
        driver_(owner, "goto", {.text = "Where to drive to."}),
        arrived_(owner, "arrived", {.text = "Arrivals of " + words.driver + "."}),
        failed_(owner, "failed", {.text = "Goals that " + words.driver + " has given up."}) {}

  [[nodiscard]] Task& task() { return task_; }
  [[nodiscard]] const Task& task() const { return task_; }
  [[nodiscard]] const ObjectPtr<idl::GoalPoint>& goal() const { return task_.goal; }
  /// Makes a point that has come the goal. One that no robot can take is reported as refused, and the goal of before stays.
  /// @errors  invalid_argument.
  Status keep(const ObjectPtr<idl::GoalPoint>& goal) {
    const double height = goal->coordinate().point().z();  // the driver knows that of the robot
    if (const char* const fault = fault_of(*goal, height)) {
      report_failure(*goal, idl::GOAL_REFUSED, std::string("refused: it ") + fault);
      return fail(Code::invalid_argument, "the goal \"" + goal->name() + "\" " + fault);
    }
    task_ = {goal, goal->mission()};
    return ok();
  }
  /// Sends a point to the driver.
  /// @errors  those of the port.
  Status pass_on(Loan<idl::GoalPoint> point) {
    task_.mission = point->mission();
    return driver_.send(std::move(point));
  }

  /// Returns the next result of the driver that has come and is not too late; null: there is none.
  [[nodiscard]] ObjectPtr<idl::Arrived> next_arrival() { return next(arrived_); }
  [[nodiscard]] ObjectPtr<idl::GoalFailed> next_failure() { return next(failed_); }

  /// Passes on a result of the driver as the goal's, and ends the mission.
  /// @param name  under which a failure is reported.
  void end_as(const idl::Arrived& arrived) {
    done_.push(arrived);
    end();
  }
  void end_as(const idl::GoalFailed& failed, const std::string& name) {
    auto own = make_object(failed);
    own->name() = name;
    undone_.push(std::move(own));
    end();
  }
  /// Reports that the goal is reached, or why it is not. @pre  goal()
  void report_arrival(const Pose2& pose) {
    auto arrived = done_.loan();
    arrived->name() = goal()->name();
    arrived->x(pose.x);
    arrived->y(pose.y);
    arrived->stamp(to_time_value(host_.now()));
    done_.push(std::move(arrived));
  }
  void report_failure(idl::GoalFailure kind, const std::string& reason) {
    report_failure(*goal(), kind, reason);
  }
  /// Ends the mission: there is no goal under way.
  void end() {
    task_.goal = {};
    host_.end_mission();
  }

 private:
  void report_failure(const idl::GoalPoint& goal, idl::GoalFailure kind, const std::string& reason) {
    auto failed = undone_.loan();
    failed->mission(goal.mission());
    failed->name() = goal.name();
    failed->kind(kind);
    failed->reason() = reason;
    failed->stamp(to_time_value(host_.now()));
    undone_.push(std::move(failed));
  }
  template <class Result>
  ObjectPtr<Result> next(PushProxy<Result>& results) {
    while (results.new_data_arrived())
      if (auto result = results.get_update(); goal() && result->mission() == task_.mission) return result;
    return {};
  }

  ComponentHost& host_;
  SendServer<idl::GoalPoint> goals_;
  PushServer<idl::Arrived> done_;
  PushServer<idl::GoalFailed> undone_;
  SendProxy<idl::GoalPoint> driver_;
  PushProxy<idl::Arrived> arrived_;
  PushProxy<idl::GoalFailed> failed_;
  Task task_;
};

}  // namespace orca::go
