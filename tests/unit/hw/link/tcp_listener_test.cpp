// SPDX-License-Identifier: GPL-3.0-or-later
// A port at which clients arrive. Everything is on loopback.
#include <catch2/catch.hpp>

#include <unistd.h>

#include "link_talk.hpp"
#include "orca/hw/link/make_link.hpp"
#include "orca/hw/link/tcp_link.hpp"
#include "orca/hw/link/tcp_listener.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::link::Opening;
using hw::link::TcpLink;
using hw::link::TcpListener;

namespace {

const std::string kLoopback = "127.0.0.1";

TcpLink client_of(const TcpListener& listener) { return TcpLink({kLoopback, listener.port(), 5s}); }

Error error_of_listening(const std::string& address, std::uint16_t port) {
  TcpListener listener;
  const Status opened = listener.open(address, port);
  REQUIRE_FALSE(opened.ok());
  CHECK_FALSE(listener.is_open());
  return opened.error();
}

// Gives up the rights of the superuser, if the test has them, as long as it lives.
class OrdinaryUser {
 public:
  OrdinaryUser() {
    if (before_ == 0) REQUIRE(seteuid(65534) == 0);
  }
  ~OrdinaryUser() { (void)!seteuid(before_); }
  OrdinaryUser(const OrdinaryUser&) = delete;
  OrdinaryUser& operator=(const OrdinaryUser&) = delete;

 private:
  const uid_t before_ = geteuid();
};

// Sends a text both ways.
void check_talk(TcpLink& client, TcpLink& server, const std::string& text) {
  must_write(client, bytes_of(text));
  CHECK(text_of(read_bytes(server, text.size())) == text);
  must_write(server, bytes_of(text));
  CHECK(text_of(read_bytes(client, text.size())) == text);
}

}  // namespace

TEST_CASE("a listener at port 0 has one that is free, and names it as a driver writes it",
          "[hw][link][tcp]") {
  TcpListener first;
  TcpListener second;
  REQUIRE(first.open(kLoopback, 0).ok());
  REQUIRE(second.open(kLoopback, 0).ok());
  CHECK(first.port() >= 1024);
  CHECK(first.port() != second.port());
  CHECK(first.name() == "tcp:127.0.0.1:" + std::to_string(first.port()));
}

TEST_CASE("clients of one port are served one after the other", "[hw][link][tcp]") {
  TcpListener listener;
  REQUIRE(listener.open(kLoopback, 0).ok());
  TcpLink server(listener);
  CHECK(*server.open() == Opening::under_way);
  for (int i = 0; i < 3; ++i) {
    TcpLink client = client_of(listener);
    must_open(client);
    must_open(server);
    check_talk(client, server, "hello");
    client.close();
    CHECK(error_of_reading(server) == Code::unavailable);
    server.close();
    CHECK(*server.open() == Opening::under_way);
  }
}

TEST_CASE("a client that comes while another is served waits, and what it says is kept", "[hw][link][tcp]") {
  TcpListener listener;
  REQUIRE(listener.open(kLoopback, 0).ok());
  TcpLink server(listener);
  TcpLink first = client_of(listener);
  TcpLink second = client_of(listener);
  must_open(first);
  must_open(server);
  must_open(second);
  must_write(second, bytes_of("me too"));
  check_talk(first, server, "first");
  first.close();
  CHECK(error_of_reading(server) == Code::unavailable);
  server.close();
  must_open(server);
  CHECK(text_of(read_bytes(server, 6)) == "me too");
}

TEST_CASE("several links of one listener have a client each", "[hw][link][tcp]") {
  TcpListener listener;
  REQUIRE(listener.open(kLoopback, 0).ok());
  TcpLink one(listener);
  TcpLink other(listener);
  TcpLink first = client_of(listener);
  TcpLink second = client_of(listener);
  must_open(first);
  must_open(one);
  must_open(second);
  must_open(other);
  check_talk(first, one, "first");
  check_talk(second, other, "second");
  first.close();
  CHECK(error_of_reading(one) == Code::unavailable);
  check_talk(second, other, "still here");
}

