// SPDX-License-Identifier: GPL-3.0-or-later
// The contract of Push (thesis 7.3, Fig. 7.1-7.3), for every link.
#include "link_kits.hpp"

using namespace orca;
using namespace orca::test;

CONTRACT_CASE("get_update blocks for the first object and then gives the last one again",
              "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source);
  std::vector<ObjectPtr<MotionCommand>> got;
  Script script(listener, [&] {
    got.push_back(listener.in.get_update());
    got.push_back(listener.in.get_update());
  });
  sleep(kit.executive, 20ms);
  CHECK_FALSE(script.ended());
  source.push_numbers(1, 1);
  REQUIRE(script.ends_within(5s));
  CHECK(number_of(got[0]) == 1);
  CHECK(got[1] == got[0]);
}

CONTRACT_CASE("get_update gives every queued object before it repeats the last", "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source, {.depth = 2});
  source.push_numbers(1, 2);
  REQUIRE(listener.has_seen(2));
  CHECK(number_of(listener.in.get_update()) == 1);
  CHECK(number_of(listener.in.get_update()) == 2);
  CHECK(number_of(listener.in.get_update()) == 2);
}

CONTRACT_CASE("get_update_wait blocks until there is a new object and repeats none", "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source);
  std::atomic<int> last{0};
  Script script(listener, [&] {
    while (last < 3) last = number_of(listener.in.get_update_wait());
  });
  for (int number = 1; number <= 3; ++number) {
    source.push_numbers(number, number);
    CHECK(eventually(kit.executive, [&] { return last == number; }));
  }
  CHECK(script.ends_within(5s));
}

CONTRACT_CASE("get_update_wait_max gives nothing when its time has passed without a new object",
              "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source);
  source.push_numbers(1, 1);
  CHECK(number_of(listener.in.get_update_wait_max(5s)) == 1);
  const TimePoint before = kit.executive.now();
  CHECK(listener.in.get_update_wait_max(20ms) == nullptr);
  const Duration waited = kit.executive.now() - before;
  CHECK(waited >= 20ms);
  if (kit.executive.is_virtual()) CHECK(waited == 20ms);
  CHECK(number_of(listener.in.get_update()) == 1);
}

CONTRACT_CASE("get_update_wait_max returns as soon as there is a new object", "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source);
  int got = 0;
  Script script(listener, [&] { got = number_of(listener.in.get_update_wait_max(1h)); });
  sleep(kit.executive, 5ms);
  source.push_numbers(7, 7);
  REQUIRE(script.ends_within(5s));
  CHECK(got == 7);
}

CONTRACT_CASE("new_data_arrived reports an object that was not taken yet, without taking it",
              "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source);
  CHECK_FALSE(listener.in.new_data_arrived());
  source.push_numbers(1, 1);
  REQUIRE(listener.has_seen(1));
  CHECK(listener.in.new_data_arrived());
  CHECK(listener.in.new_data_arrived());
  CHECK(number_of(listener.in.get_update()) == 1);
  CHECK_FALSE(listener.in.new_data_arrived());
}

CONTRACT_CASE("latest returns nothing before the first object, then the newest, and takes none",
              "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source, {.depth = 4});
  CHECK(listener.in.latest() == nullptr);
  source.push_numbers(1, 3);
  REQUIRE(listener.has_seen(3));
  CHECK(number_of(listener.in.latest()) == 3);
  CHECK(listener.take_all() == std::vector{1, 2, 3});
  CHECK(number_of(listener.in.latest()) == 3);
}

CONTRACT_CASE("a full queue that drops the oldest keeps the newest objects in order and counts",
              "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge =
      listener.listen(kit, source, {.depth = 3, .overflow = QueuePolicy::Overflow::drop_oldest});
  source.push_numbers(1, 10);
  REQUIRE(eventually(kit.executive, [&] { return edge.counters().dropped == 7; }));
  CHECK(listener.take_all() == std::vector{8, 9, 10});
  source.push_numbers(11, 12);
  REQUIRE(listener.has_seen(12));
  CHECK(listener.take_all() == std::vector{11, 12});
  CHECK(edge.counters().dropped == 7);
}

