// SPDX-License-Identifier: GPL-3.0-or-later
// Waits that input from outside ends.
#include <fcntl.h>
#include <unistd.h>

#include <atomic>
#include <catch2/catch.hpp>
#include <thread>

#include "executive_kinds.hpp"
#include "orca/base/strand.hpp"

using namespace orca;
using namespace orca::test;

namespace {

class Pipe {
 public:
  Pipe() { REQUIRE(pipe2(ends_, O_CLOEXEC | O_NONBLOCK) == 0); }
  ~Pipe() {
    close(ends_[0]);
    hang_up();
  }
  Pipe(const Pipe&) = delete;
  Pipe& operator=(const Pipe&) = delete;
  [[nodiscard]] int reading() const { return ends_[0]; }
  void write(char byte) const { REQUIRE(::write(ends_[1], &byte, 1) == 1); }
  [[nodiscard]] char read() const {
    char byte = 0;
    return ::read(ends_[0], &byte, 1) == 1 ? byte : '\0';
  }
  void hang_up() {
    if (ends_[1] >= 0) close(ends_[1]);
    ends_[1] = -1;
  }

 private:
  int ends_[2]{-1, -1};
};

// Runs `body` with an event of free-running threads.
void with_input_event(const std::function<void(Executive&, InputEvent&)>& body) {
  const auto executive = make({ClockKind::steady, Backend::thread});
  executive->run([&] {
    const auto event = executive->make_input_event();
    REQUIRE(event != nullptr);
    body(*executive, *event);
  });
}

constexpr Duration kHang = 20s;

}  // namespace

TEST_CASE("a wait ends when input comes, and at once while it is not read", "[base][event]") {
  const Pipe pipe;
  with_input_event([&](Executive& executive, InputEvent& event) {
    event.watch(pipe.reading());
    std::thread sender([&] {
      std::this_thread::sleep_for(20ms);
      pipe.write('a');
    });
    CHECK(event.wait_until(executive.now() + kHang));
    sender.join();
    CHECK(event.wait_until(executive.now() + kHang));
    CHECK(pipe.read() == 'a');
    CHECK_FALSE(event.wait_until(executive.now() + 10ms));
  });
}

TEST_CASE("a wait ends when the other end has gone", "[base][event]") {
  Pipe pipe;
  with_input_event([&](Executive& executive, InputEvent& event) {
    event.watch(pipe.reading());
    pipe.hang_up();
    CHECK(event.wait_until(executive.now() + kHang));
  });
}

TEST_CASE("what is not watched any more ends no wait", "[base][event]") {
  const Pipe pipe;
  pipe.write('a');
  with_input_event([&](Executive& executive, InputEvent& event) {
    event.watch(pipe.reading());
    CHECK(event.wait_until(executive.now()));
    event.watch(-1);
    CHECK_FALSE(event.wait_until(executive.now() + 10ms));
  });
}

TEST_CASE("an event for input is notified like others, also before the wait and past the deadline",
          "[base][event]") {
  with_input_event([&](Executive& executive, InputEvent& event) {
    event.notify();
    event.notify();
    CHECK(event.wait_until(executive.now()));
    CHECK_FALSE(event.wait_until(executive.now()));
    CHECK_FALSE(event.wait_until(executive.now() + 5ms));
  });
}

TEST_CASE("no notification is lost between threads, and no wait ends early without one", "[base][event]") {
  with_input_event([&](Executive& executive, InputEvent& event) {
    std::atomic<int> rung{0};
    std::atomic<int> heard{0};
    constexpr int kRings = 20'000;
    std::thread ringer([&] {
      for (int i = 0; i < kRings; ++i) {
        ++rung;
        event.notify();
        while (heard.load() < rung.load()) std::this_thread::yield();
      }
    });
    while (heard.load() < kRings) {
      const TimePoint deadline = executive.now() + kHang;
      if (!event.wait_until(deadline)) {
        CHECK(executive.now() >= deadline);
        FAIL("a notification was lost");
      }
      heard.store(rung.load());
    }
    ringer.join();
    for (int i = 0; i < 200; ++i) {  // late rings of before wake nobody
      const TimePoint deadline = executive.now() + 50us;
      CHECK_FALSE(event.wait_until(deadline));
      CHECK(executive.now() >= deadline);
    }
  });
}

TEST_CASE("a strand waits for input where its executive can, and says where it cannot",
          "[base][event][strand]") {
  for (const ExecutiveOptions& options : all_kinds()) {
    const auto executive = make(options);
    const Pipe pipe;
    executive->run([&] {
      Strand strand(*executive, {"strand", 0});
      const bool can = strand.await_input();
      CHECK(can == (options.backend == Backend::thread));
      strand.watch_input(pipe.reading());
      pipe.write('a');
      const TimePoint deadline = executive->now() + (can ? kHang : Duration(5ms));
      strand.pause_until(deadline);
      CHECK((executive->now() < deadline) == can);
      strand.wake();
      strand.pause_until(executive->now() + kHang);
      CHECK(executive->now() < deadline + kHang);
    });
  }
}
