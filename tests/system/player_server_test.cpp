// SPDX-License-Identifier: GPL-3.0-or-later
// A simulated Scout as a server of Player. The client's bytes are those of the protocol's description, written out by hand.
#include <catch2/catch.hpp>

#include <csignal>
#include <cstdint>
#include <string>

#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "orca/base/steady_clock.hpp"
#include "player_client.hpp"
#include "shipped_graph.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using namespace orca::test::player;

namespace {

// The system with the Scout, at a port that the kernel has chosen.
struct Robot {
  explicit Robot(const Words& more = {}, const std::string& graph = source_file("graphs/scout_player.xml"))
      : program(deployer(Words{graph, "--set", "port=0"} + more)) {
    const std::string said = "clients of Player find the robot at 127.0.0.1:";
    const bool listens = program.wait_for_output(said, Seconds(30 * kSlowdown));
    INFO(program.err());
    REQUIRE(listens);
    REQUIRE(
        eventually([&] { return program.err().find('\n', program.err().find(said)) != std::string::npos; }));
    const std::string text = program.err();
    port = static_cast<std::uint16_t>(std::stoi(text.substr(text.find(said) + said.size())));
  }
  Subprocess program;
  std::uint16_t port = 0;
};

}  // namespace

TEST_CASE("a client of Player finds the robot's devices, subscribes to them and drives", "[system][player]") {
  Robot robot;
  Client client(robot.port);
  CHECK(client.banner().starts_with("Player v."));
  const Answer devices = client.ask(1, 1);
  REQUIRE(devices.payload.size() == 8 + 3 * 16);
  CHECK(word_at(devices.payload, 0) == 3);
  CHECK(word_at(devices.payload, 4) == 3);
  CHECK(word_at(devices.payload, 8) == 0x0100007F);  // 127.0.0.1
  CHECK(word_at(devices.payload, 12) == robot.port);
  CHECK(word_at(devices.payload, 16) == kPosition2d);
  CHECK(word_at(devices.payload, 32) == kSonar);
  CHECK(word_at(devices.payload, 48) == kRanger);

  const Answer base = client.subscribe(kPosition2d);
  CHECK(base.type == kAck);
  CHECK(word_at(base.payload, 16) == 1);  // open
  CHECK(client.subscribe(kSonar).type == kAck);
  CHECK(client.subscribe(6).type == kNack);  // it has no laser
  CHECK(client.ask(kPosition2d, 2, {0, 0, 0, 1}).type == kAck);

  const Answer geometry = client.ask(kPosition2d, 1);
  CHECK(double_at(geometry.payload, 6 * 8) == Approx(0.41).margin(0.05));
  const Answer ranges = client.receive(kSonar, kData);
  CHECK(word_at(ranges.payload, 0) == 16);
  const Answer poses = client.ask(kSonar, 1);
  CHECK(word_at(poses.payload, 0) == 16);
  CHECK(poses.payload.size() == 8 + 16 * 48);
  CHECK(way_driven(client, 2s) > 0.2);
}

TEST_CASE("the robot stops when a client of Player says nothing more, and when it goes", "[system][player]") {
  Robot robot;
  Client watcher(robot.port);
  CHECK(watcher.subscribe(kPosition2d).type == kAck);
  const auto stands_soon = [&] {
    return eventually([&] {
      const Bytes state = watcher.receive(kPosition2d, kData).payload;
      return std::abs(double_at(state, 24)) < 0.01;
    });
  };
  {
    Client driver(robot.port);
    CHECK(driver.subscribe(kPosition2d).type == kAck);
    CHECK(way_driven(driver, 1s) > 0.05);
    CHECK(stands_soon());  // it is still there
    CHECK(way_driven(driver, 1s) > 0.05);
  }
  CHECK(stands_soon());
}

TEST_CASE("motors that a client of Player has switched off do not turn", "[system][player]") {
  Robot robot;
  Client client(robot.port);
  CHECK(client.subscribe(kPosition2d).type == kAck);
  CHECK(client.ask(kPosition2d, 2, {0, 0, 0, 0}).type == kAck);
  CHECK(std::abs(way_driven(client, 1s)) < 0.01);
  CHECK(client.ask(kPosition2d, 2, {0, 0, 0, 1}).type == kAck);
  CHECK(way_driven(client, 1s) > 0.05);
}

