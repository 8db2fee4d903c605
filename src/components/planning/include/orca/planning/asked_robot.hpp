// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

#include "orca/component.hpp"
#include "orca/geometry/objects/description.hpp"
#include "orca/idl/hardware.hpp"
#include "orca/idl/system.hpp"
#include "orca/navigation/footprint.hpp"

namespace orca::planning {

/// The robot's body, as the base reports it. Zero: it does not.
struct Body {
  double radius = 0.0;        ///< [m]
  double length = 0.0;        ///< [m]
  double width = 0.0;         ///< [m]
  double max_speed = 0.0;     ///< [m/s]
  double max_rate = 0.0;      ///< [rad/s]
  double acceleration = 0.0;  ///< [m/s2]

  /// Returns its outline: the circle cuts the corners of the rectangle, as both hold the body.
  [[nodiscard]] nav::Footprint outline() const { return {0.5 * length, 0.5 * width, radius}; }
};

/// The port by which a planner asks the base about the robot, and the answer.
///
/// Thread contract: as the component that owns it.
class AskedRobot {
 public:
  explicit AskedRobot(
      Component& owner,
      std::string text = "Base that is asked about the robot's outline and how fast it can be.")
      : port_(owner, "robot", {.text = std::move(text), .optional = true}) {}

  /// Returns what is wrong if nobody can be asked, for a component that cannot do without.
  [[nodiscard]] Status check() const {
    if (port_.connected()) return ok();
    return fail(
        Code::failed_precondition,
        "it does not know the robot's outline: connect its port \"robot\" to the RobotQuery of the base");
  }
  /// Asks, unless the port is not connected.
  /// @errors  those of the port.
  Status ask() {
    body_.reset();
    slides_ = false;
    if (!port_.connected()) return ok();
    const Result<QueryId> sent = port_.query_request(port_.loan());
    if (!sent) return fail(sent.error().code, "cannot ask the base about the robot: " + sent.error().message);
    question_ = *sent;
    return ok();
  }
  /// Looks for the answer.
  /// @errors  those of the base, and of check_description().
  Status learn() {
    const auto answer = question_ ? port_.query_receive(*question_) : std::nullopt;
    if (!answer) return ok();
    question_.reset();
    if (!*answer)
      return fail(answer->error().code, "the base does not describe the robot: " + answer->error().message);
    const idl::Robot& robot = ***answer;
    if (Status sound = check_description(robot); !sound.ok()) return sound;
    body_ = Body{std::max(robot.radius(), robot.bumper_radius()), robot.length(), robot.width()};
    for (const idl::Drive& drive : robot.drives()) {
      body_->max_speed = drive.max_speed();
      body_->max_rate = drive.max_steer_speed();
      body_->acceleration = drive.speed_change();
      slides_ = slides_ || drive.type() == idl::HOLONOMIC;
    }
    return ok();
  }
  /// Waits for no answer any more.
  void leave() {
    if (question_) port_.query_forget(*question_);
    question_.reset();
  }
  /// Returns whether the answer is still to come.
  [[nodiscard]] bool is_asked() const { return question_.has_value(); }
  [[nodiscard]] const std::optional<Body>& body() const { return body_; }
  /// Returns whether the base has said that it can move sideways.
  [[nodiscard]] bool slides() const { return slides_; }
  /// Names what a successor of the component goes on with.
  [[nodiscard]] auto state() { return std::tie(body_); }

 private:
  QueryProxy<idl::Ask, idl::Robot> port_;
  std::optional<QueryId> question_;  // to the base, as long as it has not answered
  std::optional<Body> body_;
  bool slides_ = false;
};

}  // namespace orca::planning
