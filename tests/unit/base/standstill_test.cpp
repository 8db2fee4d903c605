// SPDX-License-Identifier: GPL-3.0-or-later
// Virtual time that cannot pass, because tasks go on at one instant without end.
#include <catch2/catch.hpp>

#include <utility>
#include <vector>

#include "executive_kinds.hpp"

using namespace orca;
using namespace orca::test;

TEST_CASE("tasks that wake each other at one instant for ever end main's wait, and are named",
          "[base][executive][standstill]") {
  const int priority = GENERATE(0, 100);
  for (const auto& kind : virtual_kinds()) {
    const auto executive = make(kind);
    executive->run([&] {
      const auto a = executive->make_event();
      const auto b = executive->make_event();
      bool over = false;
      const auto answer = [&](Event& mine, Event& other) {
        while (!over) {
          other.notify();
          mine.wait_until(kForever);
        }
        other.notify();
      };
      executive->sleep_until(executive->now() + 1s);
      const auto ping = executive->spawn({"ping", priority}, [&] { answer(*a, *b); });
      const auto pong = executive->spawn({"pong", priority}, [&] { answer(*b, *a); });
      const auto idle = executive->spawn({"idle", 0}, [] {});
      const TimePoint before = executive->now();
      CHECK_FALSE(executive->make_event()->wait_until(before + 1s));
      CHECK(executive->now() == before);
      CHECK(executive->restless_tasks() == std::vector<std::string>{"ping", "pong"});
      over = true;
    });
  }
}

EXECUTIVE_CASE(in_virtual_time, "a burst at one instant is no standstill", "[base][executive][standstill]") {
  constexpr std::size_t kSenders = 300, kRounds = 30;
  const auto event = executive.make_event();
  std::vector<Event*> waiting;
  std::size_t turns = 0;
  std::size_t ended = 0;
  const auto receiver = executive.spawn({"receiver", 1}, [&] {
    for (; ended < kSenders; ++turns) {
      event->wait_until(kForever);
      for (Event* sender : std::exchange(waiting, {})) sender->notify();
    }
  });
  std::vector<std::unique_ptr<Task>> senders;
  for (std::size_t i = 0; i < kSenders; ++i)
    senders.push_back(executive.spawn({"sender", 0}, [&] {
      const auto answered = executive.make_event();
      for (std::size_t round = 0; round < kRounds; ++round) {
        waiting.push_back(answered.get());
        event->notify();
        answered->wait_until(kForever);
      }
      ++ended;
      event->notify();
    }));
  const TimePoint before = executive.now();
  CHECK_FALSE(executive.make_event()->wait_until(before + 1s));
  CHECK(executive.now() == before + 1s);
  CHECK(turns >= kSenders * kRounds);
  CHECK(executive.restless_tasks().empty());
}
