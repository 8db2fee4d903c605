// SPDX-License-Identifier: GPL-3.0-or-later
// A connection that cannot be made says why. Everything is on loopback.
#include <catch2/catch.hpp>

#include <arpa/inet.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "link_talk.hpp"
#include "orca/base/descriptor.hpp"
#include "orca/hw/link/tcp_link.hpp"
#include "tcp_socket.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::link::Opening;
using hw::link::TcpLink;

namespace {

// A port on loopback that belongs to this test; nobody listens there until listen() is called.
struct OwnPort {
  Descriptor socket{::socket(AF_INET, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
  std::uint16_t number = 0;

  OwnPort() {
    sockaddr_in place{};
    place.sin_family = AF_INET;
    place.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof place;
    REQUIRE(bind(socket.number(), reinterpret_cast<sockaddr*>(&place), size) == 0);
    REQUIRE(getsockname(socket.number(), reinterpret_cast<sockaddr*>(&place), &size) == 0);
    number = ntohs(place.sin_port);
  }
};

Error error_of_connecting(TcpLink& link) {
  const Status opened = hw::link::open_within(link, 10s);
  if (opened.ok()) FAIL("it connects");
  return opened.error();
}

}  // namespace

TEST_CASE("a port where nobody listens: refused, with what to look after", "[hw][link][tcp]") {
  const OwnPort port;
  TcpLink link({"127.0.0.1", port.number, 5s});
  const Error refused = error_of_connecting(link);
  CHECK(refused.code == Code::unavailable);
  CHECK(refused.where == "tcp:127.0.0.1:" + std::to_string(port.number));
  CHECK_THAT(refused.message, Contains("refused") && Contains("is the device server running?"));
  check_closed(link);
  REQUIRE(listen(port.socket.number(), 1) == 0);
  must_open(link);  // the next attempt begins anew
}

TEST_CASE("a host that does not exist is told by its name", "[hw][link][tcp]") {
  TcpLink link({"no..such..host", 4000, 5s});
  const Error unknown = error_of_connecting(link);
  CHECK_THAT(unknown.message, Contains("\"no..such..host\" has no address"));
  CHECK(unknown.where == "tcp:no..such..host:4000");
}

TEST_CASE("a host by its name has more than one address, and the one that answers is taken",
          "[hw][link][tcp]") {
  const OwnPort port;  // on 127.0.0.1 alone, while localhost may also be ::1
  REQUIRE(listen(port.socket.number(), 1) == 0);
  TcpLink link({"localhost", port.number, 5s});
  must_open(link);
  CHECK(link.name() == "tcp:localhost:" + std::to_string(port.number));
}

TEST_CASE("a host that does not answer is given up after the limit, and nobody waits for it meanwhile",
          "[hw][link][tcp]") {
  const OwnPort port;
  REQUIRE(listen(port.socket.number(), 0) == 0);
  // Connections that nobody accepts, until the system leaves the next one without an answer.
  std::vector<std::unique_ptr<TcpLink>> others;
  const auto is_full = [&] {
    others.push_back(std::make_unique<TcpLink>(hw::link::TcpOptions{"127.0.0.1", port.number, 10s}));
    return !hw::link::open_within(*others.back(), 200ms).ok();
  };
  bool full = false;
  for (int i = 0; i < 16 && !full; ++i) full = is_full();
  REQUIRE(full);
  TcpLink link({"127.0.0.1", port.number, 500ms});
  const Result<Opening> opening = link.open();
  REQUIRE(opening.has_value());
  CHECK(*opening == Opening::under_way);
  const Error late = error_of_connecting(link);
  CHECK(late.code == Code::deadline_exceeded);
  CHECK_THAT(late.message, Contains("timed out") && Contains("0.5"));
}

TEST_CASE("a search for a host can be given up at any time, and the next one begins anew",
          "[hw][link][tcp]") {
  const OwnPort port;
  TcpLink link({"localhost", port.number, 5s});
  for (int i = 0; i < 20; ++i) {
    (void)TcpLink({"localhost", port.number, 5s}).open();  // gone before its search has ended
    const Result<Opening> opening = link.open();
    CHECK((!opening.has_value() || *opening == Opening::under_way));
    link.close();
    check_closed(link);
  }
  REQUIRE(listen(port.socket.number(), 1) == 0);
  must_open(link);
}

TEST_CASE("an address needs no search", "[hw][link][tcp]") {
  for (const char* host : {"127.0.0.1", "::1"}) {
    const auto found = hw::link::AddressLookup(host, "4000").ask();
    REQUIRE(found.has_value());
    REQUIRE(found->has_value());
    CHECK((*found)->size() == 1);
  }
}

TEST_CASE("an IPv6 address stands in brackets in a link's name", "[hw][link][tcp]") {
  CHECK(TcpLink({"::1", 4000, 1s}).name() == "tcp:[::1]:4000");
}
