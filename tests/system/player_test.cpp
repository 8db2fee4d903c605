// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of robots behind a Player server, with the server's emulation at the other end of a pseudo terminal or of a connection.
#include <catch2/catch.hpp>

#include <cmath>
#include <csignal>
#include <deque>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "bad_line.hpp"
#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/base/random.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "record_table.hpp"
#include "tcp_front.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using emulators::PlayerFirmware;
using emulators::PlayerSettings;

namespace {

using OnTerminal = DeviceOnDesk<PlayerFirmware, PlainBody>;
using OnNetwork = TcpFront<PlayerFirmware, PlainBody>;

Words drive(const std::string& device, const Words& more = {}) {
  return Words{system_graph("player.xml"), "--set", "device=" + device} + more;
}

Words far_goal() { return {"--set", "goals=far: 30 0"}; }

// Returns what lets a piece of 1 to 9 bytes go in each millisecond, wherever messages begin and end. After a wait for the processor it
// makes up for what it missed, as the line itself does not become slower with the machine.
std::function<void(std::vector<std::uint8_t>&)> in_pieces() {
  return [held = std::deque<std::uint8_t>(), random = RandomStream(1, "test", "pieces"),
          due = steady_now()](std::vector<std::uint8_t>& sent) mutable {
    held.insert(held.end(), sent.begin(), sent.end());
    sent.clear();
    for (; due < steady_now(); due += 1ms)
      for (std::uint64_t left = 1 + random() % 9; left > 0 && !held.empty(); --left) {
        sent.push_back(held.front());
        held.pop_front();
      }
  };
}

template <class Server>
bool is_moving(Server& server) {
  return server.with([](PlayerFirmware&, PlainBody& body) { return body.velocity().forward > 0.1; });
}

template <class Server>
bool stands(Server& server) {
  return server.with([](PlayerFirmware&, PlainBody& body) { return body.velocity() == Twist2{}; });
}

template <class Server>
bool has_power(Server& server) {
  return server.with([](PlayerFirmware& firmware, PlainBody&) { return firmware.has_power(); });
}

template <class Server>
void check_reaches_goals(Server& server, const Run& run) {
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 2);
  CHECK(run.says("connected to a Player server \"3.1.1-dev\" with a base of its driver \"p2os\""));
  const Pose2 end = server.with([](PlayerFirmware&, PlainBody& body) { return body.odometry(); });
  CHECK(std::hypot(end.x - run.arrivals()[1].x, end.y - run.arrivals()[1].y) < 0.1);
  CHECK(stands(server));
  CHECK_FALSE(has_power(server));
}

// Runs a system that cannot begin, and returns what it says.
std::string complaint_about(const PlayerSettings& settings) {
  const TempFolder folder;
  const std::string device = folder.file("server");
  OnTerminal server(device, settings);
  const Run run = run_deployer(drive(device), Seconds(60));
  CHECK(run.exit_code() == 3);
  return run.err;
}

}  // namespace

TEST_CASE("a robot behind a Player server drives to its goals, and its motors are off before and after",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("server");
  OnTerminal server(device);
  check_reaches_goals(server, run_deployer(drive(device), Seconds(60)));
}

TEST_CASE("so it does over a connection of the network", "[system][hardware]") {
  OnNetwork server;
  check_reaches_goals(server, run_deployer(drive(server.address()), Seconds(60)));
}

