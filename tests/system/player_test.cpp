// SPDX-License-Identifier: GPL-3.0-or-later
// The driver of robots behind a Player server, with the server's emulation at the other end of a line in memory, in virtual time; the
// cases at the end have a connection of the network and real time.
#include <catch2/catch.hpp>

#include <csignal>
#include <deque>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "base_on_desk.hpp"
#include "orca/base/random.hpp"
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

using Server = VirtualBase<PlayerFirmware>;
using OnNetwork = BaseOn<TcpFront, PlayerFirmware>;

Run run(const Words& more = {}, const std::function<void()>& script = {}) {
  return run_virtual(on_line("player.xml", "memory:server", more), script);
}

// Returns what lets a piece of 1 to 9 bytes go in each millisecond, wherever messages begin and end.
std::function<void(std::vector<std::uint8_t>&)> in_pieces() {
  return [held = std::deque<std::uint8_t>(),
          random = RandomStream(1, "test", "pieces")](std::vector<std::uint8_t>& sent) mutable {
    held.insert(held.end(), sent.begin(), sent.end());
    sent.clear();
    for (std::uint64_t left = 1 + random() % 9; left > 0 && !held.empty(); --left) {
      sent.push_back(held.front());
      held.pop_front();
    }
  };
}

template <class AnyServer>
void check_reaches_goals(AnyServer& server, const Run& run) {
  server.check_at_goal(run);
  CHECK(run.says("connected to a Player server \"3.1.1-dev\" with a base of its driver \"p2os\""));
  CHECK_FALSE(server.has_power());
}

// Runs a system that cannot begin, and returns what it says.
std::string complaint_about(const PlayerSettings& settings) {
  Server server("server", settings);
  const Run ended = run();
  CHECK(ended.exit_code() == 3);
  return ended.err;
}

}  // namespace

TEST_CASE("messages of a Player server may come in small pieces", "[system][hardware]") {
  Server server("server");
  server.spoil(in_pieces());
  check_reaches_goals(server, run());
}

TEST_CASE("a Player server that falls silent is left, and found again", "[system][hardware]") {
  Server server("server");
  (void)run(far_goal(), [&] {
    server.set_off();
    server.fall_silent(true);
    REQUIRE(bench().until_log("is it still connected and switched on?"));
    CHECK(bench().until([&] { return server.stands(); }));
    server.fall_silent(false);
    CHECK(bench().until_log("it works again"));
    CHECK(server.stands());
  });
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
}

TEST_CASE("without sonars, bumpers and battery a Player base drives, and what is missing is said",
          "[system][hardware]") {
  PlayerSettings settings;
  settings.refused = {14};
  settings.missing = {2};
  settings.silent = {5};
  Server server("server", settings);
  (void)run({}, [&] {
    CHECK(bench().until_log("the server has no power:0; leave it out of \"uses\""));
    CHECK(bench().until_log("bumper:0 cannot be opened: its driver \"p2os\" does not start"));
    CHECK(bench().until_log("does not say where sonar:0 is, so the sonars are not used"));
    CHECK(bench().until([&] {
      return server.look(
          [](PlayerFirmware& firmware) { return firmware.is_subscribed(4) && firmware.is_subscribed(5); });
    }));
  });
}

// A p2os driver takes 2 s, and that of a SICK up to 35 s.
TEST_CASE(
    "a driver that still starts is waited for as long as \"patience\" says, and its late answer is taken",
    "[system][hardware]") {
  PlayerSettings settings;
  settings.starting = {{5, 2500ms}};
  Server server("server", settings);
  SECTION("in time") {
    const Run ended = run();
    check_reaches_goals(server, ended);
    CHECK_FALSE(ended.says("does not say where sonar:0 is"));
  }
  SECTION("late") {
    (void)run(far_goal({"--set", "robot.patience=1"}), [&] {
      CHECK(bench().until_log("so the sonars are not used until it does"));
      CHECK(bench().until_log("the server says now where sonar:0 is"));
      CHECK(bench().until([] {
        const auto sensors = bench().seat().sensors();
        const auto sonars =
            std::ranges::find(sensors, "SonarRangeReadings", &hw::HardwareSeat::Sensor::port_stem);
        return sonars != sensors.end() && bench().seat().latest(*sonars);
      }));
    });
  }
}

