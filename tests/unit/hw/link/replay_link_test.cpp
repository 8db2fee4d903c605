// SPDX-License-Identifier: GPL-3.0-or-later
// A recording plays the device.
#include <catch2/catch.hpp>

#include "link_talk.hpp"
#include "orca/hw/link/logged_link.hpp"
#include "orca/hw/link/memory_link.hpp"
#include "orca/hw/link/replay_link.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::link::ReplayLink;

namespace {

constexpr const char* kTwoSessions =
    "# orca byte log 1\n"
    "5.000000 open\n"
    "5.001000 out  01 02\n"
    "5.010000 in   0a 0b\n"
    "5.010000 in   0c\n"
    "5.015000 dropped ff\n"
    "5.020000 in   0d\n"
    "6.000000 gone the cable was pulled\n"
    "6.500000 close\n"
    "9.000000 open\n"
    "9.500000 in   aa\n"
    "10.000000 close\n";

// A recording on a clock of the test's own.
struct Replay {
  TempFolder folder;
  TimePoint time{77s};
  ReplayLink link;

  explicit Replay(const std::string& text) : link({folder.write("log", text), [this] { return time; }}) {}
};

}  // namespace

TEST_CASE("a recording gives what was received, at its times after opening", "[hw][link][replay]") {
  Replay replay(kTwoSessions);
  must_open(replay.link);
  CHECK(replay.link.descriptor() == -1);
  CHECK(read_some(replay.link).empty());
  replay.time += 9999us;
  CHECK(read_some(replay.link).empty());
  replay.time += 1us;
  CHECK(read_some(replay.link, 2) == Bytes{0x0A, 0x0B});
  CHECK(read_some(replay.link) == Bytes{0x0C});
  CHECK(read_some(replay.link).empty());
  replay.time += 10ms;
  CHECK(read_some(replay.link) == Bytes{0x0D});
  replay.time += 1ms;
  CHECK(read_some(replay.link).empty());  // nothing now is not an end
}

TEST_CASE("a recording ends as the device did, and the next opening plays the next session",
          "[hw][link][replay]") {
  Replay replay(kTwoSessions);
  must_open(replay.link);
  replay.time += 2s;
  CHECK(read_some(replay.link) == Bytes{0x0A, 0x0B, 0x0C, 0x0D});
  Bytes bytes(4);
  const Error gone = replay.link.read(bytes).error();
  CHECK(gone.code == Code::unavailable);
  CHECK(gone.message == "the cable was pulled");
  CHECK(replay.link.write(bytes_of("x")).error().code == Code::unavailable);
  CHECK(replay.link.flush().error().code == Code::unavailable);
  replay.link.close();
  check_closed(replay.link);

  must_open(replay.link);
  CHECK(read_some(replay.link).empty());
  replay.time += 500ms;
  CHECK(read_some(replay.link) == Bytes{0xAA});
  replay.time += 500ms;
  CHECK_THAT(replay.link.read(bytes).error().message, Contains("the recording ends here"));
  replay.link.close();
  replay.link.close();

  const auto third = replay.link.open();
  REQUIRE_FALSE(third.has_value());
  CHECK(third.error().code == Code::unavailable);
  CHECK_THAT(third.error().message, Contains("2 sessions"));
}

TEST_CASE("a recording of a line that had rates has those, and no others", "[hw][link][replay]") {
  Replay with(
      "# orca byte log 1\n"
      "5.000000 open\n"
      "# line: 9600 baud 8N1\n"
      "# no line: 500000 baud 8N1\n"
      "5.100000 in   0a\n"
      "# line: 38400 baud 8N1\n"
      "6.000000 close\n");
  must_open(with.link);
  CHECK(with.link.set_line({.baud = 9600}).ok());
  CHECK(with.link.byte_time() == Approx(10.0 / 9600));
  CHECK(with.link.set_line({.baud = 500000}).error().code == Code::invalid_argument);
  CHECK(with.link.set_line({.baud = 38400}).ok());
  CHECK(with.link.byte_time() == Approx(10.0 / 38400));
  Replay without(kTwoSessions);
  must_open(without.link);
  CHECK(without.link.set_line({.baud = 500000}).ok());
  CHECK(without.link.byte_time() == 0.0);
}

