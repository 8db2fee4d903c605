// SPDX-License-Identifier: GPL-3.0-or-later
// How often a subscriber is updated (thesis 7.3, end of Push), for every link.
#include "link_kits.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// Waits until the server has granted that.
template <class Peer>
bool is_granted(Peer& listener, const UpdateGrant& grant) {
  return eventually(listener.executive(), [&] { return listener.in.granted() == grant; });
}

}  // namespace

CONTRACT_CASE("a server that has not started is irregular, and every object reaches its subscriber",
              "[contract][push][rate]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source, {.depth = 10});
  CHECK(listener.in.base_period() == 0s);
  CHECK(is_granted(listener, {0s, 1, 0s}));
  source.push_numbers(1, 5);
  REQUIRE(listener.has_seen(5));
  CHECK(listener.take_all() == std::vector{1, 2, 3, 4, 5});
}

CONTRACT_CASE("a server announces its base period before and while it is subscribed to",
              "[contract][push][rate]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  CHECK(source.out.base_period() == 0s);
  source.out.start(50ms);
  CHECK(source.out.base_period() == 50ms);
  kit.connect(source.endpoint("out"), listener.endpoint("in"));
  CHECK(eventually(kit.executive, [&] { return listener.in.base_period() == 50ms; }));
  listener.in.subscribe();
  CHECK(is_granted(listener, {50ms, 1, 50ms}));
  source.out.start(20ms);
  CHECK(source.out.base_period() == 20ms);
  CHECK(eventually(kit.executive, [&] { return listener.in.base_period() == 20ms; }));
  CHECK(is_granted(listener, {20ms, 1, 20ms}));
}

CONTRACT_CASE("a multiple of the base period brings every n-th object, the first included",
              "[contract][push][rate]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  source.out.start(10ms);
  kit.connect(source.endpoint("out"), listener.endpoint("in"), {.depth = 10});
  listener.in.set_multiple(3);
  listener.in.subscribe();
  CHECK(eventually(kit.executive, [&] { return source.out.subscriber_count() == 1; }));
  CHECK(is_granted(listener, {10ms, 3, 30ms}));
  source.push_numbers(1, 10);
  REQUIRE(listener.has_seen(4));
  CHECK(listener.take_all() == std::vector{1, 4, 7, 10});
  CHECK(listener.edge().counters().dropped == 0);
}

CONTRACT_CASE("an interval is rounded up to a multiple of the base period", "[contract][push][rate]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  source.out.start(40ms);
  listener.listen(kit, source, {.depth = 10});
  listener.in.set_interval(100ms);
  CHECK(is_granted(listener, {40ms, 3, 120ms}));
  listener.in.set_interval(80ms);
  CHECK(is_granted(listener, {40ms, 2, 80ms}));
  listener.in.set_interval(1ms);
  CHECK(is_granted(listener, {40ms, 1, 40ms}));
}

CONTRACT_CASE("a subscriber may change its rate while it is subscribed, and its siblings keep theirs",
              "[contract][push][rate]") {
  Source source(kit.executive);
  Listener all(kit.executive, "all");
  Listener some(kit.executive, "some");
  source.out.start(10ms);
  all.listen(kit, source, {.depth = 20});
  some.listen(kit, source, {.depth = 20});
  some.in.set_multiple(2);
  REQUIRE(is_granted(some, {10ms, 2, 20ms}));
  source.push_numbers(1, 4);
  REQUIRE(some.has_seen(2));
  some.in.set_multiple(1);
  REQUIRE(is_granted(some, {10ms, 1, 10ms}));
  source.push_numbers(5, 6);
  REQUIRE(some.has_seen(4));
  REQUIRE(all.has_seen(6));
  CHECK(some.take_all() == std::vector{1, 3, 5, 6});
  CHECK(all.take_all() == std::vector{1, 2, 3, 4, 5, 6});
}

CONTRACT_CASE("the interval that the graph gives an edge is the limit of what its component gets",
              "[contract][push][rate]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  source.out.start(10ms);
  listener.listen(kit, source, {.depth = 10, .min_interval = 30ms});
  CHECK(is_granted(listener, {10ms, 3, 30ms}));
  listener.in.set_interval(10ms);
  listener.in.set_multiple(2);
  CHECK(is_granted(listener, {10ms, 3, 30ms}));
  listener.in.set_multiple(5);
  CHECK(is_granted(listener, {10ms, 5, 50ms}));
}

CONTRACT_CASE("an irregular server measures the interval by the times at which objects were made",
              "[contract][push][rate]") {
  if (!kit.executive.is_virtual()) return;  // only there the times are exact
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source, {.depth = 10, .min_interval = 25ms});
  CHECK(is_granted(listener, {0s, 1, 25ms}));
  for (int number = 0; number <= 10; ++number) {
    source.push_numbers(number, number);
    sleep(kit.executive, 10ms);
  }
  REQUIRE(listener.has_seen(4));
  CHECK(listener.take_all() == std::vector{0, 3, 6, 9});
}

CONTRACT_CASE("a rate requested between two subscriptions holds for the next one", "[contract][push][rate]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  source.out.start(10ms);
  listener.listen(kit, source);
  listener.in.unsubscribe();
  listener.in.set_multiple(4);
  listener.in.subscribe();
  CHECK(is_granted(listener, {10ms, 4, 40ms}));
}

TEST_CASE("a port that is not connected is granted nothing", "[contract][push][rate]") {
  run_on_each(all_executives(), [](Executive& executive) {
    Listener listener(executive);
    listener.in.set_multiple(3);
    CHECK(listener.in.granted() == UpdateGrant{});
    CHECK(listener.in.base_period() == 0s);
    CHECK(listener.in.counters().delivered == 0);
  });
}
