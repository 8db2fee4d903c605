// SPDX-License-Identifier: GPL-3.0-or-later
// The emulated Player server as programs of others meet it: over TCP, and with other habits than Orca's driver.
#include <catch2/catch.hpp>

#include <cmath>
#include <csignal>
#include <cstdint>
#include <span>
#include <string>
#include <thread>
#include <vector>

#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "free_port.hpp"
#include "orca/base/steady_clock.hpp"
#include "orca/emulators/player_firmware.hpp"
#include "player_client.hpp"
#include "tcp_front.hpp"

using namespace orca;
using namespace orca::test;
using namespace orca::test::player;

namespace {

// A Pioneer in the simulated office behind the emulated server, and no driver of Orca.
struct Office {
  Office() : program(deployer({system_graph("emulated_player.xml")})) {
    const std::string said = "an emulated player is at tcp:127.0.0.1:";
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

constexpr std::uint32_t kPush = 1, kPull = 2;

Bytes words(std::initializer_list<std::uint32_t> values) {
  Bytes bytes;
  for (const std::uint32_t value : values) add_word(bytes, value);
  return bytes;
}

Bytes glued(std::initializer_list<Bytes> messages) {
  Bytes all;
  for (const Bytes& message : messages) all.insert(all.end(), message.begin(), message.end());
  return all;
}

Bytes subscription(std::uint32_t interface) {
  return Client::message(1, kRequest, 3, words({0, 0, interface, 0, 1, 0, 0}));
}
Bytes motors_on() { return Client::message(kPosition2d, kRequest, 2, words({1})); }

struct State {
  double x = 0.0, y = 0.0;  // [m]
  double forward = 0.0;     // [m/s]
};

State next_state(Client& client) {
  const Bytes payload = client.receive(kPosition2d, kData).payload;
  REQUIRE(payload.size() == 52);
  return {double_at(payload, 0), double_at(payload, 8), double_at(payload, 24)};
}

bool comes_to(Client& client, double forward) {
  for (int i = 0; i < 100; ++i)
    if (std::abs(next_state(client).forward - forward) < 0.02) return true;
  return false;
}

// Subscribes to the base and switches its motors on.
void take_base(Client& client) {
  REQUIRE(word_at(client.subscribe(kPosition2d).payload, 16) == 1);
  REQUIRE(client.ask(kPosition2d, 2, words({1})).type == kAck);
}

std::vector<std::uint32_t> devices_of(Client& client) {
  const Bytes list = client.ask(1, 1).payload;
  REQUIRE(list.size() == 8 + 16 * word_at(list, 0));
  REQUIRE(word_at(list, 0) == word_at(list, 4));
  std::vector<std::uint32_t> interfaces;
  for (std::size_t at = 8; at < list.size(); at += 16) interfaces.push_back(word_at(list, at + 8));
  return interfaces;
}

}  // namespace

TEST_CASE(
    "a program of others finds the devices of the emulated Player server, drives its robot and sees it move",
    "[system][hardware]") {
  Office office;
  Client client(office.port);
  CHECK(client.banner().starts_with("Player v."));
  CHECK(client.banner().size() == 32);
  CHECK(devices_of(client) == std::vector<std::uint32_t>{kPosition2d, kSonar, 14, 2, kLaser});
  take_base(client);
  const State start = next_state(client);
  client.drive(0.3, 0.0);  // once: the server has no time limit
  CHECK(comes_to(client, 0.3));
  CHECK(eventually([&] { return next_state(client).x > start.x + 0.5; }));
  client.drive(0.0, 0.0);
  CHECK(comes_to(client, 0.0));
  CHECK(word_at(client.subscribe(kLaser).payload, 16) == 1);
  const Bytes scan = client.receive(kLaser, kData).payload;
  CHECK(word_at(scan, 16) == 181);
  office.program.send(SIGINT);
  CHECK(finish(office.program, Seconds(20)).exit_code() == 0);
}

TEST_CASE("a message to the emulated Player server may come in several packets, or several in one",
          "[system][hardware]") {
  Office office;
  Client client(office.port);
  const Bytes open = subscription(kPosition2d);
  for (const auto& [from, to] : {std::pair<std::size_t, std::size_t>{0, 40}, {40, 41}, {41, open.size()}}) {
    client.send_bytes(
        {open.begin() + static_cast<std::ptrdiff_t>(from), open.begin() + static_cast<std::ptrdiff_t>(to)});
    std::this_thread::sleep_for(30ms);
  }
  CHECK(word_at(client.receive(1, kAck).payload, 16) == 1);
  Bytes velocity;
  for (const double value : {0.2, 0.0, 0.0}) add_double(velocity, value);
  add_word(velocity, 1);
  client.send_bytes(glued({motors_on(), Client::message(kPosition2d, kRequest, 1, {}), subscription(kSonar),
                           Client::message(kPosition2d, kCommand, 1, velocity)}));
  CHECK(client.receive(kPosition2d, kAck).subtype == 2);
  CHECK(client.receive(kPosition2d, kAck).subtype == 1);
  CHECK(word_at(client.receive(1, kAck).payload, 8) == kSonar);
  CHECK(comes_to(client, 0.2));
}

TEST_CASE("a client of the emulated Player server may speak before it has read the banner",
          "[system][hardware]") {
  Office office;
  Client hasty(office.port, glued({subscription(kPosition2d), motors_on()}));
  CHECK(hasty.banner().starts_with("Player v."));
  CHECK(word_at(hasty.receive(1, kAck).payload, 16) == 1);
  CHECK(hasty.receive(kPosition2d, kAck).subtype == 2);
}

TEST_CASE("a client of the emulated Player server pulls its data, and then has them pushed",
          "[system][hardware]") {
  Office office;
  Client client(office.port);
  CHECK(client.ask(1, 5, words({kPull})).type == kAck);
  take_base(client);
  for (int round = 0; round < 5; ++round) {
    std::this_thread::sleep_for(150ms);
    client.send(1, kRequest, 4);
    CHECK(client.receive().type == kAck);
    const Answer data = client.receive();
    CHECK(data.type == kData);
    CHECK(data.interface == kPosition2d);
    CHECK(client.receive().type == kSynch);
  }
  CHECK(client.ask(1, 5, words({kPush})).type == kAck);
  for (int i = 0; i < 5; ++i) CHECK(client.receive().type == kData);
}

TEST_CASE("the emulated Player server refuses devices and ways that it does not know, and goes on",
          "[system][hardware]") {
  Office office;
  Client client(office.port);
  constexpr std::uint32_t kRanger = 62;
  CHECK(client.subscribe(kRanger).type == kNack);
  CHECK(client.ask(1, 2, words({0, 0, kRanger, 0, 0, 0})).type == kNack);
  CHECK(client.ask(1, 3, words({0, 0, kPosition2d, 1, 1, 0, 0})).type == kNack);  // there is one base only
  CHECK(client.ask(1, 5, words({3})).type == kNack);
  client.send(kRanger, kRequest, 1);  // no device: a server drops it
  client.send(1, kRequest, 77);       // no request
  CHECK(client.ask(1, 10, words({4, 0, 1, 1, 1})).type == kAck);
  take_base(client);
}

TEST_CASE("a client that goes without a word stops the base of the emulated Player server",
          "[system][hardware]") {
  Office office;
  {
    Client client(office.port);
    take_base(client);
    client.drive(0.3, 0.0);
    CHECK(comes_to(client, 0.3));
  }
  Client next(office.port);
  CHECK(word_at(next.subscribe(kPosition2d).payload, 16) == 1);
  CHECK(comes_to(next, 0.0));
  next.drive(0.3, 0.0);  // its motors have no power any more
  for (int i = 0; i < 10; ++i) CHECK(std::abs(next_state(next).forward) < 0.02);
}

TEST_CASE(
    "several clients of the emulated Player server have one robot, and what one reads another can drive",
    "[system][hardware]") {
  Office office;
  Client driver(office.port);
  Client watcher(office.port);
  Client idle(office.port);
  CHECK(watcher.ask(1, 5, words({kPush})).type == kAck);
  CHECK(word_at(watcher.subscribe(kPosition2d).payload, 16) == 1);
  take_base(driver);
  driver.drive(0.0, 0.3);
  CHECK(
      eventually([&] { return std::abs(double_at(watcher.receive(kPosition2d, kData).payload, 16)) > 0.2; }));
  CHECK(devices_of(idle).size() == 5);
}

TEST_CASE("a program of others watches the emulated robot while Orca's own driver drives it to a goal",
          "[system][hardware]") {
  const std::uint16_t port = free_port();
  Subprocess program(deployer({source_file("graphs/player_robot.xml"), "--profile", "emulate", "--set",
                               "port=" + std::to_string(port), "--set", "goals=door: 3.6 6 > 3.6 7.4"}));
  const bool connected = program.wait_for_output("connected to a Player server", Seconds(30 * kSlowdown));
  INFO(program.err());
  REQUIRE(connected);
  {
    Client watcher(port);
    CHECK(word_at(watcher.subscribe(kPosition2d).payload, 16) == 1);
    const State start = next_state(watcher);
    CHECK(eventually([&] { return next_state(watcher).x > start.x + 0.5; }));
  }
  const Run run = finish(program, Seconds(60));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
  CHECK(run.contacts().empty());
}

TEST_CASE("a port that is taken stops an emulation before it starts, with how to find who has it",
          "[system][hardware]") {
  TcpFront<emulators::PlayerFirmware, PlainBody> other;
  const std::string address = other.address();
  const Run run = run_deployer(
      {system_graph("emulated_player.xml"), "--set", "line=tcp:" + address.substr(address.rfind(':') + 1)});
  CHECK(run.exit_code() == 3);
  CHECK(run.says("another program has the port"));
  CHECK(run.says("or choose another port"));
}
