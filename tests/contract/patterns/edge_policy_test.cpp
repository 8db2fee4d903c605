// SPDX-License-Identifier: GPL-3.0-or-later
// The settings of a Push edge that the integrator may make besides its depth (DESIGN 6): block, deadline; and
// the counters, for every link.
#include <thread>

#include "link_kits.hpp"

using namespace orca;
using namespace orca::test;
using Overflow = QueuePolicy::Overflow;

namespace {

constexpr QueuePolicy kBlocking{.depth = 2, .overflow = Overflow::block, .block_limit = 1h};

std::vector<int> one_to(int last) {
  std::vector<int> numbers(static_cast<std::size_t>(last));
  std::iota(numbers.begin(), numbers.end(), 1);
  return numbers;
}

}  // namespace

CONTRACT_CASE("a publisher waits for room at an edge that blocks, and nothing is lost",
              "[contract][push][block]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge = listener.listen(kit, source, kBlocking);
  Script push(source, [&] { source.push_numbers(1, 20); });
  REQUIRE(eventually(kit.executive, [&] { return edge.counters().waits == 1; }));
  CHECK_FALSE(push.ends_within(20ms));
  std::vector<int> got;
  while (got.size() < 20) got.push_back(number_of(listener.in.get_update_wait_max(5s)));
  CHECK(push.ends_within(5s));
  CHECK(got == one_to(20));
  CHECK(edge.counters().dropped == 0);
  CHECK(edge.counters().delivered == 20);
  CHECK(edge.counters().high_water == 2);
}

CONTRACT_CASE("all other subscribers have an object before its publisher waits for the one that blocks",
              "[contract][push][block]") {
  Source source(kit.executive);
  Listener blocking(kit.executive, "blocking");
  Listener sibling(kit.executive, "sibling");
  blocking.listen(kit, source, kBlocking);
  sibling.listen(kit, source, {.depth = 10});
  Script push(source, [&] { source.push_numbers(1, 3); });
  REQUIRE(sibling.has_seen(3));
  CHECK_FALSE(push.ends_within(20ms));
  CHECK(sibling.take_all() == std::vector{1, 2, 3});
}

CONTRACT_CASE(
    "a publisher waits at most for the edge's block limit, then its object is dropped there and counted",
    "[contract][push][block]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge =
      listener.listen(kit, source, {.depth = 1, .overflow = Overflow::block, .block_limit = 30ms});
  const TimePoint before = kit.executive.now();
  source.push_numbers(1, 2);
  const Duration waited = kit.executive.now() - before;
  CHECK(waited >= 30ms);
  if (kit.executive.is_virtual())
    CHECK(waited == 30ms + 4 * TestType::kDelay);  // there and back, for each object
  CHECK(eventually(kit.executive, [&] { return edge.counters().dropped_blocked == 1; }));
  CHECK(listener.take_all() == std::vector{1});
}

CONTRACT_CASE(
    "a subscriber that let one wait run out counts as stuck: nobody waits for it until it takes an object "
    "again",
    "[contract][push][block]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge =
      listener.listen(kit, source, {.depth = 1, .overflow = Overflow::block, .block_limit = 30ms});
  source.push_numbers(1, 2);
  const TimePoint before = kit.executive.now();
  source.push_numbers(3, 100);
  if (kit.executive.is_virtual()) CHECK(kit.executive.now() == before + 98 * 2 * TestType::kDelay);
  CHECK(eventually(kit.executive, [&] { return edge.counters().dropped_blocked == 99; }));
  CHECK(edge.counters().waits == 1);
  CHECK(listener.take_all() == std::vector{1});
  source.push_numbers(101, 102);
  CHECK(eventually(kit.executive, [&] { return edge.counters().dropped_blocked == 100; }));
  CHECK(edge.counters().waits == 2);
  CHECK(listener.take_all() == std::vector{101});
}

CONTRACT_CASE("an edge that blocks does not hold a component that must leave its lap",
              "[contract][push][block]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge = listener.listen(kit, source, kBlocking);
  bool pushed_all = false;
  Script push(source, [&] {
    source.push_numbers(1, 5);
    pushed_all = true;
  });
  REQUIRE(eventually(kit.executive, [&] { return edge.counters().waits == 1; }));
  source.leave();
  REQUIRE(push.ends_within(5s));
  CHECK(pushed_all);  // push() does not throw: the code after it may be needed to stop something
  CHECK(eventually(kit.executive, [&] { return edge.counters().dropped_blocked == 3; }));
}

CONTRACT_CASE("a publisher that waits goes on when the subscriber leaves", "[contract][push][block]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge = listener.listen(kit, source, kBlocking);
  Script push(source, [&] { source.push_numbers(1, 5); });
  REQUIRE(eventually(kit.executive, [&] { return edge.counters().waits == 1; }));
  listener.in.unsubscribe();
  CHECK(push.ends_within(5s));
  CHECK(edge.counters().left_behind == 2);
}

namespace {

// Pushes every object back to its source.
struct Mirror : Peer {
  Mirror(Executive& executive, const std::string& name) : Peer(executive, name) {}
  PushProxy<MotionCommand> in{*this, "in"};
  PushServer<MotionCommand> out{*this, "out"};
};

}  // namespace

