// SPDX-License-Identifier: GPL-3.0-or-later
// A link tells "nothing now" from "gone", and can be opened again.
#include <catch2/catch.hpp>

#include <algorithm>

#include "link_kits.hpp"

using namespace orca;
using namespace orca::test;
using hw::link::Opening;

TEMPLATE_TEST_CASE("nothing now is not an end", "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  for (int i = 0; i < 5; ++i) {
    CHECK(read_some(*kit.link).empty());
    std::this_thread::sleep_for(2ms);
  }
  must_write(*kit.device, bytes_of("late"));
  CHECK(text_of(read_bytes(*kit.link, 4)) == "late");
  CHECK(read_some(*kit.link).empty());
}

TEMPLATE_TEST_CASE("that the device has gone is told to who reads, again and again", "[hw][link]",
                   ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  kit.device->close();
  CHECK(error_of_reading(*kit.link) == Code::unavailable);
  Bytes bytes(8);
  const Result<std::size_t> again = kit.link->read(bytes);
  REQUIRE_FALSE(again.has_value());
  CHECK(again.error().code == Code::unavailable);
  CHECK(again.error().where == kit.link->name());
  CHECK_FALSE(again.error().message.empty());
}

TEMPLATE_TEST_CASE("that the device has gone is told to who writes", "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  kit.device->close();
  CHECK(error_of_writing(*kit.link) == Code::unavailable);
}

TEMPLATE_TEST_CASE("what arrived before the device went is read first where the system keeps it",
                   "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  must_write(*kit.device, bytes_of("last words"));
  kit.device->close();
  if (TestType::kKeepsLastWords) CHECK(text_of(read_bytes(*kit.link, 10)) == "last words");
  CHECK(error_of_reading(*kit.link) == Code::unavailable);
}

TEMPLATE_TEST_CASE("what was written before the link was closed still gets to the device", "[hw][link]",
                   ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  must_write(*kit.device, bytes_of("never read"));
  must_write(*kit.link, bytes_of("stop"));
  kit.link->close();
  if (TestType::kDeliversLastWords) CHECK(text_of(read_bytes(*kit.device, 4)) == "stop");
  CHECK(error_of_reading(*kit.device) == Code::unavailable);
}

TEST_CASE("a connection that is closed with input unread still delivers what the system has taken",
          "[hw][link]") {
  TcpKit<AF_INET> kit;
  kit.connect();
  must_write(*kit.device, bytes_of("never read"));
  std::size_t written = 0;
  while (kit.link->write(Bytes(64)).ok()) written += 64;
  const std::size_t held_by_system =
      kit.link->pending() - std::min(kit.link->pending(), hw::link::kMostPending);
  REQUIRE(held_by_system > 0);  // so that the device has not got everything
  kit.link->close();
  std::size_t arrived = 0;
  Bytes bytes(4096);
  CHECK(soon([&] {
    const Result<std::size_t> count = kit.device->read(bytes);
    if (count) arrived += *count;
    return !count;
  }));
  CHECK(arrived >= written - hw::link::kMostPending);
}

TEMPLATE_TEST_CASE("a link that is not open says so, also when it is closed twice", "[hw][link]",
                   ORCA_LINK_KITS) {
  TestType kit;
  check_closed(*kit.link);
  kit.connect();
  kit.link->close();
  check_closed(*kit.link);
  kit.link->close();
  check_closed(*kit.link);
}

TEMPLATE_TEST_CASE("opening an open link changes nothing", "[hw][link]", ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  must_write(*kit.device, bytes_of("kept"));
  const Result<Opening> again = kit.link->open();
  REQUIRE(again.has_value());
  CHECK(*again == Opening::done);
  CHECK(text_of(read_bytes(*kit.link, 4)) == "kept");
}

TEMPLATE_TEST_CASE("a link that was closed can be opened again and begins anew", "[hw][link]",
                   ORCA_LINK_KITS) {
  TestType kit;
  for (int round = 0; round < 3; ++round) {
    kit.connect();
    must_write(*kit.device, bytes_of("to the link"));
    CHECK(text_of(read_bytes(*kit.link, 11)) == "to the link");
    must_write(*kit.link, bytes_of("to the device"));
    CHECK(text_of(read_bytes(*kit.device, 13)) == "to the device");
    must_write(*kit.device, bytes_of("never read"));
    kit.link->close();
    kit.device->close();
  }
}

TEMPLATE_TEST_CASE("a link is opened again after its device went and came back", "[hw][link]",
                   ORCA_LINK_KITS) {
  TestType kit;
  kit.connect();
  kit.device->close();
  CHECK(error_of_reading(*kit.link) == Code::unavailable);
  kit.link->close();
  kit.connect();
  must_write(*kit.device, bytes_of("back"));
  CHECK(text_of(read_bytes(*kit.link, 4)) == "back");
}
