// SPDX-License-Identifier: GPL-3.0-or-later
// Logs of CARMEN as text: lines, what is wrong in a log, and what a log says of its lasers.
#include <sys/stat.h>
#include <zlib.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "orca/recording/carmen/log.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::carmen;
using namespace orca::test;
using Catch::Contains;

namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

template <class Content>
Content content_of(const std::string& text) {
  const Result<Line> line = read_line(text);
  INFO(text << ": " << (line ? "" : line.error().message));
  REQUIRE(line);
  REQUIRE(std::holds_alternative<Content>(line->content));
  return std::get<Content>(line->content);
}

std::string fault_of(const std::string& text) {
  const Result<Line> line = read_line(text);
  REQUIRE_FALSE(line);
  CHECK(line.error().code == Code::data_loss);
  return line.error().message;
}

// Reads a log of which `piece` bytes come at a time.
Result<Log> log_of(const std::string& text, std::size_t piece = 7) {
  std::size_t at = 0;
  return read_log([&]() -> std::string_view {
    const std::string_view next = std::string_view(text).substr(at, piece);
    at += next.size();
    return next;
  });
}

std::string odometry_at(double time) {
  return to_text({from_seconds(time), OdometryLine{{time, 0.0, 0.0}, 0.5, 0.0}});
}

std::vector<double> passed_of(const Log& log) {
  std::vector<double> times;
  for (const Entry& entry : log.entries) times.push_back(to_seconds(entry.passed));
  return times;
}

std::vector<double> sensed_of(const Log& log) {
  std::vector<double> times;
  for (const Entry& entry : log.entries) times.push_back(to_seconds(entry.sensed));
  return times;
}

Log good_log_of(const std::string& text) {
  Result<Log> log = log_of(text);
  INFO((log ? "" : log.error().message));
  REQUIRE(log);
  return *std::move(log);
}

ScanLine three_beams() {
  ScanLine scan;
  scan.angle_start = -0.5;
  scan.angle_increment = 0.5;
  scan.max_range = 8.0;
  scan.ranges = {1.0, 2.5, 8.0};
  scan.X_OL = {1.2, 2.0, 0.3};
  scan.X_OB = {1.0, 2.0, 0.3};
  scan.speed = 0.4;
  scan.turn_rate = -0.1;
  return scan;
}

}  // namespace

TEST_CASE("a line of odometry has a pose, two velocities and its stamp", "[recording][carmen]") {
  const Result<Line> line = read_line("ODOM 1.5 -2 0.25 0.3 -0.1 0 976052857.337311 pippo 12.5");
  REQUIRE(line);
  CHECK(to_seconds(line->stamp) == Approx(976052857.337311).margin(1e-6));
  const auto& odometry = std::get<OdometryLine>(line->content);
  CHECK(odometry.X_OB == Pose2{1.5, -2.0, 0.25});
  CHECK(odometry.speed == 0.3);
  CHECK(odometry.turn_rate == -0.1);
}

TEST_CASE("a scan without angles looks to both sides by 90 degrees, by its number of readings",
          "[recording][carmen]") {
  const auto [count, start, increment] = GENERATE(table<int, double, double>(
      {{180, -90.0, 1.0}, {181, -90.0, 1.0}, {361, -90.0, 0.5}, {401, -100.0, 0.5}, {91, -90.0, 2.0}}));
  std::string text = "FLASER " + std::to_string(count);
  for (int i = 0; i < count; ++i) text += " 2.5";
  const auto scan = content_of<ScanLine>(text + " 1 2 0.5 1 2 0.5 3.0 host 3.0");
  CHECK(scan.ranges == std::vector<double>(static_cast<std::size_t>(count), 2.5));
  CHECK(scan.angle_start == Approx(start * kDegree));
  CHECK(scan.angle_increment == Approx(increment * kDegree));
  CHECK_FALSE(scan.max_range);
  CHECK(scan.X_OB == Pose2{1.0, 2.0, 0.5});
}

