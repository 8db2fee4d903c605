// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/avoidance/avoider.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "orca/base/portable_math.hpp"
#include "orca/component/held_motors.hpp"
#include "orca/geometry/arc.hpp"
#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/description.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::avoid {
namespace {

// A robot that slows down as it is advised has left so much of the way between the two distances to stop.
constexpr double kShareToStop = 0.6;

// [m/s2] At which a base slows down that does not say how fast it does: no robot that Orca knows is slower.
constexpr double kLeastAcceleration = 0.5;

// Returns the weight of the advice: 0 where the way is free, 1 half way, and at the stop distance, where no other wish must move
// the robot on, so much that others have the share `yields`.
double insistence(double urgency, double yields) { return urgency / (1.0 + yields - urgency); }

// Slower than this a robot stands, as far as its odometry and what it remembers are concerned.
bool stands(const Twist2& twist) {
  constexpr double kSlow = 0.005;     // [m/s]
  constexpr double kSlowTurn = 0.01;  // [rad/s]
  return speed_of(twist) < kSlow && std::abs(twist.turn_rate) < kSlowTurn;
}

// A robot that turns on the spot does not get on either.
bool stays(const Twist2& twist) { return speed_of(twist) < 0.005; }

// Returns whether somebody moves near a place in the frame of the odometry: a robot there may stand to let him pass.
bool passes_somebody(const ObjectPtr<idl::MovingThings>& moving, Vec2 place, TimePoint now) {
  constexpr double kBeside = 3.5;  // [m]
  constexpr Duration kFresh = 1s;
  return moving && std::chrono::abs(now - to_time_point(moving->stamp())) <= kFresh &&
         std::ranges::any_of(moving->things(), [&](const idl::MovingThing& thing) {
           return norm(Vec2{thing.x(), thing.y()} - place) <= kBeside;
         });
}

}  // namespace

Avoider::Avoider(ComponentHost& host, const Manner& manner)
    : Component(host),
      odometry_(*this, "odometry",
                {.text = "Motion of the robot; with it recent echoes are remembered and carried along.",
                 .optional = true}),
      goal_(*this, "goal",
            {.text = "Place that the robot drives to; directions near it are preferred.", .optional = true}),
      localizer_(*this, "localizer",
                 {.text = "Pose of the robot in the frame of the goal; if not connected, odometry gives it.",
                  .optional = true}),
      motion_(*this, "motion",
              {.text = "One command per odometry object (if not connected, per sensor object)."}),
      manner_(manner),
      robot_radius_(*this, "robot_radius", 0.205,
                    {.unit = "m",
                     .min = 0.0,
                     .text = "Radius of the circle that holds the robot, unless the base says it."}),
      margin_(*this, "margin", 0.1,
              {.unit = "m", .min = 0.0, .text = "Free space to keep on both sides of the robot."}),
      safe_distance_(
          *this, "safe_distance", 0.8,
          {.unit = "m", .min = 0.1, .text = "Free way ahead from which on there is nothing to avoid."}),
      stop_distance_(*this, "stop_distance", 0.15,
                     {.unit = "m", .min = 0.0, .text = "Free way ahead at which the robot only turns."}),
      sideways_(
          *this, "sideways", false,
          {.text = "Whether it moves a base that can do that sideways, without turning to where it drives."}),
      max_speed_(
          *this, "max_speed", 0.4,
          {.unit = "m/s", .min = 0.0, .text = "Speed at safe_distance; it falls to 0 at stop_distance."}),
      weight_(
          *this, "weight", 2.0,
          {.min = 0.0,
           .text =
               "Weight of its wishes half way between safe_distance (weight 0) and stop_distance (1000 times "
               "this, and 100,000 times where a laser shows the shape of what is near); 0: they never "
               "count."}),
      reaction_time_(
          *this, "reaction_time", 0.25,
          {.unit = "s", .min = 0.0, .text = "Time from an echo until the robot follows the advice."}),
      memory_time_(*this, "memory_time", manner.memory_time,
                   {.unit = "s", .min = 0.0, .text = "Time for which an echo heard at least twice is kept."}),
      echo_time_(*this, "echo_time", manner.echo_time,
                 {.unit = "s", .min = 0.0, .text = "Time for which an echo heard once is kept."}),
      same_place_(
          *this, "same_place", 0.15,
          {.unit = "m", .min = 0.0, .text = "Echoes nearer to each other than this confirm each other."}),
      memory_range_(
          *this, "memory_range", 0.8,
          {.unit = "m",
           .min = 0.0,
           .text = "Echoes farther from the robot's centre are never confirmed: they count for echo_time."}),
      deaf_after_(*this, "deaf_after", 0.6,
                  {.unit = "s",
                   .min = 0.0,
                   .text = "Least time without sensor readings after which the robot stops."}),
      goal_max_age_(*this, "goal_max_age", 0.5,
                    {.unit = "s", .min = 0.0, .text = "Age beyond which a goal is disregarded."}) {}

