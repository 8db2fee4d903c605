// SPDX-License-Identifier: GPL-3.0-or-later
// The bytes are those of the interface's description, written out by hand.
#include <catch2/catch.hpp>

#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "hex_bytes.hpp"
#include "orca/emulators/rplidar_firmware.hpp"

using namespace orca;
using namespace std::chrono_literals;
using emulators::MirrorTurn;
using emulators::RplidarFirmware;
using emulators::RplidarSettings;
using hw::test::Bytes;
using hw::test::hex;
using hw::test::text_of;

namespace {

constexpr const char* kStop = "A5 25";
constexpr const char* kReset = "A5 40";
constexpr const char* kScan = "A5 20";
constexpr const char* kExpress = "A5 82 05 00 00 00 00 00 22";
constexpr const char* kInfo = "A5 50";
constexpr const char* kHealth = "A5 52";
constexpr const char* kNodesFollow = "A5 5A 05 00 00 40 81";
constexpr const char* kCapsulesFollow = "A5 5A 54 00 00 40 82";
constexpr std::size_t kAnnouncement = 7;  // bytes

struct FourWalls final : emulators::Mirror {
  [[nodiscard]] std::optional<MirrorTurn> last_turn() const override {
    return MirrorTurn{{}, 0.0, 0.5 * std::numbers::pi, ranges};
  }
  std::vector<double> ranges{1.0, 1.0, 1.0, 1.0};  // ahead, left, behind, right
};

/// An RPLIDAR and its host, which hears everything that it sends.
struct RplidarLine {
  explicit RplidarLine(const RplidarSettings& settings = {}) : laser(walls, settings) {}

  /// Lets time pass, a millisecond at a time, and returns what was sent.
  Bytes pass(Duration time) {
    Bytes sent;
    for (const TimePoint end = now + time; now < end;) {
      now += 1ms;
      const Bytes part = laser.advance(now);
      sent.insert(sent.end(), part.begin(), part.end());
    }
    return sent;
  }
  /// Lets it start up and drops what it says of that.
  void start_up() { (void)pass(2s); }
  void say(const std::string& bytes) { laser.take(hex(bytes), baud, now); }
  std::string answer(const std::string& request) {
    say(request);
    return text_of(pass(10ms));
  }
  /// Returns what a scan sends behind its announcement.
  Bytes scan(const std::string& request, Duration time) {
    say(request);
    const Bytes sent = pass(time);
    REQUIRE(sent.size() > kAnnouncement);
    return Bytes(sent.begin() + kAnnouncement, sent.end());
  }

  FourWalls walls;
  RplidarFirmware laser;
  TimePoint now{10s};
  std::uint32_t baud = 115200;
};

struct ReadyRplidar : RplidarLine {
  explicit ReadyRplidar(const RplidarSettings& settings = {}) : RplidarLine(settings) { start_up(); }
};

// The part of a stream of nodes or capsules, by its number.
std::string part_of(const Bytes& stream, std::size_t size, std::size_t number) {
  REQUIRE(stream.size() >= size * (number + 1));
  return text_of(std::span(stream).subspan(size * number, size));
}

// Returns the distance of the first node at or behind an angle [deg] of the scanner, as text.
std::string distance_at(const Bytes& nodes, double degrees) {
  for (std::size_t at = 0; at + 5 <= nodes.size(); at += 5) {
    const unsigned angle = (nodes[at + 1] + 256U * nodes[at + 2]) >> 1;
    if (angle >= 64.0 * degrees) return text_of(std::span(nodes).subspan(at + 3, 2));
  }
  return "none";
}

}  // namespace

TEST_CASE("the emulated RPLIDAR prints a text when it has started, and hears nothing before",
          "[emulators][rplidar]") {
  RplidarLine line;
  line.pass(1ms);
  CHECK(line.answer(kInfo).empty());
  const Bytes text = line.pass(1s);
  CHECK(std::string(text.begin(), text.end()) == "RP LIDAR System.\r\nFirmware Ver 1.29, HW Ver 7\r\n");
  CHECK(line.laser.requests().empty());
}

TEST_CASE("the emulated RPLIDAR tells model, firmware, hardware and serial number", "[emulators][rplidar]") {
  ReadyRplidar line;
  CHECK(line.answer(kInfo) ==
        "A5 5A 14 00 00 00 04 18 1D 01 07 A4 E1 9A F0 C1 E3 9E D4 B1 98 4C 95 1C 28 42 13");
}

TEST_CASE("the emulated RPLIDAR tells its health and the number of its error", "[emulators][rplidar]") {
  ReadyRplidar line;
  CHECK(line.answer(kHealth) == "A5 5A 03 00 00 00 06 00 00 00");
  line.laser.set_health(1, 0x0203);
  CHECK(line.answer(kHealth) == "A5 5A 03 00 00 00 06 01 03 02");
}

