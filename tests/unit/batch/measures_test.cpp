// SPDX-License-Identifier: GPL-3.0-or-later
// What a run's motion is worth, on motions whose measures are known.
#include "orca/batch/measures.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>
#include <set>

#include "measures/motion.hpp"

using namespace orca;
using namespace orca::batch;

namespace {

constexpr double kPeriod = 0.1;  // [s]

TimePoint at(double seconds) { return TimePoint{} + from_seconds(seconds); }

// A robot's motion, a step each tenth of a second. speed(t) and turn(t) give the velocity; it slides along the x axis.
template <class Speed, class Turn>
Scene driven(double seconds, Speed speed, Turn turn) {
  Scene scene;
  Scene::Robot& robot = scene.robots.emplace_back();
  double x = 0.0;
  double yaw = 0.0;
  for (int i = 0; i <= std::lround(seconds / kPeriod); ++i) {
    const double t = i * kPeriod;
    robot.motion.push_back({at(t), {x, 0.0, yaw}, {.forward = speed(t), .turn_rate = turn(t)}, 1.0});
    x += speed(t) * kPeriod;
    yaw += turn(t) * kPeriod;
  }
  return scene;
}

Scene straight(double seconds, double speed) {
  return driven(
      seconds, [=](double) { return speed; }, [](double) { return 0.0; });
}

}  // namespace

TEST_CASE("a straight way has its length, no jerk and no reversals", "[batch][measures]") {
  const Measures measures = measure(straight(10.0, 0.5), {.succeeded = true, .end = at(10.0)});
  CHECK(measures.way.value() == Approx(5.0));
  CHECK(measures.jerk.value() == Approx(0.0).margin(1e-9));
  CHECK(measures.reversals == 0.0);
  CHECK(measures.clearance == 1.0);
  CHECK_FALSE(measures.impact_speed);
  CHECK_FALSE(measures.spl);
}

TEST_CASE("people who were touched, run into and nearly missed are counted where people are",
          "[batch][measures]") {
  Scene scene = straight(10.0, 0.5);
  CHECK_FALSE(measure(scene, {}).people_touched);
  scene.people = 2;
  CHECK(measure(scene, {}).people_touched == 0.0);
  CHECK(measure(scene, {}).near_misses == 0.0);
  scene.robots[0].encounters = {{at(1.0), "anna", 0.2, 0.5, 1.0, false},
                                {at(2.0), "bert", 0.0, 0.4, 0.0, true},
                                {at(3.0), "anna", 0.0, 0.04, 1.2, true},
                                {at(4.0), "bert", 0.1, 0.0, 1.0, false},
                                {at(5.0), "bert", 0.29, 0.0, 1.0, false}};
  const Measures measures = measure(scene, {});
  CHECK(measures.people_touched == 2.0);
  CHECK(measures.people_run_into == 1.0);
  CHECK(measures.near_misses == 3.0);
}

TEST_CASE("the way of all robots counts, and the nearest of them", "[batch][measures]") {
  Scene scene = straight(10.0, 0.5);
  scene.robots.push_back(straight(10.0, 0.25).robots.front());
  scene.robots[1].motion[7].clearance_m = 0.125;
  const Measures measures = measure(scene, {.succeeded = true, .end = at(10.0)});
  CHECK(measures.way.value() == Approx(7.5));
  CHECK(measures.clearance == 0.125);
  CHECK(measures.clearance_p5 == 1.0);
}

TEST_CASE("the clearance that was kept in 95 % of the time", "[batch][measures]") {
  Scene scene = straight(10.0, 0.5);
  REQUIRE(scene.robots[0].motion.size() == 101);
  for (std::size_t i = 0; i < 101; ++i)
    scene.robots[0].motion[i].clearance_m = 0.01 * static_cast<double>(100 - i);
  CHECK(measure(scene, {}).clearance_p5.value() == Approx(0.05));
}

TEST_CASE("the jerk of a sine of the speed is that of its second derivative", "[batch][measures]") {
  const double w = std::numbers::pi / 10.0;  // [rad/s]
  const Scene scene = driven(
      40.0, [=](double t) { return std::sin(w * t); }, [](double) { return 0.0; });
  CHECK(measure(scene, {}).jerk.value() == Approx(w * w / std::sqrt(2.0)).epsilon(0.01));
}