TEST_CASE("messages of a Player server may come in small pieces", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("server");
  DeviceOnDesk<BadLine<PlayerFirmware>, PlainBody> server(device, PlayerSettings{});
  server.with([](BadLine<PlayerFirmware>& line, PlainBody&) { line.spoil(in_pieces()); });
  const Run run = run_deployer(drive(device, {"--set", "goals=ahead: 0.6 0"}), Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
}

TEST_CASE("a connection that is cut while the base drives comes back, and the base stands until it is let go",
          "[system][hardware]") {
  OnNetwork server;
  Subprocess program(deployer(drive(server.address(), far_goal())));
  REQUIRE(eventually([&] { return is_moving(server); }));
  server.shut();
  REQUIRE(program.wait_for_output("the other end has gone", Seconds(20 * kSlowdown)));
  CHECK(eventually([&] { return stands(server); }));  // its driver is closed with the connection
  CHECK(program.wait_for_output("nothing listens on port", Seconds(20 * kSlowdown)));
  server.listen();
  const bool back = program.wait_for_output("it works again", Seconds(30 * kSlowdown));
  INFO(program.err());
  REQUIRE(back);
  for (int i = 0; i < 50; ++i, std::this_thread::sleep_for(10ms)) REQUIRE(stands(server));
  CHECK_FALSE(has_power(server));
  const Run counted = run_orcactl({"query", "base.DeviceStatisticsQuery", "<Ask/>"});
  CHECK_THAT(counted.out, Contains("connections=\"2\""));
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return is_moving(server); }));
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
  CHECK(stands(server));
}

TEST_CASE("a Player server that falls silent is left, and found again", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("server");
  OnTerminal server(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(server); }));
  server.fall_silent(true);
  REQUIRE(program.wait_for_output("is it still connected and switched on?", Seconds(20 * kSlowdown)));
  CHECK(eventually([&] { return stands(server); }));
  server.fall_silent(false);
  CHECK(program.wait_for_output("it works again", Seconds(30 * kSlowdown)));
  CHECK(stands(server));
}

TEST_CASE("kill -9 of the whole system: the base stops as its connection ends", "[system][hardware]") {
  OnNetwork server;
  Subprocess program(deployer(drive(server.address(), far_goal() + Words{"--in-process"})));
  REQUIRE(eventually([&] { return is_moving(server); }));
  program.send(SIGKILL);
  CHECK(eventually([&] { return stands(server); }));
}

TEST_CASE("without a Player server nothing starts, and what to look at is said", "[system][hardware]") {
  PlayerSettings settings;
  SECTION("something else speaks there") {
    settings.banner = "220 mail.example.org ESMTP ready";
    CHECK_THAT(
        complaint_about(settings),
        Contains("the server begins with \"220 mail.example.org ESMTP ready\" and not with \"Player v.\"; "
                 "check host and port"));
  }
  SECTION("nothing speaks there") {
    settings.accept_time = 100s;
    CHECK_THAT(complaint_about(settings),
               Contains("sends no banner; is this the server's port (usually 6665)"));
  }
  SECTION("its base does not start") {
    settings.refused = {4};
    CHECK_THAT(complaint_about(settings),
               Contains("position2d:0 cannot be opened: its driver \"p2os\" does not start"));
  }
  SECTION("it has no base") {
    settings.missing = {4};
    CHECK_THAT(complaint_about(settings), Contains("position2d:0 is none of its 3 devices"));
  }
  SECTION("it answers no request") {
    settings.silent = {1};
    CHECK_THAT(complaint_about(settings),
               Contains("does not answer the request to let data come by themselves; does the server hang?"));
  }
  SECTION("nobody listens at that port") {
    OnNetwork gone;
    gone.shut();
    const Run run = run_deployer(drive(gone.address()), Seconds(60));
    CHECK(run.exit_code() == 3);
    CHECK_THAT(run.err, Contains("nothing listens on port") && Contains("is the device server running?"));
  }
  SECTION("there is no such host") {
    const Run run = run_deployer(drive("tcp:no-such-host.invalid:6665"), Seconds(60));
    CHECK(run.exit_code() == 3);
    CHECK_THAT(run.err, Contains("no-such-host.invalid"));
  }
}

TEST_CASE("without sonars, bumpers and battery a Player base drives, and what is missing is said",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("server");
  PlayerSettings settings;
  settings.refused = {14};
  settings.missing = {2};
  settings.silent = {5};
  OnTerminal server(device, settings);
  Subprocess program(deployer(drive(device)));
  CHECK(program.wait_for_output("the server has no power:0; leave it out of \"uses\"", Seconds(20)));
  CHECK(
      program.wait_for_output("bumper:0 cannot be opened: its driver \"p2os\" does not start", Seconds(20)));
  CHECK(program.wait_for_output("does not say where sonar:0 is, so the sonars are not used", Seconds(20)));
  CHECK(eventually([&] {
    return server.with([](PlayerFirmware& firmware, PlainBody&) {
      return firmware.is_subscribed(4) && firmware.is_subscribed(5);
    });
  }));
}

