// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of Nomad XR4000s with robot and agent emulated at the other end of a line in memory, in virtual time; two cases at the end
// have a pseudo terminal and real time.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <string>

#include "base_on_desk.hpp"
#include "orca/emulators/xr4000_firmware.hpp"
#include "orca/text/object_xml.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::Xr4000Firmware;
using emulators::Xr4000Settings;

namespace {

using Nomad = VirtualBase<Xr4000Firmware>;
using NomadInRealTime = BaseOn<DeviceOnDesk, Xr4000Firmware>;

constexpr int kSetAxes = 3;
constexpr int kResetMotionTimer = 4;
constexpr std::uint8_t kEmergencyStop = 1;
constexpr std::uint8_t kJoystick = 2;
constexpr std::uint8_t kMotionError = 4;

Run run(const Words& more = {}, const std::function<void()>& script = {}) {
  return run_virtual(on_line("xr4000.xml", "memory:nomad", more), script);
}

template <class AnyNomad>
int limp_stops(AnyNomad& nomad) {
  return nomad.ask(&Xr4000Firmware::limp_stops);
}
Duration timeout(Nomad& nomad) { return nomad.ask(&Xr4000Firmware::timeout); }
std::vector<int> requests(Nomad& nomad) { return nomad.ask(&Xr4000Firmware::requests); }
void set_status(Nomad& nomad, std::uint8_t bits) {
  nomad.look([&](Xr4000Firmware& robot) { robot.set_status(bits); });
}

// The robot stands for a second, whatever Goto wishes.
void check_goes_on_standing(Nomad& nomad) {
  const Pose2 there = nomad.pose();
  bench().sleep(1s);
  CHECK(nomad.pose() == there);
}

void check_goes_on_when_let_go(Nomad& nomad) {
  CHECK(bench().seat().let_go());
  CHECK(bench().until([&] { return nomad.moves(); }));
}

}  // namespace

TEST_CASE("an XR4000's axes are told nothing before it drives, and go limp at the end",
          "[system][hardware]") {
  Nomad nomad("nomad");
  nomad.check_at_goal(run());
  CHECK(timeout(nomad) == 500ms);
  const std::vector<int> all = requests(nomad);
  CHECK(std::ranges::find(all, kResetMotionTimer) < std::ranges::find(all, kSetAxes));
}

TEST_CASE("an XR4000 that nobody lets drive is asked and told nothing else", "[system][hardware]") {
  Nomad nomad("nomad");
  (void)run({"--fail", "goto=silent@0s", "--until", "3 s"});
  const std::vector<int> all = requests(nomad);
  CHECK(all.size() > 50);
  CHECK(std::ranges::count(all, kSetAxes) == 0);
  CHECK(std::ranges::count(all, kResetMotionTimer) == 0);
}

TEST_CASE("an XR4000 drives sideways as long as it is told so", "[system][hardware]") {
  const TempFolder folder;
  Nomad nomad("nomad");
  const std::string graph = folder.write("base.xml", R"(<graph name="base" version="1">
<hardware name="nomad" type="orca.hw.Xr4000"><param name="device" value="memory:nomad"/></hardware>
<component name="base" type="orca.RobotBaseServer" hardware="nomad"/>
<connect from="test_operator.velocity" to="base.HolonomicVelocitySend"/></graph>)");
  (void)run_virtual({graph}, [&] {
    REQUIRE(bench().until_log("connected to the agent of an XR4000"));
    idl::HolonomicVelocity sideways;
    sideways.left(0.3);
    REQUIRE(bench().until([&] { return bench().send(sideways).ok() && nomad.pose().y > 0.05; }));
    CHECK(bench().until_log("no motion command for 200 ms"));
    REQUIRE(bench().until([&] { return nomad.stands(); }));
    CHECK(nomad.pose().x == Approx(0.0).margin(1e-9));
    CHECK(nomad.pose().yaw == Approx(0.0).margin(1e-9));
  });
}

TEST_CASE("without an agent on the line nothing starts, and what to look at is said", "[system][hardware]") {
  Nomad nomad("nomad");
  const bool loops = GENERATE(false, true);
  nomad.fall_silent(!loops);
  if (loops) {
    nomad.echo(true);
    nomad.spoil([](std::vector<std::uint8_t>& sent) { sent.clear(); });
  }
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err, Contains(loops ? "sends back what it is sent, and nothing else"
                                       : "no agent of an XR4000 answers at memory:nomad"));
}

