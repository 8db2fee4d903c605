// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include "orca/hw/player/position2d.hpp"
#include "orca/hw/player/sensors.hpp"
#include "player_bytes.hpp"

using namespace orca::hw::player;
using namespace orca::hw::player::test;

namespace {

const std::string kOne = "3FF0000000000000 ";
const std::string kTwo = "4000000000000000 ";
const std::string kHalf = "3FE0000000000000 ";
const std::string kZero = "0000000000000000 ";

const std::string kPoseWords = kOne + kTwo + kHalf + kZero + kZero + kOne;  // x, y, z, roll, pitch, yaw
const Pose3 kPose{1.0, 2.0, 0.5, 0.0, 0.0, 1.0};
const std::string kSizeWords = kHalf + kOne + kTwo;
const Size3 kSize{0.5, 1.0, 2.0};

}  // namespace

TEST_CASE("motor power is a request of position2d with a switch", "[hw][player]") {
  CHECK(make_message(header_for(kPosition2dMotorPower), encode(Switch{true})).value() ==
        words("00000000 00000000 00000004 00000000 00000003 00000002 0000000000000000 00000000 00000004 | "
              "00000001"));
  CHECK(agree(Switch{false}, words("00000000")));
}

TEST_CASE("a velocity command has three velocities and the motor state", "[hw][player]") {
  CHECK(
      make_message(header_for(kPosition2dVelocity), encode(VelocityCommand{{0.2, 0.0, 0.1}, true})).value() ==
      words("00000000 00000000 00000004 00000000 00000002 00000001 0000000000000000 00000000 0000001C"
            "| 3FC999999999999A 0000000000000000 3FB999999999999A 00000001"));
  CHECK(agree(VelocityCommand{{0.2, 0.0, 0.1}, true},
              words("3FC999999999999A 0000000000000000 3FB999999999999A 00000001")));
}

TEST_CASE("position2d data have a pose, a velocity and the stall", "[hw][player]") {
  const std::string numbers =
      "3FF0000000000000 4000000000000000 3FE0000000000000 3FC999999999999A 0000000000000000 "
      "3FB999999999999A ";
  CHECK(agree(Position2dState{{1.0, 2.0, 0.5}, {0.2, 0.0, 0.1}, false}, words(numbers + "00000000")));
  CHECK(agree(Position2dState{{1.0, 2.0, 0.5}, {0.2, 0.0, 0.1}, true}, words(numbers + "00000001")));
}

TEST_CASE("a pose in the plane has its numbers in order", "[hw][player]") {
  CHECK(agree(Planar{1.0, 2.0, 0.5}, words(kOne + kTwo + kHalf)));
}

TEST_CASE("a geometry is a pose and a size", "[hw][player]") {
  const Bytes bytes = words(kPoseWords + kSizeWords);
  CHECK(bytes.size() == 72);
  CHECK(agree(Geometry{kPose, kSize}, bytes));
}

TEST_CASE("a laser scan has its intensities filled up to a multiple of four", "[hw][player]") {
  const LaserScan scan{.min_angle = -1.5707964F,
                       .max_angle = 1.5707964F,
                       .resolution = 1.5707964F,
                       .max_range = 8.0F,
                       .ranges = {1.0F, 2.0F, 3.5F},
                       .intensities = {0, 1, 2},
                       .id = 7};
  const Bytes bytes = words(
      "BFC90FDB 3FC90FDB 3FC90FDB 41000000 00000003 00000003 3F800000 40000000 40600000 00000003 00000003 "
      "00010200 "
      "00000007");
  CHECK(bytes.size() == 52);
  CHECK(agree(scan, bytes));
}

TEST_CASE("a captured scan of 181 points is read", "[hw][player]") {
  // The captured head; what the log did not keep is zero.
  Bytes bytes = words("BFC90FDB 3FC90FDB 3C8EFA35 41000000 000000B5 000000B5 3F800000 3F8020C5");
  bytes.resize(24 + 181 * 4);
  const Bytes count = words("000000B5 000000B5");
  bytes.insert(bytes.end(), count.begin(), count.end());
  bytes.resize(bytes.size() + 184 + 4);
  CHECK(bytes.size() == 944);
  const auto scan = decode<LaserScan>(bytes);
  REQUIRE(scan.has_value());
  CHECK(scan->min_angle == Approx(-1.5707963).margin(1e-7));
  CHECK(scan->resolution == Approx(0.0174533).margin(1e-7));
  CHECK(scan->max_range == 8.0F);
  CHECK(scan->ranges.size() == 181);
  CHECK(scan->ranges[0] == 1.0F);
  CHECK(scan->ranges[1] == Approx(1.001).margin(1e-6));
  CHECK(scan->intensities.size() == 181);
  CHECK(encode(*scan) == bytes);
}