TEST_CASE("the log says which commands of a client of Player are not carried out, once each",
          "[system][player]") {
  Robot robot;
  Client client(robot.port);
  CHECK(client.subscribe(kPosition2d).type == kAck);
  const std::string said = "it commands what is not carried out (interface 4, command 2): only velocities";
  for (int i = 0; i < 3; ++i) client.send(kPosition2d, kCommand, 2, Bytes(52, 0));
  CHECK(client.ask(kPosition2d, 3, {0, 0, 0, 0}).type == kAck);
  CHECK(robot.program.wait_for_output(said, Seconds(5 * kSlowdown)));
  const std::string text = robot.program.err();
  CHECK(text.find(said, text.find(said) + 1) == std::string::npos);
}

TEST_CASE("in pull mode a client of Player gets the newest of each device, and the end of the round",
          "[system][player]") {
  Robot robot;
  Client client(robot.port);
  CHECK(client.ask(1, 5, {0, 0, 0, 2}).type == kAck);
  CHECK(client.subscribe(kPosition2d).type == kAck);
  for (int round = 0; round < 3; ++round) {
    std::this_thread::sleep_for(300ms);
    client.send(1, kRequest, 4);
    CHECK(client.receive().type == kAck);
    CHECK(client.receive().type == kData);  // one, although several have come
    CHECK(client.receive().type == kSynch);
  }
}

TEST_CASE("a client of Player sets its odometry to 0, and another's stays", "[system][player]") {
  Robot robot;
  Client client(robot.port);
  Client other(robot.port);
  CHECK(client.subscribe(kPosition2d).type == kAck);
  CHECK(other.subscribe(kPosition2d).type == kAck);
  CHECK(way_driven(client, 2s) > 0.2);
  CHECK(client.ask(kPosition2d, 6).type == kAck);
  CHECK(std::abs(double_at(client.receive(kPosition2d, kData).payload, 0)) < 0.2);
  double there = 0.0;
  for (int i = 0; i < 20; ++i) there = double_at(other.receive(kPosition2d, kData).payload, 0);
  CHECK(there > 0.1);
}

TEST_CASE("a client that sends no messages of Player is cut off, and others go on", "[system][player]") {
  Robot robot;
  Client good(robot.port);
  CHECK(good.subscribe(kPosition2d).type == kAck);
  Client bad(robot.port);
  bad.send_bytes(Bytes(4096, 0xFF));
  CHECK(bad.is_cut_off());
  CHECK(robot.program.wait_for_output("is no longer served", Seconds(10)));
  CHECK(way_driven(good, 1s) > 0.05);
}

TEST_CASE("a client that does not read delays nobody", "[system][player]") {
  Robot robot;
  Client lazy(robot.port);
  CHECK(lazy.subscribe(kPosition2d).type == kAck);
  CHECK(lazy.subscribe(kSonar).type == kAck);
  Client good(robot.port);
  CHECK(good.subscribe(kPosition2d).type == kAck);
  CHECK(way_driven(good, 5s) > 0.8);
}

TEST_CASE("a robot that a client of Player drives is stopped when the server or the avoider fails",
          "[system][player]") {
  for (const char* behaviour : {"player", "avoid"})
    for (const char* how : {"silent", "throw", "hang", "slow"}) {
      Robot robot({"--fail", std::string(behaviour) + "=" + how + "@1s"});
      Client client(robot.port);
      CAPTURE(behaviour, how);
      CHECK(client.subscribe(kPosition2d).type == kAck);
      const auto says = [&] { return robot.program.err().find("stops the robot: ") != std::string::npos; };
      const TimePoint end = steady_now() + 20s * static_cast<int>(kSlowdown);
      while (!says() && steady_now() < end) {
        (void)client.tries_to_drive(0.0, 0.5);
        std::this_thread::sleep_for(50ms);
      }
      INFO(robot.program.err());
      CHECK(says());
    }
}

TEST_CASE("a client that comes at once is told where the sonars sit", "[system][player]") {
  Robot robot;
  Client client(robot.port);
  const Answer poses = client.ask(kSonar, 1);
  CHECK(poses.type == kAck);
  CHECK(word_at(poses.payload, 0) == 16);
}

