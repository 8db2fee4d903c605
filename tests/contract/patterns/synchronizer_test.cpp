// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of the Synchronizer (thesis 7.4, Fig. 7.11), for every link.
#include "link_kits.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// Receives the wishes of two behaviours.
struct Fuser : Peer {
  explicit Fuser(Executive& executive) : Peer(executive, "fuser") {
    both.add(goto_);
    both.add(avoid);
  }
  PushProxy<MotionCommand> goto_{*this, "goto"};
  PushProxy<MotionCommand> avoid{*this, "avoid"};
  PushServer<MotionCommand> fused{*this, "fused"};
  Synchronizer both;
};

template <class Kit>
struct Behaviours {
  explicit Behaviours(Kit& kit)
      : goto_(kit.executive, "goto"), avoid(kit.executive, "avoid"), fuser(kit.executive) {
    kit.connect(goto_.endpoint("out"), fuser.endpoint("goto"));
    kit.connect(avoid.endpoint("out"), fuser.endpoint("avoid"));
    fuser.goto_.subscribe();
    fuser.avoid.subscribe();
    CHECK(eventually(kit.executive,
                     [&] { return goto_.out.subscriber_count() == 1 && avoid.out.subscriber_count() == 1; }));
  }
  // Pushes and waits until the object has arrived.
  void wish_goto(int number) { push(goto_, fuser.goto_, number); }
  void wish_avoid(int number) { push(avoid, fuser.avoid, number); }

  Source goto_;
  Source avoid;
  Fuser fuser;

 private:
  static void push(Source& from, const PushProxy<MotionCommand>& to, int number) {
    const std::uint64_t before = to.counters().delivered;
    from.push_numbers(number, number);
    CHECK(eventually(from.executive(), [&] { return to.counters().delivered == before + 1; }));
  }
};

}  // namespace

CONTRACT_CASE("wait for one subject ends when that one has new data, whatever the others have",
              "[contract][synchronizer]") {
  Behaviours robot(kit);
  Script script(robot.fuser, [&] { robot.fuser.both.wait(robot.fuser.avoid); });
  robot.wish_goto(1);
  CHECK_FALSE(script.ends_within(20ms));
  robot.wish_avoid(2);
  CHECK(script.ends_within(5s));
  CHECK(robot.fuser.avoid.new_data_arrived());
}

CONTRACT_CASE("wait for any subject names the one with new data; of several, the one that was added first",
              "[contract][synchronizer]") {
  Behaviours robot(kit);
  std::atomic<PushSubject*> found{nullptr};
  Script script(robot.fuser, [&] { found = &robot.fuser.both.wait(); });
  CHECK_FALSE(script.ends_within(20ms));
  robot.wish_avoid(1);
  REQUIRE(script.ends_within(5s));
  CHECK(found == &robot.fuser.avoid);
  robot.wish_goto(2);
  CHECK(&robot.fuser.both.wait() == &robot.fuser.goto_);
}

CONTRACT_CASE("wait for any subject can end by a condition, which new data precede",
              "[contract][synchronizer]") {
  Behaviours robot(kit);
  std::atomic<bool> enough = false;
  std::atomic<PushSubject*> found{&robot.fuser.goto_};
  Script script(robot.fuser, [&] { found = robot.fuser.both.wait(1h, [&] { return enough.load(); }); });
  CHECK_FALSE(script.ends_within(20ms));
  enough = true;
  robot.fuser.strand().wake();
  REQUIRE(script.ends_within(5s));
  CHECK(found == nullptr);
  robot.wish_avoid(1);
  CHECK(robot.fuser.both.wait(1h, [] { return true; }) == &robot.fuser.avoid);
  CHECK(robot.fuser.both.wait(Duration{0}, [] { return false; }) == &robot.fuser.avoid);
}

