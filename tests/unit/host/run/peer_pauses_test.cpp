// SPDX-License-Identifier: GPL-3.0-or-later
// For whom components are suspended.
#include <catch2/catch.hpp>

#include <string>

#include "orca/host/peer_call.hpp"

using namespace orca;
using namespace orca::host;

namespace {

using Act = PeerOrder::Kind;

PeerCall order_of(const std::string& by, Act act) { return {by, 1, {.kind = act, .component = "walk"}}; }

/// A component that obeys, unless a test says otherwise.
struct Walker {
  bool suspended = false;
  bool obeys = true;
  PeerPauses pauses;

  Result<std::string> take(const std::string& by, Act act) {
    return pauses.obey(order_of(by, act), [this](bool suspends) -> Result<bool> {
      if (!obeys) return fail(Code::unavailable, "it does not obey");
      return std::exchange(suspended, suspends) != suspends;
    });
  }
};

Reports all_are(ComponentState state) {
  return [state](const std::string&) {
    ComponentReport report;
    report.state = state;
    return report;
  };
}

}  // namespace

TEST_CASE("a component goes on when the last one for whom it is suspended lets it", "[host][rights]") {
  Walker walk;
  CHECK(walk.take("a", Act::suspend).value() == kPeerWorks);
  CHECK(walk.take("a", Act::suspend).value() == kPeerIsSuspended);
  CHECK(walk.take("b", Act::suspend).value() == kPeerWorks);
  CHECK(walk.take("a", Act::resume).value() == kPeerIsSuspended);
  CHECK(walk.suspended);
  CHECK(walk.take("b", Act::resume).value() == kPeerIsSuspended);
  CHECK_FALSE(walk.suspended);
}

TEST_CASE("what an operator has suspended stays so when a component lets go", "[host][rights]") {
  Walker walk;
  walk.suspended = true;
  CHECK(walk.take("a", Act::suspend).value() == kPeerIsSuspended);
  CHECK(walk.take("a", Act::resume).value() == kPeerWorks);
  CHECK(walk.suspended);
}

TEST_CASE("a component that was lost while it was suspended is suspended anew", "[host][rights]") {
  Walker walk;
  CHECK(walk.take("a", Act::suspend).value() == kPeerWorks);
  walk.suspended = false;  // its process has begun again
  CHECK(walk.take("a", Act::suspend).value() == kPeerWorks);
  CHECK(walk.suspended);
}

TEST_CASE("what is suspended for a component that works no more is to go on", "[host][rights]") {
  Walker walk;
  REQUIRE(walk.take("a", Act::suspend));
  CHECK(walk.pauses.left(all_are(ComponentState::work)).empty());
  CHECK(walk.pauses.left(all_are(ComponentState::suspended_work)).empty());
  for (const auto state : {ComponentState::work_done, ComponentState::broken, ComponentState::unloaded}) {
    const auto left = walk.pauses.left(all_are(state));
    REQUIRE(left.size() == 1);
    CHECK(left[0].by == "a");
    CHECK(left[0].order.kind == Act::resume);
    CHECK(left[0].order.component == "walk");
  }
  walk.obeys = false;
  CHECK_FALSE(walk.take("a", Act::resume).has_value());
  CHECK(walk.pauses.left(all_are(ComponentState::broken)).size() == 1);  // it is tried again
  walk.pauses.forget("walk");
  CHECK(walk.pauses.left(all_are(ComponentState::broken)).empty());
}
