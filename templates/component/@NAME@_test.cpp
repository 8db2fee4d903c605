#include <catch2/catch.hpp>

#include "orca/idl/motion.hpp"
#include "orca/idl/sensing.hpp"
#include "orca/testing/component_trial.hpp"

namespace {

// Ports of the test: each is connected to the component's port of the same name.
struct Ports final : orca::testing::Partner {
  using Partner::Partner;
  orca::PushServer<orca::idl::RangeReadings> ranges{*this, "ranges"};
  orca::PushProxy<orca::idl::MotionCommand> motion{*this, "motion"};
};

const orca::testing::Trial kTrial{.type = "@TYPE@", .params = {{"stop_distance", "0.6 m"}}};

}  // namespace

TEST_CASE("it commands a full stop while something is nearer than stop_distance") {
  orca::testing::try_component<Ports>(kTrial, [](Ports& test) {
    for (const double range : {2.0, 0.61, 0.59, 2.0}) {
      auto readings = test.ranges.loan();
      readings->ranges({3.0, range, 3.0});
      test.ranges.push(std::move(readings));
      CAPTURE(range);
      const bool stops = test.motion.get_update_wait()->kind() == orca::idl::FULLSTOP;
      CHECK(stops == (range < 0.6));
    }
  });
}
