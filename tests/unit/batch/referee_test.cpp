// SPDX-License-Identifier: GPL-3.0-or-later
// The referee: which goals robots reached by their true poses, whatever their components say.
#include "orca/batch/referee.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>

#include "orca/hw/scene.hpp"

using namespace orca;
using namespace orca::batch;

namespace {

TimePoint after(double seconds) { return TimePoint{} + from_seconds(seconds); }

// A robot that drives along the x axis at 1 m/s from x = 0 until `stops`, and stands there until `end` [s].
Scene::Robot driven(const std::string& name, double stops, double end, double yaw = 0.0) {
  Scene::Robot robot;
  robot.name = name;
  for (int i = 0; i < std::lround(10.0 * end); ++i)
    robot.motion.push_back({after(0.1 * i), {std::min(0.1 * i, stops), 0.0, yaw}, {}, 1.0});
  robot.pose = {std::min(end, stops), 0.0, yaw};
  return robot;
}

Scene scene_of(std::vector<Scene::Robot> robots) {
  Scene scene;
  scene.robots = std::move(robots);
  return scene;
}

Goal goal_at(double x, double radius = 0.25) { return {.position = {x, 0.0}, .radius = radius}; }

GoalClaim reached_at(double seconds, const std::string& robot = "") { return {robot, after(seconds), true}; }
GoalClaim given_up_at(double seconds) { return {"", after(seconds), false}; }

Judgement judged(const std::vector<Goal>& goals, const Scene& scene, const std::vector<GoalClaim>& claims,
                 double end) {
  const Result<Judgement> judgement = judge_goals(goals, scene, claims, after(end));
  INFO((judgement ? "" : judgement.error().message));
  REQUIRE(judgement);
  return *judgement;
}

}  // namespace

TEST_CASE("a goal is reached when the true pose comes into its radius", "[batch][referee]") {
  const Judgement judgement =
      judged({goal_at(4.0)}, scene_of({driven("Dewey", 4.0, 6.0)}), {reached_at(4.0)}, 6.0);
  CHECK(judgement == Judgement{.reached = 1, .claimed = 1, .done = after(3.8)});
}

TEST_CASE("what a component claims of a place that the robot is not at does not count", "[batch][referee]") {
  const Scene scene = scene_of({driven("Dewey", 1.0, 2.0)});
  CHECK(judged({goal_at(9.9)}, scene, {reached_at(0.2)}, 2.0) ==
        Judgement{.missed = 1, .claimed = 1, .claimed_wrongly = 1});
}

TEST_CASE("a goal that was claimed too early is missed, even if the robot comes there later",
          "[batch][referee]") {
  const Scene scene = scene_of({driven("Dewey", 8.0, 10.0)});
  CHECK(judged({goal_at(4.0), goal_at(8.0)}, scene, {reached_at(2.0), reached_at(8.0)}, 10.0) ==
        Judgement{.reached = 1, .missed = 1, .claimed = 2, .claimed_wrongly = 1});
}

TEST_CASE("a robot that does not know that it has arrived has arrived all the same", "[batch][referee]") {
  const Scene scene = scene_of({driven("Dewey", 4.0, 30.0)});
  CHECK(judged({goal_at(4.0)}, scene, {}, 30.0) ==
        Judgement{.reached = 1, .not_claimed = 1, .done = after(3.8)});
  CHECK(judged({goal_at(4.0)}, scene, {given_up_at(20.0)}, 30.0) ==
        Judgement{.reached = 1, .not_claimed = 1, .done = after(3.8)});
}

TEST_CASE("a goal that is given up before the robot was there is missed", "[batch][referee]") {
  const Scene scene = scene_of({driven("Dewey", 2.0, 30.0)});
  CHECK(judged({goal_at(4.0)}, scene, {given_up_at(20.0)}, 30.0) == Judgement{.missed = 1});
  CHECK(judged({goal_at(4.0)}, scene, {}, 30.0) == Judgement{});
}

TEST_CASE("a claim beyond the goals of the experiment is wrong", "[batch][referee]") {
  const Scene scene = scene_of({driven("Dewey", 4.0, 6.0)});
  const Judgement judgement = judged({goal_at(4.0)}, scene, {reached_at(4.0), reached_at(5.0)}, 6.0);
  CHECK(judgement.claimed == 2);
  CHECK(judgement.claimed_wrongly == 1);
}

TEST_CASE("goals count in their order", "[batch][referee]") {
  const Scene scene = scene_of({driven("Dewey", 8.0, 10.0)});
  CHECK(judged({goal_at(4.0), goal_at(8.0)}, scene, {}, 10.0).done == after(7.8));
  CHECK(judged({goal_at(8.0), goal_at(4.0)}, scene, {}, 10.0) == Judgement{.reached = 1, .not_claimed = 1});
}

