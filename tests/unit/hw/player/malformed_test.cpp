// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sensors.hpp"
#include "orca/hw/player/session.hpp"
#include "player_bytes.hpp"

using namespace orca::hw::player;
using namespace orca::hw::player::test;

namespace {

const std::string kHint = "; check that the peer speaks Player 3.x";

}  // namespace

TEST_CASE("counts of a list that disagree are an error", "[hw][player]") {
  const auto read = decode<SonarRanges>(words("00000002 00000001 3F800000 3F000000"));
  CHECK(read.error().code == orca::Code::data_loss);
  CHECK(error_of(read) ==
        "sonar RANGES, 16 bytes: a list has the counts 2 and 1, which must be equal" + kHint);
}

TEST_CASE("a list that is longer than its payload is an error and takes no memory", "[hw][player]") {
  CHECK(error_of(decode<SonarRanges>(words("FFFFFFFF FFFFFFFF 3F800000"))) ==
        "sonar RANGES, 12 bytes: a list of 4294967295 elements is announced, but only 4 bytes follow" +
            kHint);
  CHECK_FALSE(decode<SonarRanges>(words("00000002 00000002 3F800000")).has_value());
  CHECK_FALSE(decode<RangerValues>(words("00000002 00000002 3FF00000 00000000")).has_value());
  CHECK_FALSE(decode<BumperState>(words("FFFFFFFF FFFFFFFF 00000000")).has_value());
  CHECK_FALSE(decode<SonarGeometry>(words("20000000 20000000 00000000")).has_value());
  CHECK_FALSE(decode<DeviceList>(words("10000001 10000001 00000000 00000000 00000000 00000000")).has_value());
}

TEST_CASE("a list of bytes without its padding is an error", "[hw][player]") {
  CHECK(agree(BumperState{{1}}, words("00000001 00000001 01000000")));
  CHECK(error_of(decode<BumperState>(words("00000001 00000001 01"))) ==
        "bumper STATE, 9 bytes: it ends too early" + kHint);
}

TEST_CASE("a payload that is longer than its content is an error", "[hw][player]") {
  CHECK(error_of(decode<Switch>(words("00000001 00000000"))) ==
        "switch, 8 bytes: 4 bytes are left over" + kHint);
}

TEST_CASE("an enumeration with an unknown value is an error", "[hw][player]") {
  CHECK(error_of(decode<DataMode>(words("00000003"))) ==
        "player DATAMODE, 4 bytes: a field has the value 3, which means nothing there" + kHint);
  CHECK_FALSE(decode<DataMode>(words("00000000")).has_value());
  const std::string device = "00000000 00000000 00000004 00000000 ";
  CHECK_FALSE(decode<Subscription>(words(device + "00000000 00000000 00000000")).has_value());
  CHECK_FALSE(decode<Subscription>(words(device + "00000004 00000000 00000000")).has_value());
}

TEST_CASE("a scan is an error when it is cut after any byte", "[hw][player]") {
  const Bytes scan = words(
      "BFC90FDB 3FC90FDB 3FC90FDB 41000000 00000003 00000003 3F800000 40000000 40600000 00000003 00000003 "
      "00010200 "
      "00000007");
  for (std::size_t size = 0; size < scan.size(); ++size)
    CHECK_FALSE(decode<LaserScan>(std::span(scan).first(size)).has_value());
}

TEST_CASE("a wrong byte in a scan gives another scan or an error", "[hw][player]") {
  const Bytes scan = words(
      "BFC90FDB 3FC90FDB 3FC90FDB 41000000 00000003 00000003 3F800000 40000000 40600000 00000003 00000003 "
      "00010200 "
      "00000007");
  int errors = 0;
  for (std::size_t bit = 0; bit < scan.size() * 8; ++bit) {
    Bytes wrong = scan;
    wrong[bit / 8] ^= static_cast<std::uint8_t>(1U << bit % 8);
    errors += decode<LaserScan>(wrong) ? 0 : 1;
  }
  CHECK(errors == 4 * 32);  // each bit of the four counts
}
