// SPDX-License-Identifier: GPL-3.0-or-later
#include "orca/hw/frame_session.hpp"

#include <catch2/catch.hpp>
#include <string>

#include "orca/hw/link/memory_link.hpp"

using namespace orca;
using namespace orca::hw;
using namespace std::chrono_literals;
using Catch::Contains;
using link::MemoryLink;
using link::MemoryOptions;

namespace {

// A frame is a capital letter.
framing::Finding look_for_capital(std::span<const std::uint8_t> bytes) {
  const bool capital = bytes[0] >= 'A' && bytes[0] <= 'Z';
  return capital ? framing::Finding{framing::Finding::Kind::frame, 1} : framing::Finding{};
}

/// A session over a line, and the device's end of that.
struct Conversation {
  Conversation() {
    REQUIRE(device.open());
    REQUIRE(driver.open());
    REQUIRE(session.begin(TimePoint{10s}).ok());
  }
  void say(const std::string& text) {
    REQUIRE(device.write(std::vector<std::uint8_t>(text.begin(), text.end())).ok());
  }

  MemoryLink device{{.name = "frames", .end = MemoryOptions::End::device}};
  MemoryLink driver{{.name = "frames"}};
  std::string taken;
  FrameSession session{
      driver, {look_for_capital, 1}, [this](const framing::Frame& frame, TimePoint /*sent*/) {
        taken += static_cast<char>(frame.bytes[0]);
      }};
};

}  // namespace

TEST_CASE("a device that sends by itself is known by its first good frame", "[frame_session]") {
  Conversation line;
  line.say("ab");
  CHECK_FALSE(line.session.advance(TimePoint{10s}).value());
  line.say("cD");
  CHECK(line.session.advance(TimePoint{11s}).value());
  line.say("EfG");
  CHECK(line.session.read(TimePoint{12s}).ok());
  CHECK(line.taken == "DEG");
  CHECK(line.session.counts().skipped_bytes == 4);
}

TEST_CASE("a device whose frames make no sense is given up after two seconds", "[frame_session]") {
  Conversation line;
  line.say("abc");
  CHECK_FALSE(line.session.advance(TimePoint{11s}).value());
  CHECK(line.session.next() == TimePoint{12s});
  const Result<bool> known = line.session.advance(TimePoint{12s});
  REQUIRE_FALSE(known);
  CHECK(known.error().code == Code::not_found);
  CHECK_THAT(known.error().message, Contains("nothing that makes sense comes over memory:frames"));
}

TEST_CASE("a line that is opened again must show that the device is there again", "[frame_session]") {
  Conversation line;
  line.say("A");
  REQUIRE(line.session.advance(TimePoint{10s}).value());
  REQUIRE(line.session.begin(TimePoint{20s}).ok());
  CHECK_FALSE(line.session.advance(TimePoint{20s}).value());
}

TEST_CASE("an unplugged line is reported as such", "[frame_session]") {
  Conversation line;
  line.device.close();
  CHECK(line.session.advance(TimePoint{10s}).error().code == Code::unavailable);
}
