// SPDX-License-Identifier: GPL-3.0-or-later
#include <catch2/catch.hpp>

#include <string>
#include <vector>

#include "orca/base/random.hpp"
#include "xr4000_bytes.hpp"

using namespace orca;
using namespace orca::hw::test;
using hw::xr4000::Message;
using hw::xr4000::Type;
using XrFrames = std::vector<std::string>;

namespace {

XrFrames xr_frames_in(const Bytes& bytes) { return frames_in(hw::xr4000::kProtocol, bytes); }

}  // namespace

TEST_CASE("a frame of the XR4000's agent is 58 52, length, type, payload and CRC", "[hw][xr4000]") {
  CHECK(text_of(make_frame(Message{Type::get_state}).view()) == kXrGetState);
  const Bytes timeout = hex("F4 01 00 00");
  CHECK(text_of(make_frame(Message{Type::set_timer, false, timeout}).view()) == kXrSetTimer);
  const HeldXrMessage request(kXrSetTimer);
  CHECK(request.message.type == Type::set_timer);
  CHECK_FALSE(request.message.is_answer);
  CHECK(text_of(request.message.payload) == "F4 01 00 00");
  const HeldXrMessage answer(kXrHelloAnswer);
  CHECK(answer.message.type == Type::hello);
  CHECK(answer.message.is_answer);
  CHECK(text_of(answer.message.payload) == "00 01 78");
}

TEST_CASE("a frame of the XR4000's agent is found one byte at a time", "[hw][xr4000]") {
  FrameList list(hw::xr4000::kProtocol);
  for (const std::uint8_t byte : hex(kXrStateAnswer)) {
    CHECK(list.frames().empty());
    list.hear({byte});
  }
  CHECK(list.frames() == XrFrames{kXrStateAnswer});
}

TEST_CASE("frames of the XR4000's agent are found behind noise and behind false beginnings", "[hw][xr4000]") {
  CHECK(xr_frames_in(hex("00 58 58 52 58 52 01 FF " + kXrGetState + " 58 " + kXrHello)) ==
        XrFrames{kXrGetState, kXrHello});
}

TEST_CASE("a frame of the XR4000's agent with a wrong CRC is dropped and the next one found",
          "[hw][xr4000]") {
  FrameList list(hw::xr4000::kProtocol);
  list.hear(hex("58 52 00 00 02 DE ED " + kXrGetSonar));
  CHECK(list.frames() == XrFrames{kXrGetSonar});
  CHECK(list.statistics().bad_checksums == 1);
}

TEST_CASE("a frame of the XR4000's agent that says it is longer than any is no beginning", "[hw][xr4000]") {
  CHECK(hw::xr4000::look(hex("58 52 81 00 02")).kind == hw::framing::Finding::Kind::nothing);
  CHECK(hw::xr4000::look(hex("58 52 00 01 02")).kind == hw::framing::Finding::Kind::nothing);
  CHECK(hw::xr4000::look(hex("58 52 80 00 02")).kind == hw::framing::Finding::Kind::need_more);
}

TEST_CASE("what is put into a frame of the XR4000's agent is found in it", "[hw][xr4000]") {
  RandomStream random(1, "test", "xr4000");
  for (int i = 0; i < 500; ++i) {
    Bytes payload(random() % (hw::xr4000::kLongestPayload + 1));
    for (std::uint8_t& byte : payload) byte = static_cast<std::uint8_t>(random());
    const Message sent{static_cast<Type>(random() % 128), random() % 2 == 1, payload};
    const hw::xr4000::Frame frame = make_frame(sent);
    REQUIRE(xr_frames_in({frame.begin(), frame.end()}) == XrFrames{text_of(frame.view())});
    const Message got = hw::xr4000::message_of(frame.view());
    CHECK(got.type == sent.type);
    CHECK(got.is_answer == sent.is_answer);
    CHECK(text_of(got.payload) == text_of(payload));
  }
}