TEST_CASE("a scan of a newer log says its angles and its largest range", "[recording][carmen]") {
  const auto scan = content_of<ScanLine>(
      "ROBOTLASER2 0 -0.5 1.0 0.5 8.0 0.01 0 3 1.0 2.5 8.0 2 17 18 1.2 2 0.3 1 2 0.3 0.4 -0.1 0.6 0.3 1e6 "
      "12.5 host 12.5");
  CHECK(scan.laser == Laser::rear);
  CHECK(scan.angle_start == -0.5);
  CHECK(scan.angle_increment == 0.5);
  CHECK(scan.max_range == 8.0);
  CHECK(scan.ranges == std::vector<double>{1.0, 2.5, 8.0});
  CHECK(scan.X_OL == Pose2{1.2, 2.0, 0.3});
  CHECK(scan.X_OB == Pose2{1.0, 2.0, 0.3});
  CHECK(scan.speed == 0.4);
}

TEST_CASE("parameters, comments, empty lines and lines of other kinds are told apart",
          "[recording][carmen]") {
  CHECK(content_of<ParamLine>("PARAM robot_use_laser on nohost 0").value == "on");
  CHECK(content_of<ParamLine>("PARAM robot_name big red nohost 0").value == "big red");
  CHECK(content_of<OtherLine>("NEFF 14.5").kind == "NEFF");
  content_of<NoLine>("# ODOM x y theta");
  content_of<NoLine>("  ");
  CHECK_THAT(fault_of("\x1f\x8b\x08 binary"), Contains("which is no kind of line"));
}

TEST_CASE("a line that is cut anywhere is damaged, and says what is missing", "[recording][carmen]") {
  for (const std::string& whole : {odometry_at(3.0), to_text({3s, three_beams()}),
                                   std::string("FLASER 2 1 2 0 0 0 0 0 0 3.25 host 3.25")}) {
    REQUIRE(read_line(whole));
    const std::size_t last_word = whole.find_last_of(' ');
    for (std::size_t size = whole.find(' '); size <= last_word; ++size) {
      INFO(whole.substr(0, size));
      CHECK_THAT(fault_of(whole.substr(0, size)), Contains("it ends before its") || Contains("cannot be"));
    }
  }
}

TEST_CASE("numbers that are none, or that cannot be, make a line damaged", "[recording][carmen]") {
  CHECK_THAT(fault_of("ODOM 1,5 0 0 0 0 0 3 h 3"), Contains("its pose cannot be \"1,5\""));
  CHECK_THAT(fault_of("ODOM nan 0 0 0 0 0 3 h 3"), Contains("its pose cannot be so large"));
  CHECK_THAT(fault_of("ODOM 1e300 0 0 0 0 0 3 h 3"), Contains("its pose cannot be so large"));
  CHECK_THAT(fault_of("ODOM 0 0 0 0 0 0 -3 h 3"), Contains("its stamp is negative"));
  CHECK_THAT(fault_of("ODOM 0 0 0 0 0 0 1e30 h 3"), Contains("its stamp cannot be so large"));
  CHECK_THAT(fault_of("ODOM 0 0 0 0 0 0 3 h 3 4"), Contains("there is more behind its end"));
  CHECK_THAT(fault_of("FLASER 99999999999 1 2"), Contains("its number of readings cannot be"));
  CHECK_THAT(fault_of("FLASER -1 0 0 0 0 0 0 3 h 3"), Contains("its number of readings cannot be"));
  CHECK_THAT(fault_of("FLASER 1 -2.5 0 0 0 0 0 0 3 h 3"), Contains("a reading is negative"));
}

TEST_CASE("readings that are no numbers stay so", "[recording][carmen]") {
  const auto scan = content_of<ScanLine>("FLASER 2 nan inf 0 0 0 0 0 0 3 h 3");
  CHECK(std::isnan(scan.ranges[0]));
  CHECK(std::isinf(scan.ranges[1]));
}

