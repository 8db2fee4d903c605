// SPDX-License-Identifier: GPL-3.0-or-later
// Bases without a graph around them: commands come one by one from outside, and nobody repeats them.
#include <catch2/catch.hpp>

#include <charconv>
#include <cmath>
#include <string>
#include <thread>

#include "device_on_desk.hpp"
#include "hosted_system.hpp"
#include "orca/emulators/create2_firmware.hpp"
#include "orca/emulators/nomad_scout_firmware.hpp"
#include "orca/emulators/p2os_firmware.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "orca/emulators/xr4000_firmware.hpp"
#include "orca/idl/sensing.hpp"
#include "temp_folder.hpp"
#include "virtual_desk.hpp"

using namespace orca;
using namespace orca::test;
using namespace std::chrono_literals;

namespace {

template <class Of>
struct Base {
  using Firmware = Of;
};
struct Pioneer : Base<emulators::P2osFirmware> {
  static constexpr const char* driver = "orca.hw.P2os";
};
struct Scout : Base<emulators::NomadScoutFirmware> {
  static constexpr const char* driver = "orca.hw.NomadScout";
};
struct Create : Base<emulators::Create2Firmware> {
  static constexpr const char* driver = "orca.hw.Create2";
};
struct Nomad : Base<emulators::Xr4000Firmware> {
  static constexpr const char* driver = "orca.hw.Xr4000";
};
struct PlayerRobot : Base<emulators::PlayerFirmware> {
  static constexpr const char* driver = "orca.hw.Player";
};

// A base that nobody commands.
std::string lonely_base(const std::string& driver, const std::string& device,
                        const std::string& params = "") {
  return R"(<graph name="lonely" version="1"><hardware name="robot" type=")" + driver +
         R"("><param name="device" value=")" + device + R"("/>)" + params +
         R"(</hardware><component name="base" type="orca.RobotBaseServer" hardware="robot" autonomous="true"/></graph>)";
}

// Runs such a base in virtual time; the script commands it.
void in_memory(const std::string& driver, const std::string& params, const std::function<void()>& script) {
  const TempFolder folder;
  std::string graph = lonely_base(driver, "memory:line", params);
  graph.insert(graph.rfind("</graph>"),
               R"(<connect from="test_operator.motion" to="base.MotionCommandSend"/>)");
  (void)run_virtual({folder.write("graph.xml", graph)}, script);
}

long counted(const std::string& what) {
  const Run run = run_orcactl({"query", "base.DeviceStatisticsQuery", "<Ask/>"});
  const std::size_t at = run.out.find(" " + what + "=\"");
  long number = -1;
  if (at != std::string::npos)
    std::from_chars(run.out.data() + at + what.size() + 3, run.out.data() + run.out.size(), number);
  return number;
}

template <class Firmware>
int watchdog_stops(Firmware& firmware) {
  if constexpr (requires { firmware.watchdog_stops(); })
    return firmware.watchdog_stops();
  else
    return 0;  // it has no watchdog, or does not count
}

}  // namespace

TEMPLATE_TEST_CASE("a base whose commander says nothing more is told to stand, while its line goes on",
                   "[system][hardware]", Pioneer, Scout, Create, Nomad, PlayerRobot) {
  using Firmware = typename TestType::Firmware;
  VirtualDevice<Firmware, PlainBody> desk("line");
  const auto way = [&] { return desk.with([](Firmware&, PlainBody& body) { return body.odometry().x; }); };
  const auto stands = [&] {
    return desk.with([](Firmware&, PlainBody& body) { return body.velocity() == Twist2{}; });
  };
  in_memory(TestType::driver, "", [&] {
    const auto frames = [] { return bench().seat().statistics().frames(); };
    REQUIRE(bench().until([&] { return frames() > 0; }));
    REQUIRE(stands());

    idl::MotionCommand ahead;
    ahead.speed(0.3);
    REQUIRE(bench().send(ahead).ok());
    REQUIRE(bench().until([&] { return way() > 0.01; }));
    REQUIRE(bench().until(stands));
    CHECK(desk.with([](Firmware& firmware, PlainBody&) { return watchdog_stops(firmware); }) == 0);
    const double there = way();
    const auto before = frames();
    bench().sleep(1s);
    CHECK(frames() > before);
    CHECK(bench().seat().statistics().connections() == 1);
    CHECK(way() == there);
  });
}

TEST_CASE("with --hold a base stands until an operator releases it", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("line");
  DeviceOnDesk<emulators::P2osFirmware, PlainBody> desk(DeskLine{device});
  const std::string graph = folder.write("graph.xml", lonely_base(Pioneer::driver, device));
  Subprocess program(deployer({graph, "--hold"}));
  INFO(program.err());
  const auto send = [] {
    return run_orcactl({"send", "base.MotionCommandSend", R"(<MotionCommand speed="0.3 m/s"/>)"});
  };
  const auto velocity = [&] { return desk.with([](auto&, PlainBody& body) { return body.velocity(); }); };
  REQUIRE(program.wait_for_output("alarm ESTOP: all motors are held", Seconds(20) * kSlowdown));
  REQUIRE(eventually([&] { return counted("frames") > 0; }));
  for (int i = 0; i < 10; ++i) {
    (void)send();
    std::this_thread::sleep_for(50ms);
    CHECK(velocity() == Twist2{});
  }
  REQUIRE(run_orcactl({"estop", "--release"}).exit_code() == 0);
  REQUIRE(eventually([&] { return send().exit_code() == 0 && velocity() != Twist2{}; }));
  CHECK(run_deployer({graph, "--hold", "--in-process"}).exit_code() == 2);
}

