// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of SICK lasers with the laser's emulation at the other end of a line in memory, in virtual time; two cases at the end have a
// pseudo terminal and real time.
#include <catch2/catch.hpp>

#include <cmath>
#include <csignal>
#include <limits>
#include <numbers>
#include <string>

#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/emulators/sick_lms_firmware.hpp"
#include "record_table.hpp"
#include "temp_folder.hpp"
#include "virtual_desk.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::SickLmsFirmware;
using emulators::SickLmsSettings;
using hw::link::Fault;

namespace {

using Laser = VirtualDevice<SickLmsFirmware, MirrorOnDesk>;
using LaserInRealTime = DeviceOnDesk<SickLmsFirmware, MirrorOnDesk>;

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

SickLmsSettings at_once() {
  SickLmsSettings settings;
  settings.power_up = 0s;
  return settings;
}

// A range of its own for each quarter of a degree over 180 degrees, and no echo at the very left.
std::vector<double> ranges_of_place() {
  std::vector<double> ranges;
  for (int i = 0; i <= 720; ++i) ranges.push_back(1.0 + 0.00737 * i);
  ranges.back() = kInfinity;
  return ranges;
}

template <class AnyLaser>
void show_place(AnyLaser& laser) {
  laser.with([](SickLmsFirmware&, MirrorOnDesk& mirror) {
    mirror.show(-90.0 * kDegree, 0.25 * kDegree, ranges_of_place());
  });
}

Words listen(const std::string& device, const Words& more = {}) {
  return Words{system_graph("sick_lms.xml"), "--set", "device=" + device} + more;
}

// The words for the laser in memory.
Words in_memory(const Words& more = {}) { return listen("memory:lms", more); }

Words recorded(const TempFolder& folder, const Words& more = {}) {
  return Words{"--record", folder.file("scans.csv") + "=laser.LaserRangeReadingsPush"} + more;
}

// The recorded scans.
struct Scans {
  explicit Scans(const TempFolder& folder)
      : rows(RecordTable(folder.file("scans.csv")).rows("laser.LaserRangeReadingsPush")) {}
  [[nodiscard]] double value(std::size_t row, const std::string& name) const {
    return number(rows.at(row), name);
  }
  std::vector<RecordTable::Row> rows;
};

// Checks that each beam of the row shows what the mirror shows in its direction.
void check_ranges(const Scans& scans, std::size_t row, double angle, double resolution, double unit) {
  const std::vector<double> shown = ranges_of_place();
  const auto beams = static_cast<std::size_t>(std::lround(angle / resolution)) + 1;
  const std::vector<double> got = numbers(scans.rows.at(row), "ranges");
  REQUIRE(got.size() == beams);
  CHECK(scans.value(row, "angle_start") == Approx(-0.5 * angle * kDegree));
  CHECK(scans.value(row, "angle_increment") == Approx(resolution * kDegree));
  for (std::size_t i = 0; i < beams; ++i) {
    const double degrees = static_cast<double>(i) * resolution - 0.5 * angle;
    const double range = shown[static_cast<std::size_t>(std::lround((degrees + 90.0) / 0.25))];
    INFO("beam " << i);
    if (std::isfinite(range))
      CHECK(std::abs(got[i] - range) <= 0.501 * unit);
    else
      CHECK(got[i] >= scans.value(row, "max_range"));
  }
}

template <class AnyLaser>
bool sends(AnyLaser& laser) {
  return laser.with([](SickLmsFirmware& firmware, MirrorOnDesk&) { return firmware.sends_scans(); });
}

template <class AnyLaser>
int scans_sent(AnyLaser& laser) {
  return laser.with([](SickLmsFirmware& firmware, MirrorOnDesk&) { return firmware.scans(); });
}

std::uint32_t baud_of(Laser& laser) {
  return laser.with([](SickLmsFirmware& firmware, MirrorOnDesk&) { return firmware.baud(); });
}

}  // namespace

TEST_CASE("a scan's time is that of its measurement, whatever the line takes", "[system][hardware]") {
  const TempFolder folder;
  Laser laser("lms", at_once());
  show_place(laser);
  const Run run = run_virtual(in_memory(recorded(folder, {"--until", "8 s", "--set", "rate=9600"})));
  INFO(run.err);
  const Scans scans(folder);
  REQUIRE(scans.rows.size() >= 2);
  // 361 values need 0.76 s of the line and 2/75 s of the mirror.
  const double age = scans.value(1, "creation_time") - scans.value(1, "stamp");
  CHECK(age > 0.7625 + 0.0266);
}