TEST_CASE("the configuration of a laser has single precision", "[hw][player]") {
  const Bytes config = words("BFC90FDB 3FC90FDB 3F000000 41000000 3C800000 00000001 42960000");
  CHECK(config.size() == 28);
  CHECK(agree(LaserConfig{-1.5707964F, 1.5707964F, 0.5F, 8.0F, 0.015625F, true, 75.0F}, config));
}

TEST_CASE("sonar ranges are a list", "[hw][player]") {
  CHECK(agree(SonarRanges{{1.0F, 0.5F}}, words("00000002 00000002 3F800000 3F000000")));
}

TEST_CASE("captured ranges of 16 sonars are read", "[hw][player]") {
  Bytes bytes = words("00000010 00000010 3F800000 3F8147AE 3F828F5C 3F83D70A");
  bytes.resize(72);  // what the log did not keep is zero
  const auto sonar = decode<SonarRanges>(bytes);
  REQUIRE(sonar.has_value());
  CHECK(sonar->ranges.size() == 16);
  CHECK(sonar->ranges[0] == 1.0F);
  CHECK(sonar->ranges[1] == Approx(1.01).margin(1e-6));
  CHECK(sonar->ranges[3] == Approx(1.03).margin(1e-6));
}

TEST_CASE("the geometry of sonars is a list of poses", "[hw][player]") {
  CHECK(agree(SonarGeometry{{kPose, Pose3{}}},
              words("00000002 00000002 " + kPoseWords + kZero + kZero + kZero + kZero + kZero + kZero)));
}

TEST_CASE("a ranger has numbers of double precision", "[hw][player]") {
  CHECK(agree(RangerValues{{1.0, 0.5}}, words("00000002 00000002" + kOne + kHalf)));
  CHECK(agree(RangerConfig{1.0, 2.0, 0.5, 0.0, 1.0, 2.0, 0.5},
              words(kOne + kTwo + kHalf + kZero + kOne + kTwo + kHalf)));
  CHECK(agree(RangerGeometry{kPose, kSize, {kPose}, {kSize, kSize}},
              words(kPoseWords + kSizeWords + "00000001 00000001" + kPoseWords + "00000002 00000002" +
                    kSizeWords + kSizeWords)));
}

TEST_CASE("what a stamped ranger message does not have is there as zeros", "[hw][player]") {
  RangerStamped stamped{.ranges = {{0.5}}, .config = RangerConfig{.frequency = 2.0}};
  const std::string no_geometry = "00000000" + kZero + kZero + kZero + kZero + kZero + kZero + kZero + kZero +
                                  kZero + "00000000 00000000 00000000 00000000";
  const std::string config = "00000001" + kZero + kZero + kZero + kZero + kZero + kZero + kTwo;
  CHECK(agree(stamped, words("00000001 00000001" + kHalf + no_geometry + config)));
}

TEST_CASE("bumpers are a list of bytes", "[hw][player]") {
  CHECK(agree(BumperState{{0, 1, 0, 0, 1}}, words("00000005 00000005 00010000 01000000")));
}

TEST_CASE("a power state has only what its mask says", "[hw][player]") {
  CHECK(agree(PowerState{.voltage = 12.0F}, words("00000001 41400000 00000000 00000000 00000000 00000000")));
  CHECK(agree(PowerState{.voltage = 12.0F, .charge = 50.0F, .energy = 8.0F, .power = 2.0F, .charging = -1},
              words("0000001F 41400000 42480000 41000000 40000000 FFFFFFFF")));
  const auto none = decode<PowerState>(words("00000000 41400000 42480000 41000000 40000000 00000001"));
  CHECK(none.value() == PowerState{});
}