TEST_CASE("an agent of another version or of another robot is refused", "[system][hardware]") {
  Xr4000Settings settings;
  const bool is_other_robot = GENERATE(false, true);
  (is_other_robot ? settings.robot_type : settings.version) = is_other_robot ? 'n' : 2;
  Nomad nomad("nomad", settings);
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  CHECK_THAT(ended.err, Contains(is_other_robot ? "the agent's robot has the type 110"
                                                : "the agent speaks version 2 of the protocol"));
}

TEST_CASE(
    "an XR4000 that is unplugged while it drives goes limp; it comes back and stands until it is let go",
    "[system][hardware]") {
  Nomad nomad("nomad");
  const Run ended = run(far_goal(), [&] {
    nomad.set_off();
    nomad.unplug();
    REQUIRE(bench().until([&] { return nomad.stands(); }, 700ms));
    CHECK(limp_stops(nomad) == 1);
    CHECK(bench().until_log("the other end of the line is closed"));
    nomad.plug_in();
    REQUIRE(bench().until_log("it works again"));
    check_goes_on_standing(nomad);
    CHECK_FALSE(nomad.has_power());
    check_goes_on_when_let_go(nomad);
  });
  CHECK(ended.exit_code() == 0);
}

TEST_CASE(
    "an XR4000 whose emergency stop is pressed, or that is taken by its joystick, stands until it is let go",
    "[system][hardware]") {
  const std::uint8_t status = GENERATE(kEmergencyStop, kJoystick);
  Nomad nomad("nomad");
  (void)run(far_goal(), [&] {
    nomad.set_off();
    set_status(nomad, status);
    CHECK(bench().until_log(
        status == kEmergencyStop
            ? "its emergency stop is pressed; release it, then orcactl estop --release"
            : "somebody drives it with the joystick; let go of that, then orcactl estop --release"));
    set_status(nomad, 0);
    bench().sleep(100ms);
    check_goes_on_standing(nomad);
    CHECK_FALSE(nomad.has_power());
    check_goes_on_when_let_go(nomad);
  });
}

TEST_CASE("an XR4000 with a motion error has failed until it is gone", "[system][hardware]") {
  Nomad nomad("nomad");
  (void)run(far_goal(), [&] {
    nomad.set_off();
    set_status(nomad, kMotionError);
    CHECK(bench().until_log("its axes report a motion error; is a wheel blocked"));
    check_goes_on_standing(nomad);
    set_status(nomad, 0);
    REQUIRE(bench().until_log("it works again"));
    check_goes_on_standing(nomad);
    check_goes_on_when_let_go(nomad);
  });
}

TEST_CASE("an XR4000 whose library fails has failed, and the return code is said", "[system][hardware]") {
  Nomad nomad("nomad");
  (void)run(far_goal(), [&] {
    nomad.set_off();
    nomad.look([](Xr4000Firmware& robot) { robot.fail_with(-6); });
    CHECK(bench().until_log("the robot's library has returned -6 (connection failed)"));
    CHECK(bench().until([&] { return nomad.stands(); }));
    nomad.look([](Xr4000Firmware& robot) { robot.fail_with(0); });
    REQUIRE(bench().until_log("it works again"));
    check_goes_on_standing(nomad);
    check_goes_on_when_let_go(nomad);
  });
}

TEST_CASE(
    "an XR4000's computer that is switched off and on in mid-motion is found again, and the robot stands",
    "[system][hardware]") {
  Xr4000Settings settings;
  // It answers again before its silence is noticed, or after.
  settings.power_up = GENERATE(Duration{0}, Duration{2s});
  Nomad nomad("nomad", settings);
  (void)run(far_goal(), [&] {
    nomad.set_off();
    bench().sleep(1s);  // its clock must be seen to go back
    nomad.reset();
    REQUIRE(bench().until_log(settings.power_up == Duration{0}
                                  ? "its clock has gone back; was the robot's computer switched off and on"
                                  : "is it still connected and switched on?"));
    REQUIRE(bench().until_log("it works again"));
    nomad.check_stays();
    CHECK(bench().until([&] { return !nomad.has_power(); }));
    CHECK(timeout(nomad) == 500ms);
  });
}