TEST_CASE("what is written is read as it was, to the digits that are written", "[recording][carmen]") {
  ScanLine scan = three_beams();
  for (const bool usual : {false, true}) {
    if (usual) {
      scan.angle_start = -90.0 * kDegree;
      scan.angle_increment = 90.0 * kDegree;
    }
    const std::string text = to_text({12500000us, scan});
    CHECK_THAT(text, Catch::StartsWith(usual ? "FLASER 3 " : "ROBOTLASER1 0 "));
    const auto again = content_of<ScanLine>(text);
    CHECK(again.ranges == scan.ranges);
    CHECK(again.angle_start == Approx(scan.angle_start).margin(1e-6));
    CHECK(again.angle_increment == Approx(scan.angle_increment).margin(1e-6));
    CHECK(again.X_OL == scan.X_OL);
    CHECK(again.X_OB == scan.X_OB);
    CHECK(to_text({12500000us, again}) == text);
  }
}

TEST_CASE("a log is read line by line, however its bytes come", "[recording][carmen]") {
  const std::string text =
      "# a log\nPARAM robot_frontlaser_offset 0.2 nohost 0\nODOM 0 0 0 0 0 0 1 h 1\r\nNEFF "
      "3\nFLASER 2 1 2 0 0 0 0 0 0 1.5 h 1.5";
  for (const std::size_t piece : {1U, 7U, 1000U}) {
    const Result<Log> log = log_of(text, piece);
    REQUIRE(log);
    CHECK(log->entries.size() == 2);
    CHECK(log->entries[1].line == 5);
    CHECK(passed_of(*log) == std::vector<double>{1.0, 1.5});
    CHECK(log->others == std::map<std::string, std::size_t>{{"NEFF", 1}});
    CHECK(log->flaws.texts().empty());
    CHECK(mount_of(*log, Laser::front) == Pose2{0.2, 0.0, 0.0});
  }
}

TEST_CASE("damaged lines are left out and counted, with the first of them", "[recording][carmen]") {
  const Log log = good_log_of(odometry_at(1.0) + "ODOM 3 4\nODxM 1 2 3\n" + odometry_at(2.0));
  CHECK(log.entries.size() == 2);
  CHECK(log.flaws.damaged.count == 2);
  CHECK(log.flaws.texts() ==
        std::vector<std::string>{
            "2 damaged lines are left out, the first in line 2: a line ODOM: it ends before its pose"});
}

TEST_CASE("stamps that run backwards stay as they are, and pass with what came before",
          "[recording][carmen]") {
  const Log log = good_log_of(odometry_at(1.0) + odometry_at(2.0) + odometry_at(1.9) + odometry_at(2.5));
  CHECK(sensed_of(log) == std::vector<double>{1.0, 2.0, 1.9, 2.5});
  CHECK(passed_of(log) == std::vector<double>{1.0, 2.0, 2.0, 2.5});
  CHECK(log.flaws.back.count == 1);
  CHECK(log.flaws.texts() ==
        std::vector<std::string>{"1 stamp runs backwards, the first in line 3: by 0.1 s"});
}

TEST_CASE("a scan that began before the last odometry is as it should be", "[recording][carmen]") {
  const Log log =
      good_log_of(odometry_at(1.0) + odometry_at(2.0) + to_text({1950ms, three_beams()}) + odometry_at(3.0));
  CHECK(sensed_of(log) == std::vector<double>{1.0, 2.0, 1.95, 3.0});
  CHECK(passed_of(log) == std::vector<double>{1.0, 2.0, 2.0, 3.0});
  CHECK(log.flaws.texts().empty());
}

TEST_CASE("a line whose stamp is 0, or alone far off, has the time of the line before",
          "[recording][carmen]") {
  const double wrong = GENERATE(0.0, 1.13, 34.0, 9000.0);
  const Log log = good_log_of(odometry_at(30.0) + odometry_at(wrong) + odometry_at(31.0));
  CHECK(sensed_of(log) == std::vector<double>{30.0, 30.0, 31.0});
  CHECK(log.flaws.texts().size() == 1);
  CHECK(log.flaws.wrong.count == 1);
  CHECK(log.flaws.wrong.first_line == 2);
}

