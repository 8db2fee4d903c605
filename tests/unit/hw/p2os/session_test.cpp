// SPDX-License-Identifier: GPL-3.0-or-later
// The connection to a Pioneer with the emulation of its controller at the other end, in a time of its own.
#include "session.hpp"

#include <catch2/catch.hpp>

#include <algorithm>
#include <string>
#include <vector>

#include "../../emulators/robot_line.hpp"
#include "orca/emulators/p2os_firmware.hpp"

using namespace orca;
using namespace orca::hw::p2os;
using namespace std::chrono_literals;
using Catch::Contains;
using emulators::P2osFirmware;
using emulators::P2osSettings;

namespace {

/// The line to a robot. Above its fastest rate nothing arrives.
class RobotLink final : public hw::link::ByteLink {
 public:
  RobotLink(P2osFirmware& robot, const TimePoint& now) : robot_(robot), now_(now) {}

  void set_fastest(std::uint32_t baud) { fastest_ = baud; }
  /// The adapter refuses what is faster.
  void refuse_beyond(std::uint32_t baud) { adapter_ = baud; }
  void cut(bool is_cut) { is_cut_ = is_cut; }

  Result<hw::link::Opening> open() override { return hw::link::Opening::done; }
  void close() override {}
  Result<std::size_t> read(std::span<std::uint8_t> into) override {
    const auto sent = robot_.advance(now_);
    if (!is_deaf()) coming_.insert(coming_.end(), sent.begin(), sent.end());
    const auto count = static_cast<std::ptrdiff_t>(std::min(coming_.size(), into.size()));
    std::copy_n(coming_.begin(), count, into.begin());
    coming_.erase(coming_.begin(), coming_.begin() + count);
    return static_cast<std::size_t>(count);
  }
  Status write(std::span<const std::uint8_t> bytes) override {
    if (!is_deaf()) robot_.take(bytes, baud_, now_);
    return ok();
  }
  Status flush() override { return ok(); }
  [[nodiscard]] std::size_t pending() const override { return 0; }
  void discard_input() override {
    (void)robot_.advance(now_);
    coming_.clear();
  }
  void discard_output() override {}
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] std::string name() const override { return "line"; }
  Status set_line(const hw::link::Line& line) override {
    if (line.baud > adapter_) return fail(Code::invalid_argument, "the adapter is too slow");
    baud_ = line.baud;
    return ok();
  }
  [[nodiscard]] double byte_time() const override { return 10.0 / baud_; }

 private:
  [[nodiscard]] bool is_deaf() const { return is_cut_ || baud_ > fastest_; }

  P2osFirmware& robot_;
  const TimePoint& now_;
  std::uint32_t baud_ = 0, fastest_ = 1'000'000, adapter_ = 1'000'000;
  bool is_cut_ = false;
  std::vector<std::uint8_t> coming_;
};

struct Desk {
  explicit Desk(const P2osSettings& settings = {}) : robot(body, settings), link(robot, now) {}

  // Returns the rate at which the robot is met, and 0 if it is not.
  std::uint32_t meet() { return meet(session); }
  std::uint32_t meet(Session& other) {
    REQUIRE(other.begin(now).ok());
    for (const TimePoint end = now + 10s; now < end; now += 1ms) {
      const Result<bool> done = other.advance(now);
      if (!done) return 0;
      if (*done) return other.rate();
    }
    return 0;
  }
  // Returns whether packets come, for as long as the driver waits for one.
  bool hears() {
    int packets = 0;
    for (const TimePoint end = now + 1s; now < end; now += 1ms)
      REQUIRE(session.receive(now, [&](const Received&) { ++packets; }).ok());
    return packets > 5;
  }
  void take_leave() {
    REQUIRE(session.send(encode(Command::stop)).ok());
    REQUIRE(session.send(encode(Command::close)).ok());
  }
  static inline const std::vector<std::uint32_t> kRates{9600, 38400, 19200, 115200, 57600};
  TimePoint now{10s};
  emulators::test::ScriptedBody body;
  P2osFirmware robot;
  RobotLink link;
  Session session{link, kRates};
};

P2osSettings with_rate(std::uint32_t baud) {
  P2osSettings settings;
  settings.baud = baud;
  return settings;
}

}  // namespace

TEST_CASE(
    "a Pioneer at a slow rate is told to send at 38400 baud, and has its own rate again when it is left",
    "[hw][p2os]") {
  Desk desk(with_rate(GENERATE(9600U, 19200U)));
  REQUIRE(desk.meet() == 38400);
  CHECK(desk.session.config());
  CHECK(desk.session.identity().subclass == "p2dx");
  CHECK(desk.session.rate_trouble().empty());
  CHECK(desk.hears());
  desk.take_leave();
  desk.now += 20s;
  CHECK(desk.meet() == 38400);
}