TEST_CASE("the emulated RPLIDAR measures every 500 us, and every 250 us in an express scan",
          "[emulators][rplidar]") {
  ReadyRplidar line;
  CHECK(line.answer("A5 59") == "A5 5A 04 00 00 00 15 F4 01 FA 00");
}

// GET_LIDAR_CONF: the entry in 4 bytes, the number of a mode in 2, both with the low byte first.
TEST_CASE("the emulated RPLIDAR tells its scan modes", "[emulators][rplidar]") {
  ReadyRplidar line;
  CHECK(line.answer("A5 84 04 70 00 00 00 55") == "A5 5A 06 00 00 00 20 70 00 00 00 02 00");  // two
  CHECK(line.answer("A5 84 04 7C 00 00 00 59") == "A5 5A 06 00 00 00 20 7C 00 00 00 01 00");  // typical: 1
  // 500 and 250 us, in parts of 1/256.
  CHECK(line.answer("A5 84 06 71 00 00 00 00 00 56") == "A5 5A 08 00 00 00 20 71 00 00 00 00 F4 01 00");
  CHECK(line.answer("A5 84 06 71 00 00 00 01 00 57") == "A5 5A 08 00 00 00 20 71 00 00 00 00 FA 00 00");
  CHECK(line.answer("A5 84 06 74 00 00 00 01 00 52") ==
        "A5 5A 08 00 00 00 20 74 00 00 00 00 0C 00 00");  // 12 m
  CHECK(line.answer("A5 84 06 75 00 00 00 00 00 52") == "A5 5A 05 00 00 00 20 75 00 00 00 81");
  CHECK(line.answer("A5 84 06 75 00 00 00 01 00 53") == "A5 5A 05 00 00 00 20 75 00 00 00 82");
  CHECK(line.answer("A5 84 06 7F 00 00 00 01 00 59") ==
        "A5 5A 0C 00 00 00 20 7F 00 00 00 45 78 70 72 65 73 73 00");  // "Express"
  CHECK(line.answer("A5 84 06 7F 00 00 00 02 00 5A").empty());        // there is no third one
}

TEST_CASE("an emulated RPLIDAR with firmware before 1.24 does not know its configuration",
          "[emulators][rplidar]") {
  RplidarSettings settings;
  settings.firmware_minor = 20;
  ReadyRplidar line(settings);
  CHECK(line.answer("A5 84 04 70 00 00 00 55").empty());
  CHECK(line.answer(kHealth) == "A5 5A 03 00 00 00 06 00 00 00");
}

TEST_CASE("a request takes its bytes' time, and so does the answer", "[emulators][rplidar]") {
  ReadyRplidar line;
  line.say(kInfo);
  CHECK(line.pass(2ms).size() == 23);  // of 27; at 115200 baud a byte takes 86.8 us
  CHECK(line.pass(1ms).size() == 4);
}

TEST_CASE("the emulated RPLIDAR sends a node of 5 bytes for each point, clockwise from ahead",
          "[emulators][rplidar]") {
  ReadyRplidar line;
  line.walls.ranges = {1.0, 2.0, 3.0, 4.0};
  line.say(kScan);
  const Bytes sent = line.pass(200ms);
  REQUIRE(sent.size() > kAnnouncement);
  CHECK(text_of(std::span(sent).first(kAnnouncement)) == kNodesFollow);
  const Bytes nodes(sent.begin() + kAnnouncement, sent.end());
  CHECK(part_of(nodes, 5, 0) == "BE 01 00 A0 0F");  // quality 47, 0 deg, 4000 / 4 mm
  CHECK(part_of(nodes, 5, 1) == "BE 7F 00 A0 0F");  // 63 / 64 deg
  CHECK(distance_at(nodes, 90.0) == "80 3E");       // 4 m to the right
  CHECK(distance_at(nodes, 180.0) == "E0 2E");      // 3 m behind
  CHECK(distance_at(nodes, 270.0) == "40 1F");      // 2 m to the left
}

TEST_CASE("the first node of each turn is marked", "[emulators][rplidar]") {
  ReadyRplidar line;
  const Bytes nodes = line.scan(kScan, 1900ms);
  int marked = 0;
  for (std::size_t at = 0; at + 5 <= nodes.size(); at += 5) {
    if ((nodes[at] & 3) != 1) continue;
    ++marked;
    CHECK(nodes[at + 1] <= 0x7F);  // within a degree behind 0
    CHECK(nodes[at + 2] == 0);
  }
  CHECK(marked == 10);  // 5.5 turns a second
  CHECK(line.laser.turns() == 10);
  CHECK(nodes.size() / 5 > 3790);
  CHECK(nodes.size() / 5 <= 3800);
}

TEST_CASE("what is too far for the emulated RPLIDAR, and nothing at all, are a distance and a quality of 0",
          "[emulators][rplidar]") {
  ReadyRplidar line;
  line.walls.ranges = {std::numeric_limits<double>::infinity(), 1.0, 1.0, 12.5};
  const Bytes nodes = line.scan(kScan, 100ms);
  CHECK(part_of(nodes, 5, 0) == "02 01 00 00 00");
  CHECK(distance_at(nodes, 90.0) == "00 00");
}

