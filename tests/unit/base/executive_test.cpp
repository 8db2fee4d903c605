// SPDX-License-Identifier: GPL-3.0-or-later
// One contract for all back ends of the executive.
#include <catch2/catch.hpp>

#include <atomic>
#include <ctime>
#include <regex>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "executive_kinds.hpp"
#include "orca/base/stall_watch.hpp"
#include "orca/base/strand.hpp"

using namespace orca;
using namespace orca::test;

namespace {

// Writes to each page of a stack that grows by that many bytes.
int use_stack(std::size_t bytes) {
  volatile char* const room = static_cast<char*>(__builtin_alloca(bytes));
  int sum = 0;
  for (std::size_t i = 0; i < bytes; i += 4096) {
    room[i] = 1;
    sum += room[i];
  }
  return sum;
}

}  // namespace

TEST_CASE("free-running threads in virtual time are refused with a hint", "[base][executive]") {
  const auto refused = make_executive({ClockKind::virtual_time, Backend::thread});
  REQUIRE_FALSE(refused.has_value());
  CHECK(refused.error().code == Code::invalid_argument);
  CHECK(refused.error().message.find("--executor fiber or baton") != std::string::npos);
}

EXECUTIVE_CASE(on_all, "a notification before the wait is remembered, once", "[base][executive]") {
  const auto event = executive.make_event();
  event->notify();
  event->notify();
  CHECK(event->wait_until(executive.now() + 1s));
  CHECK_FALSE(event->wait_until(executive.now() + 1ms));
}

EXECUTIVE_CASE(on_all, "a wait that is not notified ends at its deadline", "[base][executive]") {
  const auto event = executive.make_event();
  const TimePoint deadline = executive.now() + 20ms;
  CHECK_FALSE(event->wait_until(deadline));
  CHECK(executive.now() >= deadline);
}

TEST_CASE("a wait in steady time uses no processor", "[base][executive]") {
  const auto cpu_time = [] {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return std::chrono::seconds(time.tv_sec) + std::chrono::nanoseconds(time.tv_nsec);
  };
  for (const auto& kind : all_kinds()) {
    if (kind.clock != ClockKind::steady) continue;
    const auto executive = make(kind);
    executive->run([&] {
      const auto before = cpu_time();
      CHECK_FALSE(executive->make_event()->wait_until(executive->now() + 300ms));
      CHECK(cpu_time() - before < 150ms);
    });
  }
}

TEST_CASE("tasks hand over to each other through events and are joined", "[base][executive]") {
  for (const auto& kind : all_kinds()) {
    const auto executive = make(kind);
    std::atomic<int> laps{0};
    executive->run([&] {
      const auto ping = executive->make_event();
      const auto pong = executive->make_event();
      const auto task = executive->spawn({"pong", 0}, [&] {
        for (int i = 0; i < 100; ++i) {
          ping->wait_until(kForever);
          ++laps;
          pong->notify();
        }
      });
      for (int i = 0; i < 100; ++i) {
        ping->notify();
        REQUIRE(pong->wait_until(kForever));
      }
      CHECK(task->join_until(kForever));
    });
    CHECK(laps == 100);
  }
}

EXECUTIVE_CASE(on_all, "a task may use 1.5 MB of stack, also after it has waited", "[base][executive]") {
  int sum = 0;
  const auto task = executive.spawn({"deep", 0}, [&] {
    executive.sleep_until(executive.now() + 1ms);
    sum = use_stack(1'500'000);
  });
  CHECK(task->join_until(kForever));
  CHECK(sum > 0);
}

TEST_CASE("only the threads of its tasks run an executive", "[base][executive]") {
  for (const auto& kind : all_kinds()) {
    const auto executive = make(kind);
    CHECK_FALSE(executive->runs_here());
    executive->run([&] {
      CHECK(executive->runs_here());
      bool in_task = false;
      bool in_stranger = true;
      const auto task = executive->spawn({"task", 0}, [&] {
        in_task = executive->runs_here();
        std::thread([&] { in_stranger = executive->runs_here(); }).join();
      });
      CHECK(task->join_until(kForever));
      CHECK(in_task);
      CHECK_FALSE(in_stranger);
      CHECK_FALSE(make(kind)->runs_here());
    });
    CHECK_FALSE(executive->runs_here());
  }
}

EXECUTIVE_CASE(in_steady_time, "a thread that the executive does not know may notify", "[base][executive]") {
  const auto event = executive.make_event();
  std::thread stranger([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    event->notify();
  });
  CHECK(event->wait_until(executive.now() + 10s));
  stranger.join();
}