Status Avoider::params_changed() {
  if (*stop_distance_ < *safe_distance_) return ok();
  return stop_distance_.refuse("it must be less than safe_distance");
}

Status Avoider::configure() {
  if (Status sound = params_changed(); !sound.ok()) return sound;
  if (goal_.connected() && !localizer_.connected() && !odometry_.connected())
    return fail(Code::failed_precondition,
                "with a goal, connect its port localizer or odometry too: it must know where it is");
  lap_on(odometry_.connected() ? odometry_ : sensor());
  return ok();
}

Status Avoider::start() {
  motion_.start(lap_period());
  memory_.clear();
  floor_.clear();
  heard_at_.reset();
  moved_at_.reset();
  last_direction_ = 0.0;
  standing_.reset();
  body_.reset();
  escape_.reset();
  return ask_robot();
}

Status Avoider::ask_robot() {
  if (!robot_.connected()) return ok();
  const Result<QueryId> sent = robot_.query_request(robot_.loan());
  if (!sent) return fail(sent.error().code, "cannot ask the base about the robot: " + sent.error().message);
  question_ = *sent;
  return ok();
}

Status Avoider::learn_robot() {
  const auto answer = question_ ? robot_.query_receive(*question_) : std::nullopt;
  if (!answer) return ok();
  question_.reset();
  if (!*answer)
    return fail(answer->error().code, "the base does not describe the robot: " + answer->error().message);
  const idl::Robot& robot = ***answer;
  if (Status sound = check_description(robot); !sound.ok()) return sound;
  body_ = {std::max(robot.radius(), robot.bumper_radius()), 0.0, robot.length(), robot.width()};
  for (const idl::Drive& drive : robot.drives()) {
    body_->slides = body_->slides || drive.type() == idl::HOLONOMIC;
    body_->acceleration = drive.speed_change();
  }
  // A sensor on a line of its own is none of the base's.
  const auto note = [this](const idl::Sensor& sensor) {
    if (sensor.type() == sensed().name)
      body_->sensor_interval = std::max(body_->sensor_interval, sensor.update_interval());
  };
  std::ranges::for_each(robot.sonar_rings(), note);
  std::ranges::for_each(robot.laser_sensors(), note);
  return ok();
}

void Avoider::stop() {
  if (question_) robot_.query_forget(*question_);
  question_.reset();
}

// Saves the common part; a derived class finds its own again in a lap or two.
void Avoider::save_state(StateWriter& state) const {
  state.write(body_, memory_, pose_, twist_, moved_at_, heard_at_, last_direction_);
}

Status Avoider::load_state(StateReader& state) {
  return state.read(body_, memory_, pose_, twist_, moved_at_, heard_at_, last_direction_);
}

std::vector<StateTag> Avoider::accepted_states() const {
  return {{"orca.Dwa", kStateVersion},        {"orca.LaserAvoid", kStateVersion},
          {"orca.NdPlus", kStateVersion},     {"orca.PotentialField", kStateVersion},
          {"orca.SonarAvoid", kStateVersion}, {"orca.VfhPlus", kStateVersion}};
}