TEST_CASE("where all stamps are 0 the times of logging count, and a log in which no time passes says so",
          "[recording][carmen]") {
  const auto line = [](double stamp, double logged) {
    return "ODOM 1 0 0 0.5 0 0 " + std::to_string(stamp) + " host " + std::to_string(logged) + "\n";
  };
  const Log logged = good_log_of(line(0, 3) + line(0, 4) + line(0, 5));
  CHECK(sensed_of(logged) == std::vector<double>{3.0, 4.0, 5.0});
  REQUIRE(logged.flaws.texts().size() == 1);
  CHECK_THAT(logged.flaws.texts()[0],
             Contains("all stamps are 0, so each line has the time at which it was logged"));
  for (const double stamp : {0.0, 7.0}) {
    const Log standing = good_log_of(line(stamp, 0) + line(stamp, 0) + line(stamp, 0));
    REQUIRE(standing.flaws.texts().size() == 1);
    CHECK_THAT(standing.flaws.texts()[0], Contains("all 3 lines have the same stamp"));
  }
  CHECK(good_log_of(line(7, 1) + line(7, 2)).flaws.texts().empty());
}

TEST_CASE("when the clock of a log is set, time goes on without the jump, and it is reported",
          "[recording][carmen]") {
  const double jump = GENERATE(-3600.0, -5.0, 86400.0);
  std::string text;
  for (int i = 0; i < 10; ++i) text += odometry_at(10000.0 + 0.5 * i + (i >= 5 ? jump : 0.0));
  const Log log = good_log_of(text);
  CHECK(log.flaws.clock_jumps.count == 1);
  CHECK(log.flaws.clock_jumps.first_line == 6);
  CHECK(passed_of(log)[5] == passed_of(log)[4]);
  CHECK(passed_of(log).back() - passed_of(log).front() == Approx(4.0));
  CHECK(sensed_of(log) == passed_of(log));
}

TEST_CASE("a pause of ten times the usual interval is a gap, of odometry and of scans alike",
          "[recording][carmen]") {
  std::string text;
  for (int i = 0; i < 20; ++i) text += odometry_at(0.2 * i + (i >= 10 ? 5.0 : 0.0));
  const Log log = good_log_of(text);
  CHECK(log.flaws.texts() == std::vector<std::string>{"1 gap, the first in line 11: of 5.2 s"});
}

TEST_CASE("a log without odometry and scans is refused", "[recording][carmen]") {
  for (const std::string text : {"", "# nothing\n", "NEFF 3\n", "\x1f\x8b\x08 binary\n"}) {
    const Result<Log> log = log_of(text);
    REQUIRE_FALSE(log);
    CHECK_THAT(log.error().message, Contains("there is no line ODOM, FLASER"));
  }
}

TEST_CASE("a log that takes more memory than it may is refused, with the line, before it is read",
          "[recording][carmen]") {
  std::string readings;
  for (int i = 0; i < 1000; ++i) readings += "0 ";
  const auto [line, least, most] = GENERATE_COPY(table<std::string, std::size_t, std::size_t>({
      {"FLASER 1000 " + readings + "0 0 0 0 0 0 1 h 1\n", 8000, 9000},
      {"PARAM " + readings + "h 0\n", 2000, 2500},
      {odometry_at(1.0), sizeof(Entry), 500},
      {"NEFF 3\n", sizeof(Entry), 500},
  }));
  INFO(line.substr(0, 20));
  std::size_t lines = 0;
  const auto endless = [&]() -> std::string_view { return ++lines, line; };
  constexpr std::size_t kRoom = 100000;
  const Result<Log> log = read_log(endless, kRoom);
  REQUIRE_FALSE(log);
  CHECK(log.error().code == Code::invalid_argument);
  CHECK_THAT(log.error().message, Contains("it is too large from line " + std::to_string(lines)) &&
                                      Contains("cut it into pieces"));
  CHECK(lines * most > kRoom);
  CHECK((lines - 1) * least <= kRoom);
}