TEST_CASE("a client of Player that knows rangers finds the sonars as ranger:0", "[system][player]") {
  Robot robot;
  Client client(robot.port);
  CHECK(client.subscribe(kRanger).type == kAck);
  CHECK(client.subscribe(kSonar).type == kAck);
  const Answer geometry = client.ask(kRanger, 1);
  REQUIRE(geometry.payload.size() == 9 * 8 + 8 + 16 * 48 + 8 + 16 * 24);
  const Answer places = client.ask(kSonar, 1);
  CHECK(Bytes(geometry.payload.begin() + 72, geometry.payload.begin() + 72 + 8 + 16 * 48) == places.payload);
  const Answer config = client.ask(kRanger, 5);
  REQUIRE(config.payload.size() == 7 * 8);
  CHECK(double_at(config.payload, 8) == -double_at(config.payload, 0));  // what one of them hears
  CHECK(double_at(config.payload, 32) > 1.0);                            // how far
  const Answer ranges = client.receive(kRanger, kData);
  REQUIRE(ranges.payload.size() == 8 + 16 * 8);
  for (std::size_t i = 0; i < 16; ++i) CHECK(double_at(ranges.payload, 8 + 8 * i) > 0.1);
  CHECK(client.ask(kRanger, 2, {0, 0, 0, 1}).type == kNack);  // they are always on
}

TEST_CASE("a system of Orca drives another one's robot by the driver for servers of Player",
          "[system][player]") {
  Robot robot;
  const TempFolder folder;
  Subprocess program(
      Words{"/usr/bin/env", "XDG_RUNTIME_DIR=" + folder.path().string()} +
      deployer({system_graph("player.xml"), "--set", "device=tcp:127.0.0.1:" + std::to_string(robot.port),
                "--set", "uses=sonar=ranger:0"}));
  const Run run = finish(program, Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  REQUIRE(run.arrivals().size() == 2);
  CHECK(std::abs(run.arrivals()[1].x - 0.6) < 0.3);
  CHECK(std::abs(run.arrivals()[1].y - 0.4) < 0.3);
}

TEST_CASE("when the code of the server is exchanged, clients of Player find the robot again",
          "[system][player]") {
  Robot robot;
  const std::string port = std::to_string(robot.port);
  // The new code has to get the same port, so the parameter names it.
  robot.program.send(SIGINT);
  (void)finish(robot.program, Seconds(20));
  Subprocess again(deployer({source_file("graphs/scout_player.xml"), "--set", "port=" + port}));
  REQUIRE(again.wait_for_output("clients of Player find the robot at", Seconds(30 * kSlowdown)));
  const Run swapped = run_orcactl(
      Words{"swap", "player", ORCA_BINARY_DIR "/plugins/player_server.so", "--untried"} + kBriefly);
  INFO(swapped.out << swapped.err << again.err());
  CHECK(swapped.exit_code() == 0);
  const std::string said = "clients of Player find the robot at";
  REQUIRE(eventually([&] { return again.err().find(said) != again.err().rfind(said); }));
  Client client(robot.port);
  CHECK(client.subscribe(kPosition2d).type == kAck);
  CHECK(way_driven(client, 1s) > 0.05);
}

TEST_CASE("without avoid a client of Player that drives ahead meets the wall, with it not",
          "[system][player][ablation]") {
  for (const bool avoids : {true, false}) {
    const TempFolder folder;
    ShippedGraph graph("scout_player");
    if (!avoids) graph.remove("avoid");
    Robot robot({"--set", "scout.place=", "--set", "scout.x=3.5 m", "--set", "scout.y=6 m"},
                folder.write("graph.xml", graph.text()));
    Client client(robot.port);
    CHECK(client.subscribe(kPosition2d).type == kAck);
    for (const TimePoint end = steady_now() + (avoids ? 10s : 30s);
         steady_now() < end && robot.program.out().find("contact") == std::string::npos;)
      (void)way_driven(client, 500ms);
    CAPTURE(avoids);
    INFO(robot.program.err());
    CHECK((robot.program.out().find("contact") != std::string::npos) == !avoids);
  }
}

TEST_CASE("without any other component of the graph for Player the robot stands",
          "[system][player][ablation]") {
  for (const char* component : {"fuser", "base"}) {
    Robot robot({"--fail", std::string(component) + "=silent@1s"});
    Client client(robot.port);
    CHECK(client.subscribe(kPosition2d).type == kAck);
    std::this_thread::sleep_for(1500ms);
    client.drive(0.3, 0.0);
    const Bytes state = client.receive(kPosition2d, kData).payload;
    CAPTURE(component);
    CHECK(std::abs(double_at(state, 24)) < 0.01);
  }
}