TEST_CASE("each angle and resolution that an LMS has is set, and the ranges are those of its beams",
          "[system][hardware]") {
  struct Case {
    double angle, resolution;
    const char* unit;
    double metres;
  };
  const auto [angle, resolution, unit, metres] =
      GENERATE(Case{180, 1, "mm", 0.001}, Case{180, 0.5, "cm", 0.01}, Case{100, 1, "cm", 0.01},
               Case{100, 0.5, "mm", 0.001}, Case{100, 0.25, "mm", 0.001});
  const TempFolder folder;
  Laser laser("lms", at_once());
  show_place(laser);
  std::ostringstream angle_text, resolution_text;
  angle_text << "angle=" << angle << " deg";
  resolution_text << "resolution=" << resolution << " deg";
  const Run run =
      run_virtual(in_memory(recorded(folder, {"--until", "5 s", "--set", angle_text.str(), "--set",
                                              resolution_text.str(), "--set", std::string("unit=") + unit})));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const Scans scans(folder);
  REQUIRE(scans.rows.size() > 5);
  check_ranges(scans, scans.rows.size() - 1, angle, resolution, metres);
}

TEST_CASE("an angle and a resolution that no LMS has are refused before anything is opened",
          "[system][hardware]") {
  const Run run = run_deployer(listen("/dev/null", {"--set", "resolution=0.25 deg", "--check"}));
  CHECK(run.exit_code() == 2);
  CHECK(run.says("an LMS has no beams 0.25 deg apart over 180 deg"));
  const Run rate = run_deployer(listen("/dev/null", {"--set", "rate=115200", "--check"}));
  CHECK(rate.exit_code() == 2);
  CHECK(rate.says("a laser has no rate of 115200 baud"));
}

TEST_CASE("the laser is found at each of its rates, and set to the wished one", "[system][hardware]") {
  const auto found = GENERATE(9600U, 19200U, 38400U, 500000U);
  const auto [wish, rate] = GENERATE(std::pair{"rate=38400", 38400U}, std::pair{"rate=0", 500000U});
  SickLmsSettings settings = at_once();
  settings.baud = found;
  Laser laser("lms", settings);
  show_place(laser);
  (void)run_virtual(in_memory({"--set", wish}), [&, set = rate] {
    CHECK(bench().until_log("at " + std::to_string(set) + " baud"));
    CHECK(bench().until([&] { return scans_sent(laser) > 3; }));
    CHECK(baud_of(laser) == set);
  });
}

TEST_CASE("the configuration is written only if the unit differs, since that wears the laser's memory",
          "[system][hardware]") {
  const TempFolder folder;
  Laser laser("lms", at_once());
  show_place(laser);
  const auto writes = [&] {
    return laser.with([](SickLmsFirmware& firmware, MirrorOnDesk&) { return firmware.writes(); });
  };
  for (int run = 0; run < 2; ++run) {
    CHECK(run_virtual(in_memory({"--until", "4 s"})).exit_code() == 0);
    CHECK(writes() == 1);  // it had cm
  }
}

TEST_CASE("without a laser on the line nothing starts, and what to look at is said", "[system][hardware]") {
  const TempFolder folder;
  Laser laser("lms", at_once());
  laser.fall_silent(true);
  const Run run = run_virtual(in_memory());
  CHECK(run.exit_code() == 3);
  CHECK_THAT(
      run.err,
      Contains("no laser answers at memory:lms at 38400, 9600, 19200, 500000 baud; is it switched on"));
}

TEST_CASE("a line that sends back what it is sent is not taken for a laser", "[system][hardware]") {
  const TempFolder folder;
  SickLmsSettings settings;
  settings.power_up = 1h;
  Laser laser("lms", settings);
  laser.echo(true);
  const Run run = run_virtual(in_memory());
  CHECK(run.exit_code() == 3);
  CHECK(run.says("sends back what it is sent, and no laser answers"));
}

