// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/rplidar/request.hpp"

#include <catch2/catch.hpp>

#include "hex_bytes.hpp"

using namespace orca::hw::rplidar;
using orca::hw::test::text_of;

TEST_CASE("requests without arguments are two bytes", "[hw][rplidar]") {
  CHECK(text_of(encode(Request::stop).view()) == "A5 25");
  CHECK(text_of(encode(Request::reset).view()) == "A5 40");
  CHECK(text_of(encode(Request::scan).view()) == "A5 20");
  CHECK(text_of(encode(Request::force_scan).view()) == "A5 21");
  CHECK(text_of(encode(Request::info).view()) == "A5 50");
  CHECK(text_of(encode(Request::health).view()) == "A5 52");
  CHECK(text_of(encode(Request::sample_rates).view()) == "A5 59");
}

TEST_CASE("an express scan has five arguments and the exclusive or of all bytes", "[hw][rplidar]") {
  CHECK(text_of(encode(Request::express_scan).view()) == "A5 82 05 00 00 00 00 00 22");
}