TEST_CASE("a robot that only passes does not stay", "[batch][referee]") {
  Goal goal = goal_at(4.0);
  goal.hold = 1s;
  CHECK(judged({goal}, scene_of({driven("Dewey", 8.0, 10.0)}), {}, 10.0).reached == 0);
  CHECK(judged({goal}, scene_of({driven("Dewey", 4.0, 10.0)}), {}, 10.0).done == after(3.8));
  // It comes to stay, and the run ends.
  CHECK(judged({goal}, scene_of({driven("Dewey", 4.0, 4.2)}), {reached_at(4.1)}, 4.2).reached == 1);
}

TEST_CASE("a robot that has to face somewhere is judged by its direction, too", "[batch][referee]") {
  Goal goal = goal_at(4.0);
  goal.heading = std::numbers::pi;
  goal.heading_tolerance = 0.2;
  CHECK(judged({goal}, scene_of({driven("Dewey", 4.0, 6.0)}), {}, 6.0).reached == 0);
  CHECK(judged({goal}, scene_of({driven("Dewey", 4.0, 6.0, -std::numbers::pi + 0.1)}), {}, 6.0).reached == 1);
}

TEST_CASE("a run that ends between two true poses is judged by the last one", "[batch][referee]") {
  Scene scene = scene_of({driven("Dewey", 8.0, 3.7)});  // the last step is at 3.6 s and 3.6 m
  scene.robots[0].pose.x = 3.76;
  CHECK(judged({goal_at(4.0)}, scene, {reached_at(3.75)}, 3.76) ==
        Judgement{.reached = 1, .claimed = 1, .done = after(3.76)});
}

TEST_CASE("each of several robots has goals and claims of its own", "[batch][referee]") {
  const Scene scene = scene_of({driven("Huey", 4.0, 10.0), driven("Dewey", 2.0, 10.0)});
  Goal of_huey = goal_at(4.0);
  of_huey.robot = "Huey";
  Goal of_dewey = goal_at(4.0);
  of_dewey.robot = "Dewey";
  CHECK(judged({of_huey, of_dewey}, scene, {reached_at(4.0, "Huey"), reached_at(5.0, "Dewey")}, 10.0) ==
        Judgement{.reached = 1, .missed = 1, .claimed = 2, .claimed_wrongly = 1});
  of_dewey.position.x = 2.0;
  CHECK(judged({of_huey, of_dewey}, scene, {}, 10.0).done == after(3.8));
}

TEST_CASE("a goal may be at a place of the world", "[batch][referee]") {
  Scene scene = scene_of({driven("Dewey", 4.0, 6.0)});
  scene.places = {{"start", {0.0, 0.0}}, {"goal", {4.0, 0.0}}};
  CHECK(judged({{.place = "goal", .radius = 0.25}}, scene, {}, 6.0).reached == 1);
  const Result<Judgement> nowhere = judge_goals({{.place = "gaol", .radius = 0.25}}, scene, {}, after(6.0));
  REQUIRE_FALSE(nowhere);
  CHECK(nowhere.error().message ==
        "a goal is at the place \"gaol\", which this world does not have; it has: start, goal; did you mean "
        "\"goal\"?");
}

TEST_CASE("a goal without its robot says what is wrong", "[batch][referee]") {
  const Scene two = scene_of({driven("Huey", 4.0, 6.0), driven("Dewey", 4.0, 6.0)});
  Goal goal = goal_at(4.0);
  CHECK(judge_goals({goal}, two, {}, after(6.0)).error().message ==
        "a goal names no robot, and there are several; give it robot=\"...\", one of: Huey, Dewey");
  goal.robot = "Louie";
  CHECK(judge_goals({goal}, two, {}, after(6.0)).error().message ==
        "a goal is for the robot \"Louie\", which is not simulated; there are: Huey, Dewey");
  goal.robot.clear();
  CHECK(judge_goals({goal}, Scene{}, {}, after(6.0)).error().message ==
        "a goal is judged by the true pose of a robot, and no robot is simulated");
}

TEST_CASE("a goal is written for people", "[batch][referee]") {
  CHECK(goal_text({.robot = "Dewey", .position = {4.2, 9.8}, .radius = 0.3}) ==
        "Dewey within 0.3 m of 4.2 9.8");
  CHECK(
      goal_text({.place = "goal", .radius = 1.0, .heading = 1.5, .heading_tolerance = 0.25, .hold = 500ms}) ==
      "the robot within 1 m of goal, facing 1.5 rad +- 0.25 rad, for 0.5 s");
}
