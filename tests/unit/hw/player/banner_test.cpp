// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/hw/player/banner.hpp"
#include "player_bytes.hpp"

using namespace orca::hw::player;
using namespace orca::hw::player::test;

TEST_CASE("the banner of a server is its version in 32 bytes", "[hw][player]") {
  const Bytes expected = words("506C6179 65722076 2E332E31 2E312D64 65760000 00000000 00000000 00000000");
  const auto banner = make_banner("3.1.1-dev");
  CHECK(Bytes(banner.begin(), banner.end()) == expected);
  CHECK(parse_banner(expected).value() == "3.1.1-dev");
}

TEST_CASE("a long version is cut so that the banner ends with a zero byte", "[hw][player]") {
  const auto banner = make_banner("3.1.1-with-a-very-long-suffix");
  CHECK(banner.back() == 0);
  CHECK(parse_banner(banner).value() == "3.1.1-with-a-very-long");
}

TEST_CASE("a server that is no Player server is named by what it says", "[hw][player]") {
  Bytes other{'S', 'S', 'H', '-', '2', '.', '0', '\r', '\n'};
  other.resize(32);
  CHECK(error_of(parse_banner(other)) ==
        "the server begins with \"SSH-2.0\\r\\n\" and not with \"Player v.\"; check host and port");
}

TEST_CASE("a banner that was cut short is an error", "[hw][player]") {
  const auto banner = make_banner("3.1.1");
  CHECK(error_of(parse_banner(std::span(banner).first(31))) ==
        "the banner of a Player server has 32 bytes, but only 31 have arrived");
}

TEST_CASE("a banner without a zero byte is read to its end", "[hw][player]") {
  const std::string text = "Player v.12345678901234567890123";
  CHECK(parse_banner(Bytes(text.begin(), text.end())).value() == "12345678901234567890123");
}