EXECUTIVE_CASE(in_virtual_time, "virtual time stands still while tasks run and jumps when they all wait",
               "[base][executive]") {
  CHECK(to_seconds(executive.now()) == 0.0);
  std::vector<std::pair<char, double>> seen;
  const auto sleeper = [&](char name, Duration step) {
    return [&, name, step] {
      for (int i = 1; i <= 3; ++i) {
        executive.sleep_until(TimePoint(step * i));
        seen.emplace_back(name, to_seconds(executive.now()));
      }
    };
  };
  const auto a = executive.spawn({"a", 0}, sleeper('a', 2s));
  const auto b = executive.spawn({"b", 0}, sleeper('b', 3s));
  CHECK(a->join_until(kForever));
  CHECK(b->join_until(kForever));
  // At 6 s both are due: b went to sleep first (at 3 s, a at 4 s), so its timer has the lower sequence.
  const std::vector<std::pair<char, double>> expected{{'a', 2}, {'b', 3}, {'a', 4},
                                                      {'b', 6}, {'a', 6}, {'b', 9}};
  CHECK(seen == expected);
}

TEST_CASE("the task with the highest priority runs first of those ready at the same time",
          "[base][executive]") {
  for (const auto& kind : virtual_kinds()) {
    const auto executive = make(kind);
    std::string order;
    executive->run([&] {
      const auto low = executive->spawn({"low", -1}, [&] { order += 'l'; });
      const auto normal = executive->spawn({"normal", 0}, [&] { order += 'n'; });
      const auto high = executive->spawn({"high", 5}, [&] { order += 'h'; });
      low->join_until(kForever);
    });
    CHECK(order == "hnl");
  }
}

EXECUTIVE_CASE(in_virtual_time, "when nothing can ever happen in virtual time, main's wait ends",
               "[base][executive]") {
  const auto event = executive.make_event();
  CHECK_FALSE(event->wait_until(kForever));
}

EXECUTIVE_CASE(on_all, "an exception can be rethrown after a switch inside its handler",
               "[base][executive]") {
  std::atomic<int> right{0};
  const auto thrower = [&](const char* text) {
    return [&, text] {
      try {
        throw std::runtime_error(text);
      } catch (...) {
        executive.sleep_until(executive.now() + 1ms);
        try {
          throw;
        } catch (const std::runtime_error& error) {
          if (error.what() == std::string(text)) ++right;
        }
      }
    };
  };
  const auto a = executive.spawn({"a", 0}, thrower("a"));
  const auto b = executive.spawn({"b", 0}, thrower("b"));
  a->join_until(kForever);
  b->join_until(kForever);
  CHECK(right == 2);
}

EXECUTIVE_CASE(on_all, "a task has stack enough for std::regex on a long text", "[base][executive]") {
  bool matched = false;
  const auto task = executive.spawn(
      {"regex", 0}, [&] { matched = std::regex_match(std::string(1000, 'a'), std::regex("(a|b)*")); });
  task->join_until(kForever);
  CHECK(matched);
}