// A p2os driver takes 2 s, and that of a SICK up to 35 s.
TEST_CASE(
    "a driver that still starts is waited for as long as \"patience\" says, and its late answer is taken",
    "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("server");
  PlayerSettings settings;
  settings.starting = {{5, 2500ms}};
  OnTerminal server(device, settings);
  SECTION("in time") {
    const Run run = run_deployer(drive(device), Seconds(60));
    check_reaches_goals(server, run);
    CHECK_FALSE(run.says("does not say where sonar:0 is"));
  }
  SECTION("late") {
    Subprocess program(deployer(drive(device, far_goal() + Words{"--set", "robot.patience=1"})));
    CHECK(program.wait_for_output("so the sonars are not used until it does", Seconds(20 * kSlowdown)));
    CHECK(program.wait_for_output("the server says now where sonar:0 is", Seconds(20 * kSlowdown)));
    CHECK(eventually([] {
      return run_orcactl({"query", "base.SonarRangeReadingsQuery", "<AskReading/>"}).out.find("ranges=") !=
             std::string::npos;
    }));
  }
}

TEST_CASE("a device that \"uses\" does not know is found before anything is opened", "[system][hardware]") {
  const Run run = run_deployer(drive("tcp:localhost:1", {"--set", "uses=sonar camera"}), Seconds(60));
  CHECK(run.exit_code() == 2);
  CHECK_THAT(run.err, Contains("\"camera\" is none of sonar, laser, bumper, power"));
  for (const char* const wrong : {"power=ranger:0", "laser=ranger", "laser=ranger:x", "sonar=laser:0"}) {
    CAPTURE(wrong);
    CHECK_THAT(
        run_deployer(drive("tcp:localhost:1", {"--set", std::string("uses=") + wrong}), Seconds(60)).err,
        Contains("\"" + std::string(wrong) + "\" is none of") && Contains("laser=ranger:1"));
  }
}

TEST_CASE("a robot whose server shows its sonars as a ranger, as Stage does, drives to its goals",
          "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("server");
  PlayerSettings settings;
  settings.shows_rangers = true;
  OnTerminal server(device, settings);
  const std::string file = folder.file("sonars.csv");
  const Run run = run_deployer(drive(device, {"--set", "uses=sonar=ranger:0 bumper power", "--record",
                                              file + "=base.SonarRangeReadingsPush"}),
                               Seconds(60));
  check_reaches_goals(server, run);
  const auto rows = RecordTable(file).rows("base.SonarRangeReadingsPush");
  REQUIRE(rows.size() > 10);
  CHECK(numbers(rows.back(), "ranges").size() == 16);
}

TEST_CASE("who asks a server that has rangers for sonars is told their names", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("server");
  PlayerSettings settings;
  settings.shows_rangers = true;
  OnTerminal server(device, settings);
  Subprocess program(deployer(drive(device)));
  const bool told = program.wait_for_output(
      "the server has no sonar:0; it has ranger:0: if one of them is meant, write e.g. sonar=ranger:0",
      Seconds(20 * kSlowdown));
  INFO(program.err());
  CHECK(told);
}

TEST_CASE("a bumper that is touched stops a Player base where it drives to", "[system][hardware]") {
  const TempFolder folder;
  const std::string device = folder.file("server");
  OnTerminal server(device);
  Subprocess program(deployer(drive(device, far_goal())));
  REQUIRE(eventually([&] { return is_moving(server); }));
  server.with([](PlayerFirmware&, PlainBody& body) { body.touch(0x04); });
  CHECK(eventually([&] { return !is_moving(server); }));
  for (int i = 0; i < 50; ++i, std::this_thread::sleep_for(10ms)) REQUIRE_FALSE(is_moving(server));
}
