// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/goals/goal_follower.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <deque>
#include <utility>
#include <vector>

#include "orca/geometry/objects/covariance.hpp"
#include "orca/geometry/objects/plane.hpp"
#include "orca/idl/time.hpp"

namespace orca::go {
namespace {

constexpr const char* kBlocked = "BLOCKED";

std::string in_short(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", number);
  return text;
}

// Returns what is left of the way to the last point [m]. @pre  there is one.
double way_left(const Route& route, const Patience& patience, Vec2 from) {
  double left = 0.0;
  for (const Route::Point& point : route.points()) {
    const Vec2 place{point->coordinate().point().x(), point->coordinate().point().y()};
    const double straight = norm(place - from);
    left += point == route.points().front() ? patience.plan_left().value_or(straight) : straight;
    from = place;
  }
  return left;
}

Loan<idl::MotionCommand> command_of(const Step& step, double weight) {
  if (!step.turn_rate) return head(step.direction, step.speed, weight);
  const Vec2 velocity = step.speed * direction(step.direction);
  return slide(velocity.x, velocity.y, *step.turn_rate, weight);
}

// Says how near the robot has come to a point, for people.
std::string where_it_stays(const Patience& patience, const idl::GoalPoint& point) {
  const std::string place = point.via() ? "the next via point" : "the goal";
  if (!std::isfinite(patience.nearest())) return "no way to " + place;
  return "no nearer than " + in_short(patience.nearest()) + " m to " + place;
}

}  // namespace

GoalFollower::GoalFollower(ComponentHost& host, double blocked_after)
    : Component(host),
      goal_(*this, "GotoCoordinateSend", &GoalFollower::on_goal,
            {.text = "Via points and goals to drive to."}),
      cancel_(*this, "CancelSend", &GoalFollower::on_cancel,
              {.text = "The goal to give up, by its name; without a name whatever it drives to. With the "
                       "kind GOAL_BLOCKED it is given up as blocked."}),
      motion_(*this, "MotionCmdPush",
              {.text = "One command per lap: a wish, full stop on arrival, no opinion without a goal."}),
      arrived_(*this, "ArrivedPush", {.text = "One object per goal reached; none for via points."}),
      failed_(*this, "GoalFailedPush",
              {.text = "One object per goal given up: refused, blocked, timed out, lost or cancelled."}),
      goal_push_(*this, "GoalPush", {.text = "The via point or goal that it drives to now, once per lap."}),
      door_(*this, "DoorPush", {.text = "The door that it drives through now, once per lap."}),
      path_(
          *this, "PathPush",
          {.text = "The way that is left: one object whenever its points change, and for a new subscriber."}),
      progress_(*this, "ProgressQuery", &GoalFollower::on_question,
                {.text = "The goal on the way, what is left of the way, and why the robot waits."}),
      odometry_(*this, "odometry",
                {.text = "Pose of the robot, used if no localizer is connected.", .optional = true}),
      localizer_(*this, "localizer",
                 {.text = "Pose of the robot, in the frame of the goals.", .optional = true}),
      blocked_after_(
          *this, "blocked_after", blocked_after,
          {.unit = "s",
           .min = 0.0,
           .text =
               "Time without coming nearer to a point after which its goal is given up; 0: it never is."}),
      lost_wait_(
          *this, "lost_wait", 0.0,
          {.unit = "s",
           .min = 0.0,
           .text = "Time for which a goal waits, and leaves the robot to other behaviours, while it is not "
                   "known where the robot is; 0: it ends at once, or after 20 s if that was never known."}),
      height_(*this, "height", 0.0,
              {.unit = "m", .text = "Height (z) of the robot in the frame of the goals."}),
      door_run_up_(
          *this, "door_run_up", 0.7,
          {.unit = "m",
           .min = 0.2,
           .text = "Distance before a door at which it lines up, and behind it at which it is through."}),
      door_room_(
          *this, "door_room", 0.5,
          {.unit = "m", .min = 0.0, .text = "Width that the robot needs; a narrower door is refused."}),
      weight_(
          *this, "weight", 1.0,
          {.min = 0.0, .text = "Weight of its wishes, relative to other behaviours; 0: they never count."}) {}

Status GoalFollower::configure() {
  if (!localizer_.connected() && !odometry_.connected())
    return fail(Code::failed_precondition,
                "connect its port localizer or odometry: it must know where it is");
  lap_on(localizer_.connected() ? "localizer" : "odometry");
  return ok();
}

Status GoalFollower::start() {
  motion_.start(lap_period());
  return ok();
}

// The places of a door belong to it: in a doorway nobody sees from which side the robot has come.
void GoalFollower::save_state(StateWriter& state) const {
  state.write(route_, patience_, before_, posed_at_, doubts_);
  state.write(route_.empty() ? std::deque<Target>{} : legs_.left_for(route_.point()));
}
Status GoalFollower::load_state(StateReader& state) {
  std::deque<Target> left;
  Status read = state.read(route_, patience_, before_, posed_at_, doubts_, left);
  if (read.ok() && !route_.empty()) legs_.take(route_.point(), std::move(left));
  return read;
}

Status GoalFollower::on_goal(const ObjectPtr<idl::GoalPoint>& goal) {
  if (route_.is_given_up(*goal))
    return fail(Code::failed_precondition, "the route to \"" + goal->name() + "\" has been given up");
  const char* fault = fault_of(*goal, *height_);
  if (const auto door = goal.as<idl::Door>(); door && fault == nullptr)
    fault = fault_of_door(*door, *door_room_);
  if (fault != nullptr) return refuse(*goal, fault);
  if (route_.empty() && *lost_wait_ > 0.0) lost_at_.reset();  // each goal waits for a pose again
  clear_alarm(kBlocked, "it drives to \"" + goal->name() + "\"");
  route_.add(goal, now());
  doubts_ = false;
  before_.near = false;
  patience_.begin();
  return ok();
}

// The order has a mission of its own; the result belongs to that of the goal.
Status GoalFollower::on_cancel(const ObjectPtr<idl::GoalFailed>& order) {
  if (route_.empty()) return fail(Code::failed_precondition, "there is no goal to cancel");
  const auto is_meant = [&](const Route::Point& point) { return point->name() == order->name(); };
  if (!order->name().empty() && std::ranges::none_of(route_.points(), is_meant))
    return fail(Code::not_found, "cannot cancel the goal \"" + order->name() + "\": the robot drives to \"" +
                                     route_.next().name() + "\"");
  const bool is_blocked = order->kind() == idl::GOAL_BLOCKED;  // Who sends it knows better.
  end_route(is_blocked ? idl::GOAL_BLOCKED : idl::GOAL_UNANSWERED,
            (is_blocked ? "blocked: by \"" : "cancelled: by \"") + order->origin() + "\"" +
                (order->reason().empty() ? "" : ", " + order->reason()));
  return ok();
}

Status GoalFollower::refuse(const idl::GoalPoint& goal, const char* fault) {
  if (goal.mission() != 0) route_.give_up(goal.mission());
  if (failed_.subscriber_count() > 0) announce(goal, idl::GOAL_REFUSED, std::string("refused: it ") + fault);
  return fail(Code::invalid_argument, "the goal \"" + goal.name() + "\" " + fault);
}

Outcome GoalFollower::work() {
  route_.delay(held_.since_last(now(), kept_alarms()));
  const std::optional<Pose2> pose = take_pose();
  if (pose && !is_lost()) {
    follow_route(*pose);
  } else {  // it stands while nobody says where it is, or lets others look around
    before_ = {};
    const bool leaves_it = lost_ && *lost_wait_ > 0.0;
    motion_.push(route_.empty() || leaves_it ? dont_care() : full_stop());
  }
  return again();
}

void GoalFollower::follow_route(const Pose2& pose) {
  seen_at_ = pose.position();
  pass_via_points(pose);
  if (route_.empty()) {
    before_ = {};
    motion_.push(dont_care());
    idle();
  } else if (!is_hopeless(pose)) {
    const Target& target = next_place(pose);
    push_goal(target);
    drive(pose, target);
  }
  push_path(pose);
}

// Returns whether it is not known where the robot is. The route that it is on would lead anywhere, so it ends, unless a localizer may find the
// robot: at first, or if somebody looks around.
bool GoalFollower::is_lost() {
  constexpr Duration kFound = 20s;
  if (!lost_) lost_at_.reset();
  if (!lost_) was_known_ = true;
  // Whoever looks around, for which lost_wait leaves time, cannot do so while the motors are held.
  const bool waits_for_release = *lost_wait_ > 0.0 && are_motors_held(kept_alarms());
  if (lost_ && (!lost_at_ || waits_for_release)) lost_at_ = now();
  const Duration unless_set = was_known_ ? Duration{0} : kFound;
  const Duration wait = *lost_wait_ > 0.0 ? from_seconds(*lost_wait_) : unless_set;
  if (lost_ && !route_.empty() && now() - *lost_at_ >= wait)
    end_route(idl::GOAL_UNANSWERED, "lost: it is not known any more where the robot is");
  return lost_;
}

// Goals that are given in the frame of the odometry are lost with it.
void GoalFollower::note_odometry(const idl::Odometry& odometry) {
  if (!odometer_.begins_anew(odometry)) return;
  forget_places();
  lost_ = lost_ || !localizer_.connected();
}

// Shows the way that is left, if it has changed or somebody has come who has not seen it.
void GoalFollower::push_path(const Pose2& pose) {
  const PathShown now_shown{route_.changes(), path_.subscriber_count()};
  const PathShown before = std::exchange(path_shown_, now_shown);
  if (now_shown.change == before.change && now_shown.to <= before.to) return;
  if (now_shown.to == 0) return;
  auto path = path_.loan();
  fill_path(route_, pose, *height_, *path);
  path_.push(std::move(path));
}

Result<Loan<idl::Progress>> GoalFollower::on_question(const ObjectPtr<idl::Ask>& /*ask*/) {
  auto progress = make_object<idl::Progress>();
  progress->stamp(to_time_value(now()));
  if (route_.empty()) return progress;
  progress->name() = route_.points().back()->name();
  progress->mission(route_.point()->mission());
  progress->left(way_left(route_, patience_, seen_at_));
  progress->waits() = why_it_waits();
  return progress;
}

std::string GoalFollower::why_it_waits() const {
  constexpr double kWaits = 3.0;  // [s] without progress
  if (lost_) return "it is not known where the robot is";
  if (const std::string held = why_motors_are_held(kept_alarms()); !held.empty()) return held;
  if (doubts_) return doubt();
  if (stuck_ < kWaits) return {};
  const std::string holds = what_holds();
  return "no progress for " + in_short(std::floor(stuck_)) + " s" + (holds.empty() ? "" : ": " + holds);
}

void GoalFollower::take(const Step& step, const Pose2& pose, const Target& target) {
  before_.near = step.near;
  before_.speed = step.speed;
  if (step.kind != Step::Kind::reached) {
    motion_.push(command_of(step, *weight_));
  } else if (deviation_ <= target.reach_radius) {
    arrive(pose);
  } else {
    wait_to_be_sure();
  }
}

// Stands where it believes the goal is: its pose may become surer.
void GoalFollower::wait_to_be_sure() {
  motion_.push(full_stop());
  if (!std::exchange(doubts_, true))
    log_warning("perhaps at \"" + route_.next().name() + "\", but not arrived: " + doubt());
}

// Says how unsure the position is, for people.
std::string GoalFollower::doubt() const {
  return "its position is known only to " + in_short(deviation_) + " m, the goal's reach is " +
         in_short(route_.next().reach_radius().distance()) + " m" +
         (trust_.guesses() ? "; this is a guess, as its odometry does not say how wrong it is" : "");
}

// Pushes the point that it drives to, or a place on the way through a door.
void GoalFollower::push_goal(const Target& target) {
  if (const auto door = route_.point().as<idl::Door>()) door_.push(copy_value(door));
  const auto& point = route_.next().coordinate().point();
  if (target.place == Vec2{point.x(), point.y()}) {
    goal_push_.push(copy_value(route_.point()));
    return;
  }
  auto place = make_object(route_.next());
  place->coordinate().point().x(target.place.x);
  place->coordinate().point().y(target.place.y);
  goal_push_.push(std::move(place));
}

// Returns whether it has given up the route. It does not as long as nobody wants to know.
bool GoalFollower::is_hopeless(const Pose2& pose) {
  if (are_motors_held(kept_alarms())) patience_.begin();  // that it stands is somebody's wish
  const double stuck = patience_.note(distance(next_place(pose), pose), now());
  stuck_ = stuck;
  const idl::GoalPoint& next = route_.next();
  if (failed_.subscriber_count() == 0 || next.reach_radius().distance() <= 0.0) return false;
  if (next.time_limit() > 0.0 && route_.age(now()) >= next.time_limit()) {
    end_route(idl::GOAL_TIMED_OUT, "timed out: not reached within " + in_short(next.time_limit()) + " s");
  } else if (*blocked_after_ > 0.0 && stuck >= *blocked_after_) {
    const std::string holds = what_holds();
    end_route(idl::GOAL_BLOCKED, "blocked: " + where_it_stays(patience_, next) + " for " +
                                     in_short(*blocked_after_) + " s" + (doubts_ ? ", and " + doubt() : "") +
                                     (holds.empty() ? "" : ", and " + holds));
  } else {
    return false;
  }
  return true;
}

void GoalFollower::end_route(idl::GoalFailure kind, const std::string& reason) {
  const ObjectPtr<idl::GoalPoint> goal = route_.point();
  route_.give_up(goal->mission());
  before_ = {};
  motion_.push(full_stop());
  if (kind == idl::GOAL_BLOCKED)
    raise_alarm(
        kBlocked, idl::ALARM_WARNING,
        "\"" + goal->name() + "\" was not reached; " + reason + "; clear the way, or give it another goal");
  announce(*goal, kind, reason);
  end_mission();
}

void GoalFollower::announce(const idl::GoalPoint& goal, idl::GoalFailure kind, const std::string& reason) {
  auto failed = failed_.loan();
  failed->mission(goal.mission());
  failed->name() = goal.name();
  failed->kind(kind);
  failed->reason() = reason;
  failed->stamp(to_time_value(now()));
  failed_.push(std::move(failed));
}

void GoalFollower::stop() {
  before_ = {};
  patience_.begin();
  legs_ = {};
  posed_at_.reset();
}

std::optional<Pose2> GoalFollower::take_pose() {
  if (!localizer_.connected()) {
    const auto odometry = odometry_.get_update();
    if (!is_valid(*odometry) || !is_valid(*odometry, check_present(now(), odometry->stamp())))
      return std::nullopt;
    note_odometry(*odometry);
    note_pose(odometry->stamp(), trust_.covariance_of(*odometry));
    return plane_pose(*odometry);
  }
  const auto pose = localizer_.get_update();
  if (!is_valid(*pose) || !is_valid(*pose, check_present(now(), pose->stamp()))) return std::nullopt;
  note_pose(pose->stamp(), pose->covariance());
  return plane_pose(*pose);
}

void GoalFollower::note_pose(const idl::TimeValue& stamp, const std::array<double, 9>& covariance) {
  deviation_ = position_deviation(covariance);
  if (localizer_.connected() && lost_ != is_anywhere(covariance)) {
    lost_ = !lost_;
    patience_.begin();
    forget_places();
  }
  const TimePoint time = to_time_point(stamp);
  before_.time = posed_at_ ? to_seconds(time - *posed_at_) : 0.0;
  posed_at_ = time;
}

void GoalFollower::pass_via_points(const Pose2& pose) {
  while (!route_.empty()) {
    const Target place = next_place(pose);
    if (!place.via || !within_reach(place, pose)) return;
    if (legs_.at_last()) route_.pop();
    legs_.pop();
    patience_.begin();
  }
}

void GoalFollower::arrive(const Pose2& pose) {
  auto arrived = arrived_.loan();
  arrived->name() = route_.next().name();
  arrived->x(pose.x);
  arrived->y(pose.y);
  arrived->stamp(to_time_value(*posed_at_));
  route_.pop();
  before_ = {};
  patience_.begin();
  motion_.push(full_stop());
  arrived_.push(std::move(arrived));
  end_mission();
}

// Returns the place that the robot, at `pose`, drives to now.
const Target& GoalFollower::next_place(const Pose2& pose) {
  return legs_.next(route_.point(), pose, {*height_, *door_run_up_});
}

}  // namespace orca::go