TEST_CASE("a table of scans is read by the names of its columns", "[recording][carmen]") {
  const std::string head = "# t odom_x odom_y odom_theta ref_x ref_y ref_theta r0..rN-1 ; SI units\n";
  std::string text = head;
  for (int i = 0; i < 4; ++i) text += std::to_string(i) + " 1 2 0.5 9 9 9 1.0 2.0 3.0\n";
  const Log log = good_log_of(text + "4 1 2 0.5 9 9 9 1.0 2.0\n5 1 2 x 9 9 9 1 2 3\n");
  REQUIRE(log.entries.size() == 4);
  const auto& scan = std::get<ScanLine>(log.entries[3].what.content);
  CHECK(log.entries[3].passed == 3s);
  CHECK(scan.X_OB == Pose2{1.0, 2.0, 0.5});
  CHECK(scan.ranges == std::vector<double>{1.0, 2.0, 3.0});
  CHECK(log.flaws.damaged.count == 2);  // a row that is cut, and one with a word for a number
  CHECK_FALSE(ScanTable::begins_with("# t odom_x odom_y r0..rN-1"));
  CHECK_FALSE(ScanTable::begins_with("# a log"));
}

TEST_CASE("the largest range of a laser is what its log says, or what comes again and again",
          "[recording][carmen]") {
  const auto log_with = [](const std::string& more, const std::string& readings) {
    return good_log_of(more + "FLASER 4 " + readings + " 0 0 0 0 0 0 1 h 1\n");
  };
  CHECK(max_range_of(log_with("", "3 81.83 2 81.83"), Laser::front) == 81.83);
  CHECK(max_range_of(log_with("", "3 7.5 2 inf"), Laser::front) == Approx(7.6));
  CHECK(max_range_of(log_with("PARAM robot_front_laser_max 50.0 nohost 0\n", "3 4 2 4"), Laser::front) ==
        50.0);
  CHECK(max_range_of(good_log_of(to_text({1s, three_beams()})), Laser::front) == 8.0);
}

TEST_CASE("where a laser is on its robot follows from its lines, unless these are corrected poses",
          "[recording][carmen]") {
  std::string text = to_text({1s, three_beams()});
  const Pose2 mount = mount_of(good_log_of(text), Laser::front);
  CHECK(mount.x == Approx(0.2 * std::cos(0.3)));
  CHECK(mount.y == Approx(-0.2 * std::sin(0.3)));
  ScanLine corrected = three_beams();
  corrected.X_OL = {5.0, 5.0, 1.0};
  CHECK(mount_of(good_log_of(text + to_text({2s, corrected})), Laser::front) == Pose2{});
}

TEST_CASE("files are read packed or not, and one that ends early says so", "[recording][carmen]") {
  const TempFolder folder;
  std::string text;
  for (int i = 0; i < 2000; ++i)
    text += to_text({from_seconds(0.137 * i), OdometryLine{{std::sin(i), std::cos(7.0 * i), 0.1}}});
  const std::string plain = folder.write("plain.log", text);
  const std::string packed = folder.file("packed.log.gz");
  const gzFile out = gzopen(packed.c_str(), "wb");
  REQUIRE(gzwrite(out, text.data(), static_cast<unsigned>(text.size())) == static_cast<int>(text.size()));
  gzclose(out);
  for (const std::string& path : {plain, packed}) {
    const Result<Log> log = read_log_file(path);
    REQUIRE(log);
    CHECK(log->entries.size() == 2000);
    CHECK(log->flaws.texts().empty());
  }
  const std::string bytes = read_text(packed);
  const Result<Log> cut = read_log_file(folder.write("cut.log.gz", bytes.substr(0, bytes.size() / 2)));
  REQUIRE(cut);
  CHECK(cut->entries.size() > 500);
  CHECK(cut->entries.size() < 2000);
  CHECK_THAT(cut->flaws.texts().back(), Contains("the file ends early: "));
  CHECK_THAT(read_log_file(folder.file("none")).error().message, Contains("No such file"));
  CHECK_THAT(read_log_file(folder.path().string()).error().message, Contains("no regular file"));
  REQUIRE(mkfifo(folder.file("pipe").c_str(), 0600) == 0);
  CHECK_THAT(read_log_file(folder.file("pipe")).error().message, Contains("no regular file"));
}