CONTRACT_CASE("a full queue that drops the newest keeps the oldest objects in order and counts",
              "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  const PushEdge& edge =
      listener.listen(kit, source, {.depth = 3, .overflow = QueuePolicy::Overflow::drop_newest});
  source.push_numbers(1, 10);
  REQUIRE(eventually(kit.executive, [&] { return edge.counters().dropped == 7; }));
  CHECK(edge.counters().delivered == 3);
  CHECK(number_of(listener.in.latest()) == 3);
  CHECK(listener.take_all() == std::vector{1, 2, 3});
}

CONTRACT_CASE("a subscriber that is asleep costs the publisher and its siblings nothing",
              "[contract][push]") {
  Source source(kit.executive);
  Listener asleep(kit.executive, "asleep");
  Listener awake(kit.executive, "awake");
  asleep.listen(kit, source);
  const PushEdge& edge = awake.listen(kit, source, {.depth = 100});
  Script script(asleep, [&] { asleep.strand().wait_for(kForever, [] { return false; }); });
  const TimePoint before = kit.executive.now();
  source.push_numbers(1, 100);
  if (kit.executive.is_virtual()) CHECK(kit.executive.now() == before);
  REQUIRE(awake.has_seen(100));
  CHECK(edge.counters().dropped == 0);
  CHECK(eventually(kit.executive, [&] { return asleep.edge().counters().dropped == 99; }));
  CHECK_FALSE(script.ended());
}

CONTRACT_CASE("only objects that are pushed between subscribe and unsubscribe arrive", "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  source.push_numbers(1, 1);
  PushEdge& edge = listener.listen(kit, source, {.depth = 8});
  CHECK(source.out.subscriber_count() == 1);
  source.push_numbers(2, 2);
  REQUIRE(listener.has_seen(1));
  CHECK(listener.take_all() == std::vector{2});
  listener.in.unsubscribe();
  CHECK(eventually(kit.executive, [&] { return source.out.subscriber_count() == 0; }));
  source.push_numbers(3, 3);
  listener.in.subscribe();
  CHECK(eventually(kit.executive, [&] { return source.out.subscriber_count() == 1; }));
  source.push_numbers(4, 4);
  REQUIRE(eventually(kit.executive, [&] { return edge.counters().delivered == 2; }));
  CHECK(listener.take_all() == std::vector{4});
}

CONTRACT_CASE(
    "an object from an earlier subscription is neither new data nor the last object in the next one",
    "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source, {.depth = 4});
  source.push_numbers(1, 3);
  REQUIRE(listener.has_seen(3));
  CHECK(number_of(listener.in.get_update()) == 1);
  listener.in.unsubscribe();
  listener.in.subscribe();
  CHECK_FALSE(listener.in.new_data_arrived());
  CHECK(listener.in.latest() == nullptr);
  ObjectPtr<MotionCommand> got;
  Script script(listener, [&] { got = listener.in.get_update(); });
  CHECK_FALSE(script.ends_within(20ms));
  source.push_numbers(4, 4);
  CHECK(script.ends_within(5s));
  CHECK(number_of(got) == 4);
}

CONTRACT_CASE("a server sees a subscriber who comes as another leaves", "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  CHECK_FALSE(source.out.take_new_subscribers());
  listener.listen(kit, source, {.depth = 4});
  CHECK(source.out.take_new_subscribers());
  CHECK_FALSE(source.out.take_new_subscribers());
  listener.in.unsubscribe();
  listener.in.subscribe();
  CHECK(eventually(kit.executive, [&] { return source.out.take_new_subscribers(); }));
  CHECK(eventually(kit.executive, [&] { return source.out.subscriber_count() == 1; }));
  listener.in.unsubscribe();
  CHECK(eventually(kit.executive, [&] { return source.out.subscriber_count() == 0; }));
  CHECK_FALSE(source.out.take_new_subscribers());
}