// Its odometry begins anew with the process, and with it what goals mean.
TEMPLATE_TEST_CASE("a base whose process is killed and started again stands until an operator releases it",
                   "[system][hardware]", Pioneer, Scout, Create, Nomad, PlayerRobot) {
  using Firmware = typename TestType::Firmware;
  const TempFolder folder;
  const std::string device = folder.file("line");
  DeviceOnDesk<Firmware, PlainBody> desk(DeskLine{device});
  System system({folder.write("graph.xml", lonely_base(TestType::driver, device))});
  const auto velocity = [&] { return desk.with([](Firmware&, PlainBody& body) { return body.velocity(); }); };
  const auto send = [] {
    return run_orcactl({"send", "base.MotionCommandSend", R"(<MotionCommand speed="0.3 m/s"/>)"});
  };
  REQUIRE(eventually([&] { return counted("frames") > 0; }));
  const pid_t lost = system.process("main");
  REQUIRE(send().exit_code() == 0);
  REQUIRE(eventually([&] { return velocity() != Twist2{}; }));
  REQUIRE(kill(lost, SIGKILL) == 0);
  (void)system.process("main", lost);

  system.when("alarm ESTOP: the motors of process main are held, because it has ended", 0);
  INFO(system.program().err());
  REQUIRE(eventually([&] { return counted("frames") > 0; }));
  REQUIRE(eventually([&] { return velocity() == Twist2{}; }));
  for (int i = 0; i < 10; ++i) {
    (void)send();
    std::this_thread::sleep_for(50ms);
    CHECK(velocity() == Twist2{});
  }

  const auto alarms = [] { return run_orcactl({"alarms"}).out; };
  CHECK(alarms().find("ESTOP") != std::string::npos);
  CHECK(run_orcactl({"alarms", "ack", "all"}).exit_code() != 0);  // while they are held
  REQUIRE(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(run_orcactl({"alarms", "ack", "all"}).exit_code() == 0);
  CHECK(velocity() == Twist2{});
  REQUIRE(eventually([&] { return send().exit_code() == 0 && velocity() != Twist2{}; }));
}

// Its controller counts less than it drives, and more than it turns.
TEMPLATE_TEST_CASE(
    "a calibrated base is told so much less or more, and its odometry tells what it has really done",
    "[system][hardware]", Pioneer, Scout, Create, Nomad) {
  using Firmware = typename TestType::Firmware;
  VirtualDevice<Firmware, PlainBody> desk("line");
  const auto counts = [&] { return desk.with([](Firmware&, PlainBody& body) { return body.odometry(); }); };
  const auto velocity = [&] { return desk.with([](Firmware&, PlainBody& body) { return body.velocity(); }); };
  // Some controllers take their time to get fast.
  const auto go_on_with = [&](const idl::MotionCommand& command, double Twist2::*speed, double wanted) {
    double fastest = 0.0;
    REQUIRE(bench().until([&] {
      REQUIRE(bench().send(command).ok());
      fastest = std::max(fastest, velocity().*speed);
      return fastest > 0.97 * wanted;
    }));
    REQUIRE(bench().until([&] {
      fastest = std::max(fastest, velocity().*speed);
      return velocity() == Twist2{};
    }));
    CHECK(fastest == Approx(wanted).margin(0.02));
  };
  const auto told = [] {
    const auto sensors = bench().seat().sensors();
    const auto odometry = std::ranges::find(sensors, "Odometry", &hw::HardwareSeat::Sensor::port_stem);
    REQUIRE(odometry != sensors.end());
    (void)bench().send(idl::MotionCommand());  // a base that nobody uses passes no readings on
    const ObjectRef latest = bench().seat().latest(*odometry);
    return latest ? *object_cast<idl::Odometry>(latest) : idl::Odometry();
  };
  const std::string scales =
      R"(<param name="distance_scale" value="1.25"/><param name="turn_scale" value="0.8"/>)";
  in_memory(TestType::driver, scales, [&] {
    // Odometry counts from the first frames.
    REQUIRE(bench().until([] { return bench().seat().statistics().frames() > 5; }));
    idl::MotionCommand ahead;
    ahead.speed(0.25);
    go_on_with(ahead, &Twist2::forward, 0.2);
    idl::MotionCommand round;
    round.steering(idl::MotionSteering::BY_TURN_RATE);
    round.turn_rate(0.4);
    go_on_with(round, &Twist2::turn_rate, 0.5);

    CHECK(counts().x > 0.01);
    CHECK(bench().until([&] { return std::abs(told().x() - 1.25 * counts().x) < 0.005; }));
    CHECK(counts().yaw > 0.01);
    CHECK(bench().until([&] { return std::abs(told().steer_angle() - 0.8 * counts().yaw) < 0.005; }));
  });
}