TEST_CASE("an express scan comes in capsules of 32 points, the first with a mark", "[emulators][rplidar]") {
  ReadyRplidar line;
  line.walls.ranges = {1.0, 1.0, 1.0, 2.0};
  line.say(kExpress);
  const Bytes sent = line.pass(1s);
  REQUIRE(sent.size() > kAnnouncement);
  CHECK(text_of(std::span(sent).first(kAnnouncement)) == kCapsulesFollow);
  const Bytes capsules(sent.begin() + kAnnouncement, sent.end());
  // 1000 mm * 4 = 0FA0. The exclusive or of pairs of equal distances is 0.
  CHECK(part_of(capsules, 84, 0).starts_with("A0 58 00 80 A0 0F A0 0F 00 A0 0F A0 0F 00"));
  CHECK(part_of(capsules, 84, 1).starts_with("A6 5F F5 03 A0 0F A0 0F 00"));    // 1013 / 64 deg
  CHECK(part_of(capsules, 84, 5).find("40 1F 40 1F 00") != std::string::npos);  // around 90 deg: 2000 mm
  CHECK(capsules.size() / 84 == 124);
}

TEST_CASE("a request with a wrong checksum is not answered", "[emulators][rplidar]") {
  ReadyRplidar line;
  CHECK(line.answer("A5 82 05 00 00 00 00 00 23").empty());
  CHECK_FALSE(line.laser.sends_scans());
}

TEST_CASE("an old firmware knows neither express scans nor its sample rates", "[emulators][rplidar]") {
  RplidarSettings settings;
  settings.has_express = false;
  ReadyRplidar line(settings);
  CHECK(line.answer(kExpress).empty());
  CHECK(line.answer("A5 59").empty());
  CHECK(line.answer(kScan).starts_with(kNodesFollow));
}

TEST_CASE("stop ends a scan without an answer, and so does each other request", "[emulators][rplidar]") {
  ReadyRplidar line;
  (void)line.answer(kScan);
  CHECK(line.laser.sends_scans());
  line.say(kStop);
  (void)line.pass(5ms);  // what was on its way
  CHECK(line.pass(100ms).empty());
  (void)line.answer(kScan);
  (void)line.answer(kHealth);
  CHECK_FALSE(line.laser.sends_scans());
  CHECK(line.laser.requests() == std::vector<int>{0x20, 0x25, 0x20, 0x52});
}

TEST_CASE("a reset starts the emulated RPLIDAR anew and heals it, if it can be healed",
          "[emulators][rplidar]") {
  const bool heals = GENERATE(true, false);
  RplidarSettings settings;
  settings.resets_heal = heals;
  ReadyRplidar line(settings);
  line.laser.set_health(2, 0x8001);
  CHECK(line.answer(kHealth) == "A5 5A 03 00 00 00 06 02 01 80");
  CHECK(line.answer(kScan).empty());  // it protects itself
  line.say(kReset);
  const Bytes text = line.pass(1s);
  CHECK(std::string(text.begin(), text.end()).starts_with("RP LIDAR System."));
  CHECK(line.answer(kHealth) == (heals ? "A5 5A 03 00 00 00 06 00 00 00" : "A5 5A 03 00 00 00 06 02 01 80"));
}

TEST_CASE("points come when the motor turns evenly, none while it stands, and a forced scan at once",
          "[emulators][rplidar]") {
  ReadyRplidar line;
  line.laser.power_motor(false, line.now);
  CHECK(line.answer(kScan) == kNodesFollow);
  CHECK(line.pass(1s).empty());
  line.laser.power_motor(true, line.now);
  CHECK(line.pass(499ms).empty());
  CHECK(line.pass(100ms).size() > 900);
  line.laser.power_motor(false, line.now);
  (void)line.pass(5ms);
  CHECK(line.pass(1s).empty());
  line.laser.power_motor(true, line.now);
  CHECK(line.scan("A5 21", 100ms).size() > 900);
}

TEST_CASE("at another rate of the line nothing is understood either way", "[emulators][rplidar]") {
  ReadyRplidar line;
  line.baud = 256000;
  CHECK(line.answer(kInfo).empty());
  line.baud = 115200;
  line.say(kInfo);
  line.laser.take({}, 256000, line.now);
  CHECK(text_of(line.pass(10ms)).find("A5 5A") == std::string::npos);
}

TEST_CASE("garbage before a request, and one that was cut short, do not disturb the next one",
          "[emulators][rplidar]") {
  ReadyRplidar line;
  CHECK(line.answer("00 FF 50 A5 52") == "A5 5A 03 00 00 00 06 00 00 00");
  CHECK(line.answer("A5").empty());
  CHECK(line.answer("A5 52") == "A5 5A 03 00 00 00 06 00 00 00");
}
