// SPDX-License-Identifier: LGPL-3.0-or-later
#include "orca/batch/referee.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>

#include "motion.hpp"
#include "orca/base/text.hpp"
#include "orca/geometry/angle.hpp"
#include "orca/hw/scene.hpp"
#include "orca/xml/names.hpp"
#include "orca/xml/number.hpp"

namespace orca::batch {
namespace {

using Steps = std::span<const Scene::Step>;

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& all) {
  std::vector<std::string> names;
  for (const Named& one : all) names.push_back(one.name);
  return names;
}

// Returns the names that there are, and which of them may have been meant.
template <class Named>
std::string there_are(const std::vector<Named>& all, const std::string& wanted) {
  const std::vector<std::string> names = names_of(all);
  return listed(names) + xml::did_you_mean(xml::nearest_name(wanted, names));
}

// Returns the robot that a goal is for.
Result<const Scene::Robot*> robot_of(const Goal& goal, const Scene& scene) {
  if (!goal.robot.empty()) {
    const auto found = std::ranges::find(scene.robots, goal.robot, &Scene::Robot::name);
    if (found != scene.robots.end()) return &*found;
    return fail(Code::not_found,
                "a goal is for the robot " + in_quotes(goal.robot) +
                    ", which is not simulated; there are: " + there_are(scene.robots, goal.robot));
  }
  if (scene.robots.size() == 1) return &scene.robots.front();
  return fail(Code::failed_precondition,
              scene.robots.empty()
                  ? "a goal is judged by the true pose of a robot, and no robot is simulated"
                  : "a goal names no robot, and there are several; give it robot=\"...\", one of: " +
                        listed(names_of(scene.robots)));
}

Result<Vec2> position_of(const Goal& goal, const Scene& scene) {
  if (goal.place.empty()) return goal.position;
  const auto found = std::ranges::find(scene.places, goal.place, &Scene::Place::name);
  if (found != scene.places.end()) return found->position;
  return fail(Code::not_found,
              "a goal is at the place " + in_quotes(goal.place) +
                  ", which this world does not have; it has: " + there_are(scene.places, goal.place));
}

// A goal whose place is known.
struct Target {
  Goal goal;
  Vec2 position;

  [[nodiscard]] bool holds(const Pose2& X_WR) const {
    if (norm(X_WR.position() - position) > goal.radius) return false;
    return !goal.heading || std::fabs(wrapped(X_WR.yaw - *goal.heading)) <= goal.heading_tolerance;
  }
};

constexpr Duration kBetweenSteps = std::chrono::milliseconds(100);  // of Scene::Robot::motion

// Returns when the robot came to stay in the goal; nothing if it did not, or only after `last`.
std::optional<TimePoint> time_of(const Target& target, Steps steps, TimePoint last) {
  std::optional<TimePoint> since;
  for (const Scene::Step& step : steps) {
    if (!target.holds(step.pose)) {
      since.reset();
      continue;
    }
    if (!since && step.time > last) return std::nullopt;
    if (!since) since = step.time;
    if (step.time - *since >= target.goal.hold) return since;
  }
  return since;  // the run ended before the time to stay was over
}

// One robot's goals, and what is said of them, both in their order.
struct Course {
  std::vector<Scene::Step> motion;
  std::vector<Target> targets{};
  std::vector<GoalClaim> claims{};
};

// Returns whether the robot was in the goal when that was said, by the true pose before or the one after.
bool is_right(const GoalClaim& claim, const Target& target, Steps motion) {
  const Steps after = batch::since(motion, claim.time);
  const auto index = static_cast<std::size_t>(motion.size() - after.size());
  return (index > 0 && target.holds(motion[index - 1].pose)) ||
         (!after.empty() && target.holds(after[0].pose));
}

// Adds the goals of one robot to the judgement. Returns when it reached the last of them, if it reached all.
std::optional<TimePoint> judge_way(const Course& course, Judgement& judgement) {
  Steps left = course.motion;
  std::optional<TimePoint> done;
  bool all = true;
  for (std::size_t k = 0; k < course.targets.size(); ++k) {
    const Target& target = course.targets[k];
    const bool concluded = k < course.claims.size();
    const std::optional<TimePoint> reached =
        time_of(target, left, concluded ? course.claims[k].time + kBetweenSteps : TimePoint::max());
    if (reached) {
      ++judgement.reached;
      done = std::max(done.value_or(*reached), *reached);
      left = batch::since(left, *reached);
    } else {
      all = false;
      if (!concluded) break;  // the robot is still on its way there
      ++judgement.missed;
      left = batch::since(left, course.claims[k].time);
    }
    if (reached && (!concluded || !course.claims[k].reached)) ++judgement.not_claimed;
  }
  return all ? done : std::nullopt;
}

void judge_claims(const Course& course, Judgement& judgement) {
  for (std::size_t k = 0; k < course.claims.size(); ++k) {
    if (!course.claims[k].reached) continue;
    ++judgement.claimed;
    if (k >= course.targets.size() || !is_right(course.claims[k], course.targets[k], course.motion))
      ++judgement.claimed_wrongly;
  }
}

// Returns all true poses of a robot; the run may end between two steps.
std::vector<Scene::Step> motion_of(const Scene::Robot& robot, TimePoint end) {
  std::vector<Scene::Step> motion = robot.motion;
  motion.push_back({.time = end, .pose = robot.pose, .velocity = {}});
  return motion;
}

}  // namespace

std::string goal_text(const Goal& goal) {
  using xml::number_text;
  std::string text =
      (goal.robot.empty() ? "the robot" : goal.robot) + " within " + number_text(goal.radius) + " m of ";
  text += goal.place.empty() ? number_text(goal.position.x) + " " + number_text(goal.position.y) : goal.place;
  if (goal.heading)
    text +=
        ", facing " + number_text(*goal.heading) + " rad +- " + number_text(goal.heading_tolerance) + " rad";
  if (goal.hold > Duration{0}) text += ", for " + number_text(to_seconds(goal.hold)) + " s";
  return text;
}

Status can_judge(const Goal& goal, const Scene& scene) {
  if (const auto robot = robot_of(goal, scene); !robot) return robot.error();
  if (const auto position = position_of(goal, scene); !position) return position.error();
  return ok();
}

Result<Judgement> judge_goals(const std::vector<Goal>& goals, const Scene& scene,
                              const std::vector<GoalClaim>& claims, TimePoint end) {
  std::map<std::string, Course> courses;
  for (const Goal& goal : goals) {
    const Result<const Scene::Robot*> robot = robot_of(goal, scene);
    if (!robot) return robot.error();
    const Result<Vec2> position = position_of(goal, scene);
    if (!position) return position.error();
    const auto [course, is_new] = courses.try_emplace((*robot)->name);
    if (is_new) course->second.motion = motion_of(**robot, end);
    course->second.targets.push_back({goal, *position});
  }
  for (const GoalClaim& claim : claims) {
    const auto course =
        claim.robot.empty() && courses.size() == 1 ? courses.begin() : courses.find(claim.robot);
    if (course != courses.end()) course->second.claims.push_back(claim);
  }
  Judgement judgement;
  bool all = true;
  for (const auto& [name, course] : courses) {
    const std::optional<TimePoint> done = judge_way(course, judgement);
    judge_claims(course, judgement);
    all = all && done;
    if (done) judgement.done = std::max(judgement.done.value_or(*done), *done);
  }
  if (!all) judgement.done.reset();
  return judgement;
}

}  // namespace orca::batch
