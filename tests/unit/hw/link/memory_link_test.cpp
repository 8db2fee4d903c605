// SPDX-License-Identifier: GPL-3.0-or-later
// A line in memory: its size, and its two ends in two threads.
#include <catch2/catch.hpp>

#include <thread>

#include "link_talk.hpp"
#include "orca/hw/link/make_link.hpp"
#include "orca/hw/link/memory_link.hpp"

using namespace orca;
using namespace orca::test;
using hw::link::MemoryLink;
using hw::link::MemoryOptions;

TEST_CASE("a line in memory holds 4096 bytes each way", "[hw][link][memory]") {
  const auto [driver, device] = make_memory_ends();
  must_open(*driver);
  must_open(*device);
  must_write(*driver, Bytes(4095));
  CHECK(driver->write(bytes_of("ab")).error().code == Code::deadline_exceeded);
  must_write(*driver, bytes_of("a"));
  must_write(*device, bytes_of("1234"));
  CHECK(read_some(*device, 8192).size() == 4096);
  CHECK(text_of(read_some(*driver)) == "1234");
}

TEST_CASE("an end that nobody has opened yet is no end that has gone", "[hw][link][memory]") {
  const auto [first, second] = make_memory_ends();
  must_open(*first);
  CHECK(read_some(*first).empty());
  must_write(*first, bytes_of("early"));
  must_open(*second);
  CHECK(text_of(read_some(*second)) == "early");
}

TEST_CASE("the ends of a line in memory may be in two threads, and one may outlive the other",
          "[hw][link][memory]") {
  constexpr int kRounds = 2000;
  auto [first, second] = make_memory_ends();
  must_open(*first);
  must_open(*second);
  std::thread echo([end = std::move(second)] {
    Bytes bytes(16);
    for (int left = kRounds; left > 0;) {
      const Result<std::size_t> count = end->read(bytes);
      if (!count) return;
      if (*count == 0) std::this_thread::yield();
      if (!end->write(std::span(bytes).first(*count)).ok()) return;
      left -= static_cast<int>(*count);
    }
  });
  int wrong = 0;
  for (int i = 0; i < kRounds; ++i) {
    const auto value = static_cast<std::uint8_t>(i);
    must_write(*first, {value});
    wrong += read_bytes(*first, 1) != Bytes{value};
  }
  CHECK(wrong == 0);
  echo.join();
  CHECK(error_of_reading(*first) == Code::unavailable);
}

TEST_CASE("each end of a line in memory is open once, and free when that link has closed it",
          "[hw][link][memory]") {
  const MemoryOptions ours{.name = "taken", .end = MemoryOptions::End::device};
  MemoryLink first(ours);
  MemoryLink second(ours);
  must_open(first);
  CHECK(second.open().error().code == Code::already_exists);
  { MemoryLink never_opened(ours); }
  CHECK(first.flush().ok());
  first.close();
  must_open(second);
}

TEST_CASE("a driver waits in its own time for the device at the other end, and then for no longer",
          "[hw][link][memory]") {
  TimePoint now{100s};
  const auto clock = [&now] { return now; };
  const auto driver = hw::link::make_link("emulated:late", {.now = clock, .is_virtual = true});
  REQUIRE(driver);
  CHECK((*driver)->name() == "memory:late");
  CHECK((*driver)->open().value() == hw::link::Opening::under_way);
  now += 11s;
  CHECK((*driver)->open().error().code == Code::not_found);
  CHECK((*driver)->open().value() == hw::link::Opening::under_way);
  MemoryLink device({.name = "late", .end = MemoryOptions::End::device});
  must_open(device);
  CHECK((*driver)->open().value() == hw::link::Opening::done);
}

TEST_CASE("a line in memory calls its reader at each write and when the writer leaves",
          "[hw][link][memory]") {
  const auto [driver, device] = make_memory_ends();
  must_open(*driver);
  must_open(*device);
  int rings = 0;
  CHECK(driver->ring_at_input([&rings] { ++rings; }));
  must_write(*device, bytes_of("a"));
  must_write(*device, bytes_of("b"));
  CHECK(rings == 2);
  must_write(*driver, bytes_of("c"));
  CHECK(rings == 2);
  device->close();
  CHECK(rings == 3);
  driver->close();
  must_open(*driver);
  must_open(*device);
  must_write(*device, bytes_of("d"));
  CHECK(rings == 3);
}

TEST_CASE("a device sees the rate that its driver has set, as long as that has the line open",
          "[hw][link][memory]") {
  const auto [driver, device] = make_memory_ends();
  must_open(*device);
  CHECK_FALSE(device->line());
  REQUIRE(driver->set_line({.baud = 19200}).ok());
  CHECK_FALSE(device->line());
  must_open(*driver);
  CHECK(device->line()->baud == 19200);
  REQUIRE(driver->set_line({.baud = 500000}).ok());
  CHECK(device->line()->baud == 500000);
  CHECK(driver->byte_time() == Approx(2e-5));
  driver->close();
  CHECK_FALSE(device->line());
}
