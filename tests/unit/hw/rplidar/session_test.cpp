// SPDX-License-Identifier: GPL-3.0-or-later
// The session with an RPLIDAR on a link that writes down what it is asked: requests, and the level of DTR, which stops the motor.
#include "rplidar_session.hpp"

#include <catch2/catch.hpp>

#include <numbers>
#include <string>
#include <vector>

#include "hex_bytes.hpp"

using namespace orca;
using namespace orca::hw::rplidar;
using hw::link::Opening;
using hw::test::Bytes;
using hw::test::hex;
using hw::test::joined;
using hw::test::text_of;

namespace {

// A serial line whose device says what the test wants.
class NotedLink final : public hw::link::ByteLink {
 public:
  [[nodiscard]] Result<Opening> open() override { return Opening::done; }
  void close() override {}
  [[nodiscard]] Result<std::size_t> read(std::span<std::uint8_t> into) override {
    const std::size_t count = std::min(into.size(), coming.size());
    std::copy_n(coming.begin(), count, into.begin());
    coming.erase(coming.begin(), coming.begin() + static_cast<std::ptrdiff_t>(count));
    return count;
  }
  [[nodiscard]] Status write(std::span<const std::uint8_t> bytes) override {
    notes.push_back(text_of(bytes));
    return ok();
  }
  [[nodiscard]] Status flush() override { return ok(); }
  [[nodiscard]] std::size_t pending() const override { return 0; }
  void discard_input() override { coming.clear(); }
  void discard_output() override {}
  [[nodiscard]] int descriptor() const override { return -1; }
  [[nodiscard]] std::string name() const override { return "noted"; }
  [[nodiscard]] Status set_dtr(bool raised) override {
    notes.emplace_back(raised ? "motor off" : "motor on");
    return ok();
  }
  [[nodiscard]] double byte_time() const override { return 10.0 / 115200; }

  Bytes coming;
  std::vector<std::string> notes;
};

const Bytes kInfoAnswer =
    hex("A5 5A 14 00 00 00 04 18 1D 01 07 A4 E1 9A F0 C1 E3 9E D4 B1 98 4C 95 1C 28 42 13");
const Bytes kGoodHealth = hex("A5 5A 03 00 00 00 06 00 00 00");
const Bytes kHealthWithError = hex("A5 5A 03 00 00 00 06 02 01 80");
const Bytes kRates = hex("A5 5A 04 00 00 00 15 F4 01 FA 00");
const Bytes kNodesComing = hex("A5 5A 05 00 00 40 81");
const std::string kStopSent = "A5 25";
const std::string kInfoAsked = "A5 50";
const std::string kHealthAsked = "A5 52";
const std::string kRatesAsked = "A5 59";

struct SessionDesk {
  explicit SessionDesk(ScanMode mode = ScanMode::standard) : session(link, mode) {}

  // Lets time pass, and then what the scanner has said meanwhile arrive.
  Result<bool> advance(Duration time, const Bytes& said = {}) {
    now += time;
    link.coming = said;
    return session.advance(now);
  }
  void meet() {
    REQUIRE(session.begin(now).ok());
    REQUIRE(advance(20ms));
    REQUIRE(advance(5ms, kInfoAnswer));
    REQUIRE(advance(5ms, kGoodHealth));
    const auto known = advance(5ms, kRates);
    REQUIRE(known);
    CHECK(*known);
  }
  Status receive(Duration time, const Bytes& said = {}) {
    now += time;
    link.coming = said;
    return session.receive(now, [this](const Point& point, TimePoint stamp) {
      points.push_back(point);
      stamps.push_back(stamp);
    });
  }

  NotedLink link;
  RplidarSession session;
  TimePoint now{10s};
  std::vector<Point> points;
  std::vector<TimePoint> stamps;
};

using Notes = std::vector<std::string>;

}  // namespace

TEST_CASE("a session stops a scan first, is quiet, and asks who is there while the motor stands",
          "[hw][rplidar]") {
  SessionDesk desk;
  desk.meet();
  CHECK(desk.link.notes == Notes{"motor off", kStopSent, kInfoAsked, kHealthAsked, kRatesAsked});
  CHECK(desk.session.info().model == 0x18);
  CHECK(desk.session.next() == kForever);
}

TEST_CASE("nothing is asked within the quiet time behind a stop", "[hw][rplidar]") {
  SessionDesk desk;
  REQUIRE(desk.session.begin(desk.now).ok());
  REQUIRE(desk.advance(19ms));
  CHECK(desk.link.notes == Notes{"motor off", kStopSent});
}