namespace {

// Returns the executive's report about a task that does `step` repeatedly until it has been named.
StuckTask name_culprit(Executive& executive, const std::function<void()>& step) {
  std::atomic<bool> found{false};
  StuckTask named;
  std::thread monitor([&] {
    while (!found) {
      if (const auto stuck = executive.stuck_task(50ms); stuck && stuck->name == "culprit") {
        named = *stuck;
        found = true;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  executive.run([&] {
    const auto innocent = executive.spawn({"innocent", 0}, [] {});
    const auto culprit = executive.spawn({"culprit", 0}, [&] {
      while (!found) step();
    });
    innocent->join_until(kForever);
    culprit->join_until(kForever);
  });
  monitor.join();
  return named;
}

}  // namespace

TEST_CASE("a task that computes without waiting is named", "[base][executive]") {
  for (const auto& kind : all_kinds()) {
    const auto executive = make(kind);
    const StuckTask named = name_culprit(*executive, [] {});
    CHECK_FALSE(named.asleep);
    CHECK(named.holds_up_others == (kind.backend != Backend::thread));
  }
}

TEST_CASE("a task that sleeps in the system instead of waiting is named", "[base][executive]") {
  for (const auto& kind : all_kinds()) {
    const auto executive = make(kind);
    const StuckTask named =
        name_culprit(*executive, [] { std::this_thread::sleep_for(std::chrono::milliseconds(500)); });
    CHECK(named.asleep == (kind.backend != Backend::thread));
  }
}

TEST_CASE("a task on a thread of its own that has left the watch is not named, and the others still are",
          "[base][executive]") {
  const auto executive = make({ClockKind::steady, Backend::thread});
  std::atomic<bool> found{false};
  std::atomic<int> named{0};
  std::thread monitor([&] {
    while (!found) {
      const auto stuck = executive->stuck_task(50ms);
      if (stuck && stuck->name == "candidate") ++named;
      found = stuck && stuck->name == "culprit";
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  executive->run([&] {
    const auto sleep = [] { std::this_thread::sleep_for(std::chrono::milliseconds(300)); };
    const auto candidate = executive->spawn({"candidate", 0}, [&] {
      leave_stall_watch();
      while (!found) sleep();
    });
    const auto culprit = executive->spawn({"culprit", 0}, [&] {
      sleep();
      while (!found) sleep();
    });
    candidate->join_until(kForever);
    culprit->join_until(kForever);
  });
  monitor.join();
  CHECK(named == 0);
}

TEST_CASE("a task on a thread of its own is not named for a time in which nobody looked at it",
          "[base][executive]") {
  const auto executive = make({ClockKind::steady, Backend::thread});
  std::atomic<bool> found{false};
  bool is_blamed_at_once = false;
  executive->run([&] {
    std::atomic<bool> runs{false};
    const auto culprit = executive->spawn({"culprit", 0}, [&] {
      executive->sleep_until(executive->now() + 1ms);  // so the first look finds it in a state of its own
      while (!found) runs = true;
    });
    std::thread monitor([&] {  // it has no processor for a while, as the culprit may have had none
      while (!runs) std::this_thread::yield();
      (void)executive->stuck_task(50ms);
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      is_blamed_at_once = executive->stuck_task(50ms).has_value();
      while (!executive->stuck_task(50ms)) std::this_thread::sleep_for(std::chrono::milliseconds(5));
      found = true;
    });
    culprit->join_until(kForever);
    monitor.join();
  });
  CHECK_FALSE(is_blamed_at_once);
}

TEST_CASE("a task that waits as it should is not named, however long", "[base][executive]") {
  for (const auto& kind : all_kinds()) {
    const auto executive = make(kind);
    std::atomic<bool> ended{false};
    std::atomic<int> named{0};
    std::thread monitor([&] {
      while (!ended) {
        if (executive->stuck_task(50ms)) ++named;
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    });
    executive->run([&] {
      const auto task =
          executive->spawn({"patient", 0}, [&] { executive->sleep_until(executive->now() + 200ms); });
      task->join_until(kForever);
    });
    ended = true;
    monitor.join();
    CHECK(named == 0);
  }
}

TEST_CASE("tasks of the same priority that are ready at the same time keep their order",
          "[base][executive]") {
  for (const auto& kind : virtual_kinds()) {
    const auto executive = make(kind);
    const std::vector<int> priorities{0, 5, 0, -3, 5, 100, 0, -3, 7, 5};
    std::vector<std::size_t> order;
    executive->run([&] {
      std::vector<std::unique_ptr<Task>> tasks;
      for (std::size_t i = 0; i < priorities.size(); ++i)
        tasks.push_back(executive->spawn({"task", priorities[i]}, [&order, i] { order.push_back(i); }));
    });
    CHECK(order == std::vector<std::size_t>{5, 8, 1, 4, 9, 0, 2, 6, 3, 7});
  }
}

EXECUTIVE_CASE(in_steady_time, "an event that unknown threads notify without pause loses no notification",
               "[base][executive]") {
  constexpr int kCount = 2000;
  const auto event = executive.make_event();
  std::atomic<int> made{0};
  std::thread stranger([&] {
    while (made < kCount) {
      ++made;
      event->notify();
    }
  });
  int seen = 0;
  while (seen < kCount && event->wait_until(executive.now() + 10s)) seen = made;
  CHECK(seen == kCount);
  stranger.join();
}

TEST_CASE("whether tasks can overlap depends on the back end", "[base][executive]") {
  for (const auto& kind : all_kinds())
    CHECK(make(kind)->tasks_overlap() == (kind.backend == Backend::thread));
}

EXECUTIVE_CASE(on_all, "a strand's wait sees a condition, a deadline or an interruption", "[base][strand]") {
  Strand strand(executive, {"strand", 0});
  std::atomic<int> step{0};
  bool interrupted = false;
  std::atomic<bool> leave{false};
  strand.set_leave_condition([&] { return leave.load(); });
  strand.start([&] {
    CHECK(strand.wait_for(kForever, [&] { return step == 1; }));
    CHECK_FALSE(strand.wait_for(executive.now() + 5ms, [] { return false; }));
    step = 2;
    try {
      strand.wait_for(kForever, [] { return false; });
    } catch (const Interrupted&) {
      interrupted = true;
    }
  });
  step = 1;
  strand.wake();
  while (step != 2) executive.sleep_until(executive.now() + 1ms);
  leave = true;
  strand.wake();
  CHECK(strand.join_until(kForever));
  CHECK(interrupted);
}
