// SPDX-License-Identifier: GPL-3.0-or-later
// A line in memory: its size, and its two ends in two threads.
#include <catch2/catch.hpp>

#include <thread>

#include "link_talk.hpp"
#include "orca/hw/link/memory_link.hpp"

using namespace orca;
using namespace orca::test;
using hw::link::make_memory_links;

TEST_CASE("a line in memory holds as many bytes as it is said to, each way", "[hw][link][memory]") {
  const auto [first, second] = make_memory_links({"small", 4, false});
  must_open(*first);
  must_open(*second);
  must_write(*first, bytes_of("abc"));
  CHECK(first->write(bytes_of("de")).error().code == Code::deadline_exceeded);
  must_write(*first, bytes_of("d"));
  must_write(*second, bytes_of("1234"));
  CHECK(text_of(read_some(*second)) == "abcd");
  CHECK(text_of(read_some(*first)) == "1234");
}

TEST_CASE("an end that nobody has opened yet is no end that has gone", "[hw][link][memory]") {
  const auto [first, second] = make_memory_links();
  must_open(*first);
  CHECK(read_some(*first).empty());
  must_write(*first, bytes_of("early"));
  must_open(*second);
  CHECK(text_of(read_some(*second)) == "early");
}

TEST_CASE("the ends of a line in memory may be in two threads, and one may outlive the other",
          "[hw][link][memory]") {
  constexpr int kRounds = 2000;
  auto [first, second] = make_memory_links({"line", 64, true});
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