TEST_CASE("the motor turns from the request for a scan until the scan is ended", "[hw][rplidar]") {
  SessionDesk desk;
  desk.meet();
  desk.link.notes.clear();
  REQUIRE(desk.session.scan(desk.now).ok());
  CHECK(desk.link.notes == Notes{"motor on", kStopSent});
  REQUIRE(desk.receive(20ms).ok());
  CHECK(desk.link.notes.back() == "A5 20");
  REQUIRE(desk.receive(5ms, kNodesComing).ok());
  CHECK_FALSE(desk.session.scans());
  desk.link.notes.clear();
  desk.session.rest();
  CHECK(desk.link.notes == Notes{kStopSent, "motor off"});
}

TEST_CASE("an express scan is asked for if the scanner tells its sample rates", "[hw][rplidar]") {
  SessionDesk desk(ScanMode::automatic);
  desk.meet();
  REQUIRE(desk.session.scan(desk.now).ok());
  REQUIRE(desk.receive(20ms).ok());
  CHECK(desk.link.notes.back() == "A5 82 05 00 00 00 00 00 22");
  for (int tries = 0; tries < 3; ++tries) REQUIRE(desk.receive(1s).ok());
  CHECK(desk.link.notes.back() == "A5 20");  // it has not begun one
  CHECK_FALSE(desk.session.is_express());
}

TEST_CASE("each question is asked three times, and a scanner that does not answer is not found",
          "[hw][rplidar]") {
  SessionDesk desk;
  REQUIRE(desk.session.begin(desk.now).ok());
  REQUIRE(desk.advance(20ms));
  REQUIRE(desk.advance(300ms));
  REQUIRE(desk.advance(300ms));
  const auto given_up = desk.advance(300ms);
  REQUIRE_FALSE(given_up);
  CHECK(given_up.error().code == Code::not_found);
  CHECK(std::ranges::count(desk.link.notes, kInfoAsked) == 3);
}

TEST_CASE("an error is followed by one reset, two seconds of patience, and the questions again",
          "[hw][rplidar]") {
  SessionDesk desk;
  REQUIRE(desk.session.begin(desk.now).ok());
  REQUIRE(desk.advance(20ms));
  REQUIRE(desk.advance(5ms, kInfoAnswer));
  REQUIRE(desk.advance(5ms, kHealthWithError));
  CHECK(desk.link.notes.back() == "A5 40");
  REQUIRE(desk.advance(1999ms));
  CHECK(desk.link.notes.back() == "A5 40");
  REQUIRE(desk.advance(1ms));
  CHECK(desk.link.notes.back() == kStopSent);
  REQUIRE(desk.advance(20ms));
  REQUIRE(desk.advance(5ms, kInfoAnswer));
  const auto still_wrong = desk.advance(5ms, kHealthWithError);
  REQUIRE_FALSE(still_wrong);
  CHECK(still_wrong.error().code == Code::failed_precondition);
  CHECK_THAT(still_wrong.error().message, Catch::Contains("reports error 8001"));
}

TEST_CASE("a point has the time of its measurement: before its bytes, and before those that came with them",
          "[hw][rplidar]") {
  SessionDesk desk;
  desk.meet();
  REQUIRE(desk.session.scan(desk.now).ok());
  REQUIRE(desk.receive(20ms).ok());
  REQUIRE(desk.receive(5ms, kNodesComing).ok());
  // Nine nodes of 1 m, a degree apart: the reader believes the first when eight fit together, and keeps the last.
  REQUIRE(desk.receive(4500us, joined({hex("BD 01 00 A0 0F"), hex("BE 81 00 A0 0F"), hex("BE 01 01 A0 0F"),
                                       hex("BE 81 01 A0 0F"), hex("BE 01 02 A0 0F"), hex("BE 81 02 A0 0F"),
                                       hex("BE 01 03 A0 0F"), hex("BE 81 03 A0 0F"), hex("BE 01 04 A0 0F")}))
              .ok());
  REQUIRE(desk.points.size() == 8);
  CHECK(desk.session.scans());
  CHECK(desk.points[7].range == 1.0);
  CHECK(desk.points[7].angle == Approx(-7.0 * std::numbers::pi / 180.0));
  // The eighth came whole with the last byte of the ninth: 500 us and five bytes of 86.8 us before now.
  CHECK(to_seconds(desk.now - desk.stamps[7]) == Approx(500e-6 + 5 * 10.0 / 115200));
}

TEST_CASE("a scan without points for six seconds is that of a motor that does not turn", "[hw][rplidar]") {
  SessionDesk desk;
  desk.meet();
  REQUIRE(desk.session.scan(desk.now).ok());
  REQUIRE(desk.receive(20ms).ok());
  REQUIRE(desk.receive(5ms, kNodesComing).ok());
  REQUIRE(desk.receive(5999ms).ok());
  const Status stands = desk.receive(1ms);
  REQUIRE_FALSE(stands.ok());
  CHECK(stands.error().code == Code::deadline_exceeded);
  CHECK_THAT(stands.error().message, Catch::Contains("does its head turn?"));
}
