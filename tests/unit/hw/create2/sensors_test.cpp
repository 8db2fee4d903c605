// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <numbers>
#include <vector>

#include "hex_bytes.hpp"
#include "orca/base/random.hpp"
#include "orca/hw/create2/sensors.hpp"
#include "orca/hw/framing/checksums.hpp"

using namespace orca::hw::create2;
using namespace orca::hw;
using SensorBytes = std::vector<std::uint8_t>;
using orca::hw::test::FrameList;
using orca::hw::test::frames_in;
using orca::hw::test::joined;
using StreamBytes = std::vector<std::uint8_t>;

namespace {

Sensors after(const SensorBytes& body) { return parse_body(body).value(); }

// Voltage 537 mV and bumper 0; all bytes have the sum 0.
const StreamBytes kExample{19, 5, 22, 2, 25, 7, 0, 176};
const std::string kExampleText = "13 05 16 02 19 07 00 B0";

StreamBytes frame_of(const StreamBytes& body) {
  StreamBytes frame{19, static_cast<std::uint8_t>(body.size())};
  frame.insert(frame.end(), body.begin(), body.end());
  frame.push_back(static_cast<std::uint8_t>(256 - framing::sum_of_bytes(frame)));
  return frame;
}

}  // namespace

TEST_CASE("bumps and wheel drops are bits", "[hw][create2]") {
  CHECK(after({7, 0x01}).bumps_and_drops == BumpsAndDrops{.bump_right = true});
  CHECK(after({7, 0x02}).bumps_and_drops == BumpsAndDrops{.bump_left = true});
  CHECK(after({7, 0x04}).bumps_and_drops == BumpsAndDrops{.drop_right = true});
  CHECK(after({7, 0x08}).bumps_and_drops == BumpsAndDrops{.drop_left = true});
}

TEST_CASE("the state of charge is not known without a capacity, and at most 1", "[hw][create2]") {
  CHECK_FALSE(state_of_charge(Sensors{}).has_value());
  CHECK_FALSE(state_of_charge(Sensors{.charge = 1.0, .capacity = 0.0}).has_value());
  CHECK_FALSE(state_of_charge(Sensors{.charge = 1.0}).has_value());
  CHECK(state_of_charge(Sensors{.charge = 2.0, .capacity = 1.0}) == 1.0);
}

TEST_CASE("a stall is a wheel's motor that draws too much, not a brush's", "[hw][create2]") {
  CHECK_FALSE(after({14, 0x01}).is_stalled);
  CHECK_FALSE(after({14, 0x04}).is_stalled);
  CHECK(after({14, 0x08}).is_stalled);
  CHECK(after({14, 0x10}).is_stalled);
}

TEST_CASE("cliffs are counted from the left", "[hw][create2]") {
  CHECK(after({9, 1, 10, 0, 11, 0, 12, 1}).cliffs == std::array{true, false, false, true});
}

TEST_CASE("the battery is reported in SI units", "[hw][create2]") {
  const Sensors sensors = after({21, 2, 22, 0x3D, 0x86, 25, 0x05, 0xDC, 26, 0x0B, 0xB8});
  CHECK(sensors.charging_state == ChargingState::full);
  CHECK(*sensors.voltage == Approx(15.75));
  CHECK(*sensors.charge == Approx(5400.0));  // 1500 mAh
  CHECK(*sensors.capacity == Approx(10800.0));
  CHECK(*state_of_charge(sensors) == Approx(0.5));
}

TEST_CASE("chargers, the mode and the encoders", "[hw][create2]") {
  CHECK_FALSE(after({34, 0}).is_at_charger);
  CHECK(after({34, 1}).is_at_charger);
  CHECK(after({34, 2}).is_at_charger);
  CHECK(after({35, 3}).mode == Mode::full);
  CHECK(after({43, 0x12, 0x34}).left_counts == 0x1234);
  CHECK(after({44, 0x12, 0x34}).right_counts == 0x1234);
}

TEST_CASE("packets that nobody asked for, or that are cut short, give no readings", "[hw][create2]") {
  CHECK_FALSE(data_size(13).has_value());
  CHECK_FALSE(parse_body(SensorBytes{22, 1, 2, 13, 0}).has_value());
  CHECK_FALSE(parse_body(SensorBytes{7, 0, 22, 1}).has_value());
  CHECK(after({}) == Sensors{});
}

TEST_CASE("a frame is found and read", "[hw][create2]") {
  CHECK(frames_in(create2::kProtocol, kExample) == std::vector<std::string>{kExampleText});
  const Sensors sensors = parse_body(body_of(kExample)).value();
  CHECK(*sensors.voltage == Approx(0.537));
  CHECK_FALSE(sensors.mode.has_value());
}

TEST_CASE("the manual's checksum counts the header", "[hw][create2]") {
  CHECK(framing::sum_of_bytes(StreamBytes{19, 5, 29, 2, 25, 13, 0, 163}) == 0);
  CHECK(frame_of({29, 2, 25, 13, 0}).back() == 163);
}

TEST_CASE("a frame is found when it comes byte by byte, and behind the text of a reset", "[hw][create2]") {
  FrameList list(create2::kProtocol);
  const std::string text = "bl-start\r\nr3_robot/tags/release-3.5.x\r\n";
  list.hear(StreamBytes(text.begin(), text.end()));
  for (const std::uint8_t byte : joined({kExample, kExample})) list.hear({byte});
  CHECK(list.frames() == std::vector<std::string>{kExampleText, kExampleText});
  CHECK(list.statistics().skipped_bytes == text.size());
}

