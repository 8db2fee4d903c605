// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of Nomad XR4000s with robot and agent emulated at the other end of a pseudo terminal.
#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <string>
#include <thread>

#include "bad_line.hpp"
#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/emulators/xr4000_firmware.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::Xr4000Firmware;
using emulators::Xr4000Settings;

namespace {

using BadNomad = BadLine<Xr4000Firmware>;
using Nomad = DeviceOnDesk<BadNomad, PlainBody>;

constexpr int kSetAxes = 3;
constexpr int kResetMotionTimer = 4;
constexpr std::uint8_t kEmergencyStop = 1;
constexpr std::uint8_t kJoystick = 2;
constexpr std::uint8_t kMotionError = 4;

Words drive(const std::string& device, const Words& more = {}) {
  return Words{system_graph("xr4000.xml"), "--set", "device=" + device} + more;
}

Words far_goal() { return {"--set", "goals=far: 30 0"}; }

Twist2 velocity(Nomad& nomad) {
  return nomad.with([](BadNomad&, PlainBody& body) { return body.velocity(); });
}
bool is_moving(Nomad& nomad) { return velocity(nomad).forward > 0.1; }
bool stands(Nomad& nomad) { return velocity(nomad) == Twist2{}; }
Pose2 pose(Nomad& nomad) {
  return nomad.with([](BadNomad&, PlainBody& body) { return body.odometry(); });
}
template <class Look>
auto look(Nomad& nomad, Look at) {
  return nomad.with([&](BadNomad& line, PlainBody&) { return at(line.device()); });
}
bool has_power(Nomad& nomad) {
  return look(nomad, [](Xr4000Firmware& robot) { return robot.has_power(); });
}
int limp_stops(Nomad& nomad) {
  return look(nomad, [](Xr4000Firmware& robot) { return robot.limp_stops(); });
}
std::vector<int> requests(Nomad& nomad) {
  return look(nomad, [](Xr4000Firmware& robot) { return robot.requests(); });
}
void set_status(Nomad& nomad, std::uint8_t bits) {
  look(nomad, [&](Xr4000Firmware& robot) { robot.set_status(bits); });
}

bool says(Subprocess& program, const std::string& text) {
  return program.wait_for_output(text, Seconds(30 * kSlowdown));
}

// The robot stands for a second, whatever Goto wishes.
void check_goes_on_standing(Nomad& nomad) {
  const Pose2 there = pose(nomad);
  std::this_thread::sleep_for(1s);
  CHECK(pose(nomad) == there);
}

void check_goes_on_when_let_go(Nomad& nomad) {
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return is_moving(nomad); }));
}

}  // namespace

TEST_CASE("an XR4000 drives to its goals, and its axes are told nothing before", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  const Run run = run_deployer(drive(device), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 2);
  const Pose2 end = pose(nomad);
  CHECK(std::hypot(end.x - run.arrivals()[1].x, end.y - run.arrivals()[1].y) < 0.1);
  CHECK(stands(nomad));
  CHECK(look(nomad, [](Xr4000Firmware& robot) { return robot.timeout(); }) == 500ms);
  CHECK(eventually([&] { return !has_power(nomad); }));
  const std::vector<int> all = requests(nomad);
  CHECK(std::ranges::find(all, kResetMotionTimer) < std::ranges::find(all, kSetAxes));
}

TEST_CASE("an XR4000 that nobody lets drive is asked and told nothing else", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  const Run run = run_deployer(drive(device, {"--fail", "goto=silent@0s", "--until", "3 s"}), Seconds(30));
  INFO(run.err);
  const std::vector<int> all = requests(nomad);
  CHECK(all.size() > 50);
  CHECK(std::ranges::count(all, kSetAxes) == 0);
  CHECK(std::ranges::count(all, kResetMotionTimer) == 0);
}