CONTRACT_CASE("wait_all ends when all subjects have new data", "[contract][synchronizer]") {
  Behaviours robot(kit);
  Script script(robot.fuser, [&] { robot.fuser.both.wait_all(); });
  robot.wish_goto(1);
  robot.wish_goto(2);
  CHECK_FALSE(script.ends_within(20ms));
  robot.wish_avoid(3);
  CHECK(script.ends_within(5s));
}

CONTRACT_CASE("wait_all with a limit reports whether all subjects had new data in time",
              "[contract][synchronizer]") {
  Behaviours robot(kit);
  robot.wish_goto(1);
  const TimePoint before = kit.executive.now();
  CHECK_FALSE(robot.fuser.both.wait_all(20ms));
  CHECK(kit.executive.now() - before >= 20ms);
  robot.wish_avoid(2);
  const TimePoint complete = kit.executive.now();
  CHECK(robot.fuser.both.wait_all(1h));
  if (kit.executive.is_virtual()) CHECK(kit.executive.now() == complete);
}

CONTRACT_CASE("wait for one subject or for any may be limited too", "[contract][synchronizer]") {
  Behaviours robot(kit);
  Fuser& fuser = robot.fuser;
  robot.wish_goto(1);
  CHECK(fuser.both.wait(fuser.goto_, 1h));
  CHECK(fuser.both.wait(1h) == &fuser.goto_);
  const TimePoint before = kit.executive.now();
  CHECK_FALSE(fuser.both.wait(fuser.avoid, 20ms));
  CHECK(kit.executive.now() - before >= 20ms);
  CHECK(number_of(fuser.goto_.get_update()) == 1);
  CHECK(fuser.both.wait(20ms) == nullptr);
  CHECK(kit.executive.now() - before >= 40ms);
}

CONTRACT_CASE("waiting takes nothing from the proxies", "[contract][synchronizer]") {
  Behaviours robot(kit);
  robot.wish_goto(1);
  robot.wish_avoid(2);
  robot.fuser.both.wait_all();
  robot.fuser.both.wait_all();
  CHECK(number_of(robot.fuser.goto_.get_update()) == 1);
  CHECK(number_of(robot.fuser.avoid.get_update()) == 2);
  CHECK_FALSE(robot.fuser.both.wait_all(1ms));
}

CONTRACT_CASE("a removed subject is waited for no longer, and one added twice counts once",
              "[contract][synchronizer]") {
  Behaviours robot(kit);
  robot.fuser.both.add(robot.fuser.avoid);
  robot.fuser.both.remove(robot.fuser.avoid);
  robot.wish_avoid(1);
  robot.wish_goto(2);
  CHECK(robot.fuser.both.wait_all(5s));
  CHECK(&robot.fuser.both.wait() == &robot.fuser.goto_);
  CHECK(number_of(robot.fuser.goto_.get_update()) == 2);
  CHECK_FALSE(robot.fuser.both.wait_all(1ms));
}

CONTRACT_CASE("a synchronizer does not hold a component that must leave its lap",
              "[contract][synchronizer]") {
  Behaviours robot(kit);
  Script script(robot.fuser, [&] { robot.fuser.both.wait_all(); });
  sleep(kit.executive, 5ms);
  robot.fuser.leave();
  REQUIRE(script.ends_within(5s));
  CHECK(script.interrupted());
}

// The three policies of thesis 7.4, as a fuser would write them. A fused command is 100 times the wish of
// goto plus the wish of avoid; a behaviour that has not spoken yet counts as 0.
namespace {

int wish(const ObjectPtr<MotionCommand>& command) { return command ? number_of(command) : 0; }

int fuse(const ObjectPtr<MotionCommand>& goto_wish, const ObjectPtr<MotionCommand>& avoid_wish) {
  return 100 * wish(goto_wish) + wish(avoid_wish);
}

template <class Kit>
struct FusedCommands : Listener {
  explicit FusedCommands(Kit& kit, Fuser& fuser) : Listener(kit.executive, "base") {
    kit.connect(fuser.endpoint("fused"), endpoint("in"), {.depth = 100});
    in.subscribe();
    CHECK(eventually(kit.executive, [&] { return fuser.fused.subscriber_count() == 1; }));
  }
  int next() { return number_of(in.get_update_wait_max(5s)); }
};

}  // namespace