Outcome Avoider::work() {
  if (const Status learnt = learn_robot(); !learnt.ok()) return failed(learnt.error().text());
  if (const auto goal = present_goal()) note_cause(*goal);  // it avoids on the way to that goal
  const bool follows = !odometry_.connected() || follow(*odometry_.get_update());
  if (sensor().new_data_arrived()) {
    if (!odometry_.connected()) memory_.clear();
    heard_at_ = listen(memory_) ? std::optional(now()) : std::nullopt;
  }
  listen_aside(memory_);
  if (follows) {
    advise();
  } else {
    motion_.push(full_stop());
  }
  return again();
}

// Returns whether it knows how the robot moves.
bool Avoider::follow(const idl::Odometry& odometry) {
  if (!is_valid(odometry)) return false;
  if (odometer_.begins_anew(odometry)) {  // what it remembers lies elsewhere now
    memory_.clear();
    floor_.clear();
    escape_.reset();
    moved_at_.reset();
  }
  const TimePoint stamp = to_time_point(odometry.stamp());
  const Pose2 pose = plane_pose(odometry);
  const double pace = stands(twist_) ? manner_.standing_pace : 1.0;
  if (moved_at_) memory_.advance(seen_from(pose_, pose), pace * to_seconds(stamp - *moved_at_), keep());
  moved_at_ = stamp;
  pose_ = pose;
  twist_ = {odometry.translational_velocity(), odometry.sideways_velocity(), odometry.steering_velocity()};
  return true;
}

double Avoider::age_of(TimePoint seen) const {
  return to_seconds((remembers() && moved_at_ ? *moved_at_ : now()) - seen);
}

Vec2 Avoider::moved_since(Vec2 point, double age) const { return seen_from(moved(twist_, age), point); }

void Avoider::advise() {
  const bool hears = heard_at_ && to_seconds(now() - *heard_at_) <= deaf_after() && hears_aside(deaf_after());
  standing_.look(stays(twist_), [&] { return hears && !question_ ? what_holds() : why_deaf(); });
  if (question_ || !hears || is_covered()) {
    motion_.push(full_stop());
    return;
  }
  const Situation here = situation();
  if (const auto way_out = escape(here)) {
    motion_.push(turn(way_out->turn_rate, way_out->speed, *weight_ * insistence(1.0, manner_.yields)));
    return;
  }
  const Advice advised = advice(memory_, here, limits());
  last_direction_ = advised.direction;
  if (advised.forgets) {
    memory_.clear();
    floor_.clear();
  }
  const double weight = *weight_ * insistence(advised.urgency, manner_.yields);
  if (!advised.needed) {
    motion_.push(dont_care());
  } else if (advised.turn_rate) {
    motion_.push(turn(*advised.turn_rate, advised.speed, weight));
  } else if (advised.slides) {
    const Vec2 velocity = advised.speed * direction(advised.direction);
    motion_.push(slide(velocity.x, velocity.y, 0.0, weight));
  } else {
    motion_.push(head(advised.direction, advised.speed, weight));
  }
}

std::string Avoider::why_deaf() {
  if (question_) return "the base has not described the robot yet";
  if (heard_at_ && to_seconds(now() - *heard_at_) <= deaf_after()) return silent_aside(deaf_after());
  const std::uint64_t unmatched = sensor().counters().unmatched;
  std::string text = "nothing valid comes at its port \"" + sensor().name() + "\"";
  if (unmatched > 0)
    text +=
        "; " + std::to_string(unmatched) +
        " objects were dropped there because no other port had one of the same moment: stamps do not meet";
  return text;
}

// Returns how a robot gets free that stands although it has somewhere to go. Remembers what it has met without seeing it.
std::optional<nav::Steer> Avoider::escape(const Situation& situation) {
  if (!remembers() || !moved_at_) return std::nullopt;
  if (!escape_) escape_.emplace(outline_of(described_body()));
  const bool has_somewhere_to_go = situation.goal && situation.goal_distance > situation.goal_reach &&
                                   !are_motors_held(kept_alarms()) &&
                                   !passes_somebody(moving_.latest(), pose_.position(), now());
  const auto goal = has_somewhere_to_go ? situation.goal : std::nullopt;
  const auto steer = escape_->step({now(), pose_, twist_, goal, memory_.echoes(), floor_});
  if (steer && steer->speed < 0.0 && escape_->has_just_begun()) feel_ahead();
  return steer;
}

