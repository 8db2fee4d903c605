// SPDX-License-Identifier: GPL-3.0-or-later
// When a LookAround speaks, and when it does not.
#include <catch2/catch.hpp>

#include <cmath>

#include "seeing_partner.hpp"

using namespace orca;
using namespace orca::testing;
using namespace std::chrono_literals;

namespace {

/// All that a LookAround hears, in a room of 3 m by 3 m: its laser, odometry and localizer.
struct Lost final : Partner {
  using Partner::Partner;
  PushServer<idl::LaserRangeReadings> laser{*this, "laser"};
  PushServer<idl::Odometry> odometry{*this, "odometry"};
  PushServer<idl::Localization> localization{*this, "localization"};
  PushProxy<idl::MotionCommand> motion{*this, "motion"};

  // Half a second in which the localizer says that. Returns what is advised in the end.
  ObjectPtr<idl::MotionCommand> hear(idl::LocalizationState state) {
    for (int i = 0; i < 10; ++i) {
      auto scan = laser.loan();
      scan->min_range(0.02);
      scan->max_range(kFar);
      scan->angle_start(-180 * kDegree);
      scan->angle_increment(kDegree);
      for (int k = -180; k < 180; ++k) {
        const double angle = k * kDegree;
        scan->ranges().push_back(1.5 / std::max(std::fabs(std::cos(angle)), std::fabs(std::sin(angle))));
      }
      scan->stamp(to_time_value(now()));
      laser.push(std::move(scan));
      auto belief = localization.loan();
      belief->state(state);
      localization.push(std::move(belief));
      auto here = odometry.loan();
      here->stamp(to_time_value(now()));
      odometry.push(std::move(here));
      sleep(50ms);
    }
    return motion.latest();
  }
};

}  // namespace

TEST_CASE("LookAround has no opinion while it is known where the robot is", "[testing][look]") {
  try_component<Lost>({.type = "orca.LookAround"}, [](Lost& test) {
    for (int i = 0; i < 10; ++i)
      CHECK(test.hear(idl::LOCALIZATION_LOCALIZED)->kind() == idl::MotionKind::DONTCARE);
  });
}

TEST_CASE("LookAround waits a moment, and then turns the robot until it is known where it is",
          "[testing][look]") {
  for (const auto state : {idl::LOCALIZATION_UNKNOWN, idl::LOCALIZATION_AMBIGUOUS, idl::LOCALIZATION_LOST})
    try_component<Lost>({.type = "orca.LookAround"}, [&](Lost& test) {
      CHECK(test.hear(state)->kind() == idl::MotionKind::DONTCARE);
      for (int i = 0; i < 3; ++i) (void)test.hear(state);
      const auto turning = test.hear(state);
      CHECK(turning->kind() == idl::MotionKind::NORMAL);
      CHECK(turning->speed() == 0.0);
      CHECK(std::fabs(turning->turn_rate()) == Approx(1.0));
      CHECK(test.hear(idl::LOCALIZATION_LOCALIZED)->kind() == idl::MotionKind::DONTCARE);
    });
}

TEST_CASE("LookAround gives up in time, and begins again after the robot was found", "[testing][look]") {
  try_component<Lost>({.type = "orca.LookAround", .params = {{"limit", "5 s"}}}, [](Lost& test) {
    for (int i = 0; i < 12; ++i) (void)test.hear(idl::LOCALIZATION_AMBIGUOUS);
    CHECK(test.motion.latest()->kind() == idl::MotionKind::NORMAL);
    for (int i = 0; i < 3; ++i) (void)test.hear(idl::LOCALIZATION_AMBIGUOUS);
    CHECK(test.motion.latest()->kind() == idl::MotionKind::DONTCARE);
    // Not if it was found for some seconds only: it may be in another building.
    for (int i = 0; i < 18; ++i) (void)test.hear(idl::LOCALIZATION_LOCALIZED);
    for (int i = 0; i < 5; ++i) (void)test.hear(idl::LOCALIZATION_AMBIGUOUS);
    CHECK(test.motion.latest()->kind() == idl::MotionKind::DONTCARE);
    for (int i = 0; i < 62; ++i) (void)test.hear(idl::LOCALIZATION_LOCALIZED);
    for (int i = 0; i < 5; ++i) (void)test.hear(idl::LOCALIZATION_AMBIGUOUS);
    CHECK(test.motion.latest()->kind() == idl::MotionKind::NORMAL);
  });
}