CONTRACT_CASE("policy 1 of thesis 7.4: wait until all behaviours have delivered, then fuse",
              "[contract][synchronizer]") {
  Behaviours robot(kit);
  Fuser& fuser = robot.fuser;
  FusedCommands base(kit, fuser);
  const Script script(fuser, [&] {
    for (;;) {
      fuser.both.wait_to_fuse(Fusing::all);
      const auto goto_wish = fuser.goto_.get_update();
      fuser.fused.push(numbered(fuse(goto_wish, fuser.avoid.get_update())));
    }
  });
  robot.wish_goto(1);
  robot.wish_goto(2);
  CHECK(base.in.get_update_wait_max(20ms) == nullptr);
  robot.wish_avoid(7);
  CHECK(base.next() == 207);
  robot.wish_avoid(8);
  robot.wish_goto(3);
  CHECK(base.next() == 308);
}

CONTRACT_CASE("policy 2 of thesis 7.4: fuse every wish with the latest of the others",
              "[contract][synchronizer]") {
  Behaviours robot(kit);
  Fuser& fuser = robot.fuser;
  FusedCommands base(kit, fuser);
  const Script script(fuser, [&] {
    for (;;) {
      fuser.both.wait_to_fuse(Fusing::any);
      for (PushProxy<MotionCommand>* behaviour : {&fuser.goto_, &fuser.avoid})
        if (behaviour->new_data_arrived()) behaviour->get_update();
      fuser.fused.push(numbered(fuse(fuser.goto_.latest(), fuser.avoid.latest())));
    }
  });
  robot.wish_goto(1);
  CHECK(base.next() == 100);
  robot.wish_avoid(7);
  CHECK(base.next() == 107);
  robot.wish_avoid(8);
  CHECK(base.next() == 108);
  robot.wish_goto(2);
  CHECK(base.next() == 208);
}

CONTRACT_CASE("policy 3 of thesis 7.4: fuse the latest of all by one clock", "[contract][synchronizer]") {
  Behaviours robot(kit);
  Fuser& fuser = robot.fuser;
  FusedCommands base(kit, fuser);
  robot.wish_goto(1);
  const TimePoint start = kit.executive.now();
  const Script script(fuser, [&] {
    for (;;) {
      fuser.both.wait_to_fuse(Fusing::clock, 20ms);
      fuser.fused.push(numbered(fuse(fuser.goto_.latest(), fuser.avoid.latest())));
    }
  });
  const auto first = base.in.get_update_wait_max(5s);
  CHECK(number_of(first) == 100);
  CHECK(first->creation_time().ns() >= (start + 20ms).time_since_epoch().count());
  robot.wish_goto(2);
  robot.wish_avoid(7);
  CHECK(eventually(kit.executive, [&] { return base.next() == 207; }));
  CHECK(base.next() == 207);
}

CONTRACT_CASE("the clock of policy 3 keeps its beat and leaves out what was missed",
              "[contract][synchronizer]") {
  if (!kit.executive.is_virtual()) return;  // only there the times are exact
  Behaviours robot(kit);
  const TimePoint start = kit.executive.now();
  const auto next_tick = [&] {
    robot.fuser.both.wait_to_fuse(Fusing::clock, 20ms);
    return kit.executive.now() - start;
  };
  CHECK(next_tick() == 20ms);
  sleep(kit.executive, 5ms);
  CHECK(next_tick() == 40ms);
  sleep(kit.executive, 50ms);
  CHECK(next_tick() == 100ms);
  CHECK(next_tick() == 120ms);
}
