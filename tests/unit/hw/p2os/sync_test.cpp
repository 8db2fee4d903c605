// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "hex_bytes.hpp"
#include "orca/hw/p2os/packet.hpp"
#include "orca/hw/p2os/sync.hpp"

using namespace orca::hw;
using p2os::Identity;
using test::hex;

TEST_CASE("the answer to SYNC2 gives name, class and subclass", "[hw][p2os]") {
  const auto packet =
      hex("FA FB 19 02 50 69 6F 6E 65 65 72 32 00 50 69 6F 6E 65 65 72 00 70 32 64 78 00 DD 7C");
  REQUIRE(p2os::look(packet).kind == framing::Finding::Kind::frame);
  CHECK(p2os::sync_step(p2os::body_of(packet)) == 2);
  CHECK(p2os::parse_identity(p2os::body_of(packet)) == Identity{"Pioneer2", "Pioneer", "p2dx"});
}

TEST_CASE("echoes of the handshake give their step, and nothing else does", "[hw][p2os]") {
  CHECK(p2os::sync_step(hex("00")) == 0);
  CHECK(p2os::sync_step(hex("01")) == 1);
  CHECK_FALSE(p2os::sync_step(hex("FF")).has_value());
  CHECK_FALSE(p2os::sync_step(hex("32 00")).has_value());
  CHECK_FALSE(p2os::sync_step({}).has_value());
  CHECK_FALSE(p2os::parse_identity(hex("01 41 00")).has_value());
}

TEST_CASE("names that are missing or not ended are read as far as they go", "[hw][p2os]") {
  CHECK(p2os::parse_identity(hex("02")) == Identity{"", "", ""});
  CHECK(p2os::parse_identity(hex("02 41 00 42 43")) == Identity{"A", "BC", ""});
  CHECK(p2os::parse_identity(hex("02 00 00 44 00 45")) == Identity{"", "", "D"});
}