TEST_CASE("reversals are counted per metre, and slow turns are none", "[batch][measures]") {
  const auto to_and_fro = [](double t) { return static_cast<int>(t + 0.01) % 2 == 0 ? 0.5 : -0.5; };
  const Scene turning = driven(
      10.0, [](double) { return 0.5; }, to_and_fro);
  CHECK(measure(turning, {}).reversals.value() == Approx(9.0 / 5.0));
  const Scene trembling = driven(
      10.0, [](double) { return 0.5; }, [&](double t) { return 0.1 * to_and_fro(t); });
  CHECK(measure(trembling, {}).reversals == 0.0);
}

TEST_CASE("the mean absolute curvature of a circle is one by its radius, whichever way it turns",
          "[batch][measures]") {
  const double speed = 0.5;
  const double turn = 0.25;  // a radius of 2 m
  const auto circle = [&](double sign) {
    return driven(
        20.0, [=](double) { return speed; }, [=](double) { return sign * turn; });
  };
  for (const double sign : {-1.0, 1.0})
    CHECK(measure(circle(sign), {.succeeded = true, .end = at(20.0)}).curvature.value() == Approx(0.5));
  const auto to_and_fro = driven(
      20.0, [=](double) { return speed; }, [=](double t) { return t < 9.95 ? turn : -turn; });
  CHECK(measure(to_and_fro, {.succeeded = true, .end = at(20.0)}).curvature.value() == Approx(0.5));
  CHECK(measure(straight(10.0, 0.5), {}).curvature == 0.0);
  CHECK_FALSE(measure(straight(10.0, 0.0), {}).curvature);
}

TEST_CASE("the mean clearance is that along the way: while a robot stands it does not count",
          "[batch][measures]") {
  Scene scene = driven(
      20.0, [](double t) { return t < 9.95 ? 0.5 : 0.0; }, [](double) { return 0.0; });
  std::vector<Scene::Step>& steps = scene.robots[0].motion;
  for (std::size_t i = 0; i < steps.size(); ++i)
    steps[i].clearance_m = i <= 100 ? 1.0 - 0.005 * static_cast<double>(i) : 2.0;
  CHECK(measure(scene, {}).clearance_mean.value() == Approx(0.75));  // from 1 m to 0.5 m, evenly
  CHECK_FALSE(measure(straight(10.0, 0.0), {}).clearance_mean);
}

TEST_CASE("a way is compared with the world's reference", "[batch][measures]") {
  const RunEnd end{.succeeded = true, .end = at(10.0), .reference = 4.0};
  const Measures measures = measure(straight(10.0, 0.5), end);
  CHECK(measures.way_ratio.value() == Approx(1.25));
  CHECK(measures.spl.value() == Approx(0.8));
  const Measures failed = measure(straight(10.0, 0.5), {.end = at(10.0), .reference = 4.0});
  CHECK(failed.spl == 0.0);
  CHECK(failed.barn_score == 0.0);
  CHECK(measure(straight(10.0, 0.25), end).spl == 1.0);
}

TEST_CASE("the score of BARN is 0.5 at best, and its clock starts when the robot has moved 0.1 m",
          "[batch][measures]") {
  const auto score = [](double waits, double takes, double reference) {
    const Scene scene = driven(
        waits + takes, [=](double t) { return t < waits - 0.01 ? 0.0 : 0.5; }, [](double) { return 0.0; });
    return measure(scene, {.succeeded = true, .end = at(waits + takes), .reference = reference})
        .barn_score.value();
  };
  CHECK(score(0.0, 4.0, 12.0) == 0.5);                  // 6 s at best, and twice that is never beaten
  CHECK(score(0.0, 24.2, 12.0) == Approx(6.0 / 24.0));  // 0.2 s until it has moved
  CHECK(score(30.0, 24.2, 12.0) == Approx(6.0 / 24.0));
  CHECK(score(0.0, 99.0, 12.0) == 0.125);
}

