// SPDX-License-Identifier: GPL-3.0-or-later
// One Push edge in virtual time, where a deadline passes to the nanosecond.
#include <catch2/catch.hpp>

#include <functional>
#include <string>

#include "executives.hpp"
#include "orca/idl/motion.hpp"
#include "orca/patterns/local/local_links.hpp"
#include "peer.hpp"

using namespace orca;
using namespace orca::test;
using idl::MotionCommand;

namespace {

struct Pusher : Peer {
  explicit Pusher(Executive& executive) : Peer(executive, "pusher") {}
  PushServer<MotionCommand> out{*this, "out"};
};

struct Hearer : Peer {
  Hearer(Executive& executive, LinkObserver& observer) : Peer(executive, "hearer", &observer) {}
  PushProxy<MotionCommand> in{*this, "in"};
};

struct Reports final : LinkObserver {
  void delivered(std::string_view /*component*/, std::string_view /*port*/,
                 const ObjectRef& /*object*/) override {}
  void link_changed(std::string_view /*client*/, std::string_view /*server*/, bool /*connected*/) override {}
  void trouble(LinkTrouble kind, std::string_view /*from*/, std::string_view /*to*/,
               std::string_view text) override {
    late += kind == LinkTrouble::late ? 1 : 0;
    last = text;
  }
  int late = 0;
  std::string last;
};

struct Connected {
  Connected(Executive& in_time, const QueuePolicy& policy)
      : executive(in_time), pusher(in_time), hearer(in_time, reports) {
    REQUIRE(LocalLinks().connect(pusher.endpoint("out"), hearer.endpoint("in"), policy).ok());
    hearer.in.subscribe();
  }
  [[nodiscard]] PushEdge& edge() const { return *hearer.edges("in").at(0); }
  void push() { pusher.out.push(full_stop()); }
  void pass(Duration time) const { sleep(executive, time); }

  Executive& executive;
  Reports reports;
  Pusher pusher;
  Hearer hearer;
};

void in_virtual_time(const QueuePolicy& policy, const std::function<void(Connected&)>& body) {
  run_on(virtual_executives().front(), [&](Executive& executive) {
    Connected connected(executive, policy);
    body(connected);
  });
}

}  // namespace

TEST_CASE("an object that comes exactly at its deadline is in time, and a nanosecond later it is late",
          "[patterns][deadline]") {
  in_virtual_time({.deadline = 40ms}, [](Connected& one) {
    one.pass(40ms);
    CHECK_FALSE(one.edge().deadline_missed());
    CHECK(one.edge().counters().missed_deadlines == 0);
    one.push();
    CHECK(one.edge().counters().missed_deadlines == 0);
    one.pass(40ms + 1ns);
    CHECK(one.edge().deadline_missed());
    CHECK(one.edge().counters().missed_deadlines == 1);
    one.push();
    CHECK_FALSE(one.edge().deadline_missed());
    CHECK(one.edge().counters().missed_deadlines == 1);
    one.pass(2 * 40ms + 1ns);
    CHECK(one.edge().counters().missed_deadlines == 3);
  });
}

TEST_CASE("whoever watches a deadline looks again a nanosecond after it, and hears of each delay once",
          "[patterns][deadline]") {
  in_virtual_time({.deadline = 40ms}, [](Connected& one) {
    const TimePoint begin = one.executive.now();
    CHECK(one.edge().watch_deadline() == begin + 40ms + 1ns);
    one.pass(40ms);
    CHECK(one.edge().watch_deadline() == begin + 40ms + 1ns);
    CHECK(one.reports.late == 0);
    one.pass(1ns);
    CHECK(one.edge().watch_deadline() == kForever);  // until an object comes
    CHECK(one.reports.late == 1);
    CHECK(one.reports.last == "no object within the deadline of 0.04 s");
    (void)one.edge().watch_deadline();
    CHECK(one.reports.late == 1);
    one.push();  // ends the delay that was reported
    CHECK(one.edge().watch_deadline() == one.executive.now() + 40ms + 1ns);
    CHECK(one.reports.late == 1);
    one.pass(50ms);
    one.push();  // this one was late, and nobody has looked meanwhile
    (void)one.edge().watch_deadline();
    CHECK(one.reports.late == 2);
  });
}

TEST_CASE("an edge without a deadline, or without a subscription, has nothing to watch",
          "[patterns][deadline]") {
  in_virtual_time({}, [](Connected& one) {
    one.pass(1h);
    CHECK(one.edge().watch_deadline() == kForever);
    CHECK_FALSE(one.edge().deadline_missed());
    CHECK(one.edge().counters().missed_deadlines == 0);
  });
  in_virtual_time({.deadline = 40ms}, [](Connected& one) {
    one.hearer.in.unsubscribe();
    one.pass(1h);
    CHECK(one.edge().watch_deadline() == kForever);
    CHECK_FALSE(one.edge().deadline_missed());
    CHECK(one.edge().counters().missed_deadlines == 0);
  });
}

TEST_CASE("drops count against the limit of the edge only where they exceed it", "[patterns][counters]") {
  in_virtual_time({.depth = 2, .drop_limit = 3}, [](Connected& one) {
    for (int i = 0; i < 2 + 3; ++i) one.push();
    CHECK(one.edge().counters().dropped_oldest == 3);
    CHECK(one.edge().counters().over_limit == 0);
    one.push();
    CHECK(one.edge().counters().over_limit == 1);
  });
  in_virtual_time({}, [](Connected& one) {  // the latest: any number may be dropped
    for (int i = 0; i < 100; ++i) one.push();
    CHECK(one.edge().counters().dropped == 99);
    CHECK(one.edge().counters().over_limit == 0);
  });
}

TEST_CASE("a queue remembers the largest number that ever waited in it", "[patterns][counters]") {
  in_virtual_time({.depth = 4}, [](Connected& one) {
    for (int i = 0; i < 3; ++i) one.push();
    for (int i = 0; i < 3; ++i) (void)one.hearer.in.get_update();
    one.push();
    CHECK(one.edge().counters().queued == 1);
    CHECK(one.edge().counters().high_water == 3);
  });
}

TEST_CASE("a server counts what it pushes, whether anybody hears it or not", "[patterns][counters]") {
  in_virtual_time({}, [](Connected& one) {
    const auto& server = static_cast<const PushServerEndpoint&>(one.pusher.endpoint("out"));
    CHECK(server.pushed_count() == 0);
    one.push();
    one.hearer.in.unsubscribe();
    one.push();
    CHECK(server.pushed_count() == 2);
    CHECK(one.edge().counters().delivered == 1);
  });
}