TEST_CASE("a listener that is closed keeps its clients, refuses others, and its port is free at once",
          "[hw][link][tcp]") {
  TcpListener listener;
  REQUIRE(listener.open(kLoopback, 0).ok());
  const std::uint16_t port = listener.port();
  TcpLink server(listener);
  TcpLink client = client_of(listener);
  must_open(client);
  must_open(server);
  listener.close();
  check_talk(client, server, "goes on");
  TcpLink late({kLoopback, port, 5s});
  CHECK_FALSE(hw::link::open_within(late, 5s).ok());
  server.close();
  const auto nobody_listens = server.open();
  REQUIRE_FALSE(nobody_listens);
  CHECK(nobody_listens.error().code == Code::failed_precondition);
  CHECK(listener.open(kLoopback, port).ok());
}

TEST_CASE("a port that another program has is refused, with how to find that program", "[hw][link][tcp]") {
  TcpListener listener;
  REQUIRE(listener.open(kLoopback, 0).ok());
  const Error taken = error_of_listening(kLoopback, listener.port());
  const std::string number = std::to_string(listener.port());
  CHECK(taken.code == Code::already_exists);
  CHECK_THAT(taken.message,
             Contains("cannot listen at 127.0.0.1:" + number + ": another program has the port") &&
                 Contains("ss -ltnp 'sport = :" + number + "'") && Contains("or choose another port"));
}

TEST_CASE("an address that this machine does not have, and what is no address, are refused",
          "[hw][link][tcp]") {
  const Error foreign = error_of_listening("192.0.2.1", 0);
  CHECK(foreign.code == Code::not_found);
  CHECK_THAT(foreign.message, Contains("this machine does not have that address"));
  const Error none = error_of_listening("localhost", 0);
  CHECK(none.code == Code::invalid_argument);
  CHECK_THAT(none.message, Contains("\"localhost\" is no IPv4 address; write 127.0.0.1"));
}

TEST_CASE("a port of the system is refused to a user, with those that may be chosen", "[hw][link][tcp]") {
  const OrdinaryUser user;
  const Error privileged = error_of_listening(kLoopback, 1);
  CHECK(privileged.code == Code::failed_precondition);
  CHECK_THAT(privileged.message, Contains("choose one from 1024 to 65535"));
}

TEST_CASE("a driver waits for an emulation at a TCP port that starts later, but for nothing else",
          "[hw][link][tcp]") {
  TcpListener listener;
  REQUIRE(listener.open(kLoopback, 0).ok());
  const std::string place = listener.name();
  listener.close();
  const auto patient = hw::link::make_link("emulated:" + place);
  const auto hasty = hw::link::make_link(place);
  REQUIRE((patient && hasty));
  for (int i = 0; i < 20; ++i, std::this_thread::sleep_for(std::chrono::milliseconds(5))) {
    const auto opening = (*patient)->open();
    REQUIRE(opening);
    CHECK(*opening == Opening::under_way);
  }
  CHECK_FALSE(hw::link::open_within(**hasty, 5s).ok());
  REQUIRE(listener.open(kLoopback, listener.port()).ok());
  must_open(**patient);
}

TEST_CASE("a driver gives up when no emulation listens in time", "[hw][link][tcp]") {
  TcpListener listener;
  REQUIRE(listener.open(kLoopback, 0).ok());
  listener.close();
  TcpLink link({.host = kLoopback, .port = listener.port(), .patience = 100ms});
  CHECK(*link.open() == Opening::under_way);
  const Status opened = hw::link::open_within(link, 5s);
  REQUIRE_FALSE(opened.ok());
  CHECK_THAT(opened.error().message, Contains("nothing listens on port"));
}
