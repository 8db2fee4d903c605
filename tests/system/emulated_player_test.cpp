// SPDX-License-Identifier: GPL-3.0-or-later
// The emulated Player server as programs meet it that others have written: in the network, with habits that Orca's driver does not have.
#include <catch2/catch.hpp>

#include <string>

#include "deployer.hpp"
#include "device_on_desk.hpp"
#include "free_port.hpp"
#include "player_client.hpp"
#include "temp_folder.hpp"

using namespace orca;
using namespace orca::test;
using namespace orca::test::player;

namespace {

// A simulated Pioneer with a laser behind an emulated server; no driver of Orca's is there.
class EmulatedServer {
 public:
  EmulatedServer() : program_(deployer(Words{folder_.write("graph.xml", graph())})) {
    REQUIRE(eventually([&] { return accepts(); }));
  }
  [[nodiscard]] std::uint16_t port() const { return port_; }

 private:
  [[nodiscard]] std::string graph() const {
    const auto param = [](const std::string& name, const std::string& value) {
      return "<param name=\"" + name + "\" value=\"" + value + "\"/>";
    };
    return R"(<graph name="emulated_server" version="1"><hardware name="world" type="orca.hw.Emulated">)" +
           param("world", source_file("sim/worlds/office.xml")) +
           param("robot", source_file("sim/robots/pioneer_2dx.urdf")) + param("place", "start") +
           param("lines", "player listen:" + std::to_string(port_)) +
           R"(</hardware><component name="truth" type="orca.TruthLocalizer" hardware="world" autonomous="true"/></graph>)";
  }
  [[nodiscard]] bool accepts() const {
    const Descriptor made(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_port = htons(port_);
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    return connect(made.number(), reinterpret_cast<const sockaddr*>(&place), sizeof place) == 0;
  }

  TempFolder folder_;
  const std::uint16_t port_ = free_port();
  Subprocess program_;
};

double speed_of(const Bytes& position) { return double_at(position, 24); }

}  // namespace

TEST_CASE("a program of others lists the emulated server's devices, subscribes and drives",
          "[system][player]") {
  EmulatedServer server;
  Client client(server.port());
  CHECK(client.banner().starts_with("Player v.3.1"));
  const Answer devices = client.ask(kPlayer, 1);
  CHECK(devices.type == kAck);
  CHECK(word_at(devices.payload, 0) == 5);  // power, base, sonars, laser, bumpers
  CHECK(client.subscribe(kPosition2d).type == kAck);
  CHECK(client.subscribe(6).type == kAck);
  CHECK(client.subscribe(42).type == kNack);
  CHECK(client.ask(kPosition2d, 2, {0, 0, 0, 1}).type == kAck);
  CHECK(way_driven(client, 2s) > 0.2);
  CHECK(word_at(client.receive(6, kData).payload, 16) == 181);  // ranges
}

TEST_CASE("requests in pieces, and several in one packet, are understood", "[system][player]") {
  EmulatedServer server;
  Client client(server.port());
  Bytes wish;
  for (const std::uint32_t word : {0U, 0U, kPosition2d, 0U, 1U, 0U, 0U}) add_word(wish, word);
  const Bytes subscribe = Client::message(kPlayer, kRequest, 3, wish);
  for (const std::uint8_t byte : subscribe) client.send_bytes({byte});
  CHECK(client.receive(kPlayer, kAck).subtype == 3);
  Bytes glued = Client::message(kPosition2d, kRequest, 2, {0, 0, 0, 1});
  const Bytes geometry = Client::message(kPosition2d, kRequest, 1, {});
  glued.insert(glued.end(), geometry.begin(), geometry.end());
  client.send_bytes(glued);
  CHECK(client.receive(kPosition2d, kAck).subtype == 2);
  CHECK(client.receive(kPosition2d, kAck).subtype == 1);
}

TEST_CASE("data come by themselves, or when they are asked for", "[system][player]") {
  EmulatedServer server;
  Client client(server.port());
  CHECK(client.subscribe(kPosition2d).type == kAck);
  for (int i = 0; i < 5; ++i) CHECK(client.receive().type == kData);
  CHECK(client.ask(kPlayer, 5, {0, 0, 0, 2}).type == kAck);
  for (int round = 0; round < 3; ++round) {
    std::this_thread::sleep_for(300ms);
    client.send(kPlayer, kRequest, 4);
    CHECK(client.receive(kPlayer, kSynch).type == kSynch);
  }
}

TEST_CASE("a program that goes without a word leaves a base that stands, and the next one begins anew",
          "[system][player]") {
  EmulatedServer server;
  {
    Client client(server.port());
    CHECK(client.subscribe(kPosition2d).type == kAck);
    CHECK(client.ask(kPosition2d, 2, {0, 0, 0, 1}).type == kAck);
    CHECK(way_driven(client, 1s) > 0.05);
  }
  Client next(server.port());
  CHECK(next.banner().starts_with("Player v."));
  CHECK(next.subscribe(kPosition2d).type == kAck);
  CHECK(eventually([&] { return std::abs(speed_of(next.receive(kPosition2d, kData).payload)) < 0.01; }));
  next.drive(0.3, 0.0);  // its motors are off until it switches them on
  CHECK(std::abs(way_driven(next, 1s)) < 0.05);
}

TEST_CASE("several programs have one robot: what one of them drives the others see", "[system][player]") {
  EmulatedServer server;
  Client driver(server.port());
  Client watcher(server.port());
  Client idle(server.port());
  CHECK(watcher.subscribe(kPosition2d).type == kAck);
  CHECK(driver.subscribe(kPosition2d).type == kAck);
  CHECK(driver.ask(kPosition2d, 2, {0, 0, 0, 1}).type == kAck);
  driver.drive(0.3, 0.0);
  CHECK(eventually([&] { return speed_of(watcher.receive(kPosition2d, kData).payload) > 0.2; }));
  CHECK(word_at(idle.ask(kPlayer, 1).payload, 0) == 5);
}

TEST_CASE("a program of others watches the emulated robot while Orca's own driver drives it to a goal",
          "[system][player]") {
  const std::uint16_t port = free_port();
  Subprocess program(deployer({source_file("graphs/player_robot.xml"), "--profile", "emulate", "--set",
                               "emulated=" + std::to_string(port), "--set", "goals=door: 3.6 6 > 3.6 7.4"}));
  const bool connected = program.wait_for_output("connected to a Player server", Seconds(30 * kSlowdown));
  INFO(program.err());
  REQUIRE(connected);
  {
    Client watcher(port);
    CHECK(watcher.subscribe(kPosition2d).type == kAck);
    CHECK(eventually([&] { return speed_of(watcher.receive(kPosition2d, kData).payload) > 0.1; }));
  }
  const Run run = finish(program, Seconds(90));
  INFO(run.err);
  CHECK(run.exit_code() == 0);
  CHECK(run.arrivals().size() == 1);
}
