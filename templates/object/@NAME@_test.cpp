#include <catch2/catch.hpp>

#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/testing/component_trial.hpp"

#include "@NAME@_objects/@NAME@.hpp"

namespace {

// What the tests push goes to the component's port of the same name, and what the component pushes comes back.
struct OfFinder final : orca::testing::Partner {
  using Partner::Partner;
  orca::PushServer<orca::idl::RangeReadings> ranges{*this, "ranges"};
  orca::PushProxy<my::@CLASS@> nearest{*this, "nearest"};
};

struct OfStop final : orca::testing::Partner {
  using Partner::Partner;
  orca::PushServer<my::@CLASS@> nearest{*this, "nearest"};
  orca::PushProxy<orca::idl::MotionCommand> motion{*this, "motion"};
};

}  // namespace

TEST_CASE("the nearest reading is found, with the number of its sensor") {
  orca::testing::try_component<OfFinder>({.type = "@TYPE@Finder"}, [](OfFinder& test) {
    auto readings = test.ranges.loan();
    readings->ranges({3.0, 0.7, 2.0});
    test.ranges.push(std::move(readings));
    const auto found = test.nearest.get_update_wait();
    CHECK(found->distance() == 0.7);
    CHECK(found->sensor() == 1);
  });
}

TEST_CASE("a robot is stopped while something is nearer than stop_distance") {
  orca::testing::try_component<OfStop>({.type = "@TYPE@Stop"}, [](OfStop& test) {
    for (const double distance : {2.0, 0.51, 0.49, 2.0}) {
      auto nearest = test.nearest.loan();
      nearest->distance(distance);
      test.nearest.push(std::move(nearest));
      CAPTURE(distance);
      CHECK((test.motion.get_update_wait()->kind() == orca::idl::FULLSTOP) == (distance < 0.5));
    }
  });
}