TEST_CASE("a device that \"uses\" does not know is found before anything is opened", "[system][hardware]") {
  const auto complaint = [](const std::string& uses) {
    const Run ended = run({"--set", "uses=" + uses});
    CHECK(ended.exit_code() == 2);
    return ended.err;
  };
  CHECK_THAT(complaint("sonar camera"), Contains("\"camera\" is none of sonar, laser, bumper, power"));
  for (const std::string wrong : {"power=ranger:0", "laser=ranger", "laser=ranger:x", "sonar=laser:0"}) {
    CAPTURE(wrong);
    CHECK_THAT(complaint(wrong), Contains("\"" + wrong + "\" is none of") && Contains("laser=ranger:1"));
  }
}

TEST_CASE("a robot whose server shows its sonars as a ranger, as Stage does, drives to its goals",
          "[system][hardware]") {
  const TempFolder folder;
  PlayerSettings settings;
  settings.shows_rangers = true;
  Server server("server", settings);
  const std::string file = folder.file("sonars.csv");
  check_reaches_goals(server, run({"--set", "uses=sonar=ranger:0 bumper power", "--record",
                                   file + "=base.SonarRangeReadingsPush"}));
  const auto rows = RecordTable(file).rows("base.SonarRangeReadingsPush");
  REQUIRE(rows.size() > 10);
  CHECK(numbers(rows.back(), "ranges").size() == 16);
}

TEST_CASE("who asks a server that has rangers for sonars is told their names", "[system][hardware]") {
  PlayerSettings settings;
  settings.shows_rangers = true;
  Server server("server", settings);
  CHECK(run().says(
      "the server has no sonar:0; it has ranger:0: if one of them is meant, write e.g. sonar=ranger:0"));
}

TEST_CASE("a bumper that is touched stops a Player base where it drives to", "[system][hardware]") {
  Server server("server");
  (void)run(far_goal(), [&] {
    server.set_off();
    server.body([](PlainBody& body) { body.touch(0x04); });
    CHECK(bench().until([&] { return !server.moves(); }));
    CHECK_FALSE(bench().until([&] { return server.moves(); }, 1s));
  });
}

TEST_CASE("a robot behind a Player server drives to its goals, and its motors are off after",
          "[system][hardware]") {
  OnNetwork server;
  check_reaches_goals(server, run_deployer(on_line("player.xml", server.address()), Seconds(60)));
}

TEST_CASE("where no Player server listens, or there is no such host, nothing starts, and that is said",
          "[system][hardware]") {
  OnNetwork gone;
  gone.shut();
  const auto complaint = [](const std::string& address) {
    const Run ended = run_deployer(on_line("player.xml", address), Seconds(60));
    CHECK(ended.exit_code() == 3);
    return ended.err;
  };
  CHECK_THAT(complaint(gone.address()),
             Contains("nothing listens on port") && Contains("is the device server running?"));
  CHECK_THAT(complaint("tcp:no-such-host.invalid:6665"), Contains("no-such-host.invalid"));
}

TEST_CASE("a connection that is cut while the base drives comes back, and the base stands until it is let go",
          "[system][hardware]") {
  OnNetwork server;
  Subprocess program(deployer(on_line("player.xml", server.address(), far_goal())));
  REQUIRE(eventually([&] { return server.moves(); }));
  server.shut();
  REQUIRE(program.wait_for_output("the other end has gone", Seconds(20 * kSlowdown)));
  CHECK(eventually([&] { return server.stands(); }));  // its driver is closed with the connection
  CHECK(program.wait_for_output("nothing listens on port", Seconds(20 * kSlowdown)));
  server.listen();
  const bool back = program.wait_for_output("it works again", Seconds(30 * kSlowdown));
  INFO(program.err());
  REQUIRE(back);
  for (int i = 0; i < 50; ++i, std::this_thread::sleep_for(10ms)) REQUIRE(server.stands());
  CHECK_FALSE(server.has_power());
  const Run counted = run_orcactl({"query", "base.DeviceStatisticsQuery", "<Ask/>"});
  CHECK_THAT(counted.out, Contains("connections=\"2\""));
  CHECK(run_orcactl({"estop", "--release"}).exit_code() == 0);
  CHECK(eventually([&] { return server.moves(); }));
  program.send(SIGINT);
  CHECK(finish(program, Seconds(20)).exit_code() == 0);
  CHECK(server.stands());
}

TEST_CASE("kill -9 of the whole system: the base stops as its connection ends", "[system][hardware]") {
  OnNetwork server;
  (void)kill_while_it_drives(server, on_line("player.xml", server.address()),
                             [&] { return server.stands(); });
}