CONTRACT_CASE("subscribing twice counts once, and so does unsubscribing", "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source, {.depth = 4});
  listener.in.subscribe();
  source.push_numbers(1, 1);
  REQUIRE(listener.has_seen(1));
  CHECK(source.out.subscriber_count() == 1);
  CHECK(listener.take_all() == std::vector{1});
  listener.in.unsubscribe();
  listener.in.unsubscribe();
  CHECK(eventually(kit.executive, [&] { return source.out.subscriber_count() == 0; }));
}

CONTRACT_CASE("two subscribers get equal objects, on a link within a process the same one",
              "[contract][push]") {
  Source source(kit.executive);
  Listener one(kit.executive, "one");
  Listener two(kit.executive, "two");
  one.listen(kit, source);
  two.listen(kit, source);
  source.push_numbers(5, 5);
  const auto first = one.in.get_update_wait_max(5s);
  const auto second = two.in.get_update_wait_max(5s);
  REQUIRE(first);
  REQUIRE(second);
  CHECK(*first == *second);
  CHECK((first.get() == second.get()) == TestType::kSharesObjects);
}

CONTRACT_CASE("an object stays valid after the queue and the subscription that brought it are gone",
              "[contract][push]") {
  ObjectPtr<MotionCommand> kept;
  Source source(kit.executive);
  {
    Listener listener(kit.executive);
    listener.listen(kit, source);
    source.push_numbers(9, 9);
    kept = listener.in.get_update_wait_max(5s);
    listener.in.unsubscribe();
  }
  source.push_numbers(10, 30);
  CHECK(number_of(kept) == 9);
}

CONTRACT_CASE("objects cross from strand to strand in order and complete while the queue has room",
              "[contract][push]") {
  constexpr int kCount = 1000;
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source, {.depth = kCount});
  std::vector<int> got;
  Script receive(listener, [&] {
    while (got.size() < kCount) got.push_back(number_of(listener.in.get_update_wait()));
  });
  Script send(source, [&] { source.push_numbers(1, kCount); });
  CHECK(send.ends_within(20s));
  REQUIRE(receive.ends_within(20s));
  std::vector<int> all(kCount);
  std::iota(all.begin(), all.end(), 1);
  CHECK(got == all);
}

CONTRACT_CASE("a wait for an object does not hold a component that must leave its lap", "[contract][push]") {
  Source source(kit.executive);
  Listener listener(kit.executive);
  listener.listen(kit, source);
  Script script(listener, [&] { (void)listener.in.get_update_wait(); });
  sleep(kit.executive, 5ms);
  listener.leave();
  REQUIRE(script.ends_within(5s));
  CHECK(script.interrupted());
}

CONTRACT_CASE("subscriptions may come and go while another strand pushes", "[contract][push]") {
  Source source(kit.executive);
  Listener steady(kit.executive, "steady");
  Listener fickle(kit.executive, "fickle");
  steady.listen(kit, source, {.depth = 500});
  fickle.listen(kit, source);
  Script push(source, [&] {
    for (int lap = 0; lap < 100; ++lap) {
      source.push_numbers(5 * lap + 1, 5 * lap + 5);
      sleep(kit.executive, 10us);
    }
  });
  for (int lap = 0; lap < 50; ++lap) {
    fickle.in.unsubscribe();
    CHECK_FALSE(fickle.in.new_data_arrived());
    fickle.in.subscribe();
    sleep(kit.executive, 20us);
  }
  CHECK(push.ends_within(20s));
  CHECK(steady.has_seen(500));
  CHECK(steady.edge().counters().dropped == 0);
}

TEST_CASE("a PushProxy that the graph does not connect says so and has nothing", "[contract][push]") {
  run_on_each(all_executives(), [](Executive& executive) {
    Listener listener(executive);
    CHECK_FALSE(listener.in.connected());
    listener.in.subscribe();
    CHECK_FALSE(listener.in.new_data_arrived());
    CHECK(listener.in.latest() == nullptr);
    CHECK(listener.in.get_update_wait_max(5ms) == nullptr);
  });
}