TEST_CASE("an answer of a recording does not come before its request, if that is a little late",
          "[hw][link][replay]") {
  Replay replay(
      "# orca byte log 1\n"
      "5.000000 open\n"
      "5.010000 out  01\n"
      "5.020000 in   0a\n"
      "5.030000 out  02\n"
      "5.040000 in   0b\n"
      "9.000000 close\n");
  must_open(replay.link);
  replay.time += 10ms;
  must_write(replay.link, {1});
  replay.time += 10ms;
  CHECK(read_some(replay.link) == Bytes{0x0a});
  replay.time += 100ms;
  CHECK(read_some(replay.link).empty());
  const bool asks = GENERATE(true, false);
  if (asks) must_write(replay.link, {2});
  CHECK(read_some(replay.link).empty() != asks);
  replay.time += ReplayLink::kMostLag;
  CHECK(read_some(replay.link).empty() == asks);
}

TEST_CASE("what is written to a recording is compared with what was recorded", "[hw][link][replay]") {
  Replay replay(kTwoSessions);
  CHECK(replay.link.comparison().recorded == 0);
  must_open(replay.link);
  must_write(replay.link, {1});
  CHECK(replay.link.comparison().agrees());
  must_write(replay.link, {2});
  CHECK(replay.link.comparison().agrees());
  CHECK(replay.link.comparison().written == 2);
  CHECK(replay.link.comparison().recorded == 2);
  CHECK(replay.link.first_difference().empty());
  must_write(replay.link, {3});
  CHECK_FALSE(replay.link.comparison().agrees());
  CHECK(replay.link.first_difference() == "byte 2 to the device: recorded nothing, written 03");
}

TEST_CASE("the first byte that differs from the recording is named", "[hw][link][replay]") {
  Replay replay(kTwoSessions);
  must_open(replay.link);
  must_write(replay.link, {1, 0xEE});
  CHECK(replay.link.comparison().equal == 1);
  CHECK(replay.link.first_difference() == "byte 1 to the device: recorded 02, written ee");
}

TEST_CASE("a driver that discards input of a recording loses what is due", "[hw][link][replay]") {
  Replay replay(kTwoSessions);
  must_open(replay.link);
  replay.time += 10ms;
  replay.link.discard_input();
  replay.time += 10ms;
  CHECK(read_some(replay.link) == Bytes{0x0D});
}

TEST_CASE("a recording that is not there or damaged says where", "[hw][link][replay]") {
  ReplayLink absent({"/no/such/recording", [] { return TimePoint(); }});
  CHECK(absent.open().error().code == Code::not_found);
  CHECK_THAT(absent.open().error().text(), Contains("/no/such/recording") && Contains("No such file"));
  Replay damaged("# orca byte log 1\n0.000000 open\n0.000000 in zz\n");
  const Error error = damaged.link.open().error();
  CHECK(error.code == Code::invalid_argument);
  CHECK_THAT(error.text(), Contains("log, line 3: \"zz\" is no byte"));
  check_closed(damaged.link);
}

TEST_CASE("a recording that was cut anywhere is still played up to there", "[hw][link][replay]") {
  const std::string whole = kTwoSessions;
  for (std::size_t size = std::string("# orca byte log 1\n5.000000 open\n").size(); size < whole.size();
       ++size) {
    Replay replay(whole.substr(0, size));
    const auto opened = replay.link.open();
    if (!opened) FAIL("cut after " << size << " bytes: " << opened.error().text());
  }
}

TEST_CASE("what a logged link has read, a replay of its log gives again in the same pieces",
          "[hw][link][replay]") {
  const TempFolder folder;
  TimePoint time{5s};
  const auto now = [&] { return time; };
  std::vector<std::pair<TimePoint, Bytes>> seen;
  {
    auto [near_end, device] = make_memory_ends();
    auto log = hw::link::ByteLog::create({folder.file("log"), std::size_t{1} << 20, now}, "x");
    hw::link::LoggedLink link(std::move(near_end), std::move(*log));
    must_open(link);
    must_open(*device);
    for (std::uint8_t i = 0; i < 50; ++i) {
      time += 7ms;
      must_write(*device, Bytes(i + 1U, i));
      seen.emplace_back(time, read_some(link));
      must_write(link, {i});
    }
  }
  time = TimePoint(5s);
  ReplayLink replay({folder.file("log"), now});
  must_open(replay);
  for (std::uint8_t i = 0; i < seen.size(); ++i) {
    time = seen[i].first;
    CHECK(read_some(replay) == seen[i].second);
    if (i + 1U < seen.size()) must_write(replay, {i});
  }
  CHECK(replay.comparison().agrees());
  CHECK(replay.comparison().equal == seen.size() - 1);
}