TEST_CASE("an XR4000 that moves when it is found is braked before it is told to drive",
          "[system][hardware]") {
  Nomad nomad("nomad");
  nomad.fall_silent(true);  // until it moves
  (void)run(far_goal({"--fail", "goto=silent@0s"}), [&] {
    // Velocity mode, y 200 mm/s at 1000 mm/s^2, from somebody else who has gone.
    nomad.line([&](Nomad::Line& line) {
      line.take(
          std::vector<std::uint8_t>{0x58, 0x52, 0x1B, 0x00, 0x03, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                                    0x00, 0x00, 0x04, 0xC8, 0x00, 0x00, 0x00, 0xE8, 0x03, 0x00, 0x00, 0x00,
                                    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xB6, 0xB6},
          0, nomad.now());
    });
    nomad.set_off();
    nomad.fall_silent(false);
    REQUIRE(bench().until_log("connected to the agent of an XR4000"));
    CHECK(bench().until([&] { return nomad.stands(); }));
    CHECK(bench().until([&] { return !nomad.has_power(); }));  // by its time-out, which it has now
  });
}

TEST_CASE("an XR4000 that touches something stands, and does not drive on towards it", "[system][hardware]") {
  Nomad nomad("nomad");
  (void)run(far_goal(), [&] {
    nomad.set_off();
    nomad.body([](PlainBody& body) { body.touch(8); });  // whatever switch that is
    nomad.check_stays();
  });
}

TEST_CASE("an XR4000's sonars reach who avoids obstacles", "[system][hardware]") {
  Nomad nomad("nomad");
  nomad.body([](PlainBody& body) { body.surround(0.2); });
  (void)run(far_goal(), [&] {
    REQUIRE(bench().until_log("connected to the agent of an XR4000"));
    bench().sleep(3s);
    CHECK(std::abs(nomad.pose().x) < 0.1);
    nomad.body([](PlainBody& body) { body.surround({}); });
    CHECK(bench().until([&] { return nomad.pose().x > 0.3; }));
  });
}

TEST_CASE("an XR4000's readings are those of its page", "[system][hardware]") {
  Nomad nomad("nomad");
  nomad.body([](PlainBody& body) {
    body.surround(1.0);
    body.touch(1);
  });
  const Words battery{"--set", "nomad.battery_scale=0.05 V", "--set", "nomad.battery_channel=2"};
  (void)run(far_goal(battery), [&] {
    REQUIRE(bench().until_log("connected to the agent of an XR4000"));
    const auto reading = [](const std::string& type) {
      const auto sensors = bench().seat().sensors();
      const auto sensor = std::ranges::find(sensors, type, &hw::HardwareSeat::Sensor::port_stem);
      REQUIRE(sensor != sensors.end());
      ObjectRef latest;
      REQUIRE(bench().until(
          [&] { return latest = bench().seat().latest(*sensor), static_cast<bool>(latest); }, 2s));
      return to_xml(latest);
    };
    CHECK_THAT(reading("Odometry"), Contains("<Odometry"));
    CHECK_THAT(reading("SonarRangeReadings"), Contains("0.991") && Contains("7.62"));
    CHECK_THAT(reading("BumperReadings"), Contains("set 0 switch 4"));
    CHECK_THAT(reading("Battery"), Contains("voltage=\"24") && Contains("channel 2"));
  });
}

TEST_CASE("an XR4000 drives to its goals over a serial line", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  NomadInRealTime nomad(device);
  nomad.check_at_goal(run_deployer(on_line("xr4000.xml", device), Seconds(60)));
  CHECK(eventually([&] { return !nomad.has_power(); }));
}

TEST_CASE("kill -9 of the whole system: an XR4000's axes go limp", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  NomadInRealTime nomad(device);
  CHECK(kill_while_it_drives(nomad, on_line("xr4000.xml", device), [&] { return nomad.stands(); }) <
        700ms * static_cast<int>(kSlowdown));
  CHECK(limp_stops(nomad) == 1);
}