TEST_CASE("a laser that is unplugged while it scans is found first at the rate that it had",
          "[system][hardware]") {
  Laser laser("lms", at_once());
  show_place(laser);
  const Run run = run_virtual(in_memory(), [&] {
    REQUIRE(bench().until([&] { return scans_sent(laser) > 3; }));
    laser.unplug();
    REQUIRE(bench().until_log("the other end of the line is closed"));
    const TimePoint plugged_in = bench().now();
    laser.plug_in();
    REQUIRE(bench().until_log("it works again", 30s));
    CHECK(bench().now() - plugged_in < 7s);  // all the other rates would take longer
    const int before = scans_sent(laser);
    CHECK(bench().until([&] { return scans_sent(laser) > before + 3; }));
  });
  CHECK(run.exit_code() == 0);
  CHECK_FALSE(sends(laser));
}

TEST_CASE("a byte log of a laser whose rate was changed is played back", "[system][hardware]") {
  const TempFolder folder;
  const std::string log = folder.file("bytes");
  {
    Laser laser("lms", at_once());
    show_place(laser);
    const Run run = run_virtual(in_memory({"--until", "6 s", "--set", "lms.byte_log=" + log}));
    INFO(run.err);
    CHECK(run.says("at 500000 baud"));
  }
  const Run run =
      run_deployer(listen("replay:" + log, recorded(folder, {"--until", "5 s"})) + virtual_clock());
  INFO(run.err);
  CHECK(run.says("connected to \"LMS200;30106;V02.30\" at 500000 baud"));
  const Scans scans(folder);
  REQUIRE(scans.rows.size() > 5);
  check_ranges(scans, scans.rows.size() - 1, 180.0, 0.5, 0.001);
}

TEST_CASE("a laser whose power was interrupted while it scans is found again and set again",
          "[system][hardware]") {
  Laser laser("lms", at_once());
  show_place(laser);
  (void)run_virtual(in_memory(), [&] {
    REQUIRE(bench().until([&] { return scans_sent(laser) > 3; }));
    laser.with([&](SickLmsFirmware& firmware, MirrorOnDesk&) { firmware.reset(laser.now()); });
    CHECK_FALSE(sends(laser));
    REQUIRE(bench().until_log("is it still connected and switched on?"));
    REQUIRE(bench().until_log("it works again", 30s));
    CHECK(bench().until([&] { return sends(laser); }));
    CHECK(baud_of(laser) == 500000);
  });
}

TEST_CASE("a laser that still sends scans from an earlier run is stopped first, set and started",
          "[system][hardware]") {
  const TempFolder folder;
  Laser laser("lms", at_once());
  show_place(laser);
  (void)run_virtual(in_memory(), [&] {
    REQUIRE(bench().until([&] { return scans_sent(laser) > 3; }));
    laser.unplug();  // so it is never told to stop
  });
  laser.plug_in();
  CHECK(sends(laser));
  const Run run = run_virtual(
      in_memory(recorded(folder, {"--until", "5 s", "--set", "resolution=1 deg", "--set", "rate=38400"})));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const Scans scans(folder);
  REQUIRE(scans.rows.size() > 5);
  check_ranges(scans, scans.rows.size() - 1, 180.0, 1.0, 0.001);
}

TEST_CASE("a laser that refuses the password says so", "[system][hardware]") {
  const TempFolder folder;
  SickLmsSettings settings = at_once();
  settings.password = "OTHER_PW";
  Laser laser("lms", settings);
  const Run run = run_virtual(in_memory());
  CHECK(run.exit_code() == 3);
  CHECK(run.says("does not accept the password SICK_LMS"));
}

TEST_CASE("a laser that refuses a rate works at the next slower one", "[system][hardware]") {
  SickLmsSettings settings = at_once();
  settings.rates = {9600, 19200, 38400};
  Laser laser("lms", settings);
  show_place(laser);
  (void)run_virtual(in_memory(), [&] {
    CHECK(bench().until_log("the line does not have 500000 baud: the laser refuses it"));
    CHECK(bench().until([&] { return scans_sent(laser) > 3; }));
    CHECK(baud_of(laser) == 38400);
  });
}

