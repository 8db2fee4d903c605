// SPDX-License-Identifier: GPL-3.0-or-later
// What starts a lap: time, an object on one of several ports, or objects on all of them.
#include <catch2/catch.hpp>

#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "peer.hpp"
#include "run/component/parts/lap_trigger.hpp"

using namespace orca;
using namespace orca::host;
using namespace orca::test;
using idl::MotionCommand;

namespace {

constexpr TimePoint kStart{100s};

PortContract input(const std::string& name, bool many = false) {
  PortContract contract;
  contract.name = name;
  contract.role = Role::proxy;
  contract.type = type_id(object_type<MotionCommand>());
  contract.many = many;
  return contract;
}

struct Speaker : Peer {
  Speaker(Executive& executive, const std::string& name) : Peer(executive, name) {}
  PushServer<MotionCommand> out{*this, "out"};
};

// A component with two PushProxies and a port array, and three peers that push to them.
struct Listener {
  explicit Listener(Executive& executive)
      : left(executive, "left"),
        right(executive, "right"),
        third(executive, "third"),
        strand(executive, {"listener", 0}),
        home{strand, "listener"},
        ports(home) {
    ports.add(input("left"));
    ports.add(input("right"));
    ports.add(input("many", true));
    connect(left, "left");
    connect(right, "right");
    ports.add(input("old", false));
    ports.add(input("new", false));
    connect(left, "old", {.depth = 4});
    connect(right, "new", {.depth = 4});
    connect(left, "many");
    connect(third, "many");
  }
  void connect(Speaker& from, const std::string& to, const QueuePolicy& policy = {}) {
    REQUIRE(links.connect(from.endpoint("out"), *ports.find(to), policy).ok());
  }
  PushClientEndpoint& port(const std::string& name) {
    return dynamic_cast<PushClientEndpoint&>(*ports.find(name));
  }

  Speaker left, right, third;
  Strand strand;
  PortHome home;
  PortSet ports;
  LocalLinks links;
  LapTrigger trigger;
};

void with_listener(const std::function<void(Listener&)>& check, const ExecutiveOptions& options = {}) {
  run_on(options, [&](Executive& executive) {
    Listener listener(executive);
    for (const char* name : {"left", "right", "many"}) listener.port(name).subscribe_all();
    check(listener);
  });
}

}  // namespace

TEST_CASE("on any of several ports each new object starts a lap", "[host][trigger]") {
  with_listener([](Listener& listener) {
    REQUIRE(listener.trigger.choose({Trigger::Kind::on_any, {}, {"left", "right"}}, listener.ports).ok());
    listener.trigger.begin(kStart);
    CHECK_FALSE(listener.trigger.is_due(kStart + 1h));
    CHECK(listener.trigger.next() == kForever);
    listener.right.out.push(MotionCommand{});
    CHECK(listener.trigger.is_due(kStart));
    (void)listener.port("right").edges()[0]->take();
    CHECK_FALSE(listener.trigger.is_due(kStart));
  });
}

TEST_CASE("on all of several ports a lap starts when each server has sent something", "[host][trigger]") {
  with_listener([](Listener& listener) {
    REQUIRE(listener.trigger.choose({Trigger::Kind::on_all, {}, {"right", "many"}}, listener.ports).ok());
    listener.trigger.begin(kStart);
    listener.right.out.push(MotionCommand{});
    listener.left.out.push(MotionCommand{});
    CHECK_FALSE(listener.trigger.is_due(kStart));
    listener.third.out.push(MotionCommand{});
    CHECK(listener.trigger.is_due(kStart));
  });
}

