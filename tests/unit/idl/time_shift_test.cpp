// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/idl/time_shift.hpp"

#include <catch2/catch.hpp>

#include "orca/idl/motion.hpp"
#include "orca/idl/navigation.hpp"
#include "orca/idl/sensing.hpp"

using namespace orca;

namespace {

std::int64_t ns(const idl::TimeValue& time) { return time.ns(); }

}  // namespace

TEST_CASE("all instants in an object are shifted, in its header, in its parts and in its lists",
          "[idl][time_shift]") {
  ObjectLoan loan = make_object(object_type<idl::SonarRangeReadings>());
  auto& readings = *static_cast<idl::SonarRangeReadings*>(loan.get());
  readings.creation_time().ns(5'000);
  readings.ranges({1.0, 2.0});
  readings.stamps().resize(2);
  readings.stamps()[0].ns(3'000);
  readings.stamps()[1].ns(4'000);
  shift_times(loan, 1us);
  CHECK(ns(readings.creation_time()) == 6'000);
  CHECK(ns(readings.stamps()[0]) == 4'000);
  CHECK(ns(readings.stamps()[1]) == 5'000);
  CHECK(readings.ranges()[1] == 2.0);
}

TEST_CASE("an instant that is not known stays so", "[idl][time_shift]") {
  ObjectLoan loan = make_object(object_type<idl::Odometry>());
  auto& odometry = *static_cast<idl::Odometry*>(loan.get());
  odometry.creation_time().ns(5'000);
  shift_times(loan, -1us);
  CHECK(ns(odometry.creation_time()) == 4'000);
  CHECK(ns(odometry.stamp()) == 0);
}

TEST_CASE("instants that no clock has shown are no reason to fail", "[idl][time_shift]") {
  ObjectLoan loan = make_object(object_type<idl::Odometry>());
  auto& odometry = *static_cast<idl::Odometry*>(loan.get());
  for (const std::int64_t wild : {INT64_MIN, INT64_MAX}) {
    odometry.stamp().ns(wild);
    shift_times(loan, 1h);
    shift_times(loan, -1h);
    CHECK(ns(odometry.stamp()) == wild);
  }
}
