// SPDX-License-Identifier: GPL-3.0-or-later
// The device's side of connections, as emulators use it.
#include <catch2/catch.hpp>

#include <thread>

#include "orca/hw/link/listen_link.hpp"
#include "orca/hw/link/tcp_link.hpp"
#include "serial_line.hpp"

using namespace orca;
using namespace orca::test;
using Catch::Contains;
using hw::link::ListenLink;
using hw::link::TcpLink;

namespace {

TcpLink driver_of(const ListenLink& device) { return TcpLink({"127.0.0.1", device.port(), 5s}); }

}  // namespace

TEST_CASE("a device that listens tells that nobody is connected, until somebody is", "[hw][link][listen]") {
  ListenLink device({});
  must_open(device);
  CHECK(device.port() != 0);
  CHECK(error_of_reading(device) == Code::unavailable);
  CHECK(error_of_writing(device) == Code::unavailable);
  TcpLink driver = driver_of(device);
  must_open(driver);
  CHECK(read_some(device).empty());
  must_write(device, bytes_of("banner"));
  CHECK(text_of(read_bytes(driver, 6)) == "banner");
}

TEST_CASE("the next driver gets in when the one before has gone, and hears nothing that was meant for that",
          "[hw][link][listen]") {
  ListenLink device({});
  must_open(device);
  TcpLink first = driver_of(device);
  TcpLink second = driver_of(device);
  must_open(first);
  CHECK(read_some(device).empty());
  must_open(second);  // it waits
  must_write(second, bytes_of("hello"));
  must_write(device, bytes_of("for the first"));
  CHECK(text_of(read_bytes(first, 13)) == "for the first");
  CHECK(read_some(device).empty());
  first.close();
  CHECK(error_of_reading(device) == Code::unavailable);
  CHECK(text_of(read_bytes(device, 5)) == "hello");
  must_write(device, bytes_of("you"));
  CHECK(text_of(read_bytes(second, 3)) == "you");
}

TEST_CASE("a port that is taken, or cannot be had, is refused with what to do", "[hw][link][listen]") {
  ListenLink device({});
  must_open(device);
  ListenLink rival({.port = device.port()});
  const Error taken = error_of_opening(rival);
  CHECK(taken.code == Code::already_exists);
  CHECK_THAT(taken.text(), Contains("another program listens there; stop it, or choose another port"));

  ListenLink nowhere({.address = "somewhere"});
  CHECK(error_of_opening(nowhere).code == Code::invalid_argument);
  CHECK_THAT(error_of_opening(nowhere).text(), Contains("somewhere is no address; write 127.0.0.1"));

  ListenLink abroad({.address = "192.0.2.1"});  // a documentation address (RFC 5737)
  CHECK(error_of_opening(abroad).code == Code::not_found);
  CHECK_THAT(error_of_opening(abroad).text(), Contains("this machine does not have that address"));

  device.close();
  must_open(rival);
}

TEST_CASE("a driver with patience waits for a device that does not listen yet", "[hw][link][listen]") {
  ListenLink device({});
  must_open(device);
  const std::uint16_t port = device.port();
  device.close();
  TcpLink hasty({"127.0.0.1", port, 5s});
  CHECK(error_of_opening(hasty).code == Code::unavailable);
  TcpLink patient({"127.0.0.1", port, 5s, 60s});
  for (int i = 0; i < 3; ++i) {
    const auto opening = patient.open();
    REQUIRE(opening);
    CHECK(*opening == hw::link::Opening::under_way);
    std::this_thread::sleep_for(60ms);
  }
  ListenLink late({.port = port});
  must_open(late);
  must_open(patient);
}