TEST_CASE("on stamps a lap starts with objects of one moment, and older ones are dropped",
          "[host][trigger]") {
  with_listener(
      [](Listener& listener) {
        Executive& executive = listener.strand.executive();
        listener.port("old").subscribe_all();
        listener.port("new").subscribe_all();
        const Trigger trigger{Trigger::Kind::on_stamps, {}, {"old", "new"}, 10ms};
        REQUIRE(listener.trigger.choose(trigger, listener.ports).ok());
        listener.trigger.begin(kStart);
        listener.left.out.push(MotionCommand{});
        sleep(executive, 20ms);
        listener.right.out.push(MotionCommand{});
        CHECK_FALSE(listener.trigger.is_due(kStart + 1h));
        CHECK(listener.port("old").edges()[0]->counters().unmatched == 1);
        sleep(executive, 10ms);
        listener.left.out.push(MotionCommand{});
        CHECK(listener.trigger.is_due(kStart));  // 10 ms apart
        CHECK(listener.trigger.is_due(kStart));
        (void)listener.port("new").edges()[0]->take();
        CHECK_FALSE(listener.trigger.is_due(kStart));
      },
      virtual_executives().front());
}

TEST_CASE("a server that a port array has left does not hold up the others", "[host][trigger]") {
  with_listener([](Listener& listener) {
    REQUIRE(listener.trigger.choose({Trigger::Kind::on_all, {}, {"many"}}, listener.ports).ok());
    listener.port("many").edges()[1]->unsubscribe();
    CHECK_FALSE(listener.trigger.is_due(kStart));
    listener.left.out.push(MotionCommand{});
    CHECK(listener.trigger.is_due(kStart));
  });
}

TEST_CASE("with a longest time between two laps one starts without objects too", "[host][trigger]") {
  with_listener([](Listener& listener) {
    REQUIRE(listener.trigger.choose({Trigger::Kind::on_any, 50ms, {"left"}}, listener.ports).ok());
    listener.trigger.begin(kStart);
    CHECK_FALSE(listener.trigger.is_due(kStart + 49ms));
    CHECK(listener.trigger.next() == kStart + 50ms);
    CHECK(listener.trigger.is_due(kStart + 50ms));
    listener.trigger.lap_begins(kStart + 30ms);  // an object came before
    CHECK_FALSE(listener.trigger.is_due(kStart + 79ms));
    CHECK(listener.trigger.is_due(kStart + 80ms));
  });
}

TEST_CASE("the time between two laps is the period, or what the servers announce that start them",
          "[host][trigger]") {
  with_listener([](Listener& listener) {
    const auto period_of = [&](const Trigger& trigger) {
      CHECK(listener.trigger.choose(trigger, listener.ports).ok());
      return listener.trigger.period();
    };
    CHECK(period_of({}) == 0ms);
    CHECK(period_of({Trigger::Kind::period, 40ms, {}}) == 40ms);
    CHECK(period_of({Trigger::Kind::on_any, {}, {"left"}}) == 0ms);
    listener.left.out.start(100ms);
    listener.right.out.start(30ms);
    CHECK(period_of({Trigger::Kind::on_any, {}, {"left"}}) == 100ms);
    CHECK(period_of({Trigger::Kind::on_any, {}, {"left", "right"}}) == 30ms);
    CHECK(period_of({Trigger::Kind::on_all, {}, {"left", "right"}}) == 100ms);
    CHECK(period_of({Trigger::Kind::on_stamps, {}, {"left", "right"}, 5ms}) == 100ms);
    CHECK(period_of({Trigger::Kind::on_stamps, 80ms, {"left", "right"}, 5ms}) == 80ms);
    CHECK(period_of({Trigger::Kind::on_any, 20ms, {"left"}}) == 20ms);
    listener.port("left").edges()[0]->ask({Duration{0}, 3});
    CHECK(period_of({Trigger::Kind::on_any, {}, {"left"}}) == 300ms);
  });
}

TEST_CASE("a trigger on what is no PushProxy of the component is refused by name", "[host][trigger]") {
  with_listener([](Listener& listener) {
    const Status refused =
        listener.trigger.choose({Trigger::Kind::on_any, {}, {"left", "lft"}}, listener.ports);
    CHECK_THAT(refused.error().text(), Catch::Contains("\"lft\""));
  });
}
