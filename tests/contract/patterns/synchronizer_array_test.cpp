// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of the Synchronizer for port arrays, whose servers are chosen at run time, for every link.
#include "link_kits.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// Receives the wishes of any number of behaviours, and a stop button.
struct ArrayFuser : Peer {
  explicit ArrayFuser(Executive& executive) : Peer(executive, "fuser") {
    both.add(motion);
    both.add(button);
  }
  PushProxyArray<MotionCommand> motion{*this, "motion"};
  PushProxy<MotionCommand> button{*this, "button"};
  Synchronizer both;
};

// Three behaviours and a button are connected. The fuser is subscribed to the button only.
template <class Kit>
struct ArrayRobot {
  explicit ArrayRobot(Kit& kit) : executive(kit.executive), fuser(kit.executive) {
    for (Source* source : {&goto_, &avoid, &wall})
      kit.connect(source->endpoint("out"), fuser.endpoint("motion"));
    kit.connect(button.endpoint("out"), fuser.endpoint("button"));
    fuser.button.subscribe();
    CHECK(eventually(executive, [&] { return button.out.subscriber_count() == 1; }));
  }

  // Subscribes to a behaviour, as a fuser does when a client list names it.
  void listen(Source& source) {
    of(source).subscribe();
    CHECK(eventually(executive, [&] { return source.out.subscriber_count() == 1; }));
  }
  void leave(Source& source) { of(source).unsubscribe(); }

  // Pushes and waits until the object has arrived.
  void push(Source& source) {
    source.push_numbers(1, 1);
    const bool is_button = &source == &button;
    CHECK(eventually(executive, [&] {
      return is_button ? fuser.button.new_data_arrived() : of(source).new_data_arrived();
    }));
  }

  [[nodiscard]] PushSourceOf<MotionCommand> of(const Source& source) const {
    for (const auto& candidate : fuser.motion.sources())
      if (candidate.path() == const_cast<Source&>(source).endpoint("out").path()) return candidate;
    FAIL("no such source");
    return fuser.motion.sources().front();
  }

  Executive& executive;
  Source goto_{executive, "goto"};
  Source avoid{executive, "avoid"};
  Source wall{executive, "wall"};
  Source button{executive, "button"};
  ArrayFuser fuser;
};

}  // namespace

CONTRACT_CASE("wait for a port array ends with the first object of any server", "[contract][synchronizer]") {
  ArrayRobot robot(kit);
  robot.listen(robot.goto_);
  robot.listen(robot.avoid);
  Script script(robot.fuser, [&] { robot.fuser.both.wait(robot.fuser.motion); });
  robot.push(robot.button);
  CHECK_FALSE(script.ends_within(20ms));
  robot.push(robot.avoid);
  CHECK(script.ends_within(5s));
}

CONTRACT_CASE("wait names the port array if one of its servers has sent something",
              "[contract][synchronizer]") {
  ArrayRobot robot(kit);
  robot.listen(robot.avoid);
  CHECK(robot.fuser.both.wait(1ms) == nullptr);
  robot.push(robot.button);
  CHECK(&robot.fuser.both.wait() == &robot.fuser.button);
  robot.push(robot.avoid);
  CHECK(&robot.fuser.both.wait() == &robot.fuser.motion);
}

CONTRACT_CASE("wait_all waits for every server that a port array is subscribed to, and for no other",
              "[contract][synchronizer]") {
  ArrayRobot robot(kit);
  robot.listen(robot.goto_);
  robot.listen(robot.avoid);
  robot.push(robot.button);
  robot.push(robot.goto_);
  CHECK_FALSE(robot.fuser.both.wait_all(10ms));
  robot.push(robot.avoid);
  CHECK(robot.fuser.both.wait_all(5s));
}

CONTRACT_CASE(
    "a server that a port array is subscribed to later is waited for, and one that it leaves is not",
    "[contract][synchronizer]") {
  ArrayRobot robot(kit);
  robot.listen(robot.goto_);
  robot.push(robot.button);
  robot.push(robot.goto_);
  CHECK(robot.fuser.both.wait_all(5s));
  robot.listen(robot.wall);
  CHECK_FALSE(robot.fuser.both.wait_all(10ms));
  robot.leave(robot.wall);
  CHECK(robot.fuser.both.wait_all(5s));
}

CONTRACT_CASE("a server is subscribed to while the component waits for all", "[contract][synchronizer]") {
  ArrayRobot robot(kit);
  robot.push(robot.button);
  Script script(robot.fuser, [&] { robot.fuser.both.wait_all(); });
  CHECK_FALSE(script.ends_within(10ms));  // the array is subscribed to nobody
  robot.listen(robot.wall);
  robot.push(robot.wall);
  CHECK(script.ends_within(5s));
}

CONTRACT_CASE("wait_all can be given up for a reason that comes with an object", "[contract][synchronizer]") {
  ArrayRobot robot(kit);
  robot.listen(robot.goto_);
  robot.listen(robot.avoid);
  std::atomic<bool> complete{true};
  const auto pressed = [&] { return robot.fuser.button.new_data_arrived(); };
  Script script(robot.fuser, [&] { complete = robot.fuser.both.wait_all(1h, pressed); });
  robot.push(robot.goto_);
  CHECK_FALSE(script.ends_within(10ms));
  robot.push(robot.button);
  REQUIRE(script.ends_within(5s));
  CHECK_FALSE(complete);
}

CONTRACT_CASE("a removed port array is waited for no longer", "[contract][synchronizer]") {
  ArrayRobot robot(kit);
  robot.listen(robot.goto_);
  robot.push(robot.button);
  CHECK_FALSE(robot.fuser.both.wait_all(1ms));
  robot.fuser.both.remove(robot.fuser.motion);
  CHECK(robot.fuser.both.wait_all(5s));
}