TEST_CASE("an XR4000 drives sideways as long as it is told so", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  const std::string graph = folder.write(
      "base.xml",
      "<graph name=\"base\" version=\"1\"><hardware name=\"nomad\" type=\"orca.hw.Xr4000\"><param "
      "name=\"device\" value=\"" +
          device +
          "\"/></hardware><component name=\"base\" type=\"orca.RobotBaseServer\" "
          "hardware=\"nomad\"/></graph>");
  Subprocess program(deployer({graph}));
  REQUIRE(says(program, "connected to the agent of an XR4000"));
  const auto send = [] {
    return run_orcactl({"send", "base.HolonomicVelocitySend", "<HolonomicVelocity left=\"0.3 m/s\"/>"})
        .exit_code();
  };
  REQUIRE(eventually([&] { return send() == 0 && pose(nomad).y > 0.05; }));
  CHECK(says(program, "no motion command for 200 ms"));
  REQUIRE(eventually([&] { return stands(nomad); }));
  CHECK(pose(nomad).x == Approx(0.0).margin(1e-9));
  CHECK(pose(nomad).yaw == Approx(0.0).margin(1e-9));
}

TEST_CASE("without an agent on the line nothing starts, and what to look at is said", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  const bool loops = GENERATE(false, true);
  nomad.fall_silent(!loops);
  if (loops) {
    nomad.with([](BadNomad& line, PlainBody&) {
      line.echo(true);
      line.spoil([](std::vector<std::uint8_t>& sent) { sent.clear(); });
    });
  }
  const Run run = run_deployer(drive(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains(loops ? "sends back what it is sent, and nothing else"
                                     : "no agent of an XR4000 answers at serial:" + device));
}

TEST_CASE("an agent of another version or of another robot is refused", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Xr4000Settings settings;
  const bool is_other_robot = GENERATE(false, true);
  (is_other_robot ? settings.robot_type : settings.version) = is_other_robot ? 'n' : 2;
  Nomad nomad(device, settings);
  const Run run = run_deployer(drive(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  CHECK_THAT(run.err, Contains(is_other_robot ? "the agent's robot has the type 110"
                                              : "the agent speaks version 2 of the protocol"));
}

TEST_CASE(
    "an XR4000 that is unplugged while it drives goes limp; it comes back and stands until it is let go",
    "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(nomad); }));
  nomad.unplug();
  REQUIRE(eventually([&] { return stands(nomad); }));
  CHECK(limp_stops(nomad) == 1);
  CHECK(says(program, "the device has gone: was it unplugged or switched off?"));
  nomad.plug_in();
  REQUIRE(says(program, "it works again"));
  INFO(program.err());
  check_goes_on_standing(nomad);
  CHECK_FALSE(has_power(nomad));
  check_goes_on_when_let_go(nomad);
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
}

TEST_CASE("kill -9 of the whole system: an XR4000's axes go limp", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  Subprocess program(deployer(drive(device, far_goal() + Words{"--in-process"})));
  REQUIRE(eventually([&] { return is_moving(nomad); }));
  const TimePoint killed = steady_now();
  program.send(SIGKILL);
  CHECK(eventually([&] { return stands(nomad); }));
  CHECK(steady_now() - killed < 700ms * static_cast<int>(kSlowdown));
  CHECK(limp_stops(nomad) == 1);
}

TEST_CASE(
    "an XR4000 whose emergency stop is pressed, or that is taken by its joystick, stands until it is let go",
    "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(nomad); }));
  const std::uint8_t status = GENERATE(kEmergencyStop, kJoystick);
  set_status(nomad, status);
  CHECK(says(program,
             status == kEmergencyStop
                 ? "its emergency stop is pressed; release it, then orcactl estop --release"
                 : "somebody drives it with the joystick; let go of that, then orcactl estop --release"));
  set_status(nomad, 0);
  check_goes_on_standing(nomad);
  CHECK_FALSE(has_power(nomad));
  check_goes_on_when_let_go(nomad);
}

TEST_CASE("an XR4000 with a motion error has failed until it is gone", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(nomad); }));
  set_status(nomad, kMotionError);
  CHECK(says(program, "its axes report a motion error; is a wheel blocked"));
  check_goes_on_standing(nomad);
  set_status(nomad, 0);
  REQUIRE(says(program, "it works again"));
  check_goes_on_standing(nomad);
  check_goes_on_when_let_go(nomad);
}

TEST_CASE("an XR4000 whose library fails has failed, and the return code is said", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(nomad); }));
  look(nomad, [](Xr4000Firmware& robot) { robot.fail_with(-6); });
  CHECK(says(program, "the robot's library has returned -6 (connection failed)"));
  CHECK(eventually([&] { return stands(nomad); }));
  look(nomad, [](Xr4000Firmware& robot) { robot.fail_with(0); });
  REQUIRE(says(program, "it works again"));
  check_goes_on_standing(nomad);
  check_goes_on_when_let_go(nomad);
}

