// SPDX-License-Identifier: GPL-3.0-or-later
// What a localizer is worth, by the true poses: does it notice that its robot was carried off, and does it find it again?
#include "orca/batch/localization.hpp"

#include <catch2/catch.hpp>

#include <functional>

#include "orca/batch/measures.hpp"
#include "orca/hw/scene.hpp"

using namespace orca;
using namespace orca::batch;
using Says = PoseClaim::Says;

namespace {

TimePoint instant(double seconds) { return TimePoint{} + from_seconds(seconds); }

constexpr double kCarried = 10.0;  // [s]
constexpr double kEnd = 40.0;      // [s]

// A robot that drives along the x axis at that speed [m/s], and is carried 5 m to the left at kCarried.
Pose2 truth(double time, double speed) { return {speed * time, time < kCarried ? 0.0 : 5.0, 0.0}; }

Scene scene(double speed) {
  Scene::Robot robot{.name = "Pioneer", .pose = {}, .outline = {}, .track = {}, .moments = {}, .motion = {}};
  for (int i = 0; i <= std::lround(10.0 * kEnd); ++i)
    robot.motion.push_back({instant(0.1 * i), truth(0.1 * i, speed), {}, 1.0});
  Scene scene;
  scene.robots = {robot};
  return scene;
}

using Localizer = std::function<PoseClaim(double time)>;

// The shares of a localizer that speaks between the true poses.
LocalizationShares shares(const Localizer& says, double speed = 0.3) {
  std::vector<PoseClaim> claims;
  for (int i = 0; i < std::lround(10.0 * kEnd); ++i) {
    const double time = 0.1 * i + 0.05;
    claims.push_back(says(time));
    claims.back().stamp = instant(time);
  }
  return judge_poses(claims, scene(speed));
}

PoseClaim at(const Pose2& pose) { return {.says = Says::place, .X_WR = pose}; }
PoseClaim lost() { return {}; }
PoseClaim one_of_several() { return {.says = Says::several}; }

// Goes on as if nothing had happened.
Pose2 unaware(double time, double speed = 0.3) { return {speed * time, 0.0, 0.0}; }

}  // namespace

TEST_CASE("a localizer that says at once that it is lost, and soon where the robot is, has noticed and found",
          "[batch][localization]") {
  const LocalizationShares all = shares(
      [](double time) { return time > kCarried && time < kCarried + 2.0 ? lost() : at(truth(time, 0.3)); });
  CHECK(all == LocalizationShares{1.0, 1.0, 0.0, 0.0});
}

TEST_CASE("a localizer that does not notice is sure and wrong", "[batch][localization]") {
  const LocalizationShares all = shares([](double time) { return at(unaware(time)); });
  CHECK(all.noticed == 0.0);
  CHECK(all.found_again == 0.0);
  // All the time after the kidnapping but for the first three seconds.
  CHECK(*all.sure_but_wrong == Approx((kEnd - kCarried - 3.0) / (kEnd - 3.0)).margin(0.005));
}

TEST_CASE("a localizer has 3 s or 1 m to notice, whichever is more", "[batch][localization]") {
  const auto noticed_after = [](double wait, double speed) {
    return *shares([&](double time) { return time > kCarried + wait ? lost() : at(unaware(time, speed)); },
                   speed)
                .noticed;
  };
  CHECK(noticed_after(2.8, 0.5) == 1.0);
  CHECK(noticed_after(3.2, 0.5) == 0.0);
  CHECK(noticed_after(9.5, 0.1) == 1.0);
  CHECK(noticed_after(10.5, 0.1) == 0.0);
}

TEST_CASE("a localizer has 15 s or 8 m to find the robot, to 10 cm and 5 degrees", "[batch][localization]") {
  const auto found_after = [](double wait, double speed, double off = 0.0, double turned = 0.0) {
    return *shares(
                [&](double time) {
                  if (time < kCarried + wait) return lost();
                  const Pose2 pose = truth(time, speed);
                  return at({pose.x, pose.y + off, pose.yaw + turned});
                },
                speed)
                .found_again;
  };
  CHECK(found_after(14.8, 0.6) == 1.0);
  CHECK(found_after(15.2, 0.6) == 0.0);
  CHECK(found_after(19.0, 0.4) == 1.0);
  CHECK(found_after(21.0, 0.4) == 0.0);
  CHECK(found_after(5.0, 0.4, 0.09, 0.08) == 1.0);
  CHECK(found_after(5.0, 0.4, 0.11) == 0.0);
  CHECK(found_after(5.0, 0.4, 0.0, 0.09) == 0.0);
}

TEST_CASE("what a localizer says of several places is neither right nor wrong", "[batch][localization]") {
  const LocalizationShares all =
      shares([](double time) { return time > kCarried ? one_of_several() : at(truth(time, 0.3)); });
  CHECK(all.noticed == 1.0);
  CHECK(all.found_again == 0.0);
  CHECK(all.sure_but_wrong == 0.0);
  CHECK(*all.ambiguous == Approx(0.75).margin(0.005));
}

TEST_CASE("without a localizer, or a kidnapping, nothing is said of it", "[batch][localization]") {
  CHECK(judge_poses({}, scene(0.3)) == LocalizationShares{});
  Scene quiet = scene(0.3);
  quiet.robots[0].motion.resize(50);
  std::vector<PoseClaim> claims{at(truth(1.0, 0.3))};
  claims[0].stamp = instant(1.0);
  const LocalizationShares all = judge_poses(claims, quiet);
  CHECK_FALSE(all.noticed);
  CHECK_FALSE(all.found_again);
  CHECK(all.sure_but_wrong == 0.0);
}

TEST_CASE("a way over which the robot was carried is none that it drove", "[batch][localization]") {
  const RunEnd end{.succeeded = true, .end = instant(kEnd)};
  CHECK(*measure(scene(0.3), end).way == Approx(0.3 * kEnd).margin(0.05));
}