// Notes that something is at the robot's nose.
void Avoider::feel_ahead() {
  constexpr std::uint32_t kTouch = std::numeric_limits<std::uint32_t>::max();  // No sensor has that number.
  constexpr int kPoints = 5;
  const nav::Footprint body = outline_of(described_body());
  EchoMemory::Limits kept = keep();
  kept.sensor = kTouch;
  for (int i = 0; i < 2 * kPoints; ++i) {  // Twice, which confirms them.
    const double aside = 0.5 * (i % kPoints) - 1.0;
    memory_.hear(body.is_circle() ? body.radius * direction(0.5 * aside)
                                  : Vec2{body.half_length, aside * body.half_width},
                 kept);
  }
}

nav::Footprint Avoider::outline_of(const std::optional<Rectangle>& body) const {
  return body ? nav::Footprint{body->half_length, body->half_width, radius()}
              : nav::Footprint{.radius = radius()};
}

std::optional<Pose2> Avoider::pose() {
  if (!localizer_.connected()) return moved_at_ ? std::optional(pose_) : std::nullopt;
  const auto pose = localizer_.latest();
  if (!pose || !is_valid(*pose) || is_anywhere(pose->covariance())) return std::nullopt;
  return plane_pose(*pose);
}

ObjectPtr<idl::GoalPoint> Avoider::present_goal() const {
  const auto goal = goal_.latest();
  const bool fresh = goal && to_seconds(now() - to_time_point(goal->creation_time())) <= *goal_max_age_;
  return fresh ? goal : ObjectPtr<idl::GoalPoint>{};
}

Situation Avoider::situation() {
  Situation situation;
  situation.last_direction = last_direction_;
  situation.turning = twist_.turn_rate * *reaction_time_;
  situation.heading = pose_.yaw;
  situation.place = pose_.position();
  situation.is_heeded = motion_.subscriber_count() > 0;
  situation.speed = twist_.forward;
  situation.turn_rate = twist_.turn_rate;
  constexpr double kMoves = 0.05;  // [m/s] Slower, the direction is noise.
  if (speed_of(twist_) > kMoves) situation.course = portable::atan2(twist_.left, twist_.forward);
  add_goal(situation);
  return situation;
}

// The goal is asked for once: it may become too old at any time.
void Avoider::add_goal(Situation& situation) {
  const auto goal = present_goal();
  const std::optional<Pose2> here = goal ? pose() : std::nullopt;
  if (!here) return;
  const auto& point = goal->coordinate().point();
  const Vec2 place = seen_from(*here, Vec2{point.x(), point.y()});
  situation.goal = portable::atan2(place.y, place.x);
  situation.goal_distance = norm(place);
  situation.goal_reach = goal->reach_radius().distance();
  situation.passes_goal = goal->via();
}

EchoMemory::Limits Avoider::keep() const {
  return {*memory_time_, *echo_time_, *same_place_, *memory_range_};
}

// A sensor that has missed two readings may still be well.
double Avoider::deaf_after() const {
  constexpr double kMissed = 3.0;
  return std::max(*deaf_after_, body_ ? kMissed * body_->sensor_interval : 0.0);
}

double Avoider::farthest() const { return radius() + *margin_ + limits().safe_distance + 0.5; }

std::optional<Rectangle> Avoider::described_body() const {
  return body_ ? rectangle(body_->length, body_->width) : std::nullopt;
}

Limits Avoider::limits() const {
  const bool is_told = body_ && body_->acceleration > 0.0;
  const double braking =
      braking_way(speed_of(twist_), *reaction_time_, is_told ? body_->acceleration : kLeastAcceleration);
  const double more = std::max(0.0, braking - kShareToStop * (*safe_distance_ - *stop_distance_));
  return {.robot_radius = radius(),
          .margin = *margin_,
          .safe_distance = *safe_distance_ + more,
          .stop_distance = *stop_distance_ + more,
          .max_speed = *max_speed_,
          .slides = *sideways_ && body_ && body_->slides};
}

}  // namespace orca::avoid
