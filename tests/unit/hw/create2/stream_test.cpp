// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/create2/stream.hpp"

#include <catch2/catch.hpp>

#include "hex_bytes.hpp"
#include "orca/base/random.hpp"
#include "orca/hw/create2/sensors.hpp"

using namespace orca::hw;
using namespace orca::hw::create2;
using orca::hw::test::FrameList;
using orca::hw::test::frames_in;
using orca::hw::test::joined;
using StreamBytes = std::vector<std::uint8_t>;

namespace {

// The frame in the manual. Its text says that the signal is 549 = 0x0225, but the bytes 2 and 25, which the checksum
// fits to, are 537; and packet 29 is the front left cliff signal, not the left one.
const StreamBytes kExample{19, 5, 29, 2, 25, 13, 0, 163};
const std::string kExampleText = "13 05 1D 02 19 0D 00 A3";

}  // namespace

TEST_CASE("the manual's frame is found and read", "[hw][create2]") {
  CHECK(frames_in(create2::kProtocol, kExample) == std::vector<std::string>{kExampleText});
  Sensors sensors;
  CHECK(sensors.apply_body(body_of(kExample)).ok());
  CHECK(sensors.cliff_signals[1] == 537);
  CHECK(sensors.virtual_wall == false);
  CHECK_FALSE(sensors.wall.has_value());
}

TEST_CASE("the frame around a body is the manual's", "[hw][create2]") {
  const StreamFrame frame = make_frame(StreamBytes{29, 2, 25, 13, 0});
  CHECK(StreamBytes(frame.begin(), frame.end()) == kExample);
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
  wrong.back() = 182;  // that of the first Create, without the header
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
  CHECK(look(StreamBytes{19, 200, 59}).kind == Kind::nothing);        // there is no packet 59
  CHECK(look(StreamBytes{19, 200, 7, 0, 59}).kind == Kind::nothing);  // nor after another
  CHECK(look(StreamBytes{19, 80, 100}).kind == Kind::nothing);        // packet 100 needs 81 bytes
  CHECK(look(StreamBytes{19, 81, 100}).kind == Kind::need_more);
  CHECK(look(StreamBytes{19, 4, 7, 0, 22, 1, 0, 0}).kind == Kind::nothing);  // packet 22 has two bytes
}

TEST_CASE("a header inside a frame does not hide the frame", "[hw][create2]") {
  const StreamFrame frame = make_frame(StreamBytes{22, 19, 5, 43, 19, 19});
  const StreamBytes bytes(frame.begin(), frame.end());
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
    for (const std::uint8_t packet : {kPacketBumpsAndDrops, kPacketLeftCounts, kPacketRightCounts, kGroup3}) {
      body.push_back(packet);
      for (std::size_t i = 0; i < *data_size(packet); ++i)
        body.push_back(static_cast<std::uint8_t>(random()));
    }
    const StreamFrame frame = make_frame(body);
    list.hear(StreamBytes(frame.begin(), frame.end()));
    Sensors sensors;
    REQUIRE(sensors.apply_body(body_of(frame.view())).ok());
    CHECK(sensors.left_counts == 256 * body[3] + body[4]);
    CHECK(sensors.right_counts == 256 * body[6] + body[7]);
  }
  CHECK(list.frames().size() == 2000);
  CHECK(list.statistics().skipped_bytes == 0);
}