TEST_CASE("a wrong checksum is no frame", "[hw][create2]") {
  StreamBytes wrong = kExample;
  wrong.back() = 195;  // that of the first Create, without the header
  FrameList list(create2::kProtocol);
  list.hear(joined({wrong, kExample}));
  CHECK(list.frames() == std::vector<std::string>{kExampleText});
  CHECK(list.statistics().bad_checksums == 1);
}

TEST_CASE("a beginning whose packets do not fit is not waited for", "[hw][create2]") {
  using Kind = framing::Finding::Kind;
  CHECK(look(StreamBytes{18}).kind == Kind::nothing);
  CHECK(look(StreamBytes{19}).kind == Kind::need_more);
  CHECK(look(StreamBytes{19, 0}).kind == Kind::nothing);
  CHECK(look(StreamBytes{19, 200, 13}).kind == Kind::nothing);        // nobody asks for packet 13
  CHECK(look(StreamBytes{19, 200, 7, 0, 13}).kind == Kind::nothing);  // nor after another
  CHECK(look(StreamBytes{19, 2, 22}).kind == Kind::nothing);          // packet 22 needs 3 bytes
  CHECK(look(StreamBytes{19, 3, 22}).kind == Kind::need_more);
  CHECK(look(StreamBytes{19, 4, 7, 0, 22, 1, 0, 0}).kind == Kind::nothing);
}

TEST_CASE("a header inside a frame does not hide the frame", "[hw][create2]") {
  const StreamBytes bytes = frame_of({22, 19, 5, 43, 19, 19});
  FrameList list(create2::kProtocol);
  list.hear(joined({bytes, bytes}));
  CHECK(list.frames().size() == 2);
  CHECK(list.statistics().skipped_bytes == 0);
}

TEST_CASE("no frame of any numbers is lost, and it is read without an error", "[hw][create2]") {
  orca::RandomStream random(1, "test", "create2");
  FrameList list(create2::kProtocol);
  for (int round = 0; round < 2000; ++round) {
    StreamBytes body;
    for (const int packet : {7, 43, 44, 21, 22, 25, 26}) {
      body.push_back(static_cast<std::uint8_t>(packet));
      for (std::size_t i = 0; i < *data_size(static_cast<std::uint8_t>(packet)); ++i)
        body.push_back(static_cast<std::uint8_t>(random()));
    }
    const StreamBytes frame = frame_of(body);
    list.hear(frame);
    const Sensors sensors = parse_body(body_of(frame)).value();
    CHECK(sensors.left_counts == 256 * body[3] + body[4]);
    CHECK(sensors.right_counts == 256 * body[6] + body[7]);
  }
  CHECK(list.frames().size() == 2000);
  CHECK(list.statistics().skipped_bytes == 0);
}

TEST_CASE("123 counts are 123 * (pi * 72 mm / 508.8) = 54.7 mm", "[hw][create2]") {
  CHECK(wheel_way(123) == Approx(0.0547).margin(0.00005));
  CHECK(wheel_way(-123) == -wheel_way(123));
}

TEST_CASE("counts wrap at 16 bits in both directions", "[hw][create2]") {
  CHECK(step_of(65535, 0) == 1);
  CHECK(step_of(0, 65535) == -1);
  CHECK(step_of(65000, 100) == 636);
  CHECK(step_of(0, 32767) == 32767);
  CHECK(step_of(0, 32768) == -32768);
  CHECK(step_of(1234, 1234) == 0);
}

TEST_CASE("the first counts are a reference alone", "[hw][create2]") {
  EncoderOdometry odometry;
  CHECK(odometry.add(1000, 2000) == orca::Travel2{});
  CHECK(odometry.add(1123, 2123).forward == Approx(0.0547).margin(0.00005));
  odometry.forget();
  CHECK(odometry.add(0, 0) == orca::Travel2{});
}

TEST_CASE("equal counts are a straight way, opposite ones a turn", "[hw][create2]") {
  EncoderOdometry odometry;
  odometry.add(65500, 100);
  const auto straight = odometry.add(65500 + 509 - 65536, 609);
  CHECK(straight.forward == Approx(std::numbers::pi * 0.072).epsilon(0.001));
  CHECK(straight.turn == Approx(0.0).margin(1e-12));
  const auto left = odometry.add(static_cast<std::uint16_t>(473 - 415), 609 + 415);
  CHECK(left.forward == Approx(0.0).margin(1e-12));
  CHECK(left.turn ==
        Approx(std::numbers::pi / 2.0).epsilon(0.001));  // a quarter turn: pi * 0.235 / 4 per wheel
  CHECK(left.left == 0.0);
}

TEST_CASE("the way is the same in one step or in many, over many wraps", "[hw][create2]") {
  EncoderOdometry odometry;
  double way = 0.0;
  for (unsigned counts = 0; counts <= 1'000'000; counts += 1000)
    way += odometry.add(static_cast<std::uint16_t>(counts), static_cast<std::uint16_t>(counts)).forward;
  CHECK(way == Approx(1'000'000 / 508.8 * std::numbers::pi * 0.072));
}