TEST_CASE(
    "an XR4000's computer that is switched off and on in mid-motion is found again, and the robot stands",
    "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Xr4000Settings settings;
  // It answers again before its silence is noticed, or after.
  settings.power_up = GENERATE(Duration{0}, Duration{2s});
  Nomad nomad(device, settings);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(nomad); }));
  std::this_thread::sleep_for(1s);  // its clock must be seen to go back
  nomad.with([](BadNomad& line, PlainBody&) { line.reset(steady_now()); });
  const bool told =
      says(program, settings.power_up == Duration{0}
                        ? "its clock has gone back; was the robot's computer switched off and on"
                        : "is it still connected and switched on?");
  INFO(program.err());
  REQUIRE(told);
  REQUIRE(says(program, "it works again"));
  REQUIRE(eventually([&] { return stands(nomad); }));
  check_goes_on_standing(nomad);
  CHECK(eventually([&] { return !has_power(nomad); }));
  CHECK(look(nomad, [](Xr4000Firmware& robot) { return robot.timeout(); }) == 500ms);
}

TEST_CASE("an XR4000 that moves when it is found is braked before it is told to drive",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  // Velocity mode, y 200 mm/s at 1000 mm/s^2, from somebody else who has gone.
  nomad.with([](BadNomad& line, PlainBody&) {
    line.take(
        std::vector<std::uint8_t>{0x58, 0x52, 0x1B, 0x00, 0x03, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
                                  0x00, 0x00, 0x04, 0xC8, 0x00, 0x00, 0x00, 0xE8, 0x03, 0x00, 0x00, 0x00,
                                  0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xB6, 0xB6},
        0, steady_now());
  });
  REQUIRE(eventually([&] { return is_moving(nomad); }));
  Subprocess program(deployer(drive(device, far_goal() + Words{"--fail", "goto=silent@0s"})));
  REQUIRE(says(program, "connected to the agent of an XR4000"));
  CHECK(eventually([&] { return stands(nomad); }));
  CHECK(eventually([&] { return !has_power(nomad); }));  // by its time-out, which it has now
}

TEST_CASE("an XR4000 that touches something stands, and does not drive on towards it", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(nomad); }));
  nomad.with([](BadNomad&, PlainBody& body) { body.touch(8); });  // whatever switch that is
  REQUIRE(eventually([&] { return stands(nomad); }));
  const double there = pose(nomad).x;
  std::this_thread::sleep_for(1s);
  CHECK(pose(nomad).x - there < 0.01);
}

TEST_CASE("an XR4000's sonars reach who avoids obstacles", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  nomad.with([](BadNomad&, PlainBody& body) { body.surround(0.2); });
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(says(program, "connected to the agent of an XR4000"));
  std::this_thread::sleep_for(3s);
  CHECK(std::abs(pose(nomad).x) < 0.1);
  nomad.with([](BadNomad&, PlainBody& body) { body.surround({}); });
  CHECK(eventually([&] { return pose(nomad).x > 0.3; }));
}

TEST_CASE("an XR4000's readings are those of its page", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("nomad");
  Nomad nomad(device);
  nomad.with([](BadNomad&, PlainBody& body) {
    body.surround(1.0);
    body.touch(1);
  });
  Subprocess program(deployer(drive(device, far_goal() + Words{"--set", "nomad.battery_scale=0.05 V", "--set",
                                                               "nomad.battery_channel=2"})));
  REQUIRE(says(program, "connected to the agent of an XR4000"));
  const auto reading = [](const std::string& port) {
    const Run run = run_orcactl({"query", "base." + port, "<AskReading/>"});
    UNSCOPED_INFO(run.err);
    return run.out;
  };
  REQUIRE(eventually([&] { return !reading("OdometryQuery").empty(); }));
  CHECK_THAT(reading("SonarRangeReadingsQuery"), Contains("0.991") && Contains("7.62"));
  CHECK_THAT(reading("BumperReadingsQuery"), Contains("set 0 switch 4"));
  REQUIRE(eventually([&] { return !reading("BatteryQuery").empty(); }));  // it is asked for once a second
  CHECK_THAT(reading("BatteryQuery"), Contains("voltage=\"24") && Contains("channel 2"));
}