TEST_CASE("the speed before the first contact is that of the impact", "[batch][measures]") {
  const Scene scene = driven(
      10.0, [](double t) { return t < 5.0 ? 0.4 : 0.0; }, [](double) { return 0.0; });
  const RunEnd end{.end = at(10.0), .first_contact = at(4.97)};
  CHECK(measure(scene, end).impact_speed == 0.4);
  CHECK(failure_in(scene, end) == Failure::contact);
}

TEST_CASE("a run that did not succeed was stuck, went to and fro, or was on its way", "[batch][measures]") {
  const RunEnd end{.end = at(60.0)};
  CHECK(failure_in(straight(60.0, 0.5), end) == Failure::time_out);
  const auto stops = [](double t) { return t < 30.0 ? 0.5 : 0.0; };
  CHECK(failure_in(driven(60.0, stops, [](double) { return 0.0; }), end) == Failure::trap);
  const auto to_and_fro = [](double t) { return static_cast<int>(t + 0.01) % 2 == 0 ? 0.5 : -0.5; };
  CHECK(failure_in(driven(60.0, stops, to_and_fro), end) == Failure::oscillation);
  CHECK(failure_in(straight(60.0, 0.5), {.succeeded = true, .end = at(60.0)}) == Failure::none);
  CHECK(failure_in({}, end) == Failure::none);
}

TEST_CASE("what is wrong with a run beside its motion has the first word", "[batch][measures]") {
  const Scene stands = straight(60.0, 0.0);
  CHECK(failure_in(stands, {.end = at(60.0), .overload = true}) == Failure::overload);
  CHECK(failure_in(stands, {.end = at(60.0), .lost = true, .overload = true}) == Failure::lost);
  CHECK(failure_in(stands, {.end = at(60.0), .first_contact = at(1.0), .lost = true}) == Failure::contact);
}

TEST_CASE("a run without a simulated robot has no measures", "[batch][measures]") {
  CHECK(measure({}, {.succeeded = true, .reference = 4.0}) == Measures{});
}

TEST_CASE("a track has at most 129 places, the first and the last among them", "[batch][measures]") {
  Scene scene = straight(100.0, 0.5);
  scene.robots.push_back(straight(0.2, 1.0).robots.front());
  const std::string text = sketch_of(scene).tracks;
  CHECK(text.starts_with("0.00 0.00,"));
  CHECK(text.ends_with(",50.00 0.00;0.00 0.00,0.10 0.00,0.20 0.00"));
  CHECK(std::count(text.begin(), text.end(), ',') <= 128 + 2);
}

TEST_CASE("walls that join are one line, and the first eight contacts are kept", "[batch][measures]") {
  Scene scene;
  scene.walls = {{{0.0, 0.0}, {1.0, 0.0}}, {{1.0, 0.0}, {1.0, 2.0}}, {{5.0, 5.0}, {6.0, 5.0}}};
  CHECK(sketch_of(scene).walls == "0.00 0.00,1.00 0.00,1.00 2.00;5.00 5.00,6.00 5.00");
  scene.contacts.assign(20, {.label = "wall", .position = {0.5, 0.004}, .time = at(1.0)});
  const std::string contacts = sketch_of(scene).contacts;
  CHECK(contacts.starts_with("0.50 0.00;0.50 0.00;"));
  CHECK(std::count(contacts.begin(), contacts.end(), ';') == 7);
}

TEST_CASE("each measure has a name of its own", "[batch][measures]") {
  std::set<std::string> names;
  for (const Measure& measure : all_measures()) CHECK(names.insert(measure.name).second);
}

TEST_CASE("docs/measures.md lists the measures as they are", "[batch][measures]") {
  std::ifstream page(ORCA_SOURCE_DIR "/docs/measures.md");
  const std::string text{std::istreambuf_iterator<char>(page), {}};
  std::string table = "| measure | unit | what it is |\n|---|---|---|\n";
  for (const Measure& measure : all_measures())
    table += std::string("| `") + measure.name + "` | " + measure.unit + " | " + measure.text + " |\n";
  INFO(table);
  CHECK(text.find(table) != std::string::npos);
}