TEST_CASE("a dirty window is reported once, and once again when it is clean", "[system][hardware]") {
  Laser laser("lms", at_once());
  show_place(laser);
  const std::string dirty = "its window is dirty, clean it";
  const Run run = run_virtual(in_memory(), [&] {
    REQUIRE(bench().until([&] { return scans_sent(laser) > 3; }));
    laser.with([](SickLmsFirmware& firmware, MirrorOnDesk&) { firmware.set_status(0x90); });
    REQUIRE(bench().until_log(dirty));
    const int before = scans_sent(laser);
    REQUIRE(bench().until([&] { return scans_sent(laser) > before + 10; }));
    laser.with([](SickLmsFirmware& firmware, MirrorOnDesk&) { firmware.set_status(0x10); });
    CHECK(bench().until_log("the laser's status is good again"));
  });
  CHECK(run.err.find(dirty) == run.err.rfind(dirty));
}

TEST_CASE("with garbage between and inside its telegrams good scans still arrive, and no wrong one",
          "[system][hardware]") {
  const TempFolder folder;
  hw::link::FaultPlan plan;
  // A scan of 181 beams has 372 bytes: about one of four is damaged.
  plan.out = {.drop = 0.0002, .flip = 0.0002, .insert = 0.0002, .duplicate = 0.0002};
  plan.modes.byte_by_byte = true;
  Laser laser(DeskLine("lms", plan), at_once());
  show_place(laser);
  const Run run = run_virtual(
      in_memory(recorded(folder, {"--until", "12 s", "--set", "resolution=1 deg", "--set", "rate=38400"})));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(laser.faults(Fault::flip) + laser.faults(Fault::drop) > 0);
  const Scans scans(folder);
  REQUIRE(scans.rows.size() > 20);
  for (std::size_t row = 0; row < scans.rows.size(); ++row) check_ranges(scans, row, 180.0, 1.0, 0.001);
}

TEST_CASE("when every telegram is damaged nothing starts, and the rates that were tried are said",
          "[system][hardware]") {
  const TempFolder folder;
  hw::link::FaultPlan plan;
  plan.out.flip = 1.0;
  Laser laser(DeskLine("lms", plan), at_once());
  const Run run = run_virtual(in_memory());
  CHECK(run.exit_code() == 3);
  CHECK(run.says("no laser answers at"));
}

TEST_CASE("an adapter that echoes what is sent does not disturb", "[system][hardware]") {
  const TempFolder folder;
  Laser laser("lms", at_once());
  show_place(laser);
  laser.echo(true);
  const Run run = run_virtual(in_memory(recorded(folder, {"--until", "6 s"})));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  const Scans scans(folder);
  REQUIRE(scans.rows.size() > 5);
  check_ranges(scans, scans.rows.size() - 1, 180.0, 0.5, 0.001);
}

TEST_CASE("scans arrive with the ranges that the mirror had, at the fastest rate, and stop at the end",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lms");
  LaserInRealTime laser(device, at_once());
  show_place(laser);
  const Run run = run_deployer(listen(device, recorded(folder, {"--until", "6 s"})), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.says("connected to \"LMS200;30106;V02.30\" at 500000 baud"));
  const Scans scans(folder);
  REQUIRE(scans.rows.size() > 20);
  check_ranges(scans, scans.rows.size() - 1, 180.0, 0.5, 0.001);
  CHECK(scans.value(1, "pose.x") == 0.1);
  CHECK(scans.value(1, "pose.y") == -0.02);
  CHECK(scans.value(1, "pose.z") == 0.3);
  CHECK(scans.value(1, "pose.rotation.yaw") == Approx(90.0 * kDegree));
  CHECK(scans.value(1, "max_range") == 32.0);
  CHECK(eventually([&] { return !sends(laser); }));  // the stop may still be on the line
}

TEST_CASE("a laser that is unplugged while it scans comes back", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("lms");
  LaserInRealTime laser(device, at_once());
  show_place(laser);
  Subprocess program(deployer(listen(device)));
  REQUIRE(eventually([&] { return scans_sent(laser) > 3; }));
  laser.unplug();
  CHECK(program.wait_for_output("the device has gone: was it unplugged or switched off?",
                                Seconds(20 * kSlowdown)));
  const TimePoint plugged_in = steady_now();
  laser.plug_in();
  const bool back = program.wait_for_output("it works again", Seconds(30));
  INFO(program.err());
  REQUIRE(back);
  // It is looked for at the rate of before first; all the others would take longer.
  CHECK(steady_now() - plugged_in < 7s * static_cast<int>(kSlowdown));
  const int before = scans_sent(laser);
  CHECK(eventually([&] { return scans_sent(laser) > before + 3; }));
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
  CHECK_FALSE(sends(laser));
}