CONTRACT_CASE("two components that wait for room at each other are freed at the time limit",
              "[contract][push][block]") {
  Mirror one(kit.executive, "one");
  Mirror other(kit.executive, "other");
  const QueuePolicy policy{.depth = 1, .overflow = Overflow::block, .block_limit = 20ms};
  kit.connect(one.endpoint("out"), other.endpoint("in"), policy);
  kit.connect(other.endpoint("out"), one.endpoint("in"), policy);
  one.in.subscribe();
  other.in.subscribe();
  REQUIRE(eventually(kit.executive,
                     [&] { return one.out.subscriber_count() == 1 && other.out.subscriber_count() == 1; }));
  const auto push_three = [](Mirror& mirror) {
    for (int number = 1; number <= 3; ++number) mirror.out.push(numbered(number));
  };
  Script first(one, [&] { push_three(one); });
  Script second(other, [&] { push_three(other); });
  CHECK(first.ends_within(5s));
  CHECK(second.ends_within(5s));
  CHECK(eventually(kit.executive, [&] { return one.in.counters().dropped_blocked == 2; }));
  CHECK(one.in.counters().delivered == 1);
}

CONTRACT_CASE("an edge without a deadline never misses one", "[contract][push][deadline]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source);
  sleep(kit.executive, 30ms);
  CHECK_FALSE(listener.in.deadline_missed());
  CHECK(listener.in.counters().missed_deadlines == 0);
}

CONTRACT_CASE("a missed deadline is seen by the component until the next object, and counted",
              "[contract][push][deadline]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge = listener.listen(kit, source, {.deadline = 50ms});
  CHECK(eventually(kit.executive, [&] { return listener.in.deadline_missed(); }));
  CHECK(edge.counters().missed_deadlines >= 1);
  source.push_numbers(1, 1);
  REQUIRE(listener.has_seen(1));
  if (kit.executive.is_virtual()) CHECK_FALSE(listener.in.deadline_missed());
  CHECK(eventually(kit.executive, [&] { return listener.in.deadline_missed(); }));
}

CONTRACT_CASE("deadlines count from the subscription and from each object, one for each that passes",
              "[contract][push][deadline]") {
  if (!kit.executive.is_virtual()) return;  // only there the times are exact
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge = listener.listen(kit, source, {.deadline = 50ms});
  const auto missed_after = [&](Duration time) {
    sleep(kit.executive, time);
    return edge.counters().missed_deadlines;
  };
  CHECK(missed_after(50ms) == 0);
  CHECK_FALSE(listener.in.deadline_missed());
  CHECK(missed_after(1ms) == 1);
  CHECK(listener.in.deadline_missed());
  source.push_numbers(1, 1);
  CHECK(missed_after(50ms) == 1);
  source.push_numbers(2, 2);  // exactly at the deadline is in time
  CHECK(missed_after(151ms + TestType::kDelay) == 4);
  listener.in.unsubscribe();
  CHECK_FALSE(listener.in.deadline_missed());
  CHECK(missed_after(1s) == 4);
  listener.in.subscribe();
  CHECK(missed_after(10ms) == 4);
}

CONTRACT_CASE("every object that does not reach its reader is counted under its reason",
              "[contract][push][counters]") {
  Source source(kit.executive);
  Listener oldest(kit.executive, "oldest");
  Listener newest(kit.executive, "newest");
  oldest.listen(kit, source, {.depth = 4});
  newest.listen(kit, source, {.depth = 4, .overflow = Overflow::drop_newest});
  source.push_numbers(1, 10);
  REQUIRE(oldest.has_seen(10));
  REQUIRE(eventually(kit.executive, [&] { return newest.in.counters().dropped_newest == 6; }));
  CHECK(oldest.in.counters().dropped_oldest == 6);
  CHECK(oldest.in.counters().dropped == 6);
  CHECK(oldest.in.counters().queued == 4);
  CHECK(oldest.in.counters().high_water == 4);
  CHECK(newest.in.counters().delivered == 4);
  (void)oldest.in.get_update();
  CHECK(oldest.in.counters().queued == 3);
  oldest.in.unsubscribe();
  CHECK(oldest.in.counters().left_behind == 3);
  CHECK(oldest.in.counters().dropped == 9);
  CHECK(oldest.in.counters().queued == 0);
}

CONTRACT_CASE("an edge's counters may be read by any thread while objects cross it",
              "[contract][push][counters]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge = listener.listen(kit, source, {.depth = 3, .deadline = 1s});
  std::atomic<bool> ending{false};
  std::uint64_t last = 0;
  bool went_back = false;
  std::thread host([&] {
    while (!ending) {
      const EdgeCounters now = edge.counters();
      went_back = went_back || now.delivered < last;
      last = now.delivered;
      (void)edge.grant();
    }
  });
  Script take(listener, [&] {
    for (;;) (void)listener.in.get_update_wait();
  });
  Script push(source, [&] {
    for (int lap = 0; lap < 200; ++lap) {
      source.push_numbers(1, 10);
      sleep(kit.executive, 10us);
    }
  });
  CHECK(push.ends_within(20s));
  CHECK(listener.has_seen(2000));
  ending = true;
  host.join();
  CHECK_FALSE(went_back);
}