TEST_CASE("a Pioneer that is as fast or faster is left as it is", "[hw][p2os]") {
  const std::uint32_t rate = GENERATE(38400U, 57600U, 115200U);
  Desk desk(with_rate(rate));
  CHECK(desk.meet() == rate);
  CHECK(desk.hears());
  CHECK(std::ranges::count(desk.robot.commands(), static_cast<int>(Command::hostbaud)) == 0);
}

TEST_CASE("a Pioneer that does not say that it returns to its own rate keeps it", "[hw][p2os]") {
  P2osSettings settings;
  SECTION("it says that it does not return") {
    settings.resets_baud = false;
    Desk desk(settings);
    CHECK(desk.meet() == 9600);
    CHECK(desk.hears());
    CHECK_THAT(desk.session.rate_trouble(), Contains("does not return to its own rate"));
  }
  SECTION("it does not tell its settings") {
    settings.tells_settings = false;
    Desk desk(settings);
    CHECK(desk.meet() == 9600);
    CHECK(desk.hears());
    CHECK_FALSE(desk.session.config());
  }
}

TEST_CASE("a Pioneer that is not heard at 38400 baud goes on at 9600, and is not tried for ever",
          "[hw][p2os]") {
  P2osSettings settings;
  settings.fastest = 19200;
  Desk desk(settings);
  for (int i = 0; i < 4; ++i) {
    CAPTURE(i);
    REQUIRE(desk.meet() == 9600);
    CHECK(desk.hears());
    CHECK_THAT(desk.session.rate_trouble(), Contains("nothing is heard of it at 38400"));
    desk.take_leave();
    desk.now += 20s;
  }
  CHECK(std::ranges::count(desk.robot.commands(), static_cast<int>(Command::hostbaud)) == 2);
}

TEST_CASE("a line that carries no faster rate costs the robot once, with what to do", "[hw][p2os]") {
  Desk desk;
  desk.link.set_fastest(19200);
  REQUIRE(desk.session.begin(desk.now).ok());
  Result<bool> done = false;
  for (int i = 0; i < 20'000 && done && !*done; ++i, desk.now += 1ms) done = desk.session.advance(desk.now);
  REQUIRE_FALSE(done);
  CHECK_THAT(done.error().message,
             Contains("was told to send at 38400 baud, and is not heard since; switch it "
                      "off and on, and write speed_up=\"false\""));
  desk.robot.reset(desk.now);
  REQUIRE(desk.meet() == 9600);
  CHECK(desk.hears());
}

TEST_CASE("a Pioneer whose graph says so keeps its rate", "[hw][p2os]") {
  Desk desk;
  desk.link.set_fastest(19200);
  Session session(desk.link, Desk::kRates, false);
  CHECK(desk.meet(session) == 9600);
}

TEST_CASE("an adapter without the faster rate is found out before the robot has it", "[hw][p2os]") {
  Desk desk;
  desk.link.refuse_beyond(19200);
  REQUIRE(desk.meet() == 9600);
  CHECK(desk.hears());
  CHECK_THAT(desk.session.rate_trouble(), Contains("the adapter is too slow"));
  CHECK(std::ranges::count(desk.robot.commands(), static_cast<int>(Command::hostbaud)) == 0);
}

TEST_CASE("a Pioneer that still sends at 38400 baud is found again, by this program and by a new one",
          "[hw][p2os]") {
  Desk desk;
  REQUIRE(desk.meet() == 38400);
  desk.now += 20s;
  SECTION("its line was lost for a while") {
    desk.link.cut(true);
    CHECK_FALSE(desk.hears());
    desk.link.cut(false);
    const TimePoint back = desk.now;
    CHECK(desk.meet() == 38400);
    CHECK(desk.now - back < 2s);
  }
  SECTION("the program was killed") {
    Session other(desk.link, Desk::kRates);
    CHECK(desk.meet(other) == 38400);
  }
  SECTION("it was switched off and on") {
    desk.robot.reset(desk.now);
    CHECK_FALSE(desk.hears());
    const TimePoint back = desk.now;
    CHECK(desk.meet() == 38400);
    CHECK(desk.now - back < 2s);
  }
}

TEST_CASE("a Pioneer that is lost twice soon after it has become faster keeps its own rate", "[hw][p2os]") {
  Desk desk;
  for (int i = 0; i < 2; ++i) {
    REQUIRE(desk.meet() == 38400);
    desk.now += 3s;
    desk.link.cut(true);
    CHECK_FALSE(desk.hears());
    desk.link.cut(false);
  }
  CHECK(desk.meet() == 9600);
  CHECK(desk.hears());
}
