// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <cstdint>
#include <stdexcept>
#include <vector>

#include "orca/hw/framing/short_list.hpp"

using namespace orca::hw::framing;

TEST_CASE("a frame is written with low bytes first", "[hw][framing]") {
  FrameBytes<8> bytes;
  bytes.u8(0x101).u16(0x0302).u32(0x07060504);
  CHECK(std::vector<std::uint8_t>(bytes.begin(), bytes.end()) ==
        std::vector<std::uint8_t>{0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07});
}

TEST_CASE("a short list refuses more than it has room for and keeps what it has", "[hw][framing]") {
  ShortList<int, 2> list;
  list.push_back(1);
  list.push_back(2);
  CHECK_THROWS_AS(list.push_back(3), std::length_error);
  CHECK(list.size() == 2);
  CHECK(list[1] == 2);
}

TEST_CASE("short lists are equal when their elements are", "[hw][framing]") {
  ShortList<int, 2> a;
  ShortList<int, 2> b;
  a.push_back(1);
  CHECK_FALSE(a == b);
  b.push_back(1);
  CHECK(a == b);
}
